// Heavy on light: a block falls on a layer of cobbles a few hundred to ten thousand times lighter,
// which it rolls over and jams in the wedges between its faces and the ground. The forces of nearly
// all steps are found, nothing is deep in anything, and no energy comes from nothing.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "stability/block_scenes.hpp"

namespace {

using namespace talus;
using namespace talus::cases;
using namespace talus::stability;

struct HeavyOnLight {
  double mass_ratio = 5000, friction_deg = 30, dip_deg = 0;
};

Mat3 any_turn(Random& random) {
  return Quat(random.normal(), random.normal(), random.normal(), random.normal())
      .normalized()
      .toRotationMatrix();
}

Scene boulder_on_cobbles(const HeavyOnLight& of, std::uint64_t seed) {
  Random random(seed, "cobbles");
  const SlopeFrame frame = slope_frame(of.dip_deg, 0);
  const auto at = [&](double x, double y, double z) {
    return Vec3(x * frame.dip + y * frame.strike + z * frame.normal);
  };
  const Vec3 half(0.17, 0.15, 0.13);
  std::vector<Body> bodies;
  for (int i = 0; i < 36; ++i) {
    const Vec3 place = at(0.6 * (i % 6) - 1.5, 0.6 * (i / 6) - 1.5, half.norm() + 0.001);
    bodies.push_back(body_of(moved(box(-half, half), any_turn(random), Vec3::Zero(), place)));
  }
  const double edge = 2 * std::cbrt(of.mass_ratio * half.prod());
  const Vec3 corner = Vec3::Constant(edge / 2);
  bodies.push_back(body_of(
      moved(box(-corner, corner), any_turn(random), Vec3::Zero(), at(0, 0, corner.norm() + 1.5))));
  Scene scene = on_plane(frame, bodies, of.friction_deg, of.friction_deg, {}, 1, 40);
  scene.joint.restitution = scene.ground.classes[0].restitution = 0.2;
  return scene;
}

TEST(HeavyOnLight, ForcesAreFound) {
  std::uint64_t seed = 0;
  for (const HeavyOnLight& of : {HeavyOnLight{650, 30, 0}, HeavyOnLight{650, 50, 0},
                                 HeavyOnLight{5000, 40, 0}, HeavyOnLight{10000, 30, 10}}) {
    const Scene scene = boulder_on_cobbles(of, ++seed);
    State state = start(scene);
    const double before = mechanical_energy(scene, state);
    const int n_steps = 400;
    run(scene, n_steps * scene.settings.dt, state);
    EXPECT_LE(state.counters.unconverged, n_steps / 50) << of.mass_ratio << ' ' << of.friction_deg;
    EXPECT_LT(mechanical_energy(scene, state), before) << of.mass_ratio << ' ' << of.friction_deg;
  }
}

}  // namespace
