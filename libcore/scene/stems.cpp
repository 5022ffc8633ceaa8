// Stems of a forest in a scene: making them, where they are, and the record of hits.
#include "scene/stems.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "motion/rotation.hpp"
#include "scene/worlds.hpp"

namespace talus {
namespace {

using std::size_t;

StemHit* hit_on(State& state, int block, int stem) {
  return find_hit(state.stem_hits, state.stem_chain, block,
                  [stem](const StemHit& h) { return h.stem == stem; });
}

double translational(const Scene& scene, int block, const Motion& m) {
  return 0.5 * scene.blocks.mass[block] * m.velocity.squaredNorm();
}
double rotational(const Scene& scene, int block, const Motion& m) {
  const Vec3 spin =
      angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[block]);
  return 0.5 * spin.dot(m.angular_momentum);
}

}  // namespace

double stem_capacity(double factor, double dbh_m) {
  return factor * 38.7 * std::pow(100 * dbh_m, 2.31);
}

void add_forest(Scene& scene, std::vector<Stem> stems, std::vector<GroundClass> faces) {
  Forest& forest = scene.forest;
  forest.stems = std::move(stems);
  forest.faces = std::move(faces);
  std::vector<Vec3> centre;
  std::vector<double> reach;  // a stem is never pushed farther than it deflects
  for (size_t s = 0; s < forest.stems.size(); ++s) {
    const Stem& stem = forest.stems[s];
    TALUS_ASSERT(stem.radius > 0 && stem.capacity > 0 && stem.deflection > 0);
    Yielding yielding;
    yielding.capacity = stem.capacity;
    yielding.force = stem.capacity / stem.deflection;
    yielding.body = body_of_stem(scene, static_cast<int>(s));
    forest.yieldings.push_back(yielding);
    forest.widest = std::max(forest.widest, stem.radius);
    centre.push_back(stem.foot);
    reach.push_back(stem.radius + stem.deflection);
  }
  forest.grid = make_body_grid(centre, reach);
}

const Yielded& met_by_stem(const Scene& scene, const State& state, int world, int stem) {
  return met_by(state.yielding, world, static_cast<int>(scene.fixed.yieldings.size()) + stem);
}

Vec2 axis_of_stem(const Scene& scene, const State& state, int world, int stem) {
  const Vec3 at = scene.forest.stems[stem].foot + met_by_stem(scene, state, world, stem).shift;
  return at.head<2>();
}

void note_stem_touch(const Scene& scene, int block, int body, const Vec3& point, double time,
                     const Motion& before, const Motion& after, State& state) {
  const int stem = stem_of(scene, body);
  StemHit* hit = hit_on(state, block, stem);
  if (hit == nullptr) {
    StemHit first;
    first.block = block;
    first.stem = stem;
    first.time = time;
    first.height = point.z() - scene.forest.stems[stem].foot.z();
    first.velocity = before.velocity;
    first.translational_energy = translational(scene, block, before);
    first.rotational_energy = rotational(scene, block, before);
    hit = &add_hit(first, n_blocks(scene), state.stem_hits, state.stem_chain);
  }
  hit->energy_after = translational(scene, block, after) + rotational(scene, block, after);
}

void note_stem_work(const Scene& scene, std::span<const YieldPush> pushes, State& state) {
  const int first = static_cast<int>(scene.fixed.yieldings.size());
  for (const YieldPush& push : pushes)
    if (push.yielding >= first)
      if (StemHit* hit = hit_on(state, push.block, push.yielding - first)) hit->work += push.work;
}

}  // namespace talus
