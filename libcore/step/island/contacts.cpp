// Stage 5 of an island's step: its contacts, made ready for the solver.
#include <algorithm>
#include <cmath>

#include "base/make_room.hpp"
#include "contact/scales.hpp"
#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "step/island/island_soil.hpp"
#include "step/island/stages.hpp"
#include "step/rough_joints.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

// Sets the data of a contact that follow from the motion of its points: they move by `moved`
// relative to each other within the substep without contact forces, and with `slip` at its start.
void set_motion(const Vec3& normal, double gap, const Vec3& arm, const Vec3& drift,
                const Vec3& moved, const Vec3& slip, ContactRow& row) {
  row.normal = normal;
  row.arm = arm;
  row.drift = drift;
  row.free_move = moved;
  row.gap_start = gap;
  row.speed_start = normal.dot(slip);
  const Vec3 tangent = slip - row.speed_start * normal;
  row.slip_speed = tangent.norm();
  row.slip_start = row.slip_speed > 0 ? Vec3(tangent / row.slip_speed) : Vec3(Vec3::Zero());
}

double approach_of(const ContactRow& row, double h) {
  return std::min(row.speed_start, row.normal.dot(row.free_move) / h);
}

// Whether block a touched a body of this name in the last step.
bool knows_body(const State& state, int a, int name) {
  const std::vector<ContactMemory>& memory = state.memory[a];
  return std::any_of(memory.begin(), memory.end(),
                     [name](const ContactMemory& m) { return m.key.body_b == name; });
}

// Lever arms, path and start velocity of a body's material point.
struct PointPath {
  Vec3 start, end, moved, velocity, spin_end;
};

/// Common data of the contacts of a manifold of two blocks.
struct Meeting {
  size_t ka, kb;         ///< members
  Vec3 shift;            ///< of B's arms from A's [m]
  GroundClass faces;     ///< class of the contacts
  int bond;              ///< index into State::bonds, -1: none
  BlockNumbers numbers;  ///< of A, but sizes, stiffness and touching gap are the pair's
};

/// Makes the contacts of a substep; a struct so that its parts share common data.
struct ContactMaker {
  const Scene& scene;
  const State& state;
  const PairSearch& search;
  std::span<const int> manifolds;
  const IslandMembers& members;
  const FreeMotions& free;
  const SubstepRetries& tries;
  std::vector<NearFeatures>& near_ground;
  ContactMaking& making;
  IslandSystem& system;

  [[nodiscard]] size_t n_points(const PairManifold& m) const {
    return static_cast<size_t>(m.point_end - m.point_begin);
  }
  [[nodiscard]] const PairPoint& point_at(int p) const { return search.pairs.points[p]; }
  [[nodiscard]] const std::vector<ContactMemory>& memory_of(int b) const { return state.memory[b]; }
  // The intact bond of two blocks.
  [[nodiscard]] int bond_of(const PairManifold& m) const {
    const int bond = find_bond(state.bonds, m.block_a, m.block_b,
                               state.motion[m.block_a].pose.attitude, m.normal);
    return bond >= 0 && is_broken(tries, bond) ? -1 : bond;
  }

  void clear() {
    system.pair_manifold.clear();
    system.contacts.clear();
    system.island.pairs.clear();
    system.island.rows.clear();
    system.island.angular.clear();
    system.island.arms.clear();
    system.first_contact.clear();
    system.ground_pair.clear();
    system.waiting.clear();
    system.has_bonds = system.fell_through = system.converges_slowly = false;
    system.outsider = -1;
    making.memories.touched_by = -1;
  }

  void begin_pair(int a, int b, int manifold) {
    open_pair(a, b, system.island);
    system.pair_manifold.push_back(manifold);
    system.first_contact.push_back(static_cast<int>(system.contacts.size()));
  }

  // Takes a contact of the last pair, filled but for this, and makes its row.
  void add_contact(ContactRow& contact, bool never_waits) {
    const double along_path = contact.normal.dot(contact.free_move);
    contact.pair = static_cast<int>(system.island.pairs.size()) - 1;
    contact.gap_free = contact.gap_start + along_path;
    contact.approach = std::min(contact.speed_start, along_path / free.h);
    // a contact that comes from so far that it must be fast, wherever another hit throws it, waits
    // too
    const BlockNumbers& c = members.of(contact.a);
    contact.waits =
        contact.memory < 0 && !never_waits &&
        (contact.approach < -c.resting_speed || contact.speed_start < -c.located_speed ||
         (contact.gap_start > contact.touch && contact.approach < -c.located_speed) ||
         contact.gap_start > contact.touch + free.h * c.resting_speed);
    if (contact.waits) system.waiting.push_back(system.contacts.size());
    system.has_bonds |= contact.bond_area != 0;
    if (contact.memory >= 0) {
      const ContactMemory& then = memory_of(contact.a)[contact.memory];
      contact.impulse = free.h * then.normal_force * contact.normal;
      contact.state = static_cast<ContactState>(then.state);
    }
    contact.row = add_row(contact, system.island);
    make_room(system.contacts);
    system.contacts.push_back(contact);
  }

  // --- with the ground -------------------------------------------------------------------------

  // Memory of block b; of a bond with the ground that the substep breaks, no more.
  [[nodiscard]] std::span<const ContactMemory> ground_memory(int b) const {
    if (tries.broken.empty()) return memory_of(b);
    making.unbonded = memory_of(b);
    for (ContactMemory& memory : making.unbonded)
      if (memory.key.body_b == ground_name && is_broken(tries, b, memory.normal))
        memory.bond_area = 0;
    return making.unbonded;
  }

  // Contacts of a member with the ground. False when it is off the known ground.
  [[gnu::flatten]] bool add_ground(size_t k) {
    const Substep& s = free.substeps[k];
    const int b = members.blocks[k];
    const BlockNumbers& c = members.numbers[k];
    system.ground_pair.push_back(-1);
    if (c.stands) return true;
    if (!scene.settings.trn_contacts) {
      system.fell_through |= is_below_ground(scene, b, s.free.pose.position);
      return true;
    }
    const SearchResult near =
        find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, Mat3::Identity(),
                      search_margin(c, s.h), making.world_vertices, making.found, &near_ground[b]);
    if (near.reach == Reach::off_ground) {
      system.outsider = b;
      return false;
    }
    system.fell_through |= near.reach == Reach::below;
    making.rows.resize(making.found.size());
    make_rows(scene, b, c, s, ground_memory(b), making.found, making.rows);
    if (making.rows.empty()) return true;
    system.ground_pair.back() = static_cast<int>(system.island.pairs.size());
    begin_pair(static_cast<int>(k), -1, -1);
    Island& island = system.island;
    island.pairs.back().angular = begin_soil(scene, b, c, s.h, slide_of(state, b, free.t),
                                             making.rows, island.angular, island.arms);
    for (ContactRow& row : making.rows) {
      for (Vec3* v : {&row.normal, &row.arm, &row.drift, &row.shear, &row.shear_velocity,
                      &row.slip_start, &row.free_move, &row.arm_start})
        *v = s.R * *v;
      row.touch = c.touch;
      add_contact(row, row.bond_area > 0);
    }
    return true;
  }

  // --- with other bodies -----------------------------------------------------------------------

  [[nodiscard]] PointPath path_of(size_t k, const Vec3& x) const {
    const Substep& s = free.substeps[k];
    const FreeTurn& turn = free.turns[k];
    PointPath p;
    p.start = x - s.start.pose.position;
    p.end = turn.by * p.start;
    p.moved = s.free.pose.position - s.start.pose.position + p.end - p.start;
    p.velocity = s.start.velocity + turn.spin_start.cross(p.start);
    p.spin_end = turn.spin_end;
    return p;
  }

  [[nodiscard]] int continued(const PairManifold& m, int p) const {
    return making.memories.continued[p - m.point_begin];
  }

  [[nodiscard]] Meeting meeting_of(const PairManifold& m) const {
    const size_t ka = members.at(m.block_a), kb = members.at(m.block_b);
    const BlockNumbers &ca = members.numbers[ka], &cb = members.numbers[kb];
    Meeting meeting{ka,
                    kb,
                    system.island.position[ka] - system.island.position[kb],
                    pair_class(scene, m),
                    bond_of(m),
                    ca};
    meeting.numbers.radius = std::min(ca.radius, cb.radius);
    meeting.numbers.thickness = std::min(ca.thickness, cb.thickness);
    meeting.numbers.touch = negligible * meeting.numbers.radius;
    const double to_lighter = ca.mass / std::min(ca.mass, cb.mass);
    const bool rest = ca.rests && cb.rests;
    const auto stiffness = [&](const BlockNumbers& c) {
      return c.rests && !rest ? c.stiffness * (1 / law::stiffest_at_rest) : c.stiffness;
    };
    meeting.numbers.stiffness = std::max(stiffness(ca), stiffness(cb)) * to_lighter;
    meeting.numbers.least_stiffness =
        ca.mass * std::min(ca.least_stiffness / ca.mass, cb.least_stiffness / cb.mass);
    meeting.numbers.sag = rest ? std::min(ca.sag, cb.sag) : std::max(ca.sag, cb.sag);
    if (meeting.bond >= 0) meeting.numbers.sag = 0;
    set_rough_friction(scene, m, memory_of(m.block_a), meeting.faces);
    return meeting;
  }

  // Takes over `memory`; false where it is not this contact's. A fast approach is met by a hit:
  // where it is still apart; where a hit left the memory; and where other features are found far
  // deeper than those of the memory were, at the other end of the block perhaps.
  bool inherit_from(const PairManifold& m, const PairPoint& point, int memory, double approach,
                    const BlockNumbers& c, ContactRow& row) const {
    if (memory < 0) return false;
    const ContactMemory& then = memory_of(m.block_a)[memory];
    const bool same_features = has_features(then.key, point.key);
    if (approach < -c.resting_speed) {
      if (row.gap_start > c.touch) return false;
      if (comes_back_fast(then, approach, free.h, c)) return false;
      if (!same_features && then.gap_end - then.offset - row.gap_start > law::shallow * c.radius)
        return false;
    }
    inherit(then, memory, same_features, Mat3::Identity(), c, row);
    return true;
  }

  void add_point(const PairManifold& m, const Meeting& meeting, const PairPoint& point,
                 int memory) {
    const size_t ka = meeting.ka, kb = meeting.kb;
    const BlockNumbers& c = meeting.numbers;
    const double h = free.h;
    const Vec3& n = m.normal;
    const PointPath pa = path_of(ka, point.point_b + point.gap * n);
    const PointPath pb = path_of(kb, point.point_b);
    const Vec3 arm = (pa.start + pa.end + pb.start + pb.end) / 4 - meeting.shift / 2;
    const Vec3 arm_b = arm + meeting.shift;
    const Vec3 drift = pa.spin_end.cross(pa.end - arm) - pb.spin_end.cross(pb.end - arm_b);
    ContactRow row;
    row.key = point.key;
    row.key.body_b = m.block_b;
    row.a = m.block_a;
    row.b = m.block_b;
    const bool bonded = meeting.bond >= 0 && point.area > 0;
    row.bond = bonded ? meeting.bond : -1;
    row.touch = c.touch;
    row.friction = meeting.faces.friction;
    row.restitution = meeting.faces.restitution;
    set_motion(n, point.gap, arm, drift, pa.moved - pb.moved, pa.velocity - pb.velocity, row);
    row.arm_start = pa.start;
    if (!bonded) weaken_friction(meeting.faces, row.slip_speed, row.friction);

    const double approach = approach_of(row, h);
    if (!inherit_from(m, point, memory, approach, c, row))
      take_on_load(memory_of(m.block_a), m.block_b, row);
    const Mobility Wa = mobility_at(members, free, ka, arm, n),
                   Wb = mobility_at(members, free, kb, arm_b, n);
    set_law(scene, c, h, {Wa.normal + Wb.normal, Wa.tangent + Wb.tangent}, approach, row);
    if (bonded) {  // where the faces were when the bond was new, it carries nothing
      row.bond_area = point.area;
      if (row.memory < 0) row.offset = -row.gap_start;
      hold(state.bonds[meeting.bond].face, c.recovery_time, row);
    }
    add_contact(row, bonded);
  }

  // A point on a fixed body: for the solver, on the ground. `n_closing`: points of the manifold
  // that close within the substep; they share the force at which it yields.
  void add_fixed_point(const PairManifold& m, const PairPoint& point, int memory, int n_closing) {
    const size_t k = members.at(m.block_a);
    const Substep& s = free.substeps[k];
    const Vec3& n = m.normal;
    const PointPath path = path_of(k, point.point_b + point.gap * n);
    const Vec3 arm = (path.start + path.end) / 2;
    BlockNumbers c = members.numbers[k];
    c.touch = negligible * c.radius;
    const int fixed = fixed_of(scene, m.block_b);
    const GroundClass& faces = fixed_class(scene, fixed);
    ContactRow row;
    row.key = point.key;
    row.key.body_b = name_of_fixed(fixed);
    row.a = m.block_a;
    row.fixed = fixed;
    row.touch = c.touch;
    row.friction = faces.friction;
    row.restitution = faces.restitution;
    set_motion(n, point.gap, arm, path.spin_end.cross(path.end - arm), path.moved, path.velocity,
               row);
    row.arm_start = path.start;

    const double approach = approach_of(row, s.h);
    const Yielding* yielding = giving_way(scene, fixed, n);
    if (yielding != nullptr) c.sag = 0;  // its force is the limit of the yielding body
    // a yielding body is pressed for many steps
    if (!inherit_from(m, point, memory, yielding != nullptr ? 0 : approach, c, row))
      row.offset = std::max(0.0, -row.gap_start);
    set_law(scene, c, s.h, mobility_at(members, free, k, row.arm, n), approach, row);
    if (yielding != nullptr) row.normal_limit = yielding->force * s.h / n_closing;
    add_contact(row, yielding != nullptr);
  }

  void add_fixed_points(const PairManifold& m) {
    const size_t k = members.at(m.block_a);
    int n_closing = 0;
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PointPath path = path_of(k, point_at(p).point_b + point_at(p).gap * m.normal);
      n_closing += point_at(p).gap + m.normal.dot(path.moved) <= 0;
    }
    for (int p = m.point_begin; p < m.point_end; ++p)
      add_fixed_point(m, point_at(p), continued(m, p), std::max(n_closing, 1));
  }

  // In one piece, as add_ground(): a contact is many small functions, and their calls are a
  // twentieth of a step.
  [[gnu::flatten]] void add_points(const PairManifold& m) {
    if (!has_points(m)) return;
    const Meeting meeting = meeting_of(m);
    for (int p = m.point_begin; p < m.point_end; ++p)
      add_point(m, meeting, point_at(p), continued(m, p));
  }

  void add_pair(int manifold) {
    const PairManifold& m = search.pairs.manifolds[manifold];
    begin_pair(members.place[m.block_a], is_fixed(scene, m.block_b) ? -1 : members.place[m.block_b],
               manifold);
    match_memories(m, name_of_body(scene, m.block_b), search.pairs.points, memory_of(m.block_a),
                   making.memories);
    if (is_fixed(scene, m.block_b))
      add_fixed_points(m);
    else
      add_points(m);
    if (system.island.pairs.back().row_begin == system.island.pairs.back().row_end) {
      system.island.pairs.pop_back();
      system.first_contact.pop_back();
      system.pair_manifold.pop_back();
    }
  }

  bool run() {
    clear();
    for (size_t k = 0; k < members.size(); ++k)
      if (!add_ground(k)) return false;
    for (const int i : manifolds) add_pair(i);
    return true;
  }
};

}  // namespace

bool make_contacts(const Scene& scene, const State& state, const PairSearch& search,
                   std::span<const int> manifolds, const IslandMembers& members,
                   const FreeMotions& free, const SubstepRetries& tries,
                   std::vector<NearFeatures>& near_ground, ContactMaking& making,
                   IslandSystem& system) {
  return ContactMaker{scene, state, search,      manifolds, members,
                      free,  tries, near_ground, making,    system}
      .run();
}

double first_touch(const Scene& scene, const State& state, const IslandSystem& system, double h) {
  double first = h + 1;
  if (!anything_yields(scene)) return first;
  for (size_t r = 0; r < system.contacts.size(); ++r) {
    const KeptContact& contact = system.contacts[r];
    const double v = contact.speed_start, g = contact.gap_start;
    if (row_of(system, r).normal_limit() >= no_normal_limit || g <= contact.touch ||
        contact.gap_free > -contact.touch ||
        knows_body(state, contact.a, name_of_fixed(contact.fixed)))
      continue;
    const double a = 2 * (contact.gap_free - g - v * h) / (h * h);
    first = std::min(first, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
  }
  return first;
}

}  // namespace talus
