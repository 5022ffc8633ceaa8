// Stems near a block of an island, and its contacts with them.
#include "step/island/stems.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/cylinder_contact.hpp"
#include "scene/stems.hpp"
#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double side_of_stem = 0.25;  // that a point may go along it, of the radius ...
constexpr double thin_stem = 0.05;     // ... which counts as this at least [m]
constexpr double as_good_as_all = 0.999, as_good_as_none = 0.05;  // of the impulse at the limit
constexpr double still_moves = 0.1;                               // of the speed at the start

VerticalCylinder cylinder_of(const Scene& scene, const State& state, int world, int stem) {
  const Stem& of = scene.forest.stems[stem];
  return {axis_of_stem(scene, state, world, stem), of.radius, of.foot.z() + of.height};
}

bool meets(const VerticalCylinder& cylinder, const Vec3& at, double reach) {
  return (cylinder.axis - at.head<2>()).norm() <= cylinder.radius + reach &&
         at.z() - reach <= cylinder.top;
}

// Calls visit(stem, cylinder) for the stems that exist for block `b` and meet the ball; in the
// order of their numbers.
template <class Visit>
void for_each_near(const Scene& scene, const State& state, int b, const Vec3& at, double reach,
                   PairSearch& search, Visit&& visit) {
  const int world = world_of(scene, b);
  const Vec3 around = Vec3::Constant(reach);
  find_near(scene.forest.grid, {at - around, at + around}, search.near);
  search.n_fixed_near += static_cast<std::int64_t>(search.near.size());
  for (const int stem : search.near) {
    const VerticalCylinder cylinder = cylinder_of(scene, state, world, stem);
    if (meets(cylinder, at, reach) && stands(scene, state, world, body_of_stem(scene, stem)))
      visit(stem, cylinder);
  }
}

bool is_on_stem(const Scene& scene, const KeptContact& contact) {
  return contact.fixed >= n_fixed(scene);
}

}  // namespace

bool is_far_from_stems(const Scene& scene, const State& state, int b, const Vec3& at, double reach,
                       PairSearch& search) {
  if (scene.forest.stems.empty()) return true;
  bool is_far = true;
  for_each_near(scene, state, b, at, reach, search,
                [&](int, const VerticalCylinder&) { is_far = false; });
  return is_far;
}

void add_stem_pairs(const Scene& scene, const State& state, double margin, PairSearch& search) {
  if (scene.forest.stems.empty()) return;
  const Hulls& hulls = scene.blocks.hulls;
  PairWork& pairs = search.pairs;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<size_t>(b);
    if (search.awake[i] == 0) continue;
    const double ahead = margin + search.step[i].norm() + search.turn[i];
    for_each_near(scene, state, b, search.poses[i].position, hulls.radius[i] + ahead, search,
                  [&](int stem, const VerticalCylinder& cylinder) {
                    for (int p = hulls.part_begin[i]; p < hulls.part_begin[i + 1]; ++p) {
                      PairManifold m;
                      m.block_a = b;
                      m.block_b = hull_of_fixed(scene, body_of_stem(scene, stem));
                      m.part_a = p;
                      m.part_b = -1;
                      m.point_begin = static_cast<int>(pairs.points.size());
                      const int n = find_cylinder_contact(hulls, state.placed, p, cylinder, ahead,
                                                          m.normal, pairs.points);
                      m.point_end = m.point_begin + n;
                      if (n > 0) pairs.manifolds.push_back(m);
                    }
                  });
  }
}

double part_by_stem(const Scene& scene, const PairSearch& search, const PairManifold& m,
                    double thickness) {
  const auto a = static_cast<size_t>(m.block_a);
  const Stem& stem = scene.forest.stems[stem_of(scene, fixed_of(scene, m.block_b))];
  const double travel = search.step[a].norm() + search.turn[a];
  double nearest = travel;
  for (int p = m.point_begin; p < m.point_end; ++p)
    nearest = std::min(nearest, search.pairs.points[p].gap);
  if (nearest >= travel) return 0;
  return travel /
         std::min(law::deep_share * thickness, side_of_stem * std::max(stem.radius, thin_stem));
}

bool follows_block(const Scene& scene, const IslandMembers& members, const IslandSystem& system,
                   size_t r) {
  const KeptContact& contact = system.contacts[r];
  return is_on_stem(scene, contact) && gives_way(system, r) && contact.gap_start <= contact.touch &&
         contact.speed_start < -members.of(contact.a).resting_speed;
}

double time_to_stop(const Scene& scene, const IslandMembers& members, const IslandSystem& system,
                    double h) {
  double first = std::numeric_limits<double>::infinity();
  if (scene.forest.stems.empty()) return first;
  for (size_t r = 0; r < system.contacts.size(); ++r) {
    if (!follows_block(scene, members, system, r)) continue;
    const ConstIslandRow row = row_of(system, r);
    const double share = row.normal_impulse() / row.normal_limit();
    // a soft contact slows the block down, as long as it takes, and does not stop it
    const double speed_end = -row.normal_impulse() / row.normal_damping() - row.bias();
    const bool stops = speed_end > still_moves * system.contacts[r].speed_start;
    if (stops && share > as_good_as_none && share < as_good_as_all)
      first = std::min(first, h * share);
  }
  return first;
}

}  // namespace talus
