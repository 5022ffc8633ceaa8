// Law paper on the paper's four benchmarks and on blocks that meet: results of the printed method,
// bounded loosely, since its errors are its own (docs/evidence/verification.md reports them). Exact
// properties are asserted tightly.
#include <gtest/gtest.h>

#include "verify/cases/block_cases.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

CaseSettings law_paper(double dt, double normal_stiffness) {
  CaseSettings settings;
  settings.paper.emplace();
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

// Energy of a block from a shaken ground is put in, not gained.
TEST(LawPaper, WorkOfTheBaseMotionIsBooked) {
  const SlopeFrame flat = slope_frame(0, 0);
  const Body cube = body_of(box_in(flat, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  Scene scene = scene_of(plane_trn(flat, 1, 20), GroundClass{}, {cube}, law_paper(1e-3, 5e8));
  scene.base = {{0, 10}, {Vec3(-5, 0, 0), Vec3(-5, 0, 0)}, {}};
  cases::Run run(scene, PaperSettings{});
  while (run.state.time < 0.5) run.advance();
  const State& state = run.state;
  const double way = state.motion[0].pose.position.x() - scene.blocks.rest[0].position.x();
  EXPECT_NEAR(way, 5 * 0.5 * 0.5 / 2, 0.02);
  EXPECT_NEAR(state.ledger.base, scene.blocks.mass[0] * 5 * way, 1e-6 * state.ledger.base);
}

TEST(LawPaper, OwnWeightStressesTheBlock) {
  EXPECT_LT(own_weight(law_paper(1e-3, 5e10)).error, 1e-2);
}

// Forces between blocks come in pairs, whatever the passes leave unsettled.
TEST(LawPaper, CollisionBetweenBlocksKeepsMomentum) {
  std::vector<Body> bodies;
  const Mat3 turn = Eigen::AngleAxisd(0.6, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  bodies.push_back(body_of(
      moved(box_in(slope_frame(0, 0), Vec3::Zero(), Vec3(-0.5, -0.4, -0.3), Vec3(0.5, 0.4, 0.3)),
            turn, Vec3::Zero(), Vec3(-2, 0.2, 500)),
      Vec3(6, 0, 3)));
  bodies.push_back(body_of(
      box_in(slope_frame(0, 0), Vec3(2, 0, 500.1), Vec3(-0.7, -0.5, -0.5), Vec3(0.7, 0.5, 0.5)),
      Vec3(-5, 0, 3)));
  cases::Run run(
      scene_of(plane_trn(slope_frame(0, 0), 5, 100), ground_of(25), bodies, law_paper(1e-4, 1e9)),
      PaperSettings{});
  const Scene& scene = run.scene;
  const State& state = run.state;
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t b = 0; b < 2; ++b)
      sum += scene.blocks.mass[b] * (state.motion[b].velocity - state.time * scene.gravity);
    return sum;
  };
  const Vec3 before = momentum();
  const double exchanged = scene.blocks.mass[0] * 5;
  run.advance_to(0.5);
  EXPECT_GT((state.motion[0].velocity - scene.blocks.velocity[0] - 0.5 * scene.gravity).norm(), 1);
  EXPECT_LT((momentum() - before).norm(), 1e-10 * exchanged);
}

// A column of three: each face carries the blocks above it, four corners of stiffness k_n.
TEST(LawPaper, ColumnPressesWithItsWeight) {
  const double k_n = 1e9;
  cases::Run run(tower(3, 0, 30, law_paper(2e-4, k_n)), PaperSettings{});
  run.advance_to(2);
  const Scene& scene = run.scene;
  const double weight = scene.blocks.mass[0] * scene.gravity.norm();
  double sunk = 0;
  for (std::size_t b = 0; b < 3; ++b) {
    sunk += static_cast<double>(3 - b) * weight / (4 * k_n);
    EXPECT_NEAR(scene.blocks.rest[b].position.z() - run.state.motion[b].pose.position.z(), sunk,
                1e-3 * sunk)
        << b;
  }
}

// The weight acts at once, so the bond has to carry twice the static load of the slope:
// sin(a) - tan(20) cos(a) = 0.3 / 2.
TEST(LawPaper, BondCarriesALoadPutOnAtOnce) {
  const double expected = 20 + std::asin(0.15 * std::cos(20 * degree)) / degree;
  EXPECT_NEAR(bond_angle(law_paper(1e-2, 5e10)).value, expected, 0.1);
}

// The error is that of the start: without overlap, so that the column first drops into its
// contacts. It falls with the stiffness: 1.4 % at 1e9 N/m.
TEST(LawPaper, ColumnSlidesAsOne) { EXPECT_LT(tower_slide(law_paper(2e-4, 1e10)).error, 5e-3); }

}  // namespace
