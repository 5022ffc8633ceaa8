// Events within a step of a lone block happen at their time: errors fall with the square of
// the step, at long steps too.
#include <gtest/gtest.h>

#include "verify/cases/closed_form.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

CaseSettings with_step(double dt) {
  CaseSettings settings;
  settings.dt = dt;
  return settings;
}

TEST(Events, PrismsRollHitByHit) {
  for (const Rolling& rolling : rolling_prisms) {
    EXPECT_LT(prism_rolls({}, rolling, 2).error, 1e-3) << rolling.n_sides;
    EXPECT_LT(prism_rolls(with_step(0.02), rolling, 2).error, 5e-3) << rolling.n_sides;
  }
}

TEST(Events, AFlatSlabBouncesDownASlope) {
  for (const double restitution : {0.3, 0.5, 0.8, 0.9}) {
    EXPECT_LT(bouncing_slab({}, restitution).error, 1e-3) << restitution;
    EXPECT_LT(bouncing_slab(with_step(0.02), restitution).error, 5e-3) << restitution;
  }
}

TEST(Events, ATopNutates) {
  EXPECT_LT(spinning_top({}, 60).error, 0.1);
  EXPECT_LT(spinning_top({}, 30).error, 0.1);
}

TEST(Events, DroppingGroundLetsGoInTheMiddleOfAStep) {
  EXPECT_LT(lifted_slab({}).error, 1e-3);
  EXPECT_LT(lifted_slab(with_step(0.02)).error, 5e-3);
}

TEST(Events, AHarmonicMotionSlidesASlab) {
  EXPECT_LT(harmonic_slide({}).error, 1e-3);
  EXPECT_LT(harmonic_slide(with_step(0.02)).error, 5e-3);
}

TEST(Events, ASlabTipsOverAnEdge) {
  EXPECT_LT(slab_over_edge({}).error, 1e-3);
  EXPECT_LT(slab_over_edge(with_step(0.02)).error, 5e-3);
}

TEST(Events, FrictionChangesWhereTheBorderIs) {
  EXPECT_LT(border_slide({}).error, 1e-4);
  EXPECT_LT(border_slide(with_step(0.02)).error, 1e-3);
}

}  // namespace
