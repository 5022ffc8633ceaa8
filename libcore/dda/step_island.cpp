#include "dda/step_island.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "contact/search.hpp"
#include "dda/fence.hpp"
#include "dda/flight.hpp"
#include "dda/rotation.hpp"
#include "dda/step.hpp"
#include "dda/substep.hpp"

namespace talus {
namespace {

using std::size_t;

// k_n dt^2 / m of a contact in an island: bounds the condition of its matrix ...
constexpr double stiffest_in_island = 1;
// ... and where it is small enough to be factored, so that a tower hardly sags.
constexpr double stiffest_in_small_island = 30;
constexpr size_t small_island = 8;
constexpr size_t small_tree = 64;  // the same where blocks hang together without a ring: a column
constexpr double pair_touch_ratio = 1e-6;     // a pair touches when its gap is below this part of r
constexpr int most_halvings = 4;              // of a substep that does not converge
constexpr double hit_stiffness = 30;          // D of a hit over the mass that it feels
constexpr double hit_share = 0.7;             // first guess of its impulse, of that of a lone hit
constexpr double hit_tolerance = 1e-2;        // of its rebound, of the speed that it came with
constexpr double small_hit_tolerance = 1e-9;  // the same in an island that is factored
constexpr int most_hit_rounds = 8;            // solutions until all hits are found and rebound
constexpr double island_tolerance = 1e-2;     // of contact forces, of what gravity does in the step
constexpr double motion_tolerance = 1e-3;  // ... but not above this part of the fastest speed ...
constexpr double rest_tolerance = 1e-6;    // ... nor below this, of what gravity does
constexpr double small_tolerance = 1e-8;   // the same in an island that is factored
constexpr double gain_rounding = 1e-6;     // of the energy of hits: not a gain
constexpr double linear_tolerance = 3e-2;  // of conjugate gradients in a Newton step
constexpr double most_turn = 0.5;          // in a substep [rad]
constexpr double most_travel = 0.5;        // relative to a neighbour in a substep, of the thickness
constexpr double most_substeps = 64;       // for these two reasons
constexpr int most_cuts = 24;              // of a substep where a panel of a fence breaks
constexpr double held = 1e100;             // strength of an intact bond while the forces are sought

Vec3 spin_of(const Motion& m, const Vec3& inertia) {
  return angular_velocity(m.pose.attitude, m.angular_momentum, inertia);
}

bool takes_part(const State& state, int b) {
  const Phase phase = state.phase[static_cast<size_t>(b)];
  return phase != Phase::left_domain && phase != Phase::stopped;
}

// Contacts between the blocks marked in work.islands.moving, and of those with others, over `h`.
void find_pairs(const Scene& scene, double h, State& state, Work& work) {
  IslandStepWork& w = work.islands;
  const Blocks& blocks = scene.blocks;
  double margin = 0;
  for (int b = 0; b < n_blocks(scene); ++b)
    margin = std::max(margin, search_margin(numbers_of(scene, b), h));
  PairSettings settings;
  settings.margin = margin;
  settings.with_areas = !state.bonds.empty();
  settings.graze_m = scene.gravity.norm() * h * h / stiffest_in_island;
  place_hulls(blocks.hulls, w.poses, {}, w.moving, state.placed);
  (void)find_pair_contacts(blocks.hulls, state.placed, {w.step, w.turn, w.awake, w.fixed, w.group},
                           settings, state.pairs, w.pairs);
}

void set_motion_ahead(const Scene& scene, int b, const Motion& m, double h, IslandStepWork& w) {
  const auto i = static_cast<size_t>(b);
  w.poses[i] = m.pose;
  w.step[i] = h * m.velocity;
  w.turn[i] = h * scene.blocks.shapes.radius[i] * spin_of(m, scene.blocks.inertia[i]).norm();
}

// Fixed bodies where they are now: they step nowhere and need no contacts of their own. Panels of
// fences that gave way have moved since they were placed last.
void place_fixed(const Scene& scene, const State& state, IslandStepWork& w) {
  const int n = n_blocks(scene), n_bodies = n + n_fixed(scene);
  if (n == n_bodies) return;
  w.fixed.assign(static_cast<size_t>(n_bodies), 0);
  w.group.clear();
  for (int b = n; b < n_bodies; ++b) {
    const auto i = static_cast<size_t>(b);
    w.poses[i] = fixed_pose(scene, state, b);
    w.step[i].setZero();
    w.turn[i] = 0;
    w.moving[i] = !state.placed.turned.empty() && state.placed.position[i] != w.poses[i].position;
    w.awake[i] = 0;
    w.fixed[i] = 1;
  }
  if (scene.settings.block_contacts) return;
  w.group.assign(static_cast<size_t>(n_bodies), 0);
  for (int b = n; b < n_bodies; ++b) w.group[static_cast<size_t>(b)] = 1;
}

// Pairs of blocks within reach; true when one of them was asleep and now is not.
bool join_pairs(const Scene& scene, State& state, IslandStepWork& w) {
  bool woken = false;
  w.joined.clear();
  w.joined_manifold.clear();
  for (size_t j = 0; j < w.pairs.manifolds.size(); ++j) {
    const PairManifold& m = w.pairs.manifolds[j];
    if (is_fixed(scene, m.block_b)) {
      if (!takes_part(state, m.block_a) || !stands(scene, state, m.block_b)) continue;
      w.joined.emplace_back(m.block_a, -1);
      w.joined_manifold.push_back(static_cast<int>(j));
      w.near_fixed[static_cast<size_t>(m.block_a)] = 1;
      continue;
    }
    if (!takes_part(state, m.block_a) || !takes_part(state, m.block_b)) continue;
    w.joined.emplace_back(m.block_a, m.block_b);
    w.joined_manifold.push_back(static_cast<int>(j));
    for (const int b : {m.block_a, m.block_b}) {
      const auto i = static_cast<size_t>(b);
      if (state.phase[i] != Phase::asleep) continue;
      state.phase[i] = Phase::near_ground;
      state.still_steps[i] = 0;
      state.local_time[i] = state.time;
      w.awake[i] = 1;
      woken = true;
    }
  }
  return woken;
}

/// Outcome of one attempt at a substep.
enum class Attempt { done, shorter, left };

/// Everything that advances one island; a struct so that its parts share what they all need.
struct AdvanceIsland {
  const Scene& scene;
  State& state;
  Work& work;
  StepReport& report;
  IslandStepWork& w;
  int outsider = -1;  // block that the last attempt found off the known ground
  int halvings = 0;
  bool small = false;
  int cuts = 0;  // of the substep at the time when a panel is used up

  [[nodiscard]] size_t block(size_t k) const { return static_cast<size_t>(w.members[k]); }
  Motion& motion(size_t k) { return state.motion[block(k)]; }
  // Whether the matrix is cheap to factor. Needs island_manifolds.
  [[nodiscard]] bool is_small() const { return small; }
  void see_size() {
    const auto n_pairs =
        std::count_if(w.island_manifolds.begin(), w.island_manifolds.end(), [this](int i) {
          return !is_fixed(scene, w.pairs.manifolds[static_cast<size_t>(i)].block_b);
        });
    const size_t n = w.members.size();
    small = n <= small_island || (n <= small_tree && static_cast<size_t>(n_pairs) < n);
  }
  [[nodiscard]] double stiffness_ratio() const {
    return is_small() ? stiffest_in_small_island : stiffest_in_island;
  }

  void gather(std::span<const int> blocks) {
    w.members.assign(blocks.begin(), blocks.end());
    w.numbers.clear();
    for (size_t k = 0; k < w.members.size(); ++k) {
      w.place[block(k)] = static_cast<int>(k);
      w.numbers.push_back(numbers_of(scene, w.members[k]));
    }
  }

  void release() {
    for (const int b : w.members) w.place[static_cast<size_t>(b)] = -1;
  }

  // The pairs at the poses of now, for at most `h` ahead.
  void search_pairs(double h) {
    for (size_t k = 0; k < w.members.size(); ++k) {
      w.moving[block(k)] = 1;
      set_motion_ahead(scene, w.members[k], motion(k), h, w);
    }
    w.awake = w.moving;
    place_fixed(scene, state, w);
    find_pairs(scene, h, state, work);
    for (const int b : w.members) w.moving[static_cast<size_t>(b)] = 0;
    w.pairs_of_step = false;
    w.island_manifolds.clear();
    for (size_t m = 0; m < w.pairs.manifolds.size(); ++m)
      if (in_island(w.pairs.manifolds[m])) w.island_manifolds.push_back(static_cast<int>(m));
    set_stiffness();
  }

  // The pairs that form_islands found, those of island `k`.
  void take_pairs(int k) {
    const auto at = static_cast<size_t>(k);
    w.island_manifolds.clear();
    for (int p = w.groups.pair_begin[at]; p < w.groups.pair_begin[at + 1]; ++p) {
      const int m = w.joined_manifold[static_cast<size_t>(w.groups.pairs[static_cast<size_t>(p)])];
      if (in_island(w.pairs.manifolds[static_cast<size_t>(m)])) w.island_manifolds.push_back(m);
    }
    set_stiffness();
  }

  [[nodiscard]] bool in_island(const PairManifold& m) const {
    return w.place[static_cast<size_t>(m.block_a)] >= 0 &&
           (is_fixed(scene, m.block_b) ? stands(scene, state, m.block_b)
                                       : w.place[static_cast<size_t>(m.block_b)] >= 0);
  }
  [[nodiscard]] size_t place(int b) const {
    return static_cast<size_t>(w.place[static_cast<size_t>(b)]);
  }
  [[nodiscard]] const BlockNumbers& numbers(int b) const { return w.numbers[place(b)]; }

  // A small block may bear a large one: its contacts are as stiff as the heaviest block that it
  // touches asks for.
  void set_stiffness() {
    see_size();
    w.bearing.clear();
    for (const BlockNumbers& c : w.numbers) w.bearing.push_back(c.mass);
    for (const int i : w.island_manifolds) {
      const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
      if (is_fixed(scene, m.block_b)) continue;
      double &a = w.bearing[place(m.block_a)], &b = w.bearing[place(m.block_b)];
      a = std::max(a, numbers(m.block_b).mass);
      b = std::max(b, numbers(m.block_a).mass);
    }
    const double dt = scene.settings.dt;
    for (size_t k = 0; k < w.members.size(); ++k)
      w.numbers[k].stiffness = stiffness_ratio() * w.bearing[k] / (dt * dt);
  }

  // The longest substep over which the contacts found at its start still describe the motion.
  [[nodiscard]] double longest_substep(double h) const {
    double part = 0;
    for (size_t k = 0; k < w.members.size(); ++k)
      part = std::max(part, w.turn[block(k)] / (most_turn * w.numbers[k].radius));
    for (const int i : w.island_manifolds) {
      const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
      const auto a = static_cast<size_t>(m.block_a), b = static_cast<size_t>(m.block_b);
      double thickness = numbers(m.block_a).thickness;
      if (!is_fixed(scene, m.block_b))
        thickness = std::min(thickness, numbers(m.block_b).thickness);
      part = std::max(part, (w.step[a] - w.step[b]).norm() / (most_travel * thickness));
    }
    return part > 1 ? h / std::min(std::ceil(part), most_substeps) : h;
  }

  void clear_island() {
    w.contacts.clear();
    w.turns.clear();
    w.island.mass.clear();
    w.island.free_velocity.clear();
    w.island.velocity.clear();
    w.island.position.clear();
    w.island.radius.clear();
    w.island.pairs.clear();
    w.island.rows.clear();
  }

  void add_member(size_t k, double h) {
    const BlockNumbers& c = w.numbers[k];
    const Substep& s = w.substeps[k];
    const FreeTurn turn = {s.R * s.R_start.transpose(), s.R_start * s.spin_start, s.R * s.spin_free,
                           s.R * c.per_inertia.asDiagonal() * s.R.transpose()};
    Vec6 free, guess;
    free << s.free.velocity, turn.spin_end;
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

  void open_pair(int a, int b) {
    const int at = static_cast<int>(w.island.rows.size());
    w.island.pairs.push_back({a, b, at, at});
  }

  // A contact, and its row for the solver, from a row in local axes.
  void push(const ContactRow& row, IslandContact contact) {
    contact.row = row;
    contact.gap_free = row.gap_start + row.normal.dot(row.free_move);
    IslandRow out;
    out.normal = row.normal;
    out.arm = row.point;
    const double along = row.normal.dot(row.drift);
    out.shear_velocity = row.shear_velocity + (row.drift - along * row.normal);
    out.slip_start = row.slip_start;
    out.bias = row.bias + along;
    out.normal_damping = row.normal_damping;
    out.shear_damping = row.shear_damping;
    out.friction = row.friction;
    out.cohesion_impulse = row.cohesion_impulse;
    out.tension_impulse = row.tension_impulse;
    out.normal_limit = row.normal_limit;
    const double h = w.substeps.front().h;
    contact.approach = std::min(row.speed_start, row.normal.dot(row.free_move) / h);
    contact.waits = row.memory < 0 && !contact.never_waits &&
                    contact.approach < -numbers(contact.a).resting_speed;
    out.waits_for_impact = contact.waits;
    if (row.memory >= 0) {
      const ContactMemory& m =
          state.memory[static_cast<size_t>(contact.a)][static_cast<size_t>(row.memory)];
      out.impulse = h * m.normal_force * row.normal;
      out.state = static_cast<ContactState>(m.state);
    }
    w.contacts.push_back(contact);
    w.island.rows.push_back(out);
    w.island.pairs.back().row_end = static_cast<int>(w.island.rows.size());
  }

  // Contacts of a member with the ground. False when it is off the known ground.
  bool add_ground(size_t k) {
    const Substep& s = w.substeps[k];
    const int b = w.members[k];
    if (!scene.settings.trn_contacts) return true;
    const SearchResult near =
        find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, Mat3::Identity(),
                      search_margin(w.numbers[k], s.h), work.world_vertices, work.contacts);
    if (near.reach == Reach::off_ground) {
      outsider = b;
      return false;
    }
    if (near.reach == Reach::below) report.flags = report.flags | StepFlag::fell_through;
    make_rows(scene, b, w.numbers[k], s, state, work);
    if (work.rows.empty()) return true;
    open_pair(static_cast<int>(k), -1);
    for (ContactRow& row : work.rows) {
      for (Vec3* v : {&row.normal, &row.point, &row.drift, &row.shear, &row.shear_velocity,
                      &row.slip_start, &row.free_move})
        *v = s.R * *v;
      const Contact& contact = work.contacts[static_cast<size_t>(row.contact)];
      const GroundClass& ground = scene.ground.classes[static_cast<size_t>(contact.ground_class)];
      IslandContact out;
      out.key = contact.key;
      out.a = b;
      out.touch = w.numbers[k].touch;
      out.restitution = ground.restitution;
      out.ground_class = contact.ground_class;
      if (row.bond_area > 0) hold(ground, w.numbers[k].recovery_time, row, out);
      push(row, out);
    }
    return true;
  }

  // Lever arms, path and start velocity of a body's material point.
  struct PointPath {
    Vec3 start, end, moved, velocity, spin_end;
  };
  [[nodiscard]] PointPath path_of(size_t k, const Vec3& x) const {
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

  // The memories that the points of a manifold continue, -1: none. First those of the same
  // features; then, where features changed, those that the pair leaves without a successor, so that
  // a face that rests on another keeps its support and its friction while corners pass edges.
  void match_memories(const PairManifold& m) {
    const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(m.block_a)];
    w.continued.assign(static_cast<size_t>(m.point_end - m.point_begin), -1);
    w.unclaimed.clear();
    for (size_t i = 0; i < memory.size(); ++i)
      if (memory[i].key.body_b == m.block_b) w.unclaimed.push_back(static_cast<int>(i));
    const auto claim = [&](const auto& continues, double least_cosine) {
      for (size_t p = 0; p < w.continued.size() && !w.unclaimed.empty(); ++p) {
        if (w.continued[p] >= 0) continue;
        const ContactKey& key = w.pairs.points[static_cast<size_t>(m.point_begin) + p].key;
        const auto found = std::find_if(w.unclaimed.begin(), w.unclaimed.end(), [&](int i) {
          const ContactMemory& then = memory[static_cast<size_t>(i)];
          return then.normal.dot(m.normal) > least_cosine && continues(key, then.key);
        });
        if (found == w.unclaimed.end()) continue;
        w.continued[p] = *found;
        w.unclaimed.erase(found);
      }
    };
    claim(
        [](const ContactKey& now, const ContactKey& then) {
          return now.mode == then.mode && now.feature_a == then.feature_a &&
                 now.feature_b == then.feature_b;
        },
        0.5);
    claim([](const ContactKey&, const ContactKey&) { return true; }, 0.99);
  }

  [[nodiscard]] int continued(const PairManifold& m, int p) const {
    return w.continued[static_cast<size_t>(p - m.point_begin)];
  }

  // Holds a contact of a bond without limit; break_bonds() compares what it carries.
  static void hold(const GroundClass& face, double recovery_time, ContactRow& row,
                   IslandContact& contact) {
    row.cohesion_impulse = held;
    row.tension_impulse = face.tension > 0 ? held : 0;
    row.bias = (row.gap_start + row.offset) / recovery_time;
    contact.never_waits = true;
  }

  // The share of a contact in the bond of its blocks, if there is one. Where the faces were when
  // the bond was new, it carries nothing.
  void bond(const PairManifold& m, const PairPoint& point, double recovery_time, ContactRow& row,
            IslandContact& contact) const {
    contact.bond = find_bond(state.bonds, m.block_a, m.block_b);
    if (contact.bond < 0) return;
    const BlockBond& of_blocks = state.bonds[static_cast<size_t>(contact.bond)];
    row.bond_area = m.area > 0 ? of_blocks.area * point.area / m.area : 0;
    if (row.memory < 0) row.offset = -row.gap_start;
    hold(of_blocks.face, recovery_time, row, contact);
  }

  // The deepest that contacts of the pair are pressed in [m]. As much of the overlap of a new one
  // is no surprise: where corners of two faces only change places, what they bear must not be
  // dropped.
  [[nodiscard]] double compression_of(const PairManifold& m, const Vec3& normal) const {
    double deepest = 0;
    for (const ContactMemory& c : state.memory[static_cast<size_t>(m.block_a)])
      if (c.key.body_b == m.block_b && c.normal.dot(normal) > 0.5)
        deepest = std::max(deepest, -c.gap_end);
    return deepest;
  }

  // Mobility of a contact's point relative to the other side's, as mobility() with local axes.
  [[nodiscard]] Mobility mobility_at(size_t k, const Vec3& arm, const Vec3& normal) const {
    const Mat3& per_inertia = w.turns[k].per_inertia;
    const Vec3 turn = arm.cross(normal);
    const double along = 1 / w.numbers[k].mass + turn.dot(per_inertia * turn);
    const double all = 3 / w.numbers[k].mass + per_inertia.trace() * arm.squaredNorm() -
                       arm.dot(per_inertia * arm);
    return {along, std::max(along, all - along)};
  }

  void add_point(const PairManifold& m, const PairPoint& point, int memory) {
    const size_t ka = place(m.block_a), kb = place(m.block_b);
    const Substep& sa = w.substeps[ka];
    const BlockNumbers &ca = w.numbers[ka], &cb = w.numbers[kb];
    const Vec3& n = m.normal;
    const PointPath pa = path_of(ka, point.point_b + point.gap * n);
    const PointPath pb = path_of(kb, point.point_b);
    const Vec3 shift = w.island.position[ka] - w.island.position[kb];  // of B's arms from A's
    const Vec3 arm = (pa.start + pa.end + pb.start + pb.end) / 4 - shift / 2;
    const Vec3 arm_b = arm + shift;

    IslandContact contact;
    contact.a = m.block_a;
    contact.b = m.block_b;
    contact.key = point.key;
    contact.key.body_b = m.block_b;
    contact.touch = pair_touch_ratio * std::min(ca.radius, cb.radius);
    const GroundClass faces = pair_class(scene, m);
    contact.restitution = faces.restitution;
    ContactRow row;
    row.normal = n;
    row.point = arm;
    row.drift = pa.spin_end.cross(pa.end - arm) - pb.spin_end.cross(pb.end - arm_b);
    row.free_move = pa.moved - pb.moved;
    row.gap_start = point.gap;
    const Vec3 slip = pa.velocity - pb.velocity;
    row.speed_start = n.dot(slip);
    const Vec3 tangent = slip - row.speed_start * n;
    const double slip_speed = tangent.norm();
    if (slip_speed > 0) row.slip_start = tangent / slip_speed;
    row.friction = faces.friction;

    const double approach = std::min(row.speed_start, n.dot(row.free_move) / sa.h);
    if (memory >= 0 && !(row.gap_start > contact.touch && approach < -ca.resting_speed))
      inherit(state.memory[static_cast<size_t>(m.block_a)][static_cast<size_t>(memory)], memory,
              Mat3::Identity(), contact.touch, row);
    else
      row.offset = std::max(0.0, -row.gap_start - compression_of(m, n));
    const Mobility Wa = mobility_at(ka, arm, n), Wb = mobility_at(kb, arm_b, n);
    BlockNumbers c = ca;
    c.touch = contact.touch;
    c.stiffness = std::max(ca.stiffness, cb.stiffness) * (ca.mass / std::min(ca.mass, cb.mass));
    set_law(scene, c, sa.h, {Wa.normal + Wb.normal, Wa.tangent + Wb.tangent}, approach, row);
    bond(m, point, c.recovery_time, row, contact);
    push(row, contact);
  }

  // A point on a fixed body: for the solver, on the ground. `n_closing`: points of the manifold
  // that close within the substep; they share the force with which a panel of a fence gives way.
  void add_fixed_point(const PairManifold& m, const PairPoint& point, int memory, int n_closing) {
    const size_t k = place(m.block_a);
    const Substep& s = w.substeps[k];
    const Vec3& n = m.normal;
    const PointPath path = path_of(k, point.point_b + point.gap * n);
    BlockNumbers c = w.numbers[k];
    c.touch = pair_touch_ratio * c.radius;

    IslandContact contact;
    contact.a = m.block_a;
    contact.fixed = m.block_b;
    contact.key = point.key;
    contact.key.body_b = m.block_b;
    contact.touch = c.touch;
    contact.restitution = fixed_class(scene, m.block_b).restitution;
    ContactRow row;
    row.normal = n;
    row.point = (path.start + path.end) / 2;
    row.drift = path.spin_end.cross(path.end - row.point);
    row.free_move = path.moved;
    row.gap_start = point.gap;
    row.speed_start = n.dot(path.velocity);
    const Vec3 tangent = path.velocity - row.speed_start * n;
    const double slip_speed = tangent.norm();
    if (slip_speed > 0) row.slip_start = tangent / slip_speed;
    row.friction = fixed_class(scene, m.block_b).friction;

    const double approach = std::min(row.speed_start, n.dot(row.free_move) / s.h);
    const FencePanel* panel = giving_way(scene, m.block_b, n);
    if (memory >= 0 &&
        (panel != nullptr || !(row.gap_start > contact.touch && approach < -c.resting_speed)))
      inherit(state.memory[static_cast<size_t>(m.block_a)][static_cast<size_t>(memory)], memory,
              Mat3::Identity(), contact.touch, row);
    else
      row.offset = std::max(0.0, -row.gap_start);
    set_law(scene, c, s.h, mobility_at(k, row.point, n), approach, row);
    if (panel != nullptr) {
      row.normal_limit = panel->force * s.h / n_closing;
      contact.never_waits = true;
    }
    push(row, contact);
  }

  void add_fixed_points(const PairManifold& m) {
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
  [[nodiscard]] bool knows_body(int a, int b) const {
    const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(a)];
    return std::any_of(memory.begin(), memory.end(),
                       [b](const ContactMemory& m) { return m.key.body_b == b; });
  }

  // Time at which a block first touches a panel that gives way, h + 1: none does within the
  // substep. Its force acts from there on.
  [[nodiscard]] double first_touch(double h) const {
    double first = h + 1;
    for (const IslandContact& contact : w.contacts) {
      const ContactRow& row = contact.row;
      const double v = row.speed_start, g = row.gap_start;
      if (row.normal_limit >= no_normal_limit || g <= contact.touch ||
          contact.gap_free > -contact.touch || knows_body(contact.a, contact.fixed))
        continue;
      const double a = 2 * (contact.gap_free - g - v * h) / (h * h);
      first = std::min(first, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
    }
    return first;
  }

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
    [[nodiscard]] double approach(const PairPoint& point, double h) const {
      const double start =
          speed + spin_a.dot(point.point_b - at_a) - spin_b.dot(point.point_b - at_b);
      return std::min(start, (gap_end(point) - point.gap) / h);
    }
  };
  [[nodiscard]] PairMotionFree free_motion(const PairManifold& m) const {
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

  // The gap above which a new contact stays open: the island's other contacts push no point
  // farther within the substep, gravity's share four times over and twice the fastest hit.
  [[nodiscard]] double farthest_closing(double h) const {
    double hit = 0;
    for (const IslandContact& contact : w.contacts)
      if (contact.waits) hit = std::max(hit, -contact.approach);
    for (const int i : w.island_manifolds) {
      const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
      if (is_fixed(scene, m.block_b)) continue;
      const PairMotionFree free = free_motion(m);
      for (int p = m.point_begin; p < m.point_end; ++p) {
        const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
        const double speed = -free.approach(point, h);
        if (speed > numbers(m.block_a).resting_speed && free.gap_end(point) < h * speed)
          hit = std::max(hit, speed);
      }
    }
    return 4 * scene.gravity.norm() * h * h + 2 * h * hit;
  }

  void add_points(const PairManifold& m, double farthest) {
    const PairMotionFree free = free_motion(m);
    const bool bonded = find_bond(state.bonds, m.block_a, m.block_b) >= 0;
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
      const int memory = continued(m, p);
      if (memory < 0 && !bonded && std::min(point.gap, free.gap_end(point)) > farthest) continue;
      add_point(m, point, memory);
    }
  }

  // Bodies, and all contacts of the island, over h from t. False: a member left the ground.
  bool assemble(double t, double h) {
    clear_island();
    w.substeps.resize(w.members.size());
    for (size_t k = 0; k < w.members.size(); ++k) {
      w.substeps[k] = predict(scene, w.members[k], w.numbers[k], motion(k), t, h);
      add_member(k, h);
    }
    for (size_t k = 0; k < w.members.size(); ++k)
      if (!add_ground(k)) return false;
    const double farthest = farthest_closing(h);
    for (const int i : w.island_manifolds) {
      const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
      open_pair(w.place[static_cast<size_t>(m.block_a)], w.place[static_cast<size_t>(m.block_b)]);
      match_memories(m);
      if (is_fixed(scene, m.block_b))
        add_fixed_points(m);
      else
        add_points(m, farthest);
      if (w.island.pairs.back().row_begin == w.island.pairs.back().row_end)
        w.island.pairs.pop_back();
    }
    return true;
  }

  // Change of a member's velocity by contact.
  [[nodiscard]] Vec6 change(size_t k) const {
    return w.island.velocity[k] - w.island.free_velocity[k];
  }

  // Relative motion of the points of contact `r`, `of` being a motion of members.
  template <class Of>
  [[nodiscard]] Vec3 relative(size_t r, Of&& of) const {
    const IslandContact& contact = w.contacts[r];
    const Vec3& arm = w.island.rows[r].arm;
    const size_t ka = place(contact.a);
    Vec3 v = point_velocity<6>(of(ka), arm);
    if (contact.b >= 0) {
      const size_t kb = place(contact.b);
      v -= point_velocity<6>(of(kb), arm + w.island.position[ka] - w.island.position[kb]);
    }
    return v;
  }
  [[nodiscard]] Vec3 changed(size_t r) const {
    return relative(r, [&](size_t k) { return change(k); });
  }

  // Makes contact `r`, which waits, a hit: from its gaps at both ends of the step without it.
  void make_hit(size_t r, double gap_end, double h) {
    IslandContact& contact = w.contacts[r];
    IslandRow& row = w.island.rows[r];
    const double v = contact.row.speed_start, g = contact.row.gap_start;
    const double a = 2 * (gap_end - g - v * h) / (h * h);
    const double a_free = 2 * (contact.gap_free - g - v * h) / (h * h);
    if (g > 0)
      contact.hit_time = std::min(h, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
    const double rest = h - contact.hit_time;
    contact.hit_speed = g > 0 ? v + a * contact.hit_time : contact.approach;
    contact.target =
        std::max(0.0, -contact.restitution * contact.hit_speed + std::min(0.0, a_free) * rest);
    contact.waits = false;
    contact.hit = true;
    const size_t ka = place(contact.a);
    Mobility W = mobility_at(ka, contact.row.point, row.normal);
    if (contact.b >= 0) {
      const size_t kb = place(contact.b);
      const Vec3 arm_b = contact.row.point + w.island.position[ka] - w.island.position[kb];
      const Mobility Wb = mobility_at(kb, arm_b, row.normal);
      W.normal += Wb.normal;
      W.tangent += Wb.tangent;
    }
    row.normal_damping = hit_stiffness / W.normal;
    row.shear_damping = hit_stiffness / W.tangent;
    row.shear_velocity.setZero();
    row.slip_start.setZero();  // friction against the end velocity never gains energy
    row.waits_for_impact = false;
    const double change_alone = std::max(0.0, contact.target - (v + a_free * h));
    row.state = ContactState::slip;
    row.impulse = change_alone / W.normal * hit_share * row.normal;
    row.bias = -contact.target - change_alone / hit_stiffness;
  }

  // Contacts that wait and are hit by the motion `of` the members: how many.
  int find_hits(double h, bool free) {
    int n = 0;
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      if (!contact.waits) continue;
      const double by_contact = free ? 0.0 : h / 2 * contact.row.normal.dot(changed(r));
      const double gap_end = contact.gap_free + by_contact;
      if (gap_end > contact.touch) continue;
      make_hit(r, gap_end, h);
      ++n;
    }
    return n;
  }

  // Moves the targets of the hits by what finite stiffness left: the largest error, of the speed.
  double correct_hits() {
    double worst = 0;
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      IslandRow& row = w.island.rows[r];
      const double p_n = row.normal.dot(row.impulse);
      if (!contact.hit || p_n <= 0) continue;
      const double reached = -row.bias - p_n / row.normal_damping;
      worst = std::max(worst, std::abs(reached - contact.target) / -contact.hit_speed);
      row.bias = -contact.target - p_n / row.normal_damping;
    }
    return worst;
  }

  // Impulses of the hits times the speeds that they came with.
  [[nodiscard]] double hit_energy() const {
    double sum = 0;
    for (size_t r = 0; r < w.contacts.size(); ++r)
      if (w.contacts[r].hit)
        sum -= w.contacts[r].hit_speed * w.island.rows[r].normal.dot(w.island.rows[r].impulse);
    return sum;
  }

  // Work of all contact impulses on the velocities; > 0 would be a gain by restitution.
  [[nodiscard]] double work_on_velocities() const {
    double sum = 0;
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const Vec3& p = w.island.rows[r].impulse;
      if (p.isZero(0)) continue;
      sum += p.dot(relative(r, [&](size_t k) -> Vec6 {
        return (w.island.velocity[k] + w.island.free_velocity[k]) / 2;
      }));
    }
    return sum;
  }

  [[nodiscard]] double fastest() const {
    double speed = 0;
    for (size_t k = 0; k < w.members.size(); ++k)
      speed = std::max(speed, w.substeps[k].start.velocity.norm());
    return speed;
  }

  // Speed of the fastest hit.
  [[nodiscard]] double fastest_hit() const {
    double fastest = 0;
    for (const IslandContact& contact : w.contacts)
      if (contact.hit) fastest = std::max(fastest, -contact.hit_speed);
    return fastest;
  }

  bool solve_once(double h, bool continues) {
    IslandSettings settings;
    settings.continues = continues;
    const double by_gravity = scene.gravity.norm() * h;
    settings.tolerance = small_tolerance * by_gravity;
    settings.direct_bodies = is_small() ? static_cast<int>(w.members.size()) : 0;
    if (!is_small()) {
      const double by_motion = std::clamp(motion_tolerance * fastest(), rest_tolerance * by_gravity,
                                          island_tolerance * by_gravity);
      settings.tolerance = std::max(by_motion, hit_tolerance * fastest_hit());
      settings.linear_tolerance = linear_tolerance;
    }
    settings.tolerance *= scene.settings.tolerance_factor;
    const IslandResult solved = solve_island(w.island, settings, w.solver);
    report.passes += solved.passes;
    return solved.converged;
  }

  // Takes the rebound from the hits: what a set of them did to the energy was a gain.
  void forgo_rebound() {
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      if (!w.contacts[r].hit) continue;
      IslandRow& row = w.island.rows[r];
      w.contacts[r].target = 0;
      row.bias = -row.normal.dot(row.impulse) / row.normal_damping;
    }
  }

  // Impulses of the substep, hits included.
  bool solve(double h) {
    int hits = find_hits(h, true);
    set_times(h);
    bool converged = solve_once(h, false);
    for (int round = 0; round < most_hit_rounds && converged; ++round) {
      const int more = find_hits(h, false);
      hits += more;
      if (hits == 0) return true;
      const double error = correct_hits();
      if (more > 0) set_times(h);
      if (more == 0 && error <= (is_small() ? small_hit_tolerance : hit_tolerance)) break;
      converged = solve_once(h, true);
    }
    report.n_impacts += hits;
    if (converged && work_on_velocities() > gain_rounding * hit_energy()) {
      forgo_rebound();
      converged = solve_once(h, true);
    }
    return converged;
  }

  [[nodiscard]] bool is_closed() const {
    return std::none_of(w.contacts.begin(), w.contacts.end(),
                        [](const IslandContact& contact) { return contact.b < 0; });
  }

  // When each member's velocity changes, on the mean over the expected impulses: a contact that
  // presses all along acts in the middle of the substep, a hit at its time. Lever arms count from
  // where the members are then, so that angular momentum is kept. An island that touches nothing
  // else takes one time for all: different ones would move its centre of mass.
  void set_times(double h) {
    w.time.assign(w.members.size(), h / 2);
    const bool any_hit = std::any_of(w.contacts.begin(), w.contacts.end(),
                                     [](const IslandContact& contact) { return contact.hit; });
    if (any_hit) find_mean_times(h);
    for (size_t k = 0; k < w.members.size(); ++k)
      w.island.position[k] =
          w.substeps[k].free.pose.position - (h - w.time[k]) * w.substeps[k].free.velocity;
    if (any_hit) shift_arms(h);
  }

  void find_mean_times(double h) {
    w.weight.assign(w.members.size(), 0);
    w.time.assign(w.members.size(), 0);
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      const double p = w.island.rows[r].impulse.norm();
      const double t = contact.hit ? contact.hit_time : h / 2;
      for (const int b : {contact.a, contact.b}) {
        if (b < 0) continue;
        w.weight[place(b)] += p;
        w.time[place(b)] += p * t;
      }
    }
    if (is_closed()) {
      const double weight = std::accumulate(w.weight.begin(), w.weight.end(), 0.0);
      const double time = std::accumulate(w.time.begin(), w.time.end(), 0.0);
      std::fill(w.weight.begin(), w.weight.end(), weight);
      std::fill(w.time.begin(), w.time.end(), time);
    }
    for (size_t k = 0; k < w.members.size(); ++k)
      w.time[k] = w.weight[k] > 0 ? w.time[k] / w.weight[k] : h / 2;
  }

  void shift_arms(double h) {
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      if (contact.b < 0) continue;
      const size_t ka = place(contact.a), kb = place(contact.b);
      w.island.rows[r].arm =
          contact.row.point + ((w.time[kb] - h / 2) * w.substeps[kb].free.velocity -
                               (w.time[ka] - h / 2) * w.substeps[ka].free.velocity) /
                                  2;
    }
  }

  void set_displacements(double h) {
    w.displacement.resize(w.members.size());
    for (size_t k = 0; k < w.members.size(); ++k) w.displacement[k] = (h - w.time[k]) * change(k);
  }

  // Way of the points of contact `r` that its impulse works on, over h: what an impulse does to
  // velocities, less what it does to heights by acting before or after the middle of the substep.
  [[nodiscard]] Vec3 way_of_impulse(size_t r, double h) const {
    const IslandContact& contact = w.contacts[r];
    Vec3 way = (contact.row.free_move + h / 2 * changed(r)) / h;
    const size_t ka = place(contact.a);
    way -= (h / 2 - w.time[ka]) * w.substeps[ka].free_acceleration;
    if (contact.b >= 0) {
      const size_t kb = place(contact.b);
      way += (h / 2 - w.time[kb]) * w.substeps[kb].free_acceleration;
    }
    return way;
  }

  // Energy that contacts took, by kind; push_panels() adds that of panels that give way.
  void account(size_t r, double h) {
    const IslandContact& contact = w.contacts[r];
    const IslandRow& row = w.island.rows[r];
    const double p_n = row.normal.dot(row.impulse);
    const Vec3 p_t = row.impulse - p_n * row.normal;
    const Vec3 way = way_of_impulse(r, h);
    if (!gives_way(r))
      (contact.hit ? state.ledger.impact : state.ledger.contact) -= p_n * row.normal.dot(way);
    state.ledger.friction -= p_t.dot(way);
  }

  // Presses on a panel of a fence that gives way.
  [[nodiscard]] bool gives_way(size_t r) const {
    const IslandRow& row = w.island.rows[r];
    return row.normal_limit < no_normal_limit && row.state != ContactState::open;
  }

  // Displacement of the points of contact `r` over the substep.
  [[nodiscard]] Vec3 path_of_contact(size_t r) const {
    return w.contacts[r].row.free_move +
           relative(r, [&](size_t k) -> const Vec6& { return w.displacement[k]; });
  }

  // What the blocks do to the panels that give way.
  void find_pushes(double h) {
    w.pushes.clear();
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      if (!gives_way(r)) continue;
      const IslandContact& contact = w.contacts[r];
      const IslandRow& row = w.island.rows[r];
      const FencePanel& panel = *giving_way(scene, contact.fixed, row.normal);
      const double p_n = row.normal.dot(row.impulse), cosine = row.normal.dot(panel.normal);
      PanelPush push;
      push.block = contact.a;
      push.panel = panel_number(scene, contact.fixed);
      push.work = -p_n * row.normal.dot(way_of_impulse(r, h));
      push.power = -p_n / h * contact.row.speed_start;
      const double gap_end = contact.row.gap_start + row.normal.dot(path_of_contact(r));
      if (p_n >= (1 - 1e-12) * row.normal_limit) push.shift = std::min(0.0, gap_end) * cosine;
      const auto f = static_cast<size_t>(contact.fixed);
      push.to = push.shift + panel.normal.dot(w.poses[f].position -
                                              scene.fixed.pose[f - first_fixed()].position);
      add_push(push, w.pushes);
    }
  }
  [[nodiscard]] size_t first_fixed() const { return static_cast<size_t>(n_blocks(scene)); }

  // First touches, and what the touched panels left to their blocks.
  void note_touched_panels(double t) {
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      if (contact.fixed < 0 || contact.waits || w.island.rows[r].state == ContactState::open ||
          panel_number(scene, contact.fixed) < 0)
        continue;
      const size_t k = place(contact.a);
      const Motion& before = w.substeps[k].start;
      note_hit(scene, contact.a, contact.fixed, before.pose.position + contact.row.point,
               t + contact.hit_time, before, motion(k), state.fence);
    }
  }

  // Bonds that carry more than they hold are gone, and true: the substep is computed without them.
  bool break_bonds(double h) {
    w.bond_loads.clear();
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      const ContactRow& row = contact.row;
      if (row.bond_area == 0 || contact.hit || w.island.rows[r].state == ContactState::open)
        continue;
      const double per_h = 1 / (h * numbers(contact.a).recovery_time);
      const Vec3 path = path_of_contact(r);
      const double along = row.normal.dot(path);
      const double N = -per_h * row.normal_damping * (row.gap_start + row.offset + along);
      const Vec3 shear = -per_h * row.shear_damping * (row.shear + path - along * row.normal);
      add_load(N, shear, row.bond_area, bond_class(contact), load_of(contact));
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
  [[nodiscard]] int bond_of(const IslandContact& contact) const {
    return contact.bond >= 0 ? contact.bond : static_cast<int>(state.bonds.size()) + contact.a;
  }
  [[nodiscard]] const GroundClass& bond_class(const IslandContact& contact) const {
    return contact.bond >= 0 ? state.bonds[static_cast<size_t>(contact.bond)].face
                             : scene.ground.classes[static_cast<size_t>(contact.ground_class)];
  }
  void break_bond(int bond) {
    const int n = static_cast<int>(state.bonds.size());
    if (bond < n) {
      state.bonds[static_cast<size_t>(bond)].area = 0;
      return;
    }
    for (ContactMemory& memory : state.memory[static_cast<size_t>(bond - n)])
      if (memory.key.body_b < 0) memory.bond_area = 0;
  }

  BondLoad& load_of(const IslandContact& contact) {
    const int bond = bond_of(contact);
    for (BondLoad& load : w.bond_loads)
      if (load.bond == bond) return load;
    BondLoad& load = w.bond_loads.emplace_back();
    load.bond = bond;
    return load;
  }

  // What the contacts keep for the next step, and the work they did.
  void remember(double h) {
    const double gravity = scene.gravity.norm();
    const double relax = std::min(0.3, 0.25 * gravity * h) * h;
    for (const int b : w.members) state.memory[static_cast<size_t>(b)].clear();
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      const IslandContact& contact = w.contacts[r];
      const IslandRow& solved = w.island.rows[r];
      if (contact.waits || solved.state == ContactState::open) continue;
      account(r, h);
      const ContactRow& row = contact.row;
      const Vec3 path = path_of_contact(r);
      const double along = row.normal.dot(path);
      ++report.n_closed;
      note_penetration(report, -(row.gap_start + along), numbers(contact.a).thickness);
      if (contact.hit) continue;
      const double p_n = row.normal.dot(solved.impulse);
      const Vec3 p_t = solved.impulse - p_n * row.normal;
      ContactMemory memory;
      memory.key = contact.key;
      memory.normal = row.normal;
      memory.offset = contact.bond >= 0 ? row.offset : std::max(0.0, row.offset - relax);
      memory.gap_end = row.gap_start + row.offset + along - (row.offset - memory.offset);
      memory.normal_force = p_n / h;
      memory.state = static_cast<std::uint8_t>(solved.state);
      memory.bond_area = contact.bond >= 0 ? 0 : row.bond_area;  // of the ground
      const double k_t = row.shear_damping / (numbers(contact.a).recovery_time * h);
      memory.shear = solved.state == ContactState::slip
                         ? Vec3(p_t / (-h * k_t))
                         : Vec3(row.shear + path - along * row.normal);
      state.memory[static_cast<size_t>(contact.a)].push_back(memory);
    }
  }

  // Motion of a member at the end of the substep: the free one, corrected (theory 1.8, 1.10).
  [[nodiscard]] Motion end_of(size_t k) const {
    const Substep& s = w.substeps[k];
    const Vec6 dv = change(k);
    Motion end = s.free;
    end.velocity += dv.head<3>();
    end.pose.position += w.displacement[k].head<3>();
    end.pose.attitude =
        (rotation_by(w.displacement[k].tail<3>()) * s.free.pose.attitude).normalized();
    end.angular_momentum += w.island.mass[k].bottomRightCorner<3, 3>() * dv.tail<3>();
    return end;
  }

  // The path of a member: in one piece, or up to its hit and on from there.
  void add_path(size_t k, const Motion& end, double t, double h) {
    const Substep& s = w.substeps[k];
    const double hit = w.time[k];
    if (std::abs(hit - h / 2) < 1e-3 * h || hit <= 0 || hit >= h) {
      add_segment(w.members[k], false, t, h, s.start, end, work);
      return;
    }
    const Vec3& inertia = w.numbers[k].inertia;
    const Motion before = fly(s.start, inertia, s.free_acceleration, hit);
    Motion after = before;
    after.velocity = end.velocity - (h - hit) * s.free_acceleration;
    after.angular_momentum = end.angular_momentum;
    add_segment(w.members[k], false, t, hit, s.start, before, work);
    add_segment(w.members[k], false, t + hit, h - hit, after, end, work);
  }

  void finish(double t, double h) {
    for (size_t k = 0; k < w.members.size(); ++k) {
      const Substep& s = w.substeps[k];
      const Motion end = end_of(k);
      add_path(k, end, t, h);
      set_rates(w.members[k], w.numbers[k], s, end, state);
      const Vec3 external = s.free_acceleration - scene.gravity;
      if (!external.isZero(0))
        state.ledger.base +=
            w.numbers[k].mass * external.dot(end.pose.position - s.start.pose.position);
      motion(k) = end;
      if (!is_finite(end)) stop_at(s.start, block(k), state, report);
      state.local_time[block(k)] = t + h;
      ++report.substeps;
    }
    for (const IslandContact& contact : w.contacts)
      if (contact.hit)
        for (const int b : {contact.a, contact.b}) forget_rates(b);
    report.shortest_dt = report.shortest_dt > 0 ? std::min(report.shortest_dt, h) : h;
  }

  // After a hit the last accelerations say nothing about the next.
  void forget_rates(int b) {
    if (b < 0) return;
    state.acceleration[static_cast<size_t>(b)] = scene.gravity;
    state.spin_rate[static_cast<size_t>(b)].setZero();
  }

  Attempt attempt(double t, double& h) {
    if (!assemble(t, h)) return Attempt::left;
    if (const double touch = first_touch(h); touch < h) {
      h = touch;
      return Attempt::shorter;
    }
    if (!solve(h)) {
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
    if (break_bonds(h)) return Attempt::shorter;
    find_pushes(h);
    const double used_up = time_to_first_break(scene, state.fence, w.pushes, h);
    if (used_up < h && cuts < most_cuts) {
      h = used_up;
      ++cuts;
      return Attempt::shorter;
    }
    remember(h);
    finish(t, h);
    note_touched_panels(t);
    push_panels(scene, w.pushes, t + h, state);
    return Attempt::done;
  }

  // Stops the members that left the known ground; those that stay, and whose numbers did not fail,
  // go on.
  void stop_outsiders(double t_end) {
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

  void run(int island, std::span<const int> blocks, double t_end) {
    gather(blocks);
    double t = state.time;
    while (t < t_end && !w.members.empty()) {
      if (w.pairs_of_step && t == state.time)
        take_pairs(island);
      else
        search_pairs(t_end - t);
      double h = longest_substep(t_end - t);
      halvings = cuts = 0;
      Attempt outcome = Attempt::shorter;
      while (outcome == Attempt::shorter) outcome = attempt(t, h);
      t = state.local_time[block(0)];
      if (t_end - t < 1e-9 * scene.settings.dt) t = t_end;
      stop_outsiders(t_end);
    }
    for (const int b : w.members) state.local_time[static_cast<size_t>(b)] = t_end;
    release();
  }
};

}  // namespace

void form_islands(const Scene& scene, State& state, Work& work) {
  IslandStepWork& w = work.islands;
  const int n = n_blocks(scene);
  const auto size = static_cast<size_t>(n + n_fixed(scene));
  w.near_fixed.assign(static_cast<size_t>(n), scene.settings.trn_contacts ? 0 : 1);
  w.poses.resize(size);
  w.step.resize(size);
  w.turn.resize(size);
  w.moving.assign(size, 1);
  w.awake.resize(size);
  for (int b = 0; b < n; ++b) {
    const auto i = static_cast<size_t>(b);
    set_motion_ahead(scene, b, motion_at(scene, state, b, state.time), scene.settings.dt, w);
    w.awake[i] = takes_part(state, b) && state.phase[i] != Phase::asleep;
  }
  place_fixed(scene, state, w);
  do find_pairs(scene, scene.settings.dt, state, work);
  while (join_pairs(scene, state, w));
  find_islands(n, w.joined, {}, w.groups);
  w.moving.assign(size, 0);
  w.place.assign(size, -1);
  w.pairs_of_step = true;
  for (const auto& [a, b] : w.joined)
    for (const int i : {a, b})
      if (i >= 0 && state.phase[static_cast<size_t>(i)] == Phase::flight)
        end_flight(scene, i, state.time, state, work);
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

void put_island_to_sleep(const Scene& scene, int k, State& state, const Work& work) {
  constexpr double still = 1e-6;  // [m/s]
  constexpr int long_enough = 100;
  const IslandGroups& groups = work.islands.groups;
  const auto at = static_cast<size_t>(k);
  const std::span<const int> blocks(
      groups.blocks.data() + groups.block_begin[at],
      static_cast<size_t>(groups.block_begin[at + 1] - groups.block_begin[at]));
  bool rests = true;
  int steps = long_enough;
  for (const int b : blocks) {
    const auto i = static_cast<size_t>(b);
    if (!takes_part(state, b)) continue;
    const Motion& m = state.motion[i];
    const double spin = m.angular_momentum.norm() / scene.blocks.inertia[i].minCoeff();
    rests &= m.velocity.norm() + spin * scene.blocks.shapes.radius[i] < still;
    for (const ContactMemory& c : state.memory[i])
      rests &= c.state == static_cast<std::uint8_t>(ContactState::stick);
    steps = std::min(steps, ++state.still_steps[i]);
  }
  for (const int b : blocks) {
    const auto i = static_cast<size_t>(b);
    if (!rests) state.still_steps[i] = 0;
    if (!rests || steps < long_enough || !takes_part(state, b)) continue;
    state.phase[i] = Phase::asleep;
    state.motion[i].velocity.setZero();
    state.motion[i].angular_momentum.setZero();
  }
}

}  // namespace talus
