// Units of plan and heights of layers.
#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct DeclareUnits : ImportTest {
  RawInputs declared() {
    RawInputs raw = open_all(request);
    declare_heights(raw);
    declare_plan_units(raw);
    declare_place(raw);
    declare_height_units(raw);
    return raw;
  }
};

TEST_F(DeclareUnits, AUnitThatIsGivenHoldsForPlanAndHeightOfItsLayerAlone) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[2132546,17060367,344]", ""}}));
  request.layers[1].ref.unit_m = 0.3048;
  const RawInputs raw = declared();
  EXPECT_EQ(raw.layers[0].lines.points[0], Vec3(650000, 5200000, 100));
  EXPECT_EQ(raw.layers[0].taken.unit_m, 1);
  EXPECT_EQ(raw.layers[1].taken.unit_m, 0.3048);
  EXPECT_NEAR(raw.layers[1].lines.points[0].x(), 650000, 1);
}

TEST_F(DeclareUnits, OneUnitOfElevationsHoldsForAll) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[650010,5200010,344]", ""}}));
  request.elevation_unit_m = 0.3048;
  for (const RawLayer& layer : declared().layers) EXPECT_EQ(layer.taken.unit_m, 0.3048);
}

TEST_F(DeclareUnits, AFieldInFeetByItsNameIsRefusedInEveryLayer) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[650010,5200010]", "\"height_ft\":344"}}));
  EXPECT_NE(error_of([&] { (void)declared(); }).find("is in feet by its name"), std::string::npos);
}

// Heights of a plan in feet may be in feet or in metres.
TEST_F(DeclareUnits, APlanInFeetLeavesTheUnitOfHeightsOpen) {
  for (const InputRole role : {InputRole::spots, InputRole::reference}) {
    request = {};
    request.has_frame = true;
    request.frame = crs_from_user("EPSG:32612", "a test");
    ask(role, file("spots", 2222, {{"Point", "[700000,1000000,344]", ""}}));
    EXPECT_NE(error_of([&] { (void)declared(); }).find("nothing says what unit the heights"),
              std::string::npos);
  }
}

}  // namespace
