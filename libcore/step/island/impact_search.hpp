// libcore/step/island/impact_search.hpp
// When pairs of an island may be hit within its substep, and which contacts touch then: the looks
// of stage 6. Between its hits a member moves freely; a pair is looked at when the gaps of its rows
// say that it may be hit, and where it is then, its features are searched anew.
// theory 1.12, "6 Hits" in docs/theory/theory.md
#pragma once

#include <span>
#include <vector>

#include "step/island/stages.hpp"

namespace talus {

/// Input and results of looks: a struct so that its parts share them.
struct ImpactSearch {
  const Scene& scene;
  const State& state;
  const PairSearch& search;
  const IslandMembers& members;
  const FreeMotions& free;
  const IslandSystem& system;
  std::vector<NearFeatures>& near_ground;
  ContactMaking& making;
  SubstepHits& hits;

  /// Every member flies from the start of the substep; no look is due.
  void begin() const;
  /// Motion of member k at `time`, not before its last hit.
  [[nodiscard]] Motion motion_of(std::size_t k, double time) const;
  /// The same, kept for the next query at the same time.
  [[nodiscard]] const MemberMotion& member_at(std::size_t k, double time) const;
  /// A look at pair `p` as its rows say from `from` on, if they say that it may be hit; not before
  /// `not_before`.
  void look_ahead(std::size_t p, double from, double not_before) const;
  /// Takes the looks that are due first, all those of one time; empty: there is none.
  void take_due(std::vector<ImpactCandidate>& due) const;
  /// The contacts that touch where the pair of `look` is at its time: appended to
  /// SubstepHits::batch where the pair is hit. Else it looks on.
  void look_at(const ImpactCandidate& look) const;

  // parts of these
  [[nodiscard]] PlacedMotion place(std::size_t k, const Motion& motion) const;
  [[nodiscard]] const PlacedMotion& end_of_member(std::size_t k) const;
  [[nodiscard]] int version_of(std::size_t p) const;
  void push(const ImpactCandidate& look) const;
  [[nodiscard]] double hit_speed(std::size_t k, double time) const;
  [[nodiscard]] bool is_pressed(std::size_t k) const;
  [[nodiscard]] double size_of(std::size_t p) const;
  void find_touching(std::size_t p, double time) const;
  ImpactContact& add_touching(std::size_t p, const Vec3& normal, const Vec3& point, double gap,
                              const ContactKey& key, const GroundClass& faces) const;
  void find_touching_ground(std::size_t p, double time) const;
  void find_touching_bodies(std::size_t p, double time) const;
};

/// Gap and normal speed of the points of contact `r` where its bodies move so; `b` of no member:
/// the ground.
struct RowMotion {
  double gap = 0, speed = 0;
  Vec3 point_a, point_b;  ///< [m]
  Vec3 velocity;          ///< of A's point relative to B's [m/s]
};
[[nodiscard]] RowMotion row_motion(const FreeMotions& free, const IslandSystem& system,
                                   std::size_t r, const PlacedMotion& a, const PlacedMotion* b);

/// Contact `r` is hit at `time`, and was not before.
inline void note_hit(std::size_t r, double time, IslandSystem& system, SubstepHits& hits) {
  KeptContact& contact = system.contacts[r];
  if (contact.is_hit()) return;
  contact.hit_time = time;
  hits.contacts_hit.push_back(r);
}

/// Makes the hits found part of the motion without contact.
void take_hits(const ImpactSearch& looks, FreeMotions& free, IslandSystem& system,
               SubstepHits& hits);

/// Earlier looks first, then those of lower pairs: for a heap.
[[nodiscard]] inline bool comes_after(const ImpactCandidate& a, const ImpactCandidate& b) {
  return a.time != b.time ? a.time > b.time : a.pair > b.pair;
}

}  // namespace talus
