#include <algorithm>
#include <cmath>

#include "base/make_room.hpp"
#include "contact/search.hpp"
#include "dda/advance_island.hpp"
#include "dda/deep_blocks.hpp"
#include "dda/fence.hpp"
#include "dda/flight.hpp"
#include "dda/rotation.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int most_halvings = 4;        // of a substep that does not converge
constexpr int most_cuts = 24;           // of a substep where a panel of a fence breaks
constexpr int most_deep_cuts = 8;       // in a step, where a block would end deep in something
constexpr double deep = 0.08;           // of the thickness: health allows a tenth
constexpr double deeper = 0.02;         // of it, than at the start of the substep
constexpr double after_hit = 1.0 / 32;  // of the substep
// Pairs are searched at most so many substeps like the last one ahead: those that are far apart
// when a long step begins cost the most, and bear nothing yet.
constexpr double substeps_ahead = 2;

}  // namespace

void AdvanceIsland::gather(std::span<const int> blocks) {
  w.members.assign(blocks.begin(), blocks.end());
  w.numbers.clear();
  for (size_t k = 0; k < w.members.size(); ++k) {
    w.place[block(k)] = static_cast<int>(k);
    w.numbers.push_back(numbers_of(scene, w.members[k]));
  }
}

void AdvanceIsland::release() {
  for (const int b : w.members) w.place[static_cast<size_t>(b)] = -1;
}

// Way per time of the points of contact `r` that its impulse works on, over h: their mean velocity
// without and with contacts, less what gravity does to a change of velocity in the rest of the
// substep.
Vec3 AdvanceIsland::way_of_impulse(size_t r, double h) const {
  const IslandContact& contact = w.contacts[r];
  Vec3 way = relative(
      r, [&](size_t k) -> Vec6 { return (w.island.velocity[k] + w.island.free_velocity[k]) / 2; });
  const size_t ka = place(contact.a);
  way -= (h - w.time[ka]) * w.substeps[ka].free_acceleration;
  if (contact.b >= 0) {
    const size_t kb = place(contact.b);
    way += (h - w.time[kb]) * w.substeps[kb].free_acceleration;
  }
  return way;
}

// Energy that contacts took, by kind; push_panels() adds that of panels that give way.
void AdvanceIsland::account(size_t r, double h) {
  const IslandContact& contact = w.contacts[r];
  const Vec3 normal = row(r).normal(), impulse = row(r).impulse();
  const double p_n = normal.dot(impulse);
  const Vec3 p_t = impulse - p_n * normal;
  const Vec3 way = way_of_impulse(r, h);
  if (!gives_way(r))
    (contact.hit >= 0 ? state.ledger.impact : state.ledger.contact) -= p_n * normal.dot(way);
  state.ledger.friction -= p_t.dot(way);
}

// What the blocks do to the panels that give way.
void AdvanceIsland::find_pushes(double h) {
  w.pushes.clear();
  if (scene.fixed.panels.empty()) return;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    if (!gives_way(r)) continue;
    const IslandContact& contact = w.contacts[r];
    const Vec3 normal = row(r).normal();
    const FencePanel& panel = *giving_way(scene, contact.fixed, normal);
    const double p_n = row(r).normal_impulse(), cosine = normal.dot(panel.normal);
    PanelPush push;
    push.block = contact.a;
    push.panel = panel_number(scene, contact.fixed);
    push.work = -p_n * normal.dot(way_of_impulse(r, h));
    push.power = -p_n / h * contact.speed_start;
    const double gap_end = contact.gap_start + normal.dot(path_of_contact(r));
    if (p_n >= (1 - 1e-12) * row(r).normal_limit()) push.shift = std::min(0.0, gap_end) * cosine;
    const auto f = static_cast<size_t>(contact.fixed);
    push.to = push.shift +
              panel.normal.dot(w.poses[f].position - scene.fixed.pose[f - first_fixed()].position);
    add_push(push, w.pushes);
  }
}

// First touches, and what the touched panels left to their blocks.
void AdvanceIsland::note_touched_panels(double t) {
  if (scene.fixed.panels.empty()) return;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    if (contact.fixed < 0 || contact.waits || row(r).state() == ContactState::open ||
        panel_number(scene, contact.fixed) < 0)
      continue;
    const size_t k = place(contact.a);
    const Motion& before = w.substeps[k].start;
    note_hit(scene, contact.a, contact.fixed, before.pose.position + contact.arm,
             contact.hit >= 0 ? t + hit_of(r)->time : t, before, motion(k), state.fence);
  }
}

// Bonds that carry more than they hold are gone, and true: the substep is computed without them.
bool AdvanceIsland::break_bonds(double h) {
  w.bond_loads.clear();
  if (!w.any_bond) return false;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    const RowIn<RowGroup> of = row(r);
    if (contact.bond_area == 0 || contact.hit >= 0 || of.state() == ContactState::open) continue;
    const double per_h = 1 / (h * numbers(contact.a).recovery_time);
    const Vec3 path = path_of_contact(r);
    const double along = of.normal().dot(path);
    const double N = -per_h * of.normal_damping() * (contact.gap_start + contact.offset + along);
    const Vec3 shear = -per_h * of.shear_damping() * (contact.shear + path - along * of.normal());
    add_load(N, shear, contact.bond_area, bond_class(contact), load_of(contact));
  }
  bool broken = false;
  for (const BondLoad& load : w.bond_loads) {
    if (!breaks(load)) continue;
    break_bond(load.bond);
    broken = true;
  }
  return broken;
}

// Bonds are numbered as in the state; after them come those of the blocks with the ground.
int AdvanceIsland::bond_of(const IslandContact& contact) const {
  return contact.bond >= 0 ? contact.bond : static_cast<int>(state.bonds.size()) + contact.a;
}

const GroundClass& AdvanceIsland::bond_class(const IslandContact& contact) const {
  return contact.bond >= 0 ? state.bonds[static_cast<size_t>(contact.bond)].face
                           : scene.ground.classes[static_cast<size_t>(contact.ground_class)];
}

void AdvanceIsland::break_bond(int bond) {
  const int n = static_cast<int>(state.bonds.size());
  if (bond < n) {
    state.bonds[static_cast<size_t>(bond)].area = 0;
    return;
  }
  for (ContactMemory& memory : state.memory[static_cast<size_t>(bond - n)])
    if (memory.key.body_b < 0) memory.bond_area = 0;
}

BondLoad& AdvanceIsland::load_of(const IslandContact& contact) {
  const int bond = bond_of(contact);
  for (BondLoad& load : w.bond_loads)
    if (load.bond == bond) return load;
  BondLoad& load = w.bond_loads.emplace_back();
  load.bond = bond;
  return load;
}

// Share of offset_relaxed() by which an overlap is pressed out. That is a speed, whatever it takes:
// between blocks that are jammed the forces would grow without bound, and throw out what they hold.
// So nothing is pressed out against several times the weight of the lighter block, unless it is
// deep: health allows a tenth of the thickness.
double AdvanceIsland::share_pressed_out(const IslandContact& contact, double normal_force) const {
  constexpr double heavy = 3, most_overlap = 0.02;
  double mass = numbers(contact.a).mass;
  if (contact.b >= 0) mass = std::min(mass, numbers(contact.b).mass);
  const double weight = mass * scene.gravity.norm();
  const double by_load = weight > 0 ? 2 - normal_force / (heavy * weight) : 0;
  const double by_depth = contact.offset / (most_overlap * thickness_of(contact)) - 1;
  return std::clamp(std::max(by_load, by_depth), 0.0, 1.0);
}

// What contact `r`, which pressed and ends with an overlap of `overlap`, keeps for the next step.
// Hits keep nothing, but where blocks are found deep in each other or in the ground: edges that
// slide on each other while they turn are hit in every step, and so are splinters that large blocks
// drive into the ground; what that adds to the overlap has to be pressed out.
void AdvanceIsland::remember_contact(size_t r, const Vec3& path, double overlap, double h) {
  constexpr double remembered_hit = 1e-2;  // of the thickness
  const IslandContact& contact = w.contacts[r];
  const RowIn<RowGroup> solved = row(r);
  const Vec3 normal = solved.normal(), impulse = solved.impulse();
  const bool was_hit = contact.hit >= 0;
  if (was_hit && (contact.fixed >= 0 || overlap <= remembered_hit * thickness_of(contact))) return;
  const double p_n = normal.dot(impulse);
  std::vector<ContactMemory>& memories = state.memory[static_cast<size_t>(contact.a)];
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
  if (was_hit) return;  // it bears nothing
  const ContactState stays = solved.state();
  memory.normal_force = p_n / h;
  const double per_time = numbers(contact.a).recovery_time * h;
  if (contact.bond < 0 && contact.bond_area == 0)
    memory.stiffness = solved.normal_damping() / per_time;
  memory.state = static_cast<std::uint8_t>(stays);
  memory.bond_area = contact.bond >= 0 ? 0 : contact.bond_area;  // of the ground
  const double k_t = solved.shear_damping() / per_time;
  memory.shear = stays == ContactState::slip ? Vec3((impulse - p_n * normal) / (-h * k_t))
                                             : Vec3(contact.shear + path - along * normal);
}

// What the contacts keep for the next step, and the work they did.
[[gnu::flatten]] void AdvanceIsland::remember(double h) {
  for (const int b : w.members) state.memory[static_cast<size_t>(b)].clear();
  w.pressed.assign(w.members.size(), 0);
  w.ground_impulse.assign(w.members.size(), Vec3::Zero());
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    const Vec3 path = path_of_contact(r);
    const double overlap = -(contact.gap_start + row(r).normal().dot(path));
    if (contact.waits) continue;
    const bool is_open = row(r).state() == ContactState::open;
    if (!is_open || contact.offset > 0)
      note_overlap(thinner_of(contact), overlap, thickness_of(contact), work, report);
    if (is_open) continue;
    const BodyPair& pair = w.island.pairs[static_cast<size_t>(contact.pair)];
    w.pressed[static_cast<size_t>(pair.a)] = 1;
    if (pair.b >= 0) w.pressed[static_cast<size_t>(pair.b)] = 1;
    account(r, h);
    ++report.n_closed;
    report.sum_penetration += std::max(overlap, 0.0);
    if (contact.hit < 0 && contact.b < 0 && !gives_way(r))
      w.ground_impulse[static_cast<size_t>(pair.a)] += row(r).impulse();
    remember_contact(r, path, overlap, h);
  }
}

// Motion of a member at the end of the substep: the free one, corrected (theory 1.8, 1.10).
Motion AdvanceIsland::end_of(size_t k) const {
  const Substep& s = w.substeps[k];
  const Vec6 dv = change(k) + w.support[k].until * w.support[k].acceleration;
  Motion end = s.free;
  end.velocity += dv.head<3>();
  end.pose.position += w.displacement[k].head<3>();
  end.pose.attitude =
      (rotation_by(w.displacement[k].tail<3>()) * s.free.pose.attitude).normalized();
  end.angular_momentum += w.island.mass[k].bottomRightCorner<3, 3>() * dv.tail<3>();
  return end;
}

// Whether a contact of the substep leads member k to this gap with the ground, but for `least`.
bool AdvanceIsland::foresaw(size_t k, const Contact& contact, double least) const {
  if (w.ground_pair[k] < 0) return false;
  for (const size_t r : contacts_of(static_cast<size_t>(w.ground_pair[k]))) {
    const double gap_end = w.contacts[r].gap_start + row(r).normal().dot(path_of_contact(r));
    if (w.contacts[r].key == contact.key && gap_end < contact.gap + least) return true;
  }
  return false;
}

int AdvanceIsland::thinner_of(const IslandContact& contact) const {
  if (contact.b < 0) return contact.a;
  return numbers(contact.b).thickness < numbers(contact.a).thickness ? contact.b : contact.a;
}

// Thickness of the thinner of the two blocks of a contact.
double AdvanceIsland::thickness_of(const IslandContact& contact) const {
  return numbers(thinner_of(contact)).thickness;
}

// When the substep has to end so that no block ends deep where it is hit, since a later hit throws
// it back or it goes in after its hit because of another: shortly after that hit. h: none does.
double AdvanceIsland::end_of_deepening_hit(double h) const {
  double end = h;
  for (const Hit& hit : w.hits) {
    const IslandContact& of = w.contacts[hit.contact];
    const double gap_end =
        of.gap_start + row(hit.contact).normal().dot(path_of_contact(hit.contact));
    const double thickness = thickness_of(of);
    if (gap_end < std::min(-deep * thickness, of.gap_start - deeper * thickness))
      end = std::min(end, hit.time + after_hit * h);
  }
  return end;
}

// The same for members that are thrown into ground that was not looked for where they end: shortly
// after the first of their hits.
double AdvanceIsland::end_of_throw_into_ground(double h) {
  if (!scene.settings.trn_contacts) return h;
  for (size_t k = 0; k < w.members.size(); ++k) {
    const BlockNumbers& c = w.numbers[k];
    const Vec6& by = w.displacement[k];
    if (by.head<3>().norm() + c.radius * by.tail<3>().norm() < deep * c.thickness) continue;
    (void)find_contacts(scene.ground, scene.blocks.shapes, w.members[k], end_of(k).pose,
                        Mat3::Identity(), 0, work.world_vertices, work.contacts,
                        &work.near_ground[block(k)]);
    const auto is_unforeseen = [&](const Contact& contact) {
      return contact.gap < -deep * c.thickness && !foresaw(k, contact, deep / 2 * c.thickness);
    };
    if (std::none_of(work.contacts.begin(), work.contacts.end(), is_unforeseen)) continue;
    double first = h;
    for (const Hit& hit : w.hits) {
      const IslandContact& of = w.contacts[hit.contact];
      if (of.a == w.members[k] || of.b == w.members[k]) first = std::min(first, hit.time);
    }
    return first < h ? std::min(first + after_hit * h, h) : h / 2;
  }
  return h;
}

// The path of a member: in one piece, or up to its hit and on from there.
void AdvanceIsland::add_path(size_t k, const Motion& end, double t, double h) {
  constexpr double rounding = 1e-12;
  const Substep& s = w.substeps[k];
  const double hit = w.time[k];
  if (std::abs(hit - h / 2) < 1e-3 * h) {
    add_segment(w.members[k], false, t, h, s.start, end, work);
    return;
  }
  const Support& support = w.support[k];
  const double borne = std::min(hit, support.until);
  Motion before = fly(s.start, w.numbers[k].inertia, s.free_acceleration, hit);
  before.velocity += borne * support.acceleration.head<3>();
  before.pose.position += borne_path(k, hit).head<3>();
  Motion after = before;
  after.velocity = end.velocity - (h - hit) * s.free_acceleration -
                   (support.until - borne) * support.acceleration.head<3>();
  after.angular_momentum = end.angular_momentum;
  if (hit > rounding * h) add_segment(w.members[k], false, t, hit, s.start, before, work);
  if (hit < (1 - rounding) * h)
    add_segment(w.members[k], false, t + hit, h - hit, after, end, work);
}

// How the ground bears a member from now on, and the work of what bore it until it was hit.
void AdvanceIsland::renew_support(size_t k, double h) {
  const Support& was = w.support[k];
  if (was.until > 0) {
    const auto [power, rise] = support_power(k);
    state.ledger.friction -= was.until * (power + was.until / 2 * rise);
  }
  Vec3 support = w.ground_impulse[k] / (w.numbers[k].mass * h);
  if (!support.isZero(0)) support += was.until / h * was.acceleration.head<3>();
  set_support(scene, w.members[k], support, state);
}

void AdvanceIsland::finish(double t, double h) {
  for (size_t k = 0; k < w.members.size(); ++k) {
    const Substep& s = w.substeps[k];
    const Motion end = end_of(k);
    add_path(k, end, t, h);
    renew_support(k, h);
    if (w.pressed[k])
      set_rates(scene, w.members[k], w.numbers[k], s, end, state);
    else
      forget_rates(scene, w.members[k], state);
    const Vec3 external = s.free_acceleration - scene.gravity;
    if (!external.isZero(0))
      state.ledger.base +=
          w.numbers[k].mass * external.dot(end.pose.position - s.start.pose.position);
    motion(k) = end;
    if (!is_finite(end)) stop_at(s.start, block(k), state, report);
    state.local_time[block(k)] = t + h;
    ++report.substeps;
  }
  for (const Hit& hit : w.hits)
    for (const int b : {w.contacts[hit.contact].a, w.contacts[hit.contact].b})
      if (b >= 0) forget_rates(scene, b, state);
  report.shortest_dt = report.shortest_dt > 0 ? std::min(report.shortest_dt, h) : h;
}

AdvanceIsland::Attempt AdvanceIsland::attempt(double t, double& h) {
  if (!assemble(t, h)) return Attempt::left;
  if (const double touch = first_touch(h); touch < h) {
    h = touch;
    return Attempt::shorter;
  }
  const bool converged = solve(h);
  if (const double hit = first_hit(h); hit < h) {
    h = hit;
    ++lone_hits;
    return Attempt::shorter;
  }
  if (!converged) {
    if (halvings < most_halvings) {
      h /= 2;
      ++halvings;
      ++state.counters.cut_back;
      return Attempt::shorter;
    }
    ++report.n_unconverged;
    report.flags = report.flags | StepFlag::unconverged;
  }
  set_displacements(h);
  if (converged && !takes_all && closes_left_out()) {
    takes_all = true;
    return Attempt::shorter;
  }
  if (deep_cuts < most_deep_cuts)
    if (const double end = std::min(end_of_deepening_hit(h), end_of_throw_into_ground(h));
        end < h) {
      h = end;
      ++deep_cuts;
      return Attempt::shorter;
    }
  if (break_bonds(h)) return Attempt::shorter;
  find_pushes(h);
  const double used_up = time_to_first_break(scene, state.fence, w.pushes, h);
  if (used_up < h && cuts < most_cuts) {
    h = used_up;
    ++cuts;
    return Attempt::shorter;
  }
  report.n_impacts += n_hits;
  remember(h);
  finish(t, h);
  note_touched_panels(t);
  push_panels(scene, w.pushes, t + h, state);
  return Attempt::done;
}

// Stops the members that left the known ground; those that stay, and whose numbers did not fail,
// go on.
void AdvanceIsland::stop_outsiders(double t_end) {
  const auto is_outside = [&](int b) {
    return b == outsider || !takes_part(state, b) ||
           left_ground(scene, state.motion[static_cast<size_t>(b)].pose.position);
  };
  if (std::none_of(w.members.begin(), w.members.end(), is_outside)) return;
  std::vector<int> stay;
  for (const int b : w.members) {
    if (!is_outside(b)) {
      stay.push_back(b);
      continue;
    }
    if (takes_part(state, b)) stop_outside(scene, b, state, report);
    state.local_time[static_cast<size_t>(b)] = t_end;
  }
  outsider = -1;
  release();
  gather(stay);
  w.pairs_of_step = false;
}

void AdvanceIsland::run(int island, std::span<const int> blocks, double t_end) {
  gather(blocks);
  double t = state.time, ahead = t_end - t;
  while (t < t_end && !w.members.empty()) {
    const bool begins = t == state.time;
    if (w.pairs_of_step && begins)
      take_pairs(island);
    else
      search_pairs(ahead);
    if (begins) see_size();
    set_stiffness();
    const double longest = longest_substep(ahead);
    double h = longest;
    halvings = cuts = 0;
    takes_all = false;
    Attempt outcome = Attempt::shorter;
    while (outcome == Attempt::shorter) outcome = attempt(t, h);
    t = state.local_time[block(0)];
    if (t_end - t < 1e-9 * scene.settings.dt) t = t_end;
    stop_outsiders(t_end);
    ahead = (t_end - t) / std::ceil((t_end - t) / (substeps_ahead * longest));
  }
  for (const int b : w.members) state.local_time[static_cast<size_t>(b)] = t_end;
  release();
}

void advance_island(const Scene& scene, int k, double t_end, State& state, Work& work,
                    StepReport& report) {
  const IslandGroups& groups = work.islands.groups;
  const auto at = static_cast<size_t>(k);
  const std::span<const int> blocks(
      groups.blocks.data() + groups.block_begin[at],
      static_cast<size_t>(groups.block_begin[at + 1] - groups.block_begin[at]));
  AdvanceIsland advance{scene, state, work, report, work.islands};
  advance.run(k, blocks, t_end);
}

}  // namespace talus
