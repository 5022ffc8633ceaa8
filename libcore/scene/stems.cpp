#include "scene/stems.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "motion/rotation.hpp"

namespace talus {
namespace {

using std::size_t;

template <class Stems>
auto place_of(Stems& stems, int stem) {
  return std::lower_bound(stems.begin(), stems.end(), stem,
                          [](const StemMet& met, int s) { return met.stem < s; });
}

StemHit* find_hit(std::vector<StemHit>& hits, int block, int stem) {
  const auto found = std::find_if(hits.rbegin(), hits.rend(), [&](const StemHit& h) {
    return h.block == block && h.stem == stem;
  });
  return found == hits.rend() ? nullptr : &*found;
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

const Yielded& met_by_stem(const YieldingState& yielding, int stem) {
  static const Yielded nothing;
  const auto found = place_of(yielding.stems, stem);
  return found != yielding.stems.end() && found->stem == stem ? found->met : nothing;
}

Yielded& meet_stem(YieldingState& yielding, int stem) {
  auto found = place_of(yielding.stems, stem);
  if (found == yielding.stems.end() || found->stem != stem)
    found = yielding.stems.insert(found, StemMet{stem, {}});
  return found->met;
}

Vec2 axis_of_stem(const Scene& scene, const State& state, int stem) {
  const Vec3 at = scene.forest.stems[stem].foot + met_by_stem(state.yielding, stem).shift;
  return at.head<2>();
}

void note_stem_touch(const Scene& scene, int block, int body, const Vec3& point, double time,
                     const Motion& before, const Motion& after, std::vector<StemHit>& hits) {
  const int stem = stem_of(scene, body);
  StemHit* hit = find_hit(hits, block, stem);
  if (hit == nullptr) {
    hit = &hits.emplace_back();
    hit->block = block;
    hit->stem = stem;
    hit->time = time;
    hit->height = point.z() - scene.forest.stems[stem].foot.z();
    hit->velocity = before.velocity;
    hit->translational_energy = translational(scene, block, before);
    hit->rotational_energy = rotational(scene, block, before);
  }
  hit->energy_after = translational(scene, block, after) + rotational(scene, block, after);
}

void note_stem_work(const Scene& scene, std::span<const YieldPush> pushes,
                    std::vector<StemHit>& hits) {
  const int first = static_cast<int>(scene.fixed.yieldings.size());
  for (const YieldPush& push : pushes)
    if (push.yielding >= first)
      if (StemHit* hit = find_hit(hits, push.block, push.yielding - first)) hit->work += push.work;
}

}  // namespace talus
