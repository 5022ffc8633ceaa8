// The lifted failure surface: known shares of hollows, clearance along the motion.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/daylight_envelope.hpp"
#include "blocks/source.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// 45 degrees down to the south.
Trn even_slope(double cell) {
  const int n = static_cast<int>(200 / cell) + 1;
  return grid(n, n, cell, [](double, double y) { return y; });
}

SourceMass hollow_in(const Trn& ground, const Area& area) {
  SourceOptions options;
  options.kind = FailureSurface::vertical_depth;
  options.depth = 10;
  return find_source(ground, area, options, {});
}

SourceMass lifted(const Trn& ground, const Area& area, const DaylightDirection& direction) {
  SourceMass mass = hollow_in(ground, area);
  Trn bed = lifted_to_daylight(ground, area, mass.bed, direction);
  return mass_over(ground, area, std::move(mass), std::move(bed), {});
}

const Area hundred_long{{{{50, 40}, {130, 40}, {130, 140}, {50, 140}}}};

}  // namespace

// 10 m deep, 100 m long, 45 degrees; along 35 degrees it keeps 1 - d / (2 L (tan b - tan a)).
TEST(DaylightEnvelope, KeepsTheKnownShareOfAnEvenHollow) {
  const double exact = 1 - 10 / (2 * 100 * (1 - std::tan(35 * degree)));
  EXPECT_NEAR(exact, 0.83322, 5e-6);
  for (const double cell : {4.0, 2.0, 1.0}) {
    const Trn ground = even_slope(cell);
    const SourceMass whole = hollow_in(ground, hundred_long);
    const SourceMass left = lifted(ground, hundred_long, {180 * degree, 35 * degree, 0});
    EXPECT_NEAR(left.volume / whole.volume, exact, 0.006 * cell) << cell;
  }
}

TEST(DaylightEnvelope, NothingStandsBeforeAnyPointOfIt) {
  const Trn ground = grid(
      101, 101, 2, [](double x, double y) { return y + 3 * std::sin(x / 9) * std::cos(y / 7); });
  const DaylightDirection direction{180 * degree, 35 * degree, 0};
  const SourceMass mass = lifted(ground, hundred_long, direction);
  for (const int node : mass.nodes) {
    const Vec3 at = node_point(mass.bed, node / ground.n_cols, node % ground.n_cols);
    if (at.y() <= 40 || at.y() >= 140 || at.x() <= 50 || at.x() >= 130) continue;
    for (double r = 1; r < at.y() - 40 + 6; r += 1) {
      const bool inside = at.y() - r >= 40;
      const double ahead = elevation_at(inside ? mass.bed : ground, at.x(), at.y() - r);
      EXPECT_LE(ahead, at.z() - r * std::tan(35 * degree) + 1e-6) << at.transpose() << " " << r;
    }
  }
}

// A bed that comes out already is left as it is.
TEST(DaylightEnvelope, LeavesAPlaneThatDaylights) {
  const Trn ground = even_slope(2);
  SourceOptions options;
  options.kind = FailureSurface::plane;
  options.plane_dip = 38 * degree;
  options.plane_dip_direction = 180 * degree;
  options.plane_point = Vec3(90, 40, 40);
  SourceMass mass = find_source(ground, hundred_long, options, {});
  const double volume = mass.volume;
  Trn bed = lifted_to_daylight(ground, hundred_long, mass.bed, {180 * degree, 35 * degree, 0});
  mass = mass_over(ground, hundred_long, std::move(mass), std::move(bed), {});
  EXPECT_NEAR(mass.volume, volume, 0.002 * volume);
}

// A rib ahead of one half of the source holds blocks that are wider than the gap beside it.
TEST(DaylightEnvelope, WiderBlocksMeetMore) {
  const Trn ground = grid(101, 101, 2, [](double x, double y) {
    return y + (std::fmod(x, 20) < 6 && y < 40 && y > 30 ? 6 : 0);
  });
  const double narrow = lifted(ground, hundred_long, {180 * degree, 35 * degree, 0}).volume;
  const double wide = lifted(ground, hundred_long, {180 * degree, 35 * degree, 8}).volume;
  EXPECT_LT(wide, 0.99 * narrow);
}
