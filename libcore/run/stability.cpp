// Factor of safety of a mass and of its blocks by strength reduction.
#include "run/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "blocks/limit_equilibrium.hpp"
#include "step/step.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double least_acceleration = 5e-4;  // of a block that moves, of gravity
// Forces of a run are found to 2 % of gravity; so near to equilibrium they have to be known to
// 4e-4.
constexpr double found_to = 0.02;

void reduce(double factor, GroundClass& made) {
  if (made.friction > 0) made.friction /= factor;
  made.cohesion /= factor;
  made.tension /= factor;
}

// When the ground has come to rest for good [s].
double end_of_motion(const AccelerationRecord& base) {
  double end = base.harmonic.amplitude.isZero(0) ? 0 : base.harmonic.end;
  for (size_t k = 1; k < base.time.size(); ++k)
    if (!base.acceleration[k - 1].isZero(0) || !base.acceleration[k].isZero(0))
      end = std::max(end, base.time[k]);
  return end;
}

std::vector<Vec3> positions_at(const Scene& scene, double time, State& state, Work& work) {
  while (state.time < time - scene.settings.dt / 2) step(scene, state, work);
  std::vector<Vec3> at;
  for (int b = 0; b < n_blocks(scene); ++b)
    at.push_back(motion_at(scene, state, b, state.time).pose.position);
  return at;
}

/// Runs by factor, made as they are asked for.
struct Reducer {
  const Scene& scene;
  const StabilitySettings& settings;
  const std::function<void(const ReducedRun&)>& said;
  std::vector<ReducedRun> runs = {};

  const ReducedRun& at(double factor) {
    const auto next =
        std::lower_bound(runs.begin(), runs.end(), factor,
                         [](const ReducedRun& run, double f) { return run.factor < f; });
    if (next != runs.end() && next->factor == factor) return *next;
    const auto made = runs.insert(next, run_reduced(scene, factor, settings));
    if (said) said(*made);
    return *made;
  }

  // Factor from which more than `share` of the mass moves.
  SafetyFactor factor_of(double share) {
    const auto moves = [&](double factor) { return at(factor).moved_share > share; };
    SafetyFactor found{0, no_limit};
    for (const ReducedRun& run : runs) {  // by factor: the smallest that moves counts
      if (run.moved_share > share) found.moves = run.factor;
      if (found.moves < no_limit) break;
      found.holds = run.factor;
    }
    for (double f = 1; found.holds == 0 && f >= settings.least; f /= 2)
      (moves(f) ? found.moves : found.holds) = f;
    for (double f = std::max(1.0, 2 * found.holds); found.moves == no_limit && f <= settings.most;
         f *= 2)
      (moves(f) ? found.moves : found.holds) = f;
    if (found.holds == 0 || found.moves == no_limit) return found;
    while (found.moves - found.holds > settings.resolution) {
      const double middle = found.value();
      (moves(middle) ? found.moves : found.holds) = middle;
    }
    return found;
  }
};

}  // namespace

Scene with_strength_reduced(Scene scene, double factor) {
  for (GroundClass& c : scene.ground.classes) reduce(factor, c);
  reduce(factor, scene.joint);
  for (GroundClass& c : scene.joints.of_block) reduce(factor, c);
  for (GroundClass& c : scene.joints.of_set) reduce(factor, c);
  scene.drained_at = no_limit;
  scene.settings.tolerance_factor = found_to;
  scene.settings.sleep = scene.settings.masses = false;
  for (Vec3& velocity : scene.blocks.velocity) velocity.setZero();
  for (Vec3& spin : scene.blocks.spin) spin.setZero();
  return scene;
}

namespace {

// Blocks that move before the ground shakes: a block at rest after it has not held.
std::vector<bool> moves_before(Scene scene, double factor, const StabilitySettings& settings) {
  if (!shakes(scene.base)) return std::vector<bool>(scene.blocks.mass.size(), false);
  scene.base = {};
  return run_reduced(scene, factor, settings).moves;
}

}  // namespace

ReducedRun run_reduced(const Scene& scene, double factor, const StabilitySettings& settings) {
  const Scene reduced = with_strength_reduced(scene, factor);
  Work work = make_work(reduced);
  State state = start(reduced, work);
  const double T = settings.duration, calm = end_of_motion(scene.base);
  std::array<std::vector<Vec3>, 3> at;
  for (size_t k = 0; k < at.size(); ++k)
    at[k] = positions_at(reduced, calm + T * (2 + static_cast<double>(k)) / 4, state, work);
  const std::vector<bool> gone = moves_before(scene, factor, settings);
  ReducedRun run;
  run.factor = factor;
  // path of an acceleration a in the last quarter: a T^2 / 2 (1 - 9 / 16)
  const double least = least_acceleration * scene.gravity.norm() * T * T * 7 / 32;
  double all = 0, moved = 0;
  for (size_t b = 0; b < at[0].size(); ++b) {
    const double before = (at[1][b] - at[0][b]).norm(), last = (at[2][b] - at[1][b]).norm();
    const double displaced = (at[2][b] - reduced.blocks.rest[b].position).norm();
    const bool is_shaken_off = calm > 0 && displaced > std::cbrt(scene.blocks.volume[b]);
    run.moves.push_back(is_released(scene, b) &&
                        ((last > before && last > least) || is_shaken_off || gone[b]));
    if (!is_released(scene, b)) continue;
    all += scene.blocks.mass[b];
    if (run.moves.back()) moved += scene.blocks.mass[b];
    run.displacement += scene.blocks.mass[b] * displaced;
  }
  run.moved_share = all > 0 ? moved / all : 0;
  run.displacement = all > 0 ? run.displacement / all : 0;
  return run;
}

Stability find_stability(const Scene& scene, const StabilitySettings& settings,
                         const std::function<void(const ReducedRun&)>& said) {
  Reducer reducer{scene, settings, said};
  Stability found;
  found.mass = reducer.factor_of(share_of_mass);
  found.first = reducer.factor_of(share_of_first);
  found.of_block.assign(scene.blocks.mass.size(), no_limit);
  for (const ReducedRun& run : reducer.runs)
    for (size_t b = 0; b < run.moves.size(); ++b)
      if (run.moves[b]) found.of_block[b] = std::min(found.of_block[b], run.factor);
  found.runs = std::move(reducer.runs);
  return found;
}

std::optional<double> factor_as_one_body(const Scene& scene, const BlockSet& blocks) {
  std::vector<BlockContact> bed;
  std::vector<const GroundClass*> classes;
  Vec3 area_vector = Vec3::Zero();
  for (int b = 0; b < n_blocks(blocks); ++b) {
    const Polyhedron shell = block_shell(blocks, b);
    for (int f = 0; f < n_faces(shell); ++f) {
      if (shell.face_tag[f] != face_failure) continue;
      const Vec3 at = face_centroid(shell, f);
      const int triangle = triangle_at(scene.ground.trn, at.x(), at.y());
      const GroundClass& ground = scene.ground.classes[class_of(scene.ground, triangle)];
      const double area = face_area(shell, f);
      area_vector -= face_area_vector(shell, f);
      classes.push_back(&ground);
      bed.push_back({-1, {-face_normal(shell, f), ground.friction, ground.cohesion * area}, area});
    }
  }
  SlidingMass mass;
  for (const PointLoad& load : scene.loads) {
    const bool is_inside = load.wet_face >= 0 && scene.wet_faces[load.wet_face].block_b >= 0;
    if (!is_inside) mass.water += load.force;
  }
  const Vec3& g = scene.gravity;
  for (const double m : scene.blocks.mass) mass.weight -= m * g.z();
  // of a rough bed, at the mean stress
  const Vec3 force = mass.weight / -g.z() * g + mass.water;
  const double stress = std::max(0.0, -force.dot(area_vector)) / area_vector.squaredNorm();
  for (size_t i = 0; i < bed.size(); ++i)
    if (is_rough(*classes[i])) bed[i].plane.friction = rough_friction(*classes[i], stress);
  mass.planes = merged(bed);
  if (mass.planes.empty() || mass.planes.size() > 2) return std::nullopt;
  return sliding_factor(mass, Vec3(g.x(), g.y(), 0) / -g.z());
}

}  // namespace talus
