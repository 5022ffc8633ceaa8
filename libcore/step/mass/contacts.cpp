// Stage 2 of the mass step: rows in single precision straight from the results of the searches.
#include <algorithm>
#include <cmath>

#include "contact/scales.hpp"
#include "motion/free_rotation.hpp"
#include "scene/bonds.hpp"
#include "scene/stems.hpp"
#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "solver/mass_numbers.hpp"
#include "step/island/stems.hpp"
#include "step/loads.hpp"
#include "step/mass/stages.hpp"
#include "step/rough_joints.hpp"
#include "step/soil.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

void set_floats(const Vec3& from, float (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

/// How the points of a contact move relative to each other without contact forces.
struct PointMotion {
  Vec3 arm_a, arm_b;             // in the middle of the step [m]
  Vec3 start, end;               // velocities [m/s]
  double gap = 0, gap_free = 0;  // at the start and at the end [m]
};

/// Faces of a contact: its law beyond firm contact.
struct Faces {
  double friction = 0, restitution = 0;
  double resting_speed = 0;
  double thickness = 0;            // of the thinner body [m]
  double limit = no_normal_limit;  // of the normal impulse [N s]
  bool yields = false;
};

/// Makes contacts of a mass; a struct so that its functions share common data.
struct MassMaker {
  const Scene& scene;
  const State& state;
  const PairSearch& search;
  std::span<const int> manifolds;
  const IslandMembers& members;
  const FreeMotions& free;
  std::vector<NearFeatures>& near_ground;
  MassScratch& w;  // members
  MassPart& out;
  double reach = 0, recovery_time = 0, compliance = 0;

  void clear_part() {
    out.rows.clear();
    out.pairs.clear();
    out.turns.clear();
    out.arms.clear();
    out.contacts.clear();
    out.ground_pair.clear();
    out.making.memories.touched_by = -1;
    out.fell_through = false;
    out.outsider = -1;
  }

  [[nodiscard]] double per_mass_of(size_t k) const {
    return members.numbers[k].stands ? 0 : members.numbers[k].inverse_mass;
  }

  void set_member(size_t k) {
    const Substep& s = free.substeps[k];
    const FreeTurn& turn = free.turns[k];
    MassMember& m = w.members[k];
    m.at = s.start.pose.position;
    m.middle = (s.start.pose.position + s.free.pose.position) / 2;
    m.moved = s.free.pose.position - s.start.pose.position;
    m.turned = turn.by - Mat3::Identity();
    m.velocity_start = s.start.velocity;
    m.velocity_end = s.free.velocity;
    m.spin_start = turn.spin_start;
    m.spin_end = turn.spin_end;
    set_middle(members.numbers[k], members.block(k), s, m);
    const Mat3& P = m.inverse_inertia;
    const auto single = [](double x) { return static_cast<float>(x); };
    w.system.inertia[k] = {single(P(0, 0)),        single(P(1, 1)),
                           single(P(2, 2)),        single(P(0, 1)),
                           single(P(0, 2)),        single(P(1, 2)),
                           single(per_mass_of(k)), single(members.numbers[k].radius)};
  }

  void set_middle(const BlockNumbers& c, size_t b, const Substep& s, MassMember& m) const {
    const Pose& start = s.start.pose;
    m.momentum = s.start.angular_momentum;
    if (!scene.loads.empty())  // as predict() has it
      m.momentum +=
          free.h / 2 * load_torque(scene, static_cast<int>(b), start.attitude, state.pressure);
    m.attitude = free_rotation(start.attitude, m.momentum, c.inertia, free.h / 2);
    const Mat3 R = m.attitude.toRotationMatrix();
    m.inverse_inertia = R * c.inverse_inertia.asDiagonal() * R.transpose();
    if (c.stands) m.inverse_inertia.setZero();
    m.spin = m.inverse_inertia * m.momentum;
  }

  void open_pair(int a, int b) {
    const auto n = static_cast<int>(out.rows.size());
    out.pairs.push_back({a, b, n, n});
  }
  // False where the pair has no rows: it is dropped.
  bool close_pair() {
    MassPair& pair = out.pairs.back();
    pair.row_end = static_cast<int>(out.rows.size());
    if (pair.row_end > pair.row_begin) return true;
    out.pairs.pop_back();
    return false;
  }

  // Stiffness of a contact in the mass, as its memory has it [N/m].
  [[nodiscard]] double stiffness_of(const Vec3& n, const PointMotion& motion,
                                    const MassContact& contact) const {
    const auto mobility = [&](int b, const Vec3& arm) {
      const size_t k = members.at(b);
      const Vec3 turn = arm.cross(n);
      return per_mass_of(k) + turn.dot(w.members[k].inverse_inertia * turn);
    };
    double W = mobility(contact.a, motion.arm_a);
    if (contact.b >= 0) W += mobility(contact.b, motion.arm_b);
    return 1 / (compliance * W * members.of(contact.a).recovery_time * free.h);
  }

  // Overlap that presses nothing: the rest of the last step's, or that of a new contact. A contact
  // that was softer, since it comes from the exact step, keeps its force: further overlap presses
  // nothing. It is pressed out slowly, so that nothing is lifted; deep overlap faster.
  [[nodiscard]] double offset_of(const Vec3& n, const PointMotion& motion, const Faces& faces,
                                 const ContactMemory* then, const MassContact& contact) const {
    double left = then != nullptr ? then->offset : std::max(0.0, -motion.gap);
    if (then != nullptr && then->stiffness > 0) {
      const double stiffness = stiffness_of(n, motion, contact);
      if (stiffness > law::same_law * then->stiffness)
        left += (1 - then->stiffness / stiffness) * std::max(0.0, -(motion.gap + left));
    }
    const double deep = std::clamp(left / (law::sunk * faces.thickness) - 1, 0.0, 1.0);
    const double relaxed = offset_relaxed(scene.gravity.norm(), free.h);
    return std::max(0.0, left - relaxed - deep * (free.h * law::fastest_relaxing - relaxed));
  }

  // Velocity below which the row presses, less that of its point.
  [[nodiscard]] double bias_of(const Vec3& n, const PointMotion& motion, const Faces& faces,
                               double approach, const ContactMemory* then,
                               const MassContact& contact) const {
    if (contact.is_hit) return faces.restitution * approach;
    if (motion.gap >= 0) return motion.gap / free.h;
    if (faces.yields) return 0;  // the overlap of a yielding body presses nothing
    return std::min(0.0, motion.gap + offset_of(n, motion, faces, then, contact)) / recovery_time;
  }

  // Adds the row of a contact that moves so; the rest of `contact` is filled. `then`: the memory
  // that it continues, or none.
  void add_row(const Vec3& normal, const PointMotion& motion, const Faces& faces,
               const ContactMemory* then, MassContact& contact) {
    const Vec3& n = normal;
    contact.gap_free = motion.gap_free;
    contact.speed_start = n.dot(motion.start);
    const Vec3 slip = motion.start - contact.speed_start * n;
    const double slip_speed = slip.norm();
    contact.slip_speed = static_cast<float>(slip_speed);
    const double approach = std::min(contact.speed_start, (motion.gap_free - motion.gap) / free.h);
    // Points of a flat hit close together, whatever rounding says of each.
    contact.is_hit = !faces.yields && approach < -faces.resting_speed &&
                     motion.gap_free < negligible * faces.thickness;
    contact.yields = faces.yields;
    MassRow& row = out.rows.emplace_back();
    set_floats(n, row.normal);
    set_floats(motion.arm_a, row.arm_a);
    set_floats(motion.arm_b, row.arm_b);
    set_floats(motion.end + bias_of(n, motion, faces, approach, then, contact) * n, row.velocity);
    if (slip_speed > 0) set_floats(slip / slip_speed, row.slip_start);
    row.friction = static_cast<float>(faces.friction);
    row.limit = static_cast<float>(std::min(faces.limit, law_limit));
    if (then != nullptr && !contact.is_hit) set_floats(last_impulse(*then, n, faces), row.impulse);
    out.contacts.push_back(contact);
  }
  static constexpr double law_limit = 1e30;  // a float, and its square times a mobility too

  // The impulse of the contact in the last step, scaled to this one.
  [[nodiscard]] Vec3 last_impulse(const ContactMemory& then, const Vec3& n,
                                  const Faces& faces) const {
    const double p_n = free.h * then.normal_force;
    Vec3 p_t = -free.h * scene.settings.shear_ratio * then.stiffness * then.shear;
    p_t -= n.dot(p_t) * n;
    const double size = p_t.norm(), cap = faces.friction * p_n;
    if (size > cap) p_t *= cap / size;
    return p_n * n + p_t;
  }

  // --- with the ground -------------------------------------------------------------------------

  // Restitution of an impact at this approach on ground.
  static double restitution_on(const GroundClass& ground, double mass, double restitution,
                               double approach) {
    return approach < 0 ? fall_on(ground, mass).at(restitution, -approach) : restitution;
  }

  // False where member k is off the known ground.
  bool add_ground(size_t k) {
    out.ground_pair.push_back(-1);
    const Substep& s = free.substeps[k];
    const int b = members.blocks[k];
    const BlockNumbers& c = members.numbers[k];
    if (c.stands) return true;
    if (!scene.settings.trn_contacts) {
      out.fell_through |= is_below_ground(scene, b, s.free.pose.position);
      return true;
    }
    const SearchResult near = find_contacts(
        scene.ground, scene.blocks.shapes, b, s.free.pose, Mat3::Identity(), search_margin(c, s.h),
        out.making.world_vertices, out.making.found, &near_ground[b]);
    if (near.reach == Reach::off_ground) return false;
    out.fell_through |= near.reach == Reach::below;
    if (out.making.found.empty()) return true;
    out.making.rows.resize(out.making.found.size());
    make_rows(scene, b, c, s, state.memory[b], out.making.found, out.making.rows);
    open_pair(static_cast<int>(k), -1);
    for (ContactRow& row : out.making.rows) add_ground_row(k, row);
    if (!close_pair()) return true;
    out.ground_pair.back() = static_cast<int>(out.pairs.size()) - 1;
    add_turn_of(k);
    return true;
  }

  void add_ground_row(size_t k, const ContactRow& row) {
    const Substep& s = free.substeps[k];
    const MassMember& m = w.members[k];
    const Vec3 normal = s.R * row.normal;
    PointMotion motion;
    motion.gap = row.gap_start;
    motion.gap_free = row.gap_start + row.normal.dot(row.free_move);
    if (std::min(motion.gap, motion.gap_free) > reach) return;
    motion.arm_a = s.R * row.arm;
    motion.arm_b.setZero();
    motion.start = row.speed_start * normal + row.slip_speed * (s.R * row.slip_start);
    motion.end = m.velocity_end + m.spin_end.cross(motion.arm_a) + s.R * row.drift;
    const GroundClass& ground = scene.ground.classes[row.ground_class];
    const BlockNumbers& c = members.numbers[k];
    const double approach = std::min(row.speed_start, (motion.gap_free - motion.gap) / free.h);
    Faces faces;
    faces.friction = row.friction;
    vary_friction(ground, slide_of(state, members.blocks[k], free.t), row.slip_speed, free.h,
                  faces.friction);
    faces.restitution = restitution_on(ground, c.mass, row.restitution, approach);
    faces.resting_speed = c.resting_speed;
    faces.thickness = c.thickness;
    MassContact contact;
    contact.key = row.key;
    contact.a = members.blocks[k];
    contact.ground_class = row.ground_class;
    add_row(normal, motion, faces, row.memory < 0 ? nullptr : &state.memory[contact.a][row.memory],
            contact);
  }

  // The couple against rolling of the pair that was closed last, of member k with the ground.
  void add_turn_of(size_t k) {
    const MassPair& pair = out.pairs.back();
    const auto class_of = [&](int r) -> const GroundClass& {
      return scene.ground.classes[out.contacts[r].ground_class];
    };
    bool any = false;
    for (int r = pair.row_begin; r < pair.row_end; ++r) any |= resists_rolling(class_of(r));
    if (!any) return;
    MassTurn turn;
    turn.pair = static_cast<int>(out.pairs.size()) - 1;
    turn.arm_begin = static_cast<int>(out.arms.size());
    turn.damping = turn_damping(scene, members.numbers[k], free.h);
    turn.inertia = members.numbers[k].inertia.minCoeff();
    turn.spin = w.members[k].spin;
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const MassContact& contact = out.contacts[r];
      const double approach = contact.is_hit ? std::max(0.0, -contact.speed_start) : 0;
      out.arms.push_back(arm_on(scene, class_of(r), contact.a)
                             .at_least(dent_on(scene, class_of(r), contact.a).arm_at(approach)));
    }
    out.turns.push_back(turn);
  }

  // --- with other bodies -----------------------------------------------------------------------

  // Without B: on a fixed body. False where the points cannot close within the step.
  bool set_motion(const Vec3& n, const PairPoint& point, const MassMember& a, const MassMember* b,
                  PointMotion& motion) const {
    const Vec3 start_a = point.point_b + point.gap * n - a.at, turned_a = a.turned * start_a;
    Vec3 start_b = Vec3::Zero(), turned_b = Vec3::Zero();
    double along = n.dot(a.moved + turned_a);
    if (b != nullptr) {
      start_b = point.point_b - b->at;
      turned_b = b->turned * start_b;
      along -= n.dot(b->moved + turned_b);
    }
    motion.gap = point.gap;
    motion.gap_free = point.gap + along;
    if (std::min(motion.gap, motion.gap_free) > reach) return false;
    motion.start = a.velocity_start + a.spin_start.cross(start_a);
    motion.end = a.velocity_end + a.spin_end.cross(start_a + turned_a);
    motion.arm_a = start_a + turned_a / 2;
    motion.arm_b.setZero();
    if (b == nullptr) return true;
    motion.start -= b->velocity_start + b->spin_start.cross(start_b);
    motion.end -= b->velocity_end + b->spin_end.cross(start_b + turned_b);
    const Vec3 shift = a.middle - b->middle;  // one point for both: impulses are on one line
    motion.arm_a = (motion.arm_a + start_b + turned_b / 2 - shift) / 2;
    motion.arm_b = motion.arm_a + shift;
    return true;
  }

  [[nodiscard]] const ContactMemory* memory_of(const PairManifold& m, int p) const {
    const int i = out.making.memories.continued[p - m.point_begin];
    return i < 0 ? nullptr : &state.memory[m.block_a][i];
  }

  // Contacts of two blocks, or of a block with a fixed body.
  void add_pair(const PairManifold& m) {
    if (!has_points(m)) return;
    const bool on_fixed = is_fixed(scene, m.block_b);
    const size_t ka = members.at(m.block_a);
    const MassMember& a = w.members[ka];
    const MassMember* b = on_fixed ? nullptr : &w.members[members.at(m.block_b)];
    const int fixed = on_fixed ? fixed_of(scene, m.block_b) : -1;
    const Yielding* yielding = on_fixed ? giving_way(scene, fixed, m.normal) : nullptr;
    open_pair(static_cast<int>(ka), on_fixed ? -1 : members.place[m.block_b]);
    GroundClass of = on_fixed ? fixed_class(scene, fixed) : pair_class(scene, m);
    if (!on_fixed) set_rough_friction(scene, m, state.memory[m.block_a], of);
    Faces faces;
    bool is_first = true;
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PairPoint& point = search.pairs.points[p];
      PointMotion motion;
      if (!set_motion(m.normal, point, a, b, motion)) continue;
      if (is_first) {
        is_first = false;
        faces = faces_of(of, m, fixed);
        match_memories(m, name_of_body(scene, m.block_b), search.pairs.points,
                       state.memory[m.block_a], out.making.memories);
      }
      weaken_friction(of, slip_of(m.normal, motion), faces.friction);
      if (yielding != nullptr) yield_to(*yielding, m, a, motion, faces);
      MassContact contact;
      contact.key = point.key;
      contact.key.body_b = name_of_body(scene, m.block_b);
      contact.a = m.block_a;
      contact.b = on_fixed ? -1 : m.block_b;
      contact.fixed = fixed;
      add_row(m.normal, motion, faces, memory_of(m, p), contact);
    }
    (void)close_pair();
  }

  static double slip_of(const Vec3& normal, const PointMotion& motion) {
    return (motion.start - normal.dot(motion.start) * normal).norm();
  }

  [[nodiscard]] Faces faces_of(const GroundClass& of, const PairManifold& m, int fixed) const {
    Faces faces;
    faces.friction = of.friction;
    faces.restitution = of.restitution;
    faces.resting_speed = members.of(m.block_a).resting_speed;
    faces.thickness = members.of(m.block_a).thickness;
    if (fixed < 0) faces.thickness = std::min(faces.thickness, members.of(m.block_b).thickness);
    return faces;
  }

  // Points that close within the step share the force at which the body yields; it resists from its
  // first touch on.
  void yield_to(const Yielding& yielding, const PairManifold& m, const MassMember& a,
                const PointMotion& at, Faces& faces) const {
    int n_closing = 0;
    for (int p = m.point_begin; p < m.point_end; ++p) {
      PointMotion motion;
      if (set_motion(m.normal, search.pairs.points[p], a, nullptr, motion))
        n_closing += motion.gap_free <= 0;
    }
    const double closes = at.gap - at.gap_free;
    const double touched = at.gap > 0 && closes > at.gap ? free.h * (1 - at.gap / closes) : free.h;
    faces.limit = yielding.force * touched / std::max(n_closing, 1);
    faces.yields = true;
  }

  void begin() {
    clear_part();
    reach = mass_reach(scene, free.h);
    recovery_time = members.numbers.front().recovery_time;
    // without shares of a mass it is the first step: nothing is remembered
    compliance = mass_compliance(
        scene, state.mass.empty() ? MassShare{} : state.mass[members.moving.front()]);
  }
  // Members [from, to), and their contacts with the ground.
  void add_members(size_t from, size_t to) {
    for (size_t k = from; k < to && out.outsider < 0; ++k) {
      set_member(k);
      if (!add_ground(k)) out.outsider = members.blocks[k];
    }
  }
  void add_pairs(size_t from, size_t to) {
    for (size_t i = from; i < to; ++i) add_pair(search.pairs.manifolds[manifolds[i]]);
  }
};

template <class T>
void append(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

// Puts the parts behind each other.
void join_parts(std::span<const MassPart> parts, MassScratch& w) {
  MassSystem& s = w.system;
  for (const MassPart& part : parts) {
    const auto first_row = static_cast<int>(s.rows.size()),
               first_pair = static_cast<int>(s.pairs.size()),
               first_arm = static_cast<int>(s.arms.size());
    append(part.rows, s.rows);
    append(part.arms, s.arms);
    append(part.contacts, w.contacts);
    for (MassPair pair : part.pairs) {
      pair.row_begin += first_row;
      pair.row_end += first_row;
      s.pairs.push_back(pair);
    }
    for (MassTurn turn : part.turns) {
      turn.pair += first_pair;
      turn.arm_begin += first_arm;
      s.turns.push_back(turn);
    }
    for (const int pair : part.ground_pair)
      w.ground_pair.push_back(pair < 0 ? -1 : first_pair + pair);
    w.fell_through |= part.fell_through;
  }
}

}  // namespace

double mass_reach(const Scene& scene, double h) {
  return h * std::max(scene.gravity.norm() * h, mass::reach_speed);
}

double longest_mass_substep(const Scene& scene, const PairSearch& search,
                            const IslandMembers& members, std::span<const int> manifolds,
                            double h) {
  double part = 0, farthest = 0;  // of the thickness
  for (size_t k = 0; k < members.size(); ++k) {
    const double turn = search.turn[members.block(k)];
    part = std::max(part, turn / (law::most_turn * members.numbers[k].radius));
    farthest = std::max(farthest, turn / members.numbers[k].thickness);
  }
  for (const int i : manifolds) {
    const PairManifold& m = search.pairs.manifolds[i];
    const size_t a = static_cast<size_t>(m.block_a), b = static_cast<size_t>(m.block_b);
    double thickness = members.of(m.block_a).thickness, travel = search.turn[a];
    if (!is_fixed(scene, m.block_b)) {
      thickness = std::min(thickness, members.of(m.block_b).thickness);
      travel += (search.step[a] - search.step[b]).norm() + search.turn[b];
    } else if (is_stem(scene, fixed_of(scene, m.block_b))) {
      part = std::max(part, part_by_stem(scene, search, m, thickness));
      continue;
    } else {
      travel += search.step[a].norm();
    }
    part = std::max(part, travel / (2 * law::deep_share * thickness));
    farthest = std::max(farthest, travel / thickness);
  }
  if (is_long_step(scene, h) && farthest > law::deep_share) part = std::max(part, 2.0);
  const double shortest = std::min(h, scene.settings.dt / law::most_substeps);
  return part > 1 ? std::max(h / std::ceil(part), shortest) : h;
}

bool make_mass_contacts(const Scene& scene, const State& state, const PairSearch& search,
                        std::span<const int> manifolds, const IslandMembers& members,
                        const FreeMotions& free, std::vector<NearFeatures>& near_ground,
                        Workers* workers, MassScratch& w, int& outsider) {
  const size_t n = members.size(), n_pairs = manifolds.size();
  w.members.resize(n);
  clear(w.system);
  w.system.inertia.resize(n);
  w.contacts.clear();
  w.ground_pair.clear();
  w.fell_through = false;
  const auto maker = [&](MassPart& part) {
    return MassMaker{scene, state, search, manifolds, members, free, near_ground, w, part};
  };
  const size_t of_members = talus::n_parts(workers, n), of_pairs = talus::n_parts(workers, n_pairs);
  w.parts.resize(std::max(w.parts.size(), of_members + of_pairs));
  const auto parts = std::span(w.parts).first(of_members + of_pairs);
  in_parts(workers, n, [&](size_t i, size_t begin, size_t end) {
    MassMaker make = maker(parts[i]);
    make.begin();
    make.add_members(begin, end);
  });
  for (const MassPart& part : parts.first(of_members)) {
    outsider = part.outsider;
    if (outsider >= 0) return false;
  }
  in_parts(workers, n_pairs, [&](size_t i, size_t begin, size_t end) {
    MassMaker make = maker(parts[of_members + i]);
    make.begin();
    make.add_pairs(begin, end);
  });
  join_parts(parts, w);
  return true;
}

}  // namespace talus
