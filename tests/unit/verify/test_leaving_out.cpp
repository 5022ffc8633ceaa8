// Parts that the scene plan leaves out, against the same scene with them kept: to the bit, or
// within the bounds of docs/evidence/verification.md.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "base/read_file.hpp"
#include "verify/study/leaving_out.hpp"

namespace talus {

void PrintTo(const Omission& omission, std::ostream* out) {
  *out << omission.item << ", " << omission.scene;
}

}  // namespace talus

namespace {

using namespace talus;

const SlideData& slide() {
  static const std::string data = std::string(TALUS_SOURCE_DIR) + "/tests/data/";
  static const SlideData read =
      read_slide(read_file(data + "terrain_F.asc"), read_file(data + "blocks_39.obj"));
  return read;
}

class LeavingOut : public testing::TestWithParam<Omission> {};

std::string name_of(const testing::TestParamInfo<Omission>& info) {
  std::string name = info.param.item + "_" + info.param.scene;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Plan, LeavingOut, testing::ValuesIn(omissions(slide(), false)), name_of);

TEST_P(LeavingOut, ChangesNoMoreThanItMay) {
  const OmissionRow row = compare(GetParam(), 1);
  EXPECT_TRUE(row.holds) << row.apart << " m apart, allowed " << row.limit << " m";
  EXPECT_GT(row.shown, 0) << "the scene does not show it";
  EXPECT_GT(row.path, 0);
}

// The comparison itself sees a part that is left out though it matters.
TEST(LeavingOutSees, AnythingThatChangesTheAnswer) {
  Omission wrong = omissions(slide(), false).front();
  const auto run = wrong.run;
  wrong.run = [run](bool kept) {
    OmissionRun out = run(true);
    if (!kept) out.places[0].x() += 2e-9;
    return out;
  };
  EXPECT_FALSE(compare(wrong, 1).holds);
  wrong.matters = true;
  EXPECT_TRUE(compare(wrong, 1).holds);
  wrong.tolerance = 0;  // to the bit
  wrong.run = [run](bool kept) {
    OmissionRun out = run(true);
    if (!kept) out.numbers[0] = std::nextafter(out.numbers[0], 1e9);
    return out;
  };
  EXPECT_FALSE(compare(wrong, 1).holds);
}

}  // namespace
