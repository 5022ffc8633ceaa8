// Classes of ground in cells: areas, holes, order.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "site/ground_classes.hpp"

namespace {

using talus::GroundArea;
using talus::Trn;
using talus::Vec2;

Trn grid(int n_rows, int n_cols, double cell) {
  Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = cell;
  trn.node0 = {-7.5, 31};
  trn.elevation.assign(static_cast<std::size_t>(n_rows) * static_cast<std::size_t>(n_cols), 0);
  return trn;
}

// Winding by angles: another method to ask whether a point lies in a ring.
bool is_inside(const std::vector<Vec2>& ring, const Vec2& point) {
  double angle = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - point, b = ring[(i + 1) % ring.size()] - point;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(angle) > 3;
}

std::vector<std::uint8_t> painted(const Trn& trn, const std::vector<talus::GroundArea>& areas,
                                  std::uint8_t elsewhere) {
  std::vector<std::uint8_t> classes(static_cast<std::size_t>((trn.n_rows - 1) * (trn.n_cols - 1)),
                                    elsewhere);
  talus::paint_areas(trn, areas, classes);
  return classes;
}

TEST(GroundClasses, HoldForCellsWhoseCentreLiesInside) {
  talus::Random random(1, "classes");
  const Trn trn = grid(21, 31, 2.5);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec2> ring;  // star-shaped, so that it does not cross itself
    const Vec2 middle(random.uniform(-10, 60), random.uniform(-20, 30));
    for (int i = 0; i < 9; ++i) {
      const double angle = 2 * 3.14159265 * i / 9;
      ring.push_back(middle + random.uniform(3, 25) * Vec2(std::cos(angle), std::sin(angle)));
    }
    const auto classes = painted(trn, {{3, {ring}}}, 1);
    for (int row = 0; row < 20; ++row)
      for (int col = 0; col < 30; ++col) {
        const Vec2 centre = trn.node0 + 2.5 * Vec2(col + 0.5, -row - 0.5);
        ASSERT_EQ(classes[static_cast<std::size_t>(row * 30 + col)],
                  is_inside(ring, centre) ? 3 : 1)
            << trial << " " << row << " " << col;
      }
  }
}

TEST(GroundClasses, OfLaterAreasWinAndHolesAreHoles) {
  const Trn trn = grid(11, 11, 1);
  const auto square = [&](double low, double high) {
    const Vec2 corner(trn.node0.x(), trn.node0.y() - 10);
    return std::vector<Vec2>{corner + Vec2(low, low), corner + Vec2(high, low),
                             corner + Vec2(high, high), corner + Vec2(low, high)};
  };
  const auto classes = painted(trn, {{1, {square(1, 9), square(4, 6)}}, {2, {square(8, 10)}}}, 0);
  const auto at = [&](int x, int y) { return classes[static_cast<std::size_t>((9 - y) * 10 + x)]; };
  EXPECT_EQ(at(0, 0), 0);
  EXPECT_EQ(at(1, 1), 1);
  EXPECT_EQ(at(5, 5), 0);
  EXPECT_EQ(at(8, 8), 2);
  EXPECT_EQ(at(9, 9), 2);
  EXPECT_EQ(at(7, 7), 1);
}

talus::Site site_of(const std::vector<talus::GroundSettings>& grounds) {
  talus::Site site;
  site.file = "site.toml";
  site.grounds = grounds;
  site.terrain.ground_raster = "classes.tif";
  return site;
}

talus::GroundSettings ground_of(const std::string& name, const std::vector<double>& values) {
  talus::GroundSettings ground;
  ground.name = name;
  ground.raster_values = values;
  return ground;
}

TEST(GroundSections, OneHoldsElsewhere) {
  talus::GroundSettings scree = ground_of("scree", {});
  scree.polygon = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(
      talus::ground_elsewhere(site_of({scree, ground_of("rock", {}), ground_of("wood", {4})})), 1);
  EXPECT_THROW(
      (void)talus::ground_elsewhere(site_of({ground_of("rock", {}), ground_of("soil", {})})),
      talus::InputError);
  EXPECT_THROW((void)talus::ground_elsewhere(site_of({scree, ground_of("wood", {4})})),
               talus::InputError);
}

TEST(GroundSections, AreFoundByTheValuesOfTheRaster) {
  const talus::Site site =
      site_of({ground_of("rock", {}), ground_of("wood", {4, 5}), ground_of("scree", {-2})});
  const auto class_of = talus::classes_of_values(site);
  const std::vector<std::uint8_t> expected = {1, 0, 2, 1};
  EXPECT_EQ(talus::classes_of_cells({4, talus::no_class, -2, 5}, class_of, 0, "classes.tif"),
            expected);
  EXPECT_THROW((void)talus::classes_of_cells({4, 7}, class_of, 0, "classes.tif"),
               talus::InputError);
}

TEST(GroundSections, AreRefusedForValuesOfNoUse) {
  const auto refused = [](const talus::Site& site) {
    EXPECT_THROW((void)talus::classes_of_values(site), talus::InputError);
  };
  refused(site_of({ground_of("wood", {4.5})}));
  refused(site_of({ground_of("wood", {4}), ground_of("scree", {1, 4})}));
  talus::Site without_raster = site_of({ground_of("wood", {4})});
  without_raster.terrain.ground_raster = "";
  refused(without_raster);
}

}  // namespace
