// A block that breaks in two when it is hit, against its energy balance.
#include "verify/cases/breakage_case.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "blocks/fragments.hpp"
#include "motion/rotation.hpp"
#include "step/breakage.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace talus::cases {
namespace {

constexpr double density = 2600;  // [kg/m3]

Material rock() {
  Material material;
  material.density = density;
  return material;
}

Scene flat_ground(const Settings& settings, const GroundClass& ground) {
  return scene_of(plane_trn(slope_frame(0, 0), 1, 60), ground, {}, settings, rock());
}

void add_bodies(const BlockSet& set, Scene& scene) {
  const Material material = rock();
  add_blocks(scene, set, std::span(&material, 1));
}

// --- pieces ------------------------------------------------------------------------------------

constexpr double cut = 1 / 2.6;  // where 2600 kg become 1000 and 1600 [m]

// A cube of 1 m and its two pieces, high above the ground, without gravity.
Scene cube_of_two(const Settings& settings) {
  Scene scene = flat_ground(settings, {});
  scene.gravity = Vec3::Zero();
  BlockSet set;
  set.material_names = {"rock"};
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {0.0, cut}, {cut, 1.0}})
    add_body(set, body_of(box(Vec3(low, 0, 20), Vec3(high, 1, 21))));
  add_bodies(set, scene);
  scene.fragments.resize(3);
  scene.fragments[0].first_piece = 1;
  scene.fragments[0].cut_normal = Vec3::UnitX();
  scene.fragments[0].cut_centroid = Vec3(cut, 0.5, 20.5);
  scene.fragments[1].parent = scene.fragments[2].parent = 0;
  return scene;
}

// --- threshold ---------------------------------------------------------------------------------

// A cube that is about to fall flat on the ground at `speed`.
Scene falling_cube(const Settings& settings, double side, double speed) {
  const double above = 0.003 * speed;
  BlockSet set;
  set.material_names = {"rock"};
  // less the speed gained in the fall
  add_body(set, body_of(box(Vec3(0, 0, above), Vec3(side, side, side + above)),
                        Vec3(0, 0, -std::sqrt(speed * speed - 2 * g * above))));
  SplitSettings split;
  split.max_generation = 1;
  split.min_volume = 1e-4;
  Scene scene = flat_ground(settings, ground_of(30, 0.3));
  scene.fragments = add_fragments(set, split);
  add_bodies(set, scene);
  scene.fragmentation = {1e5, 1e6, 0.01, 1};
  scene.fragments[0].cut_area = side * side;
  return scene;
}

}  // namespace

CaseResult pieces_part(const CaseSettings& settings) {
  constexpr double separation = 500;
  const Quat turn = rotation_by(Vec3(0.4, 1, -2));
  Run run(cube_of_two(settings), settings.paper);
  run.state.motion[0].pose.attitude = turn * run.state.motion[0].pose.attitude;
  const Vec3 normal = turn * Vec3::UnitX();
  release_pieces(run.scene, 0, separation, run.state);
  run.advance_to(0.1);
  const double impulse = std::sqrt(2 * separation / (1 / 1000.0 + 1 / 1600.0));
  const auto error_of = [&](int b, double expected) {
    return (run.motion(b).velocity - expected * normal).norm() / std::abs(expected);
  };
  const Energies e = energies(run.scene, run.state);
  const double of_energy = std::abs((e.translation + e.rotation) / separation - 1);
  return run.finish(
      run.motion(2).velocity.dot(normal), impulse / 1600,
      std::max({error_of(1, -impulse / 1000), error_of(2, impulse / 1600), of_energy}));
}

CaseResult breaking_speed(const CaseSettings& settings, double side_m) {
  CaseResult total;
  const auto breaks = [&](double speed) {
    Run run(falling_cube(settings, side_m, speed), settings.paper);
    while (run.state.breaks.empty() && run.state.time < 0.02) run.advance();
    add_counts(run.counted(), total);
    return !run.state.breaks.empty();
  };
  total.expected = std::sqrt(2 * 1e5 / (density * side_m * (1 - 0.3 * 0.3)));
  total.value = bisect(0.95 * total.expected, 1.05 * total.expected, 16, breaks);
  total.error = std::abs(total.value / total.expected - 1);
  return total;
}

}  // namespace talus::cases
