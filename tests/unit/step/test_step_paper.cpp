#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "step/step.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double degree = std::numbers::pi / 180;

Settings paper(double dt, double normal_stiffness) {
  Settings settings;
  settings.law = Law::paper;
  settings.dt = dt;
  settings.normal_stiffness = normal_stiffness;
  return settings;
}

void run(const Scene& scene, double time, State& state) {
  Work work = make_work(scene);
  const int n = static_cast<int>(std::lround(time / scene.settings.dt));
  for (int i = 0; i < n; ++i) step(scene, state, work);
}

// Forces between blocks come in pairs, whatever the passes leave unsettled.
TEST(LawPaper, CollisionBetweenBlocksKeepsMomentum) {
  GroundClass rock;
  rock.friction = std::tan(25 * degree);
  std::vector<Body> bodies;
  const Mat3 turn = Eigen::AngleAxisd(0.6, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  bodies.push_back(body_of(
      moved(box_in(slope_frame(0, 0), Vec3::Zero(), Vec3(-0.5, -0.4, -0.3), Vec3(0.5, 0.4, 0.3)),
            turn, Vec3::Zero(), Vec3(-2, 0.2, 500)),
      Vec3(6, 0, 3)));
  bodies.push_back(body_of(
      box_in(slope_frame(0, 0), Vec3(2, 0, 500.1), Vec3(-0.7, -0.5, -0.5), Vec3(0.7, 0.5, 0.5)),
      Vec3(-5, 0, 3)));
  const Scene scene =
      scene_of(plane_trn(slope_frame(0, 0), 5, 100), rock, bodies, paper(1e-4, 1e9));
  State state = start(scene);
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t b = 0; b < 2; ++b)
      sum += scene.blocks.mass[b] * (state.motion[b].velocity - state.time * scene.gravity);
    return sum;
  };
  const Vec3 before = momentum();
  const double exchanged = scene.blocks.mass[0] * 5;
  run(scene, 0.5, state);
  EXPECT_GT((state.motion[0].velocity - scene.blocks.velocity[0] - 0.5 * scene.gravity).norm(), 1);
  EXPECT_LT((momentum() - before).norm(), 1e-10 * exchanged);
}

// A column of three: each face carries what stands on it, four corners of stiffness k_n.
TEST(LawPaper, ColumnPressesWithItsWeight) {
  const double k_n = 1e9;
  const Scene scene = tower(3, 0, 30, paper(2e-4, k_n));
  State state = start(scene);
  run(scene, 2, state);
  const double weight = scene.blocks.mass[0] * scene.gravity.norm();
  double sunk = 0;
  for (std::size_t b = 0; b < 3; ++b) {
    sunk += static_cast<double>(3 - b) * weight / (4 * k_n);
    EXPECT_NEAR(scene.blocks.rest[b].position.z() - state.motion[b].pose.position.z(), sunk,
                1e-3 * sunk)
        << b;
  }
}

// The weight comes on all at once, so the bond has to bear twice what the slope asks for:
// sin(a) - tan(20) cos(a) = 0.3 / 2.
TEST(LawPaper, BondBearsALoadPutOnAtOnce) {
  const double expected = 20 + std::asin(0.15 * std::cos(20 * degree)) / degree;
  EXPECT_NEAR(bond_angle(paper(1e-2, 5e10)).value, expected, 0.1);
}

// The error is that of the start: without overlap, so that the column first drops into its
// contacts. It falls with the stiffness: 1.4 % at 1e9 N/m.
TEST(LawPaper, ColumnSlidesAsOne) { EXPECT_LT(tower_slide(paper(2e-4, 1e10)).error, 5e-3); }

}  // namespace
