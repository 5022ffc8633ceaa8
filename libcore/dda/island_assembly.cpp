#include <algorithm>
#include <cmath>
#include <optional>

#include "base/make_room.hpp"
#include "contact/search.hpp"
#include "dda/advance_island.hpp"
#include "dda/bonds.hpp"
#include "dda/fence.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double pair_touch_ratio = 1e-6;  // a pair touches when its gap is below this part of r
constexpr double reach_by_gravity = 0.25;  // of a contact: times g h^2
constexpr double held = 1e100;             // strength of an intact bond while the forces are sought

// Sets what the motion of the points says of a contact: they move by `moved` relative to each other
// within the substep without contact forces, and with `slip` at its start.
void set_motion(const Vec3& normal, double gap, const Vec3& arm, const Vec3& drift,
                const Vec3& moved, const Vec3& slip, ContactRow& row) {
  row.normal = normal;
  row.arm = arm;
  row.drift = drift;
  row.free_move = moved;
  row.gap_start = gap;
  row.speed_start = normal.dot(slip);
  const Vec3 tangent = slip - row.speed_start * normal;
  const double slip_speed = tangent.norm();
  row.slip_start = slip_speed > 0 ? Vec3(tangent / slip_speed) : Vec3(Vec3::Zero());
}

// Whether block b is wholly below the ground under its centroid.
bool is_below_ground(const Scene& scene, int b, const Vec3& centroid) {
  const double radius = scene.blocks.shapes.radius[static_cast<size_t>(b)];
  return centroid.z() + radius < elevation_at(scene.ground.trn, centroid.x(), centroid.y());
}

double approach_of(const ContactRow& row, double h) {
  return std::min(row.speed_start, row.normal.dot(row.free_move) / h);
}

}  // namespace

// The contacts of block b with the ground that no row of the substep continues: their features
// crossed to another plane.
LostContacts AdvanceIsland::lost_contacts(int b, const Substep& s,
                                          std::span<const ContactRow> rows) const {
  const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(b)];
  const std::span<const Vec3> vertices = vertices_of(scene.blocks.shapes, b);
  LostContacts lost;
  for (size_t i = 0; i < memory.size(); ++i) {
    const ContactMemory& contact = memory[i];
    if (contact.key.body_b >= 0) continue;
    lost.all += contact.normal_force;
    const auto continues = [i](const ContactRow& row) { return row.memory == static_cast<int>(i); };
    if (std::any_of(rows.begin(), rows.end(), continues)) continue;
    const bool is_vertex = contact.key.mode == ContactMode::vertex_face;
    lost.add(contact.normal_force,
             is_vertex ? Vec3(s.R_start * vertices[static_cast<size_t>(contact.key.feature_a)])
                       : Vec3(Vec3::Zero()));
  }
  return lost;
}

void AdvanceIsland::clear_island() {
  w.lost.clear();
  w.contacts.clear();
  w.turns.clear();
  w.left_out.clear();
  w.island.mass.clear();
  w.island.free_velocity.clear();
  w.island.velocity.clear();
  w.island.position.clear();
  w.island.radius.clear();
  w.island.pairs.clear();
  w.island.rows.clear();
  w.first_contact.clear();
  w.ground_pair.clear();
  w.waiting.clear();
  w.hits.clear();
  w.hit_pairs.clear();
  w.any_bond = false;
  w.touched_by = -1;
}

void AdvanceIsland::add_member(size_t k, double h) {
  const BlockNumbers& c = w.numbers[k];
  const Substep& s = w.substeps[k];
  const FreeTurn turn = {s.R * s.R_start.transpose(), s.R_start * s.spin_start, s.R * s.spin_free,
                         s.R * c.per_inertia.asDiagonal() * s.R.transpose()};
  Vec6 free, guess;
  free << s.free.velocity, turn.spin_end;
  if (state.acceleration[block(k)] == scene.gravity)  // nothing pressed it
    guess = free;
  else
    guess << s.start.velocity + h * state.acceleration[block(k)],
        turn.spin_start + h * (s.R * state.spin_rate[block(k)]);
  w.turns.push_back(turn);
  Mat6 M = Mat6::Zero();
  M.topLeftCorner<3, 3>().diagonal().setConstant(c.mass);
  M.bottomRightCorner<3, 3>() = s.R * c.inertia.asDiagonal() * s.R.transpose();
  w.island.mass.push_back(M);
  w.island.free_velocity.push_back(free);
  w.island.velocity.push_back(guess);
  w.island.position.push_back((s.start.pose.position + s.free.pose.position) / 2);
  w.island.radius.push_back(c.radius);
}

void AdvanceIsland::begin_pair(int a, int b) {
  open_pair(a, b, w.island);
  w.first_contact.push_back(static_cast<int>(w.contacts.size()));
}

// Makes a contact of the last pair, filled but for this, ready for the solver.
void AdvanceIsland::finish_contact(size_t r, bool never_waits) {
  const double h = w.substeps.front().h;
  ContactRow& contact = w.contacts[r];
  const double along_path = contact.normal.dot(contact.free_move);
  contact.pair = static_cast<int>(w.island.pairs.size()) - 1;
  contact.gap_free = contact.gap_start + along_path;
  contact.approach = std::min(contact.speed_start, along_path / h);
  // what comes from so far that it must be fast, wherever another hit throws it, waits too
  const double resting_speed = numbers(contact.a).resting_speed;
  contact.waits =
      contact.memory < 0 && !never_waits &&
      (contact.approach < -resting_speed || contact.gap_start > contact.touch + h * resting_speed);
  if (contact.waits) w.waiting.push_back(r);
  w.any_bond |= contact.bond_area != 0;
  if (contact.memory >= 0) {
    const ContactMemory& then =
        state.memory[static_cast<size_t>(contact.a)][static_cast<size_t>(contact.memory)];
    contact.impulse = h * then.normal_force * contact.normal;
    contact.state = static_cast<ContactState>(then.state);
  }
  contact.lane = add_row(contact, w.island);
}

ContactRow& AdvanceIsland::new_contact() {
  make_room(w.contacts);
  return w.contacts.emplace_back();
}

// Contacts of a member with the ground. False when it is off the known ground.
[[gnu::flatten]] bool AdvanceIsland::add_ground(size_t k) {
  const Substep& s = w.substeps[k];
  const int b = w.members[k];
  w.lost.push_back({});
  w.ground_pair.push_back(-1);
  if (!scene.settings.trn_contacts) {
    if (is_below_ground(scene, b, s.free.pose.position))
      report.flags = report.flags | StepFlag::fell_through;
    return true;
  }
  const SearchResult near =
      find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, Mat3::Identity(),
                    search_margin(w.numbers[k], s.h), work.world_vertices, work.contacts,
                    &work.near_ground[static_cast<size_t>(b)]);
  if (near.reach == Reach::off_ground) {
    outsider = b;
    return false;
  }
  if (near.reach == Reach::below) report.flags = report.flags | StepFlag::fell_through;
  if (!work.contacts.empty()) {
    w.ground_pair.back() = static_cast<int>(w.island.pairs.size());
    begin_pair(static_cast<int>(k), -1);
  }
  const size_t first = w.contacts.size();
  for (size_t i = 0; i < work.contacts.size(); ++i) (void)new_contact();
  const std::span<ContactRow> rows = std::span(w.contacts).subspan(first);
  make_rows(scene, b, w.numbers[k], s, state.memory[static_cast<size_t>(b)], work.contacts, rows);
  w.lost.back() = lost_contacts(b, s, rows);
  for (size_t r = first; r < w.contacts.size(); ++r) {
    ContactRow& row = w.contacts[r];
    for (Vec3* v : {&row.normal, &row.arm, &row.drift, &row.shear, &row.shear_velocity,
                    &row.slip_start, &row.free_move})
      *v = s.R * *v;
    const GroundClass& ground = scene.ground.classes[static_cast<size_t>(row.ground_class)];
    if (row.bond_area > 0) hold(ground, w.numbers[k].recovery_time, row);
    row.touch = w.numbers[k].touch;
    finish_contact(r, row.bond_area > 0);
  }
  return true;
}

AdvanceIsland::PointPath AdvanceIsland::path_of(size_t k, const Vec3& x) const {
  const Substep& s = w.substeps[k];
  const FreeTurn& turn = w.turns[k];
  PointPath p;
  p.start = x - s.start.pose.position;
  p.end = turn.by * p.start;
  p.moved = s.free.pose.position - s.start.pose.position + p.end - p.start;
  p.velocity = s.start.velocity + turn.spin_start.cross(p.start);
  p.spin_end = turn.spin_end;
  return p;
}

namespace {

// Of one pair of bodies, whatever the keys say of them.
bool has_features(const ContactKey& now, const ContactKey& then) {
  return now.mode == then.mode && now.feature_a == then.feature_a &&
         now.feature_b == then.feature_b;
}

}  // namespace

// The memories that the points of a manifold continue, -1: none. First those of the same
// features; then, where features changed, those that the pair leaves without a successor, so that
// a face that rests on another keeps its support and its friction while corners pass edges.
void AdvanceIsland::match_memories(const PairManifold& m) {
  const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(m.block_a)];
  w.continued.assign(static_cast<size_t>(m.point_end - m.point_begin), -1);
  if (w.touched_by != m.block_a) {  // manifolds come block by block
    w.touched_by = m.block_a;
    w.touched.clear();
    for (const ContactMemory& contact : memory) w.touched.push_back(contact.key.body_b);
  }
  w.unclaimed.clear();
  for (size_t i = 0; i < w.touched.size(); ++i)
    if (w.touched[i] == m.block_b) w.unclaimed.push_back(static_cast<int>(i));
  if (w.unclaimed.empty()) return;
  const auto claim = [&](const auto& continues, double least_cosine) {
    for (size_t p = 0; p < w.continued.size() && !w.unclaimed.empty(); ++p) {
      if (w.continued[p] >= 0) continue;
      const ContactKey& key = w.pairs.points[static_cast<size_t>(m.point_begin) + p].key;
      const auto found = std::find_if(w.unclaimed.begin(), w.unclaimed.end(), [&](int i) {
        const ContactMemory& then = memory[static_cast<size_t>(i)];
        return continues(key, then.key) && then.normal.dot(m.normal) > least_cosine;
      });
      if (found == w.unclaimed.end()) continue;
      w.continued[p] = *found;
      w.unclaimed.erase(found);
    }
  };
  claim(has_features, 0.5);
  claim([](const ContactKey&, const ContactKey&) { return true; }, 0.99);
}

int AdvanceIsland::continued(const PairManifold& m, int p) const {
  return w.continued[static_cast<size_t>(p - m.point_begin)];
}

// Holds a contact of a bond without limit; break_bonds() compares what it carries.
void AdvanceIsland::hold(const GroundClass& face, double recovery_time, ContactRow& row) {
  row.cohesion_impulse = held;
  row.tension_impulse = face.tension > 0 ? held : 0;
  row.bias = (row.gap_start + row.offset) / recovery_time;
}

// Mobility of a contact's point relative to the other side's, as mobility() with local axes.
Mobility AdvanceIsland::mobility_at(size_t k, const Vec3& arm, const Vec3& normal) const {
  const Mat3& per_inertia = w.turns[k].per_inertia;
  const Vec3 turn = arm.cross(normal);
  const double along = 1 / w.numbers[k].mass + turn.dot(per_inertia * turn);
  const double all =
      3 / w.numbers[k].mass + per_inertia.trace() * arm.squaredNorm() - arm.dot(per_inertia * arm);
  return {along, std::max(along, all - along)};
}

AdvanceIsland::Meeting AdvanceIsland::meeting_of(const PairManifold& m) const {
  const size_t ka = place(m.block_a), kb = place(m.block_b);
  const BlockNumbers &ca = w.numbers[ka], &cb = w.numbers[kb];
  Meeting meeting{ka,
                  kb,
                  w.island.position[ka] - w.island.position[kb],
                  pair_class(scene, m),
                  find_bond(state.bonds, m.block_a, m.block_b),
                  ca};
  meeting.numbers.radius = std::min(ca.radius, cb.radius);
  meeting.numbers.thickness = std::min(ca.thickness, cb.thickness);
  meeting.numbers.touch = pair_touch_ratio * meeting.numbers.radius;
  meeting.numbers.stiffness =
      std::max(ca.stiffness, cb.stiffness) * (ca.mass / std::min(ca.mass, cb.mass));
  if (meeting.bond >= 0) meeting.numbers.sag = 0;
  return meeting;
}

// Takes over what `memory` holds; false where it is not this contact's. What comes fast is met by a
// hit: where it is still apart; where a hit left the memory; and where other features are found far
// deeper than those of the memory were, at the other end of the block perhaps.
bool AdvanceIsland::inherit_from(const PairManifold& m, const PairPoint& point, int memory,
                                 double approach, const BlockNumbers& c, ContactRow& row) const {
  constexpr double far_deeper = 1e-2;  // of the radius
  if (memory < 0) return false;
  const ContactMemory& then =
      state.memory[static_cast<size_t>(m.block_a)][static_cast<size_t>(memory)];
  const bool same_features = has_features(then.key, point.key);
  if (approach < -c.resting_speed) {
    if (row.gap_start > c.touch) return false;
    if (comes_back_fast(then, approach, w.substeps.front().h, c)) return false;
    if (!same_features && then.gap_end - then.offset - row.gap_start > far_deeper * c.radius)
      return false;
  }
  inherit(then, memory, same_features, Mat3::Identity(), c, row);
  return true;
}

void AdvanceIsland::add_point(const PairManifold& m, const Meeting& meeting, const PairPoint& point,
                              int memory) {
  const size_t ka = meeting.ka, kb = meeting.kb;
  const BlockNumbers& c = meeting.numbers;
  const double h = w.substeps[ka].h;
  const Vec3& n = m.normal;
  const PointPath pa = path_of(ka, point.point_b + point.gap * n);
  const PointPath pb = path_of(kb, point.point_b);
  const Vec3 arm = (pa.start + pa.end + pb.start + pb.end) / 4 - meeting.shift / 2;
  const Vec3 arm_b = arm + meeting.shift;
  const Vec3 drift = pa.spin_end.cross(pa.end - arm) - pb.spin_end.cross(pb.end - arm_b);
  ContactRow& row = new_contact();
  row.key = point.key;
  row.key.body_b = m.block_b;
  row.a = m.block_a;
  row.b = m.block_b;
  row.bond = meeting.bond;
  row.touch = c.touch;
  row.friction = meeting.faces.friction;
  row.restitution = meeting.faces.restitution;
  set_motion(n, point.gap, arm, drift, pa.moved - pb.moved, pa.velocity - pb.velocity, row);

  const double approach = approach_of(row, h);
  if (!inherit_from(m, point, memory, approach, c, row))
    take_on_load(state.memory[static_cast<size_t>(m.block_a)], m.block_b, row);
  const Mobility Wa = mobility_at(ka, arm, n), Wb = mobility_at(kb, arm_b, n);
  set_law(scene, c, h, {Wa.normal + Wb.normal, Wa.tangent + Wb.tangent}, approach, row);
  const bool bonded = meeting.bond >= 0;
  if (bonded) {  // where the faces were when the bond was new, it carries nothing
    const BlockBond& bond = state.bonds[static_cast<size_t>(meeting.bond)];
    row.bond_area = m.area > 0 ? bond.area * point.area / m.area : 0;
    if (row.memory < 0) row.offset = -row.gap_start;
    hold(bond.face, c.recovery_time, row);
  }
  finish_contact(w.contacts.size() - 1, bonded);
}

// A point on a fixed body: for the solver, on the ground. `n_closing`: points of the manifold
// that close within the substep; they share the force with which a panel of a fence gives way.
void AdvanceIsland::add_fixed_point(const PairManifold& m, const PairPoint& point, int memory,
                                    int n_closing) {
  const size_t k = place(m.block_a);
  const Substep& s = w.substeps[k];
  const Vec3& n = m.normal;
  const PointPath path = path_of(k, point.point_b + point.gap * n);
  const Vec3 arm = (path.start + path.end) / 2;
  BlockNumbers c = w.numbers[k];
  c.touch = pair_touch_ratio * c.radius;
  const GroundClass& faces = fixed_class(scene, m.block_b);
  ContactRow& row = new_contact();
  row.key = point.key;
  row.key.body_b = m.block_b;
  row.a = m.block_a;
  row.fixed = m.block_b;
  row.touch = c.touch;
  row.friction = faces.friction;
  row.restitution = faces.restitution;
  set_motion(n, point.gap, arm, path.spin_end.cross(path.end - arm), path.moved, path.velocity,
             row);

  const double approach = approach_of(row, s.h);
  const FencePanel* panel = giving_way(scene, m.block_b, n);
  // a panel that gives way is pressed for many steps
  if (!inherit_from(m, point, memory, panel != nullptr ? 0 : approach, c, row))
    row.offset = std::max(0.0, -row.gap_start);
  set_law(scene, c, s.h, mobility_at(k, row.arm, n), approach, row);
  if (panel != nullptr) row.normal_limit = panel->force * s.h / n_closing;
  finish_contact(w.contacts.size() - 1, panel != nullptr);
}

void AdvanceIsland::add_fixed_points(const PairManifold& m) {
  const size_t k = place(m.block_a);
  int n_closing = 0;
  for (int p = m.point_begin; p < m.point_end; ++p) {
    const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
    const PointPath path = path_of(k, point.point_b + point.gap * m.normal);
    n_closing += point.gap + m.normal.dot(path.moved) <= 0;
  }
  for (int p = m.point_begin; p < m.point_end; ++p)
    add_fixed_point(m, w.pairs.points[static_cast<size_t>(p)], continued(m, p),
                    std::max(n_closing, 1));
}

// Whether block a touched body b in the last step.
bool AdvanceIsland::knows_body(int a, int b) const {
  const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(a)];
  return std::any_of(memory.begin(), memory.end(),
                     [b](const ContactMemory& m) { return m.key.body_b == b; });
}

// Time at which a block first touches a panel that gives way, h + 1: none does within the
// substep. Its force acts from there on.
double AdvanceIsland::first_touch(double h) const {
  double first = h + 1;
  if (scene.fixed.panels.empty()) return first;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const ContactRow& contact = w.contacts[r];
    const double v = contact.speed_start, g = contact.gap_start;
    if (row(r).normal_limit() >= no_normal_limit || g <= contact.touch ||
        contact.gap_free > -contact.touch || knows_body(contact.a, contact.fixed))
      continue;
    const double a = 2 * (contact.gap_free - g - v * h) / (h * h);
    first = std::min(first, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
  }
  return first;
}

AdvanceIsland::PairMotionFree AdvanceIsland::free_motion(const PairManifold& m) const {
  const size_t ka = place(m.block_a), kb = place(m.block_b);
  const Substep &a = w.substeps[ka], &b = w.substeps[kb];
  const FreeTurn &turn_a = w.turns[ka], &turn_b = w.turns[kb];
  const Vec3& n = m.normal;
  PairMotionFree out;
  out.turn_a = turn_a.by.transpose() * n - n;
  out.turn_b = turn_b.by.transpose() * n - n;
  out.spin_a = n.cross(turn_a.spin_start);
  out.spin_b = n.cross(turn_b.spin_start);
  out.at_a = a.start.pose.position;
  out.at_b = b.start.pose.position;
  out.moved = n.dot((a.free.pose.position - out.at_a) - (b.free.pose.position - out.at_b));
  out.speed = n.dot(a.start.velocity - b.start.velocity);
  return out;
}

// Gaps at the end of the substep without contact forces, w.gap_end, and how fast each member may be
// thrown by the fastest of its own hits, w.thrown.
void AdvanceIsland::look_ahead(double h) {
  w.thrown.assign(w.members.size(), 0);
  const auto note_hit = [&](int b, double speed) {
    if (b >= 0) w.thrown[place(b)] = std::max(w.thrown[place(b)], speed);
  };
  for (const size_t r : w.waiting) note_hit(w.contacts[r].a, -w.contacts[r].approach);
  w.gap_end.resize(w.pairs.points.size());
  for (const int i : w.island_manifolds) {
    const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
    if (is_fixed(scene, m.block_b)) continue;
    const PairMotionFree free = free_motion(m);
    const double resting_speed = numbers(m.block_a).resting_speed;
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
      const double gap_end = free.gap_end(point);
      w.gap_end[static_cast<size_t>(p)] = gap_end;
      const double speed = -free.approach(point, gap_end, h);
      if (!(speed > resting_speed && gap_end < h * speed)) continue;
      note_hit(m.block_a, speed);
      note_hit(m.block_b, speed);
    }
  }
}

// Contacts of two blocks. A new one is left out where its gap is wider than a quarter of what
// gravity does in the substep and twice what hits throw the two; closes_left_out() sees whether it
// closed all the same, and then the substep is made again with all. In one piece, as add_ground()
// and remember(): a contact is many small functions, and their calls are a twentieth of a step.
[[gnu::flatten]] void AdvanceIsland::add_points(int manifold, double h) {
  const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(manifold)];
  const double farthest = reach_by_gravity * scene.gravity.norm() * h * h +
                          2 * h * std::max(w.thrown[place(m.block_a)], w.thrown[place(m.block_b)]);
  const bool may_wait = !takes_all && find_bond(state.bonds, m.block_a, m.block_b) < 0;
  std::optional<Meeting> meeting;  // most manifolds of a dense mass need none
  for (int p = m.point_begin; p < m.point_end; ++p) {
    const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
    const int memory = continued(m, p);
    const double nearest = std::min(point.gap, w.gap_end[static_cast<size_t>(p)]);
    if (may_wait && memory < 0 && nearest > farthest) {
      w.left_out.push_back({manifold, p});
      continue;
    }
    if (!meeting) meeting = meeting_of(m);
    add_point(m, *meeting, point, memory);
  }
}

// Whether a contact that was left out closes by the displacements found without it.
bool AdvanceIsland::closes_left_out() {
  // Most are told by a bound: no point of a pair lies farther than two radii from a block's start.
  w.farthest.clear();
  for (size_t k = 0; k < w.members.size(); ++k) {
    const double shift = (w.island.position[k] - w.substeps[k].start.pose.position).norm();
    w.farthest.push_back(w.displacement[k].head<3>().norm() +
                         (2 * w.numbers[k].radius + shift) * w.displacement[k].tail<3>().norm());
  }
  return std::any_of(w.left_out.begin(), w.left_out.end(), [&](const LeftOutPoint& left) {
    const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(left.manifold)];
    const double gap_end = w.gap_end[static_cast<size_t>(left.point)];
    if (gap_end > w.farthest[place(m.block_a)] + w.farthest[place(m.block_b)]) return false;
    const Vec3& x = w.pairs.points[static_cast<size_t>(left.point)].point_b;
    const auto along = [&](int b) {
      const size_t k = place(b);
      return m.normal.dot(point_velocity<6>(w.displacement[k], x - w.island.position[k]));
    };
    const double touch =
        pair_touch_ratio * std::min(numbers(m.block_a).radius, numbers(m.block_b).radius);
    return gap_end + along(m.block_a) - along(m.block_b) < -touch;
  });
}

// Bodies, and all contacts of the island, over h from t. False: a member left the ground.
bool AdvanceIsland::assemble(double t, double h) {
  clear_island();
  w.substeps.resize(w.members.size());
  for (size_t k = 0; k < w.members.size(); ++k) {
    w.substeps[k] = predict(scene, w.members[k], w.numbers[k], motion(k), t, h);
    add_member(k, h);
  }
  for (size_t k = 0; k < w.members.size(); ++k)
    if (!add_ground(k)) return false;
  look_ahead(h);
  for (const int i : w.island_manifolds) {
    const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
    begin_pair(w.place[static_cast<size_t>(m.block_a)], w.place[static_cast<size_t>(m.block_b)]);
    match_memories(m);
    if (is_fixed(scene, m.block_b))
      add_fixed_points(m);
    else
      add_points(i, h);
    if (w.island.pairs.back().row_begin == w.island.pairs.back().row_end) {
      w.island.pairs.pop_back();
      w.first_contact.pop_back();
    }
  }
  return true;
}

}  // namespace talus
