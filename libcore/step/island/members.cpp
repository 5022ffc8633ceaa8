// Stages 1 and 3 of an island's step: its members, and the stiffness of their contacts.
#include <algorithm>
#include <cmath>

#include "solver/law_numbers.hpp"
#include "step/island/stages.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

using law::most_sag, law::slow, law::few_blocks, law::small_tree, law::stiffest_by_load,
    law::stiffest_at_rest;

}  // namespace

void gather_members(const Scene& scene, std::span<const int> blocks, IslandMembers& members) {
  const auto n_bodies = static_cast<size_t>(n_blocks(scene) + n_fixed(scene));
  if (members.place.size() != n_bodies) members.place.assign(n_bodies, -1);
  members.blocks.assign(blocks.begin(), blocks.end());
  members.numbers.clear();
  for (size_t k = 0; k < members.size(); ++k) {
    members.place[members.block(k)] = static_cast<int>(k);
    members.numbers.push_back(numbers_of(scene, members.blocks[k]));
  }
  members.moving = members.blocks;
}

void let_stand(const State& state, double t_end, IslandMembers& members) {
  std::erase_if(members.moving, [&](int b) {
    BlockNumbers& c = members.numbers[members.at(b)];
    c.stands = does_not_move(phase_of(state, b)) || state.local_time[b] >= t_end;
    return c.stands;
  });
}

void release_members(IslandMembers& members) {
  for (const int b : members.blocks) members.place[b] = -1;
}

void add_members(const Scene& scene, const State& state, std::vector<int>& blocks,
                 IslandMembers& members) {
  blocks.insert(blocks.end(), members.blocks.begin(), members.blocks.end());
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  release_members(members);
  gather_members(scene, blocks, members);
  let_stand(state, state.time + step_length(scene, state), members);
}

void classify_size(const Scene& scene, const State& state, const PairSearch& search,
                   std::span<const int> manifolds, IslandMembers& members) {
  const auto n_pairs = std::count_if(manifolds.begin(), manifolds.end(), [&](int i) {
    const PairManifold& m = search.pairs.manifolds[i];
    return !is_fixed(scene, m.block_b) && has_points(m);
  });
  const size_t n = members.size();
  double thickness = 0, speed = 0;
  for (size_t k = 0; k < n; ++k) {
    thickness += members.numbers[k].thickness;
    speed = std::max(speed, state.motion[members.block(k)].velocity.norm());
  }
  const bool is_column = n <= small_tree && static_cast<size_t>(n_pairs) < n &&
                         speed * speed < law::column_falls * scene.gravity.norm() * thickness;
  members.is_small = n <= few_blocks || is_column;
}

// The sag of a contact must not grow with the load from above, with the step, or with small blocks:
// a tower of springs leans by the sum of their sags, and buckles. So a contact at rest is as stiff
// as its load of the last step asks for an overlap of `sag`, whatever that takes. Contacts that
// slip, open or carry little stay soft, and all of a large island of which a block moves or has
// left its place: stiff ones that close press a small block with forces far beyond its weight, and
// take many passes; and a mass that has come to rest would be thrown up by the overlap that is
// pressed out when it stiffens. A small block may support a large one: its contacts are as stiff as
// the heaviest block that it touches asks for before they know their loads.
void choose_stiffness(const Scene& scene, const State& state, const PairSearch& search,
                      std::span<const int> manifolds, int eased, IslandMembers& members) {
  members.bearing.clear();
  for (const BlockNumbers& c : members.numbers) members.bearing.push_back(c.mass);
  for (const int i : manifolds) {
    const PairManifold& m = search.pairs.manifolds[i];
    if (is_fixed(scene, m.block_b) || !has_points(m)) continue;
    double &a = members.bearing[members.at(m.block_a)], &b = members.bearing[members.at(m.block_b)];
    a = std::max(a, members.of(m.block_b).mass);
    b = std::max(b, members.of(m.block_a).mass);
  }
  const double g = scene.gravity.norm(), dt = scene.settings.dt;
  const bool is_first = members.is_small || state.time == 0;
  const auto moves = [&](int b) {
    return state.motion[static_cast<size_t>(b)].velocity.norm() > slow * g * dt;
  };
  const auto has_left = [&](int b) {
    const auto i = static_cast<size_t>(b);
    const double path = (state.motion[i].pose.position - scene.blocks.rest[i].position).norm();
    return path > law::rests_within * scene.blocks.shapes.thickness[i];
  };
  const auto is_any = [&](const auto& so) {
    return std::any_of(members.blocks.begin(), members.blocks.end(), so);
  };
  const bool any_moves = is_any(moves) || (!members.is_small && is_any(has_left));
  const bool is_soft = eased > (any_moves ? 0 : 1) || (any_moves && !members.is_small);
  const double stiffest = stiffest_by_load / std::pow(law::easing, eased);
  members.is_soft = is_soft;
  for (size_t k = 0; k < members.size(); ++k) {
    BlockNumbers& c = members.numbers[k];
    c.slow = slow * g * dt;
    c.rests = members.is_small || !moves(members.blocks[k]);
    const bool is_stiff = members.is_small || (c.rests && state.time > 0 && !is_soft);
    const double inverse_mass = (is_stiff ? stiffest_at_rest : 1) / (dt * dt);
    c.stiffness = inverse_mass * members.bearing[k];
    c.least_stiffness = is_first ? no_normal_limit : law::stiffens * inverse_mass * c.mass;
    c.most_stiffness = is_soft ? 0 : stiffest / (dt * dt) * c.mass;
    c.sag = (c.rests ? most_sag : law::most_sag_in_motion) * c.thickness;
  }
}

void locate_hits(const Scene& scene, const State& state, const SubstepRetries& tries,
                 IslandMembers& members) {
  members.locates_hits = members.size() <= few_blocks && tries.hits < law::most_hits;
  for (size_t k = 0; k < members.size(); ++k) {
    BlockNumbers& c = members.numbers[k];
    c.located_speed = c.resting_speed;
    if (!members.locates_hits) continue;
    const Motion& m = state.motion[members.block(k)];
    const Vec3 body = m.pose.attitude.conjugate() * m.angular_momentum;
    const double spin = body.cwiseProduct(c.inverse_inertia).norm();
    c.located_speed = located_speed(scene, c, m.velocity.norm() + spin * c.radius);
  }
}

}  // namespace talus
