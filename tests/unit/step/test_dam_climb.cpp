// A block of known energy against the uphill face of a dam: it climbs v^2 / 2g / (1 + mu / tan
// beta), and passes over the crest when that is more than the crest stands above it.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "step/step.hpp"
#include "terrain/dam.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double height = 8, half_crest = 1, friction_deg = 25;

struct Climb {
  double rise = 0;  // of the centroid, at most [m]
  double x = 0;     // where it came to, at most [m]
  double start_below_crest = 0;
};

// A dam along y on level ground with a face of `slope_deg`; a slab slides up from a metre above
// its foot, with `share` of the energy that brings its centroid to the height of the crest.
Climb climb(double slope_deg, double share) {
  const double beta = slope_deg * degree, run = height / std::tan(beta);
  Trn trn = make_trn([](double, double) { return 0.0; }, 0.5, 60);
  DamShape shape;
  shape.line = {{0, -30}, {0, 30}};
  shape.height = height;
  shape.crest_width = 2 * half_crest;
  shape.tan_uphill = shape.tan_downhill = std::tan(beta);
  Dam dam;
  EXPECT_EQ(lay_dam(trn, shape, dam).kind, DamFault::none);
  const DamBurn burn = burn_dam(dam, trn);
  EXPECT_EQ(burn.fault.kind, DamFault::none);
  EXPECT_LT(burn.crest_loss, 1e-9);

  const SlopeFrame face = slope_frame(slope_deg, 180);  // dips towards -x
  const Vec3 foot(-half_crest - run, 0, 0), base = foot - 2 * face.dip;
  const Vec3 half(0.5, 0.5, 0.1);
  Climb out;
  out.start_below_crest = height - (base + 0.1 * face.normal).z();
  const double mu = std::tan(friction_deg * degree);
  const double speed =
      std::sqrt(2 * 10 * share * out.start_below_crest * (1 + mu / std::tan(beta)));
  const Scene scene = scene_of(
      trn, ground_of(friction_deg),
      {body_of(box_in(face, base, Vec3(-half.x(), -half.y(), 0), Vec3(half.x(), half.y(), 0.2)),
               -speed * face.dip)},
      {}, {2600, 5e9, 0.25});
  State state = start(scene);
  Work work = make_work(scene);
  const Vec3 from = state.motion[0].pose.position;
  out.x = from.x();
  while (state.time < 6) {
    step(scene, state, work);
    out.rise = std::max(out.rise, state.motion[0].pose.position.z() - from.z());
    out.x = std::max(out.x, state.motion[0].pose.position.x());
  }
  return out;
}

TEST(DamClimb, ABlockStopsBelowTheCrestWhereItsEnergyIsUsedUp) {
  for (const double slope_deg : {30.0, 45.0, 60.0})
    for (const double share : {0.3, 0.6, 0.9}) {
      const Climb at = climb(slope_deg, share);
      EXPECT_NEAR(at.rise, share * at.start_below_crest, 0.01 * at.start_below_crest)
          << slope_deg << " " << share;
      EXPECT_LT(at.x, -half_crest);
    }
}

TEST(DamClimb, ABlockWithMorePassesOverIt) {
  for (const double slope_deg : {30.0, 45.0, 60.0}) {
    EXPECT_GT(climb(slope_deg, 1.05).x, -half_crest) << slope_deg;
    EXPECT_GT(climb(slope_deg, 2).x, half_crest) << slope_deg;
  }
}

}  // namespace
