// Law paper on the paper's four benchmarks: what the printed method gives, bounded loosely, since
// its errors are its own (docs/evidence/verification.md reports them). What it must do exactly is
// asserted tightly.
#include <gtest/gtest.h>

#include "step/step.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

Settings law_paper(double dt, double normal_stiffness) {
  Settings settings;
  settings.law = Law::paper;
  settings.dt = dt;
  settings.normal_stiffness = normal_stiffness;
  return settings;
}

TEST(LawPaper, ParabolaIsExact) {  // Fig. 9: the scheme is exact for a constant force
  EXPECT_LT(parabola(law_paper(1e-2, 5e10)).error, 1e-11);
  EXPECT_LT(parabola(law_paper(1e-4, 5e10)).error, 1e-11);
}

TEST(LawPaper, SlidesNearTheClosedForm) {  // Fig. 10
  EXPECT_LT(sliding(law_paper(1e-4, 5e10), 0, 37, 1).error, 1e-6);
  for (const double friction : {5.0, 10.0, 15.0, 20.0})
    EXPECT_LT(sliding(law_paper(1e-4, 5e10), friction, 37, 1).error, 5e-3) << friction;
  EXPECT_LT(sliding(law_paper(1e-4, 5e10), 35, 37, 1).error,
            5e-3);  // creep [m]: it does not quite stick
}

// Keel in a valley: its vertices touch both planes, each with the friction of its own normal force.
TEST(LawPaper, WedgeSlidesNearTheClosedForm) {
  EXPECT_LT(wedge(law_paper(1e-4, 5e10), 20).error, 1e-3);
}

TEST(LawPaper, PrismStartsToRollNearTheCriticalAngle) {  // Fig. 11, (27)
  for (const int n : {3, 6, 12}) EXPECT_LT(rolling_angle(law_paper(1e-3, 1e9), n).error, 0.5) << n;
}

TEST(LawPaper, PostAdjustmentGivesTheRestitutionOfOneBounce) {  // Fig. 12a, (28)
  for (const double restitution : {0.7, 1.0})
    EXPECT_LT(bounce(law_paper(1e-4, 5e10), restitution, Landing::face).error, 5e-3) << restitution;
}

// Fig. 12b: elastic block, no post-adjustment. Restitution grows with E and tends to 1 when both E
// and k_n grow, each step of the integrator being short against the hit.
TEST(LawPaper, ElasticRestitutionTendsToOne) {
  double last = 0;
  for (const double young : {1e8, 1e9, 1e10, 1e11, 1e12}) {
    const double now = elastic_restitution(law_paper(1e-6, 1e9), young).value;
    EXPECT_GT(now, last - 1e-3) << young;
    EXPECT_LT(now, 1 + 1e-6);
    last = now;
  }
  EXPECT_GT(last, 0.99);
  EXPECT_LT(elastic_restitution(law_paper(1e-6, 1e11), 1e8).value, 0.85);
}

// What a shaken ground does to a block is put in, not gained.
TEST(LawPaper, WorkOfTheBaseMotionIsBooked) {
  using namespace cases;
  const SlopeFrame flat = slope_frame(0, 0);
  const Body cube = body_of(box_in(flat, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  Scene scene = scene_of(plane_trn(flat, 1, 20), GroundClass{}, {cube}, law_paper(1e-3, 5e8));
  scene.base = {{0, 10}, {Vec3(-5, 0, 0), Vec3(-5, 0, 0)}, {}};
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < 0.5) step(scene, state, work);
  const double way = state.motion[0].pose.position.x() - scene.blocks.rest[0].position.x();
  EXPECT_NEAR(way, 5 * 0.5 * 0.5 / 2, 0.02);
  EXPECT_NEAR(state.ledger.base, scene.blocks.mass[0] * 5 * way, 1e-6 * state.ledger.base);
}

TEST(LawPaper, OwnWeightStressesTheBlock) {
  EXPECT_LT(own_weight(law_paper(1e-3, 5e10)).error, 1e-2);
}

}  // namespace
