// Stage 9 of an island's step: accepts the substep: its bonds, memory, motion, panels, and the work
// of its contacts.
#include <algorithm>
#include <cmath>

#include "base/make_room.hpp"
#include "contact/scales.hpp"
#include "solver/law_numbers.hpp"
#include "step/breakage.hpp"
#include "step/crushing.hpp"
#include "step/deep_blocks.hpp"
#include "step/flight.hpp"
#include "step/island/island_soil.hpp"
#include "step/island/stages.hpp"
#include "step/substep.hpp"
#include "step/substep_end.hpp"

namespace talus {
namespace {

using std::size_t;

/// Accepts a substep; a struct so that its parts share common data.
struct SubstepAcceptance {
  const Scene& scene;
  const IslandMembers& members;
  const FreeMotions& free;
  const IslandSystem& system;
  const SubstepHits& hits;
  SubstepEnd& end;
  State& state;
  std::vector<Segment>& segments;
  DeepWork& deep;
  StepReport& report;
  bool is_eased = false;  // its forces were not found at first

  // Normal energy taken by the contact of a hit; below zero where other contacts drove its bodies
  // apart.
  [[nodiscard]] double hit_loss_of(size_t r) const {
    if (!system.contacts[r].is_hit() || system.contacts[r].waits || gives_way(system, r) ||
        row_of(system, r).state() == ContactState::open)
      return 0;
    return end_of_contact(members, free, system, hits, r).loss();
  }

  // Calls take(block a, block b, loss) for every contact that was hit, and where hits were stopped.
  template <class Take>
  void for_each_hit_loss(const Take& take) const {
    for (const ImpactContact& hit : hits.impulses) take(hit.a, hit.b, hit.loss);
    for (size_t r = 0; r < system.contacts.size(); ++r)
      take(system.contacts[r].a, system.contacts[r].b, hit_loss_of(r));
  }

  // Hits load their blocks too.
  void add_hit_loads() {
    for (const ImpactContact& hit : hits.impulses) {
      const double p_n = std::max(0.0, hit.normal.dot(hit.impulse));
      add_load(scene, hit.a, hit.normal, p_n, hit.impulse, state);
      add_load(scene, hit.b, hit.normal, p_n, -hit.impulse, state);
    }
  }

  // Share of offset_relaxed() by which an overlap is pressed out. That is a speed at any force:
  // between jammed blocks the forces would grow without bound, and throw the blocks out. So nothing
  // is pressed out against several times the weight of the lighter block, unless it is deep: health
  // allows a tenth of the thickness.
  [[nodiscard]] double share_pressed_out(const KeptContact& contact, double normal_force) const {
    double mass = members.of(contact.a).mass;
    if (contact.b >= 0) mass = std::min(mass, members.of(contact.b).mass);
    const double weight = mass * scene.gravity.norm();
    const double by_load = weight > 0 ? 2 - normal_force / (law::heavy * weight) : 0;
    const double by_depth = contact.offset / (law::sunk * thickness_of(members, contact)) - 1;
    return std::clamp(std::max(by_load, by_depth), 0.0, 1.0);
  }

  // For how long contacts do not stiffen: those of blocks in motion whose forces were hard to find.
  // A pile at rest would begin to lean.
  [[nodiscard]] std::uint8_t cooldown_of(const KeptContact& contact) const {
    const auto moves = [&](int b) {
      return b >= 0 && free.substeps[members.at(b)].start.velocity.norm() > members.of(b).slow;
    };
    const bool eases =
        is_eased || (system.converges_slowly && (moves(contact.a) || moves(contact.b)));
    return static_cast<std::uint8_t>(eases ? law::longest_cooldown
                                           : std::max(0, contact.cooldown_steps - 1));
  }

  // The memory that contact `r`, which pressed and ends with an overlap of `overlap`, leaves to the
  // next step. Hits leave nothing, but where blocks are found deep in each other or in the ground:
  // edges that slide on each other while they turn are hit in every step, and so are splinters that
  // large blocks drive into the ground; the overlap that this adds has to be pressed out.
  void remember_contact(size_t r, const Vec3& path, double overlap) {
    const double h = free.h;
    const KeptContact& contact = system.contacts[r];
    const ConstIslandRow row = row_of(system, r);
    const Vec3 normal = row.normal(), impulse = row.impulse();
    const bool was_hit = contact.is_hit();
    if (was_hit &&
        (gives_way(system, r) || overlap <= law::shallow * thickness_of(members, contact)))
      return;
    const double p_n = normal.dot(impulse);
    std::vector<ContactMemory>& memories = state.memory[contact.a];
    make_room(memories);
    ContactMemory& memory = memories.emplace_back();
    memory.key = contact.key;
    memory.normal = normal;
    memory.offset = contact.offset;
    if (contact.bond < 0 && contact.offset > 0) {
      const double relaxed = offset_relaxed(scene.gravity.norm(), h);
      const double pressed_out = (was_hit ? 1 : share_pressed_out(contact, p_n / h)) * relaxed;
      memory.offset = std::max(0.0, contact.offset - pressed_out);
    }
    const double along = normal.dot(path);
    memory.gap_end = contact.gap_start + contact.offset + along - (contact.offset - memory.offset);
    if (was_hit) return;  // it carries nothing
    const ContactState stays = row.state();
    memory.normal_force = p_n / h;
    const double per_time = members.of(contact.a).recovery_time * h;
    if (contact.bond < 0 && contact.bond_area == 0)
      memory.stiffness = row.normal_damping() / per_time;
    memory.cooldown_steps = cooldown_of(contact);
    memory.state = static_cast<std::uint8_t>(stays);
    memory.bond_area = contact.bond >= 0 ? 0 : contact.bond_area;  // of the ground
    const double k_t = row.shear_damping() / per_time;
    if (stays == ContactState::open) return;  // a bond without tensile strength, hardly open
    memory.shear = stays == ContactState::slip ? Vec3((impulse - p_n * normal) / (-h * k_t))
                                               : Vec3(contact.shear + path - along * normal);
  }

  // The memory of the contacts for the next step, and their work. In one piece: see
  // ContactMaker::add_points().
  [[gnu::flatten]] void remember() {
    forget_contacts(members, state);
    end.pressed.assign(members.size(), 0);
    end.ground_impulse.assign(members.size(), Vec3::Zero());
    for (size_t r = 0; r < system.contacts.size(); ++r) {
      const KeptContact& contact = system.contacts[r];
      const ConstIslandRow row = row_of(system, r);
      const Vec3 path = path_of_contact(system, end, r);
      const double overlap = -(contact.gap_start + row.normal().dot(path));
      if (contact.waits) continue;
      const bool is_open = row.state() == ContactState::open;
      if (!is_open || contact.offset > 0)
        note_overlap(thinner_of(members, contact), overlap, thickness_of(members, contact), deep,
                     report);
      if (is_open) {
        if (contact.is_hit() || contact.bond_area > 0) remember_contact(r, path, overlap);
        continue;
      }
      const BodyPair& pair = system.island.pairs[contact.pair];
      end.pressed[pair.a] = 1;
      if (pair.b >= 0) end.pressed[pair.b] = 1;
      book(scene, end_of_contact(members, free, system, hits, r), state);
      ++report.n_closed;
      report.sum_penetration += std::max(overlap, 0.0);
      // impulses between members stay within the island: only the ground may continue to support
      // one alone
      if (pair.b < 0 && !gives_way(system, r)) end.ground_impulse[pair.a] += row.impulse();
      remember_contact(r, path, overlap);
    }
    if (!state.hit_loss.empty())
      add_hit_losses([&](const auto& take) { for_each_hit_loss(take); }, state);
    if (!state.load.empty()) add_hit_loads();
  }

  // The path of a member: in one piece, or from hit to hit and on from the last.
  void add_path(size_t k, const Motion& motion) {
    const int b = members.blocks[k];
    const double t = free.t, h = free.h;
    const FlyingMember& flying = hits.members[k];
    if (!flying.was_hit) {
      add_segment(b, false, t, h, free.substeps[k].start, motion, segments);
      return;
    }
    for (const PathToHit& path : hits.paths)
      if (path.member == k && path.end > path.begin + last_figures * h)
        add_segment(b, false, t + path.begin, path.end - path.begin, path.start, path.stop,
                    segments);
    const double last = flying.clock, rest = h - last;
    if (!(rest > last_figures * h)) return;
    Motion after = flying.motion;
    after.velocity = motion.velocity - rest * free.substeps[k].free_acceleration;
    after.angular_momentum = motion.angular_momentum;
    add_segment(b, false, t + last, rest, after, motion, segments);
  }

  // The support of a member from now on. It is unknown shortly after a hit.
  void renew_support(size_t k) {
    const double since = free.h - hits.members[k].clock;
    if (since < law::after_hit * free.h) return;
    set_support(scene, members.blocks[k], end.ground_impulse[k] / (members.numbers[k].mass * since),
                state);
  }

  void move(size_t k) {
    const Substep& s = free.substeps[k];
    const int b = members.blocks[k];
    const Motion motion = end_of(members, free, system, end, k);
    add_path(k, motion);
    renew_support(k);
    if (end.pressed[k])
      set_rates(scene, b, members.numbers[k], s, motion, state);
    else
      forget_rates(scene, b, state);
    end_block(scene, b, members.numbers[k], s, motion, is_pressed(system, k), free.t + free.h,
              state, report);
    if (!is_finite(motion)) stop_at(s.start, members.block(k), state, report);
  }

  void move_all() {
    for (const int b : members.moving) move(members.at(b));
    for (const size_t r : hits.contacts_hit)
      for (const int b : {system.contacts[r].a, system.contacts[r].b})
        if (b >= 0) forget_rates(scene, b, state);
    for (const int k : hits.hit_members.items) forget_rates(scene, members.blocks[k], state);
    state.ledger.impact += hits.dissipated;
    state.ledger.friction += hits.by_friction;
    state.ledger.rolling += hits.by_rolling;
  }

  // First touches of panels and stems, and the motion of their blocks after it. Stems are touched
  // where a substep begins, see first_touch().
  void note_touched() {
    if (scene.fixed.panels.empty() && scene.forest.stems.empty()) return;
    for (size_t r = 0; r < system.contacts.size(); ++r) {
      const KeptContact& contact = system.contacts[r];
      const bool presses = !contact.waits && row_of(system, r).state() != ContactState::open;
      if (contact.fixed < 0 || !(presses || contact.is_hit())) continue;
      const Motion& before = free.substeps[members.at(contact.a)].start;
      note_touch(scene, contact.a, contact.fixed, before.pose.position + contact.arm,
                 free.t + std::max(0.0, contact.hit_time), before, state);
    }
  }
};

int heaviest_of(const Scene& scene, const IslandMembers& members) {
  const std::vector<double>& mass = scene.blocks.mass;
  return *std::max_element(members.blocks.begin(), members.blocks.end(), [&](int a, int b) {
    return mass[static_cast<size_t>(a)] < mass[static_cast<size_t>(b)];
  });
}

// Bonds of the substep that broke are gone; those with the ground have left the memories already.
void break_bonds(const SubstepRetries& tries, State& state) {
  for (const BondFace& face : tries.broken)
    if (face.bond >= 0) state.bonds[face.bond].area = 0;
}

}  // namespace

void accept(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
            const IslandSystem& system, const SubstepHits& hits, bool converged,
            const SubstepRetries& tries, SubstepEnd& end, State& state,
            std::vector<Segment>& segments, DeepWork& deep, StepReport& report) {
  SubstepAcceptance acceptance{scene,
                               members,
                               free,
                               system,
                               hits,
                               end,
                               state,
                               segments,
                               deep,
                               report,
                               tries.eased > 0 && free.t > 0};
  report.n_impacts += hits.n_hits;
  if (!converged || !hits.converged) {
    note_unconverged(heaviest_of(scene, members), report);
    report.flags = report.flags | StepFlag::unconverged;
  }
  if (system.fell_through) report.flags = report.flags | StepFlag::fell_through;
  break_bonds(tries, state);
  acceptance.remember();
  end_soil(scene, members, free, system, hits, state);
  acceptance.move_all();
  acceptance.note_touched();
  take_pushes(scene, end.pushes, free.t + free.h, state);
}

}  // namespace talus
