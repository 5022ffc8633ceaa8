// libcore/dda/advance_island.hpp
// What moves one island of blocks over a step, for step_island.cpp and the sources that share it:
// island_pairs.cpp     which blocks meet, and how long a substep may be
// island_assembly.cpp  bodies and contacts of a substep, made ready for solve_island()
// island_impacts.cpp   contact impulses, hits and their times included
// island_rebounds.cpp  what hits that follow on each other in turn leave of their rebound
// step_island.cpp      what a substep leaves: bonds, panels, memory, motion; and the loop over them
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/index_set.hpp"
#include "dda/newton.hpp"
#include "dda/step_island.hpp"
#include "dda/substep.hpp"

namespace talus {

/// Whether block b still moves or may be moved.
[[nodiscard]] inline bool takes_part(const State& state, int b) {
  const Phase phase = state.phase[static_cast<std::size_t>(b)];
  return phase != Phase::left_domain && phase != Phase::stopped;
}

/// Everything that advances one island; a struct so that its parts share what they all need.
struct AdvanceIsland {
  using size_t = std::size_t;
  enum class Attempt { done, shorter, left };  ///< at a substep

  const Scene& scene;
  State& state;
  Work& work;
  StepReport& report;
  IslandStepWork& w;
  int outsider = -1;       ///< block that the last attempt found off the known ground
  int halvings = 0;        ///< of the substep because it did not converge
  bool small = false;      ///< the island's matrix is cheap to factor
  bool takes_all = false;  ///< one of the contacts left out of the substep closed without them
  int cuts = 0;            ///< of the substep at the time when a panel is used up
  int deep_cuts = 0;       ///< substeps of the step cut because a block would end deep in something
  int n_hits = 0;          ///< in the last attempt at a substep
  int lone_hits = 0;       ///< for each of which a substep ended within the step

  [[nodiscard]] size_t block(size_t k) const { return static_cast<size_t>(w.members[k]); }
  // One block near fixed bodies: it is hit at the end of a substep, so by one body after the other.
  [[nodiscard]] bool is_lone() const { return w.members.size() == 1; }
  // Row of contact `r` for the solver.
  [[nodiscard]] RowIn<RowGroup> row(size_t r) const { return row_of(w.island, w.contacts[r].row); }
  // Contacts of a pair of the island.
  [[nodiscard]] IndexRange contacts_of(size_t pair) const {
    const BodyPair& of = w.island.pairs[pair];
    const auto first = static_cast<size_t>(w.first_contact[pair]);
    return {first, first + static_cast<size_t>(of.row_end - of.row_begin)};
  }
  Motion& motion(size_t k) { return state.motion[block(k)]; }
  [[nodiscard]] size_t place(int b) const {
    return static_cast<size_t>(w.place[static_cast<size_t>(b)]);
  }
  [[nodiscard]] const BlockNumbers& numbers(int b) const { return w.numbers[place(b)]; }
  // Change of a member's velocity by contact.
  [[nodiscard]] Vec6 change(size_t k) const {
    return w.island.velocity[k] - w.island.free_velocity[k];
  }
  // Displacement of a member by contact over the substep of `h`.
  [[nodiscard]] Vec6 displacement_by_contact(size_t k, double h) const {
    return (h - w.time[k]) * change(k) + borne_path(k, h);
  }
  // ... and what of that its support alone has made at `time`.
  [[nodiscard]] Vec6 borne_path(size_t k, double time) const {
    const double until = std::min(time, w.support[k].until);
    return until * (time - until / 2) * w.support[k].acceleration;
  }
  // Relative motion of the points of contact `r`, `of` being a motion of members.
  template <class Of>
  [[nodiscard]] Vec3 relative(size_t r, Of&& of) const {
    const BodyPair& pair = w.island.pairs[static_cast<size_t>(w.contacts[r].pair)];
    const Vec3 arm = row(r).arm();
    const auto ka = static_cast<size_t>(pair.a);
    Vec3 v = point_velocity<6>(of(ka), arm);
    if (pair.b >= 0) {
      const auto kb = static_cast<size_t>(pair.b);
      v -= point_velocity<6>(of(kb), arm + w.island.position[ka] - w.island.position[kb]);
    }
    return v;
  }
  // The next solution cannot go on from what the last one made of contact `r`.
  void note_change(size_t r) {
    w.island.pairs[static_cast<size_t>(w.contacts[r].pair)].changed = true;
  }
  [[nodiscard]] Hit* hit_of(size_t r) const {
    const int hit = w.contacts[r].hit;
    return hit < 0 ? nullptr : &w.hits[static_cast<size_t>(hit)];
  }
  // Presses on a panel of a fence that gives way.
  [[nodiscard]] bool gives_way(size_t r) const {
    return row(r).normal_limit() < no_normal_limit && row(r).state() != ContactState::open;
  }
  // Displacement of the points of contact `r` over the substep.
  [[nodiscard]] Vec3 path_of_contact(size_t r) const {
    return w.contacts[r].free_move +
           relative(r, [&](size_t k) -> const Vec6& { return w.displacement[k]; });
  }
  [[nodiscard]] size_t first_fixed() const { return static_cast<size_t>(n_blocks(scene)); }

  // island_pairs.cpp
  [[nodiscard]] bool in_island(const PairManifold& m) const;
  void see_size();
  void search_pairs(double h);
  void take_pairs(int k);
  void set_stiffness();
  [[nodiscard]] double travel_ahead(const PairManifold& m, double enough) const;
  [[nodiscard]] double longest_substep(double h) const;

  // island_assembly.cpp
  // Lever arms, path and start velocity of a body's material point.
  struct PointPath {
    Vec3 start, end, moved, velocity, spin_end;
  };
  /// Motion of two blocks along the normal of their manifold, without contact forces.
  struct PairMotionFree {
    Vec3 turn_a, turn_b, spin_a, spin_b, at_a, at_b;
    double moved, speed;

    // Gap at the end of the substep.
    [[nodiscard]] double gap_end(const PairPoint& point) const {
      return point.gap + moved + turn_a.dot(point.point_b - at_a) -
             turn_b.dot(point.point_b - at_b);
    }
    // The smaller of the speeds at the start and on the mean.
    [[nodiscard]] double approach(const PairPoint& point, double gap_end, double h) const {
      const double start =
          speed + spin_a.dot(point.point_b - at_a) - spin_b.dot(point.point_b - at_b);
      return std::min(start, (gap_end - point.gap) / h);
    }
  };
  /// What the contacts of a manifold of two blocks have in common.
  struct Meeting {
    size_t ka, kb;         ///< members
    Vec3 shift;            ///< of B's arms from A's [m]
    GroundClass faces;     ///< class of the contacts
    int bond;              ///< index into State::bonds, -1: none
    BlockNumbers numbers;  ///< of A, but sizes, stiffness and touching gap are the pair's
  };
  [[nodiscard]] LostContacts lost_contacts(int b, const Substep& s,
                                           std::span<const ContactRow> rows) const;
  void clear_island();
  void add_member(size_t k, double h);
  void begin_pair(int a, int b);
  IslandContact& push(int a, const ContactKey& key, double touch, double restitution,
                      bool never_waits, const ContactRow& row);
  bool add_ground(size_t k);
  [[nodiscard]] PointPath path_of(size_t k, const Vec3& x) const;
  void match_memories(const PairManifold& m);
  [[nodiscard]] int continued(const PairManifold& m, int p) const;
  static void hold(const GroundClass& face, double recovery_time, ContactRow& row);
  [[nodiscard]] Mobility mobility_at(size_t k, const Vec3& arm, const Vec3& normal) const;
  [[nodiscard]] Meeting meeting_of(const PairManifold& m) const;
  bool inherit_from(const PairManifold& m, const PairPoint& point, int memory, double approach,
                    const BlockNumbers& c, ContactRow& row) const;
  void add_point(const PairManifold& m, const Meeting& meeting, const PairPoint& point, int memory);
  void add_fixed_point(const PairManifold& m, const PairPoint& point, int memory, int n_closing);
  void add_fixed_points(const PairManifold& m);
  [[nodiscard]] bool knows_body(int a, int b) const;
  [[nodiscard]] double first_touch(double h) const;
  [[nodiscard]] PairMotionFree free_motion(const PairManifold& m) const;
  void look_ahead(double h);
  void add_points(int manifold, double h);
  [[nodiscard]] bool closes_left_out();
  bool assemble(double t, double h);

  // island_impacts.cpp
  void bear_until_hit(double h);
  void set_support_of(size_t k);
  bool bear_by_opened();
  [[nodiscard]] std::pair<double, double> support_power(size_t k) const;
  [[nodiscard]] double time_until_it_drives(size_t k) const;
  void make_hit(size_t r, double gap_end, double speed_end, double h);
  void see_speeds(double h);
  void note_hit_pair(size_t pair);
  int find_hits(double h, bool free);
  [[nodiscard]] double overshoot_of_hits() const;
  double correct_hits();
  [[nodiscard]] double fastest() const;
  [[nodiscard]] double fastest_hit() const;
  bool solve_once(double h, bool continues);
  [[nodiscard]] double first_hit(double h) const;
  bool solve(double h);
  [[nodiscard]] bool is_closed() const;
  void set_times(double h, bool first);
  void find_mean_times(double h);
  void shift_arms(double h);
  void set_displacements(double h);

  // island_rebounds.cpp
  [[nodiscard]] Vec6 change_by(size_t k, const Vec6& p) const;
  void sum_hits();
  [[nodiscard]] Vec6 change_apart(size_t k, const HitSum& own, double h) const;
  [[nodiscard]] double hits_in_turn(size_t pair, double h) const;
  void set_targets(double h);
  [[nodiscard]] double loss_in_turn() const;
  [[nodiscard]] double work_on_velocities() const;
  void forgo_rebound();
  void keep_solution();
  void blend_kept(double share);
  bool lower_rebound(double h, double tolerance);

  // step_island.cpp
  void gather(std::span<const int> blocks);
  void release();
  [[nodiscard]] Vec3 way_of_impulse(size_t r, double h) const;
  void account(size_t r, double h);
  void find_pushes(double h);
  void note_touched_panels(double t);
  bool break_bonds(double h);
  [[nodiscard]] int bond_of(const IslandContact& contact) const;
  [[nodiscard]] const GroundClass& bond_class(const IslandContact& contact) const;
  void break_bond(int bond);
  BondLoad& load_of(const IslandContact& contact);
  [[nodiscard]] double share_pressed_out(const IslandContact& contact, double normal_force) const;
  void remember_contact(size_t r, const Vec3& path, double overlap, double h);
  void remember(double h);
  [[nodiscard]] Motion end_of(size_t k) const;
  [[nodiscard]] bool foresaw(size_t k, const Contact& contact, double least) const;
  [[nodiscard]] int thinner_of(const IslandContact& contact) const;
  [[nodiscard]] double thickness_of(const IslandContact& contact) const;
  [[nodiscard]] double end_of_deepening_hit(double h) const;
  [[nodiscard]] double end_of_throw_into_ground(double h);
  void add_path(size_t k, const Motion& end, double t, double h);
  void renew_support(size_t k, double h);
  void finish(double t, double h);
  Attempt attempt(double t, double& h);
  void stop_outsiders(double t_end);
  void run(int island, std::span<const int> blocks, double t_end);
};

}  // namespace talus
