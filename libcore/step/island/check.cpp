// Stage 8 of an island's step: accepts the substep, or requests it again, shorter or with different
// contacts. It only reads; its findings are in SubstepEnd.
#include <algorithm>
#include <cmath>

#include "contact/scales.hpp"
#include "motion/rotation.hpp"
#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "step/accuracy.hpp"
#include "step/island/stages.hpp"
#include "step/island/stems.hpp"
#include "step/substep.hpp"
#include "step/substep_end.hpp"

namespace talus {
namespace {

using std::size_t;

using law::after_hit, law::deep_share, law::sunk, law::most_rounds_in_substep, law::most_halvings,
    law::most_repetitions;

/// Checks a substep; a struct so that its parts share common data.
struct SubstepCheck {
  const Scene& scene;
  const State& state;
  const PairSearch& search;
  const IslandMembers& members;
  const FreeMotions& free;
  const IslandSystem& system;
  const SubstepHits& hits;
  const SubstepRetries& tries;
  std::vector<NearFeatures>& near_ground;
  ContactMaking& making;
  SubstepEnd& end;

  // When the substep has to end so that no block ends deep where it is hit: shortly after that hit.
  // A later hit may throw a block back, or another contact may push it in after its own hit.
  // Returns h if there is none.
  [[nodiscard]] double end_of_deepening_hit() const {
    double first = free.h;
    for (const size_t r : hits.contacts_hit) {
      const KeptContact& contact = system.contacts[r];
      const double gap_end =
          contact.gap_start + row_of(system, r).normal().dot(path_of_contact(system, end, r));
      const double thickness = thickness_of(members, contact);
      if (gap_end < std::min(-deep_share * thickness, contact.gap_start - sunk * thickness))
        first = std::min(first, contact.hit_time + after_hit * free.h);
    }
    return first;
  }

  // Whether a contact of the substep leads member k to this gap with the ground, but for `least`.
  [[nodiscard]] bool foresaw(size_t k, const Contact& contact, double least) const {
    if (system.ground_pair[k] < 0) return false;
    for (const size_t r : contacts_of(system, static_cast<size_t>(system.ground_pair[k]))) {
      const double gap_end = system.contacts[r].gap_start +
                             row_of(system, r).normal().dot(path_of_contact(system, end, r));
      if (system.contacts[r].key == contact.key && gap_end < contact.gap + least) return true;
    }
    return false;
  }

  // Whether member k ends deep in ground that was not looked for there.
  [[nodiscard]] bool ends_in_ground(size_t k) const {
    const BlockNumbers& c = members.numbers[k];
    const Vec6 by = end.displacement[k] + hits.impact_displacement[k];
    if (by.head<3>().norm() + c.radius * by.tail<3>().norm() < deep_share * c.thickness)
      return false;
    (void)find_contacts(scene.ground, scene.blocks.shapes, members.blocks[k],
                        end_of(members, free, system, end, k).pose, Mat3::Identity(), 0,
                        making.world_vertices, making.found, &near_ground[members.block(k)]);
    return std::any_of(making.found.begin(), making.found.end(), [&](const Contact& contact) {
      return contact.gap < -deep_share * c.thickness &&
             !foresaw(k, contact, deep_share / 2 * c.thickness);
    });
  }

  // The same for members that are thrown into ground that was not looked for where they end:
  // shortly after the first of their hits.
  [[nodiscard]] double end_of_throw_into_ground() const {
    const double h = free.h;
    if (!scene.settings.trn_contacts) return h;
    for (size_t k = 0; k < members.size(); ++k) {
      if (!ends_in_ground(k)) continue;
      double first = h;
      for (const size_t r : hits.contacts_hit) {
        const KeptContact& contact = system.contacts[r];
        if (contact.a == members.blocks[k] || contact.b == members.blocks[k])
          first = std::min(first, contact.hit_time);
      }
      return first < h ? std::min(first + after_hit * h, h) : h / 2;
    }
    return h;
  }

  // When the first contact that waits closes: that ends the substep of a small island, and the
  // contact is hit when the next one begins. A member hit in free flight had its hit.
  [[nodiscard]] double first_hit() const {
    double first = free.h + 1;
    for (const size_t r : system.waiting) {
      const KeptContact& contact = system.contacts[r];
      const auto p = static_cast<size_t>(contact.pair);
      if (!contact.waits || contact.gap_start <= contact.touch || hits.n_pair_hits[p] > 0 ||
          hits.is_closed[p] != 0)
        continue;
      const double gap_end =
          contact.gap_start + row_of(system, r).normal().dot(path_of_contact(system, end, r));
      first = std::min(first, time_to_touch(contact.gap_start, contact.speed_start, gap_end,
                                            contact.touch, free.h));
    }
    return first;
  }

  // --- bonds -----------------------------------------------------------------------------------

  [[nodiscard]] const GroundClass& bond_class(const KeptContact& contact) const {
    return contact.bond >= 0 ? state.bonds[contact.bond].face
                             : scene.ground.classes[contact.ground_class];
  }

  // The faces of the bonds and their loads; whether one of them is overloaded.
  [[nodiscard]] bool overloads_bonds() const {
    end.bond_faces.clear();
    if (!system.has_bonds) return false;
    for (size_t r = 0; r < system.contacts.size(); ++r) {
      const KeptContact& contact = system.contacts[r];
      if (contact.bond_area == 0 || contact.is_hit()) continue;
      const ConstIslandRow row = row_of(system, r);
      const Vec3 normal = row.normal();
      BondFace& face = face_of(contact.bond, contact.a, normal, end.bond_faces);
      Vec3 impulse = row.impulse();
      if (!hits.bond_impulse.empty()) impulse += hits.bond_impulse[r];
      BondCorner corner = corner_of(contact, bond_class(contact), impulse, free.h);
      if (row.state() == ContactState::open) {
        double radius = members.of(contact.a).radius;
        if (contact.b >= 0) radius = std::min(radius, members.of(contact.b).radius);
        const double gap_end = contact.gap_start + normal.dot(path_of_contact(system, end, r));
        face.opened |= gap_end > bonded_gap_ratio * radius;
      }
      corner.polygon = contact.pair;
      face.corners.push_back(corner);
    }
    return !std::all_of(end.bond_faces.begin(), end.bond_faces.end(), holds);
  }

  // --- yielding bodies -------------------------------------------------------------------------

  // Pushes of the blocks on yielding fixed bodies.
  void find_pushes() const {
    end.pushes.clear();
    if (!anything_yields(scene)) return;
    for (size_t r = 0; r < system.contacts.size(); ++r) {
      if (!gives_way(system, r)) continue;
      const ConstIslandRow row = row_of(system, r);
      const KeptContact& contact = system.contacts[r];
      push(scene, state, end_of_contact(members, free, system, hits, r), free.h,
           contact.speed_start,
           row.normal_impulse() >= (1 - last_figures) * row.normal_limit() ||
               follows_block(scene, members, system, r),
           contact.gap_start + row.normal().dot(path_of_contact(system, end, r)), search.poses,
           end.pushes);
    }
  }

  // --- accuracy --------------------------------------------------------------------------------

  // Estimated error of the substep, over the displacement of the moving mass.
  [[nodiscard]] double error_over_displacement() const {
    if (free.t == 0) return 0;
    MeanError error;
    for (size_t k = 0; k < members.size(); ++k)
      if (!hits.members[k].was_hit)
        error.add(members.numbers[k],
                  error_of_member(scene, state, members, free, k, change(system.island, k),
                                  end.displacement[k].head<3>(), tries.last_h));
    return error.over_displacement();
  }

  // --- sleep -----------------------------------------------------------------------------------

  // Whether members asleep have to be awake in the substep. A block that is hit wakes with its
  // pile.
  [[nodiscard]] bool wakes_any() const {
    if (!asks_for_presses(state, members)) return false;
    list_presses(members, free.h, system, end.presses);
    for (const int k : hits.hit_members.items)
      if (phase_of(state, members.blocks[k]) == Phase::asleep)
        end.sleep.blocks.push_back(members.blocks[k]);
    add_piles(state, end.sleep);
    find_woken(scene, state, members, end);
    return !end.sleep.blocks.empty();
  }

  // --- in this order ---------------------------------------------------------------------------

  [[nodiscard]] SubstepVerdict run(bool converged) const {
    using enum SubstepCut;
    const double h = free.h;
    end.presses.clear();
    end.sleep.blocks.clear();
    if (!converged && can_ease(members, tries)) return SubstepVerdict::again(unconverged, h);
    if (!converged && tries.halvings < most_halvings)
      return SubstepVerdict::again(unconverged, h / 2);
    if (wakes_any()) return SubstepVerdict::again(SubstepCut::woken, h);
    set_displacements(free.h, system, hits, end.displacement);
    if (tries.deep_cuts < most_rounds_in_substep)
      if (const double first = std::min(end_of_deepening_hit(), end_of_throw_into_ground());
          first < h)
        return SubstepVerdict::again(SubstepCut::deep, first);
    if (members.locates_hits)
      if (const double first = first_hit(); first < h)
        return SubstepVerdict::again(SubstepCut::hit, first);
    end.error = error_over_displacement();
    if (const double shorter = accurate_substep(scene.settings, end.error, h); shorter < h)
      return SubstepVerdict::again(SubstepCut::inaccurate, shorter);
    if (overloads_bonds()) return SubstepVerdict::again(bond_broken, h);
    find_pushes();
    const double used_up = std::min(time_to_first_break(scene, state.yielding, end.pushes, h),
                                    time_to_stop(scene, members, system, h));
    if (used_up < h && tries.used_up_cuts < most_repetitions)
      return SubstepVerdict::again(yielding_used_up, used_up);
    return SubstepVerdict::accept();
  }
};

}  // namespace

SubstepVerdict check_substep(const Scene& scene, const State& state, const PairSearch& search,
                             const IslandMembers& members, const FreeMotions& free,
                             const IslandSystem& system, const SubstepHits& hits, bool converged,
                             const SubstepRetries& tries, std::vector<NearFeatures>& near_ground,
                             ContactMaking& making, SubstepEnd& end) {
  return SubstepCheck{scene, state, search,      members, free, system,
                      hits,  tries, near_ground, making,  end}
      .run(converged);
}

DisplacementError error_of_member(const Scene& scene, const State& state,
                                  const IslandMembers& members, const FreeMotions& free, size_t k,
                                  const Vec6& change, const Vec3& displacement, double last_h) {
  const size_t b = members.block(k);
  if (members.numbers[k].stands || state.acceleration[b] == scene.gravity) return {};
  const Substep& s = free.substeps[k];
  const FreeTurn& turn = free.turns[k];
  const double h = free.h;
  const Vec3 spin_end = turn.spin_end + change.tail<3>();
  const Vec3 mean = (s.free.velocity + change.head<3>() - s.start.velocity) / h,
             spin_rate = (spin_end - turn.spin_start) / h;
  const Vec3 path = s.free.pose.position - s.start.pose.position + displacement;
  return error_of_displacement(members.numbers[k], mean - state.acceleration[b],
                               spin_rate - s.R * state.spin_rate[b], path,
                               h / 2 * (turn.spin_start + spin_end), h, last_h);
}

// Path per time of the points of contact `r` that its impulse works on, over the substep: their
// mean velocity without and with contacts, less the effect of gravity on a change of velocity in
// the rest of the substep.
Vec3 path_of_impulse(const IslandMembers& members, const FreeMotions& free,
                     const IslandSystem& system, const SubstepHits& hits, size_t r) {
  const KeptContact& contact = system.contacts[r];
  Vec3 path = relative(system, r, [&](size_t k) -> Vec6 {
    return (system.island.velocity[k] + system.island.free_velocity[k]) / 2;
  });
  const double rest = free.h - hits.pair_time[contact.pair];
  path -= rest * free.substeps[members.at(contact.a)].free_acceleration;
  if (contact.b >= 0) path += rest * free.substeps[members.at(contact.b)].free_acceleration;
  return path;
}

ContactEnd end_of_contact(const IslandMembers& members, const FreeMotions& free,
                          const IslandSystem& system, const SubstepHits& hits, size_t r) {
  const KeptContact& contact = system.contacts[r];
  const ConstIslandRow row = row_of(system, r);
  return {contact.a,
          contact.b,
          contact.fixed,
          row.normal(),
          row.impulse(),
          row.normal_impulse(),
          path_of_impulse(members, free, system, hits, r),
          contact.is_hit(),
          gives_way(system, r)};
}

// The free motion, corrected (theory 1.8, 1.10).
Motion end_of(const IslandMembers& members, const FreeMotions& free, const IslandSystem& system,
              const SubstepEnd& end, size_t k) {
  const Substep& s = free.substeps[k];
  const Vec6 dv = change(system.island, k);
  Motion out = s.free;
  out.velocity += dv.head<3>();
  out.pose.position += end.displacement[k].head<3>();
  out.pose.attitude =
      (rotation_by(end.displacement[k].tail<3>()) * s.free.pose.attitude).normalized();
  out.angular_momentum += system.island.mass[k].bottomRightCorner<3, 3>() * dv.tail<3>();
  // later impulses act where earlier ones have moved the member
  const Vec3 by_times = end.displacement[k].head<3>() - free.h / 2 * dv.head<3>();
  out.angular_momentum -= members.numbers[k].mass * by_times.cross(dv.head<3>());
  return out;
}

}  // namespace talus
