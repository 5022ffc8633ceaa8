#include "dda/step_island.hpp"

#include <algorithm>
#include <cmath>
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
constexpr double stiffest_in_island = 3;
// ... and where it is small enough to be factored, so that a tower hardly sags.
constexpr double stiffest_in_small_island = 30;
constexpr size_t small_island = 8;
constexpr double pair_touch_ratio = 1e-6;  // a pair touches when its gap is below this part of r
constexpr int most_island_events = 8;      // impacts in a step before the resting speed is raised
constexpr int most_halvings = 4;           // of a substep that does not converge
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
  for (const PairManifold& m : w.pairs.manifolds) {
    if (is_fixed(scene, m.block_b)) {
      const auto a = static_cast<size_t>(m.block_a);
      if (takes_part(state, m.block_a) && stands(scene, state, m.block_b)) w.near_fixed[a] = 1;
      continue;
    }
    if (!takes_part(state, m.block_a) || !takes_part(state, m.block_b)) continue;
    w.joined.emplace_back(m.block_a, m.block_b);
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

void end_flight_now(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  const double t = state.local_time[i];
  const Motion end = motion_at(scene, state, b, state.time);
  if (state.time > t) add_segment(b, true, t, state.time - t, state.motion[i], end, work);
  state.motion[i] = end;
  state.acceleration[i] = scene.gravity;
  state.spin_rate[i].setZero();
  state.local_time[i] = state.time;
  state.phase[i] = Phase::near_ground;
}

/// Outcome of one attempt at a substep.
enum class Attempt { done, shorter, impact, left };

/// Everything that advances one island; a struct so that its parts share what they all need.
struct AdvanceIsland {
  const Scene& scene;
  State& state;
  Work& work;
  StepReport& report;
  IslandStepWork& w;
  double resting_factor = 1;
  int outsider = -1;  // block that the last attempt found off the known ground
  int halvings = 0;

  [[nodiscard]] size_t block(size_t k) const { return static_cast<size_t>(w.members[k]); }
  Motion& motion(size_t k) { return state.motion[block(k)]; }

  [[nodiscard]] double stiffness_ratio() const {
    return w.members.size() <= small_island ? stiffest_in_small_island : stiffest_in_island;
  }

  void gather(std::span<const int> blocks) {
    w.members.assign(blocks.begin(), blocks.end());
    w.place.assign(w.poses.size(), -1);
    w.numbers.clear();
    for (size_t k = 0; k < w.members.size(); ++k) {
      w.place[block(k)] = static_cast<int>(k);
      BlockNumbers c = numbers_of(scene, w.members[k], stiffness_ratio());
      c.resting_speed *= resting_factor;
      w.numbers.push_back(c);
    }
  }

  // The pairs at the poses of now, for at most `h` ahead.
  void search_pairs(double h) {
    w.moving.assign(w.poses.size(), 0);
    for (size_t k = 0; k < w.members.size(); ++k) {
      w.moving[block(k)] = 1;
      set_motion_ahead(scene, w.members[k], motion(k), h, w);
    }
    w.awake = w.moving;
    place_fixed(scene, state, w);
    find_pairs(scene, h, state, work);
    set_stiffness();
  }

  // A small block may bear a large one: its contacts are as stiff as the heaviest block that it
  // touches asks for.
  void set_stiffness() {
    w.bearing.clear();
    for (const BlockNumbers& c : w.numbers) w.bearing.push_back(c.mass);
    for (const PairManifold& m : w.pairs.manifolds) {
      if (!in_island(m) || is_fixed(scene, m.block_b)) continue;
      double& a = w.bearing[static_cast<size_t>(w.place[static_cast<size_t>(m.block_a)])];
      double& b = w.bearing[static_cast<size_t>(w.place[static_cast<size_t>(m.block_b)])];
      a = std::max(a, numbers(m.block_b).mass);
      b = std::max(b, numbers(m.block_a).mass);
    }
    const double dt = scene.settings.dt;
    for (size_t k = 0; k < w.members.size(); ++k)
      w.numbers[k].stiffness = stiffness_ratio() * w.bearing[k] / (dt * dt);
  }

  void clear_island() {
    w.contacts.clear();
    w.island.mass.clear();
    w.island.free_velocity.clear();
    w.island.velocity.clear();
    w.island.position.clear();
    w.island.radius.clear();
    w.island.pairs.clear();
    w.island.rows.clear();
  }

  void add_body(const BlockNumbers& c, const Mat3& R, const Vec3& position, const Vec6& free,
                const Vec6& guess) {
    Mat6 M = Mat6::Zero();
    M.topLeftCorner<3, 3>().diagonal().setConstant(c.mass);
    M.bottomRightCorner<3, 3>() = R * c.inertia.asDiagonal() * R.transpose();
    w.island.mass.push_back(M);
    w.island.free_velocity.push_back(free);
    w.island.velocity.push_back(guess);
    w.island.position.push_back(position);
    w.island.radius.push_back(c.radius);
  }

  void add_member(size_t k, double h) {
    const BlockNumbers& c = w.numbers[k];
    const Substep& s = w.substeps[k];
    Vec6 free, guess;
    free << s.free.velocity, s.R * s.spin_free;
    guess << s.start.velocity + h * state.acceleration[block(k)],
        spin_of(s.start, c.inertia) + h * (s.R * state.spin_rate[block(k)]);
    add_body(c, s.R, (s.start.pose.position + s.free.pose.position) / 2, free, guess);
  }

  void open_pair(int a, int b) {
    const int at = static_cast<int>(w.island.rows.size());
    w.island.pairs.push_back({a, b, at, at});
  }

  // The row for the solver, from the last contact.
  void push_row() {
    const IslandContact& contact = w.contacts.back();
    const ContactRow& row = contact.row;
    const Substep& s = w.substeps[static_cast<size_t>(w.place[static_cast<size_t>(contact.a)])];
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
    out.waits_for_impact = row.waits_for_impact;
    if (row.memory >= 0) {
      const ContactMemory& m =
          state.memory[static_cast<size_t>(contact.a)][static_cast<size_t>(row.memory)];
      out.impulse = s.h * m.normal_force * row.normal;
      out.state = static_cast<ContactState>(m.state);
    }
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
    for (ContactRow row : work.rows) {
      for (Vec3* v :
           {&row.normal, &row.point, &row.drift, &row.shear, &row.shear_velocity, &row.slip_start})
        *v = s.R * *v;
      const Contact& contact = work.contacts[static_cast<size_t>(row.contact)];
      const GroundClass& ground = scene.ground.classes[static_cast<size_t>(contact.ground_class)];
      if (row.bond_area > 0) hold(ground, w.numbers[k].recovery_time, row);
      IslandContact out;
      out.row = row;
      out.key = contact.key;
      out.a = b;
      out.gap_free = contact.gap;
      out.ground_class = contact.ground_class;
      w.contacts.push_back(out);
      push_row();
    }
    return true;
  }

  // Lever arms, path and start velocity of a body's material point.
  struct PointPath {
    Vec3 start, end, moved, velocity, spin_end;
  };
  static PointPath path_of(const Substep& s, const Vec3& inertia, const Vec3& x) {
    PointPath p;
    p.start = x - s.start.pose.position;
    p.end = s.R * (s.start.pose.attitude.conjugate() * p.start);
    p.moved = s.free.pose.position - s.start.pose.position + p.end - p.start;
    p.velocity = s.start.velocity + spin_of(s.start, inertia).cross(p.start);
    p.spin_end = s.R * s.spin_free;
    return p;
  }

  // The memories that the points of a manifold continue, -1: none. First those of the same
  // features; then, where features changed, those that the pair leaves without a successor, so that
  // a face that rests on another keeps its support and its friction while corners pass edges.
  void match_memories(const PairManifold& m) {
    const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(m.block_a)];
    w.continued.assign(static_cast<size_t>(m.point_end - m.point_begin), -1);
    w.claimed.assign(memory.size(), 0);
    const auto claim = [&](const auto& continues, double least_cosine) {
      for (size_t p = 0; p < w.continued.size(); ++p)
        for (size_t i = 0; i < memory.size() && w.continued[p] < 0; ++i) {
          if (w.claimed[i] != 0 || memory[i].key.body_b != m.block_b ||
              memory[i].normal.dot(m.normal) <= least_cosine ||
              !continues(w.pairs.points[static_cast<size_t>(m.point_begin) + p].key, memory[i].key))
            continue;
          w.continued[p] = static_cast<int>(i);
          w.claimed[i] = 1;
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

  // Holds a contact of a bond without limit; break_bonds() compares what it carries.
  static void hold(const GroundClass& face, double recovery_time, ContactRow& row) {
    row.cohesion_impulse = held;
    row.tension_impulse = face.tension > 0 ? held : 0;
    row.bias = (row.gap_start + row.offset) / recovery_time;
    row.waits_for_impact = false;
  }

  // The share of a contact in the bond of its blocks, if there is one. Where the faces were when
  // the bond was new, it carries nothing.
  void bond(const PairManifold& m, const PairPoint& point, double recovery_time,
            IslandContact& contact) const {
    contact.bond = find_bond(state.bonds, m.block_a, m.block_b);
    if (contact.bond < 0) return;
    const BlockBond& of_blocks = state.bonds[static_cast<size_t>(contact.bond)];
    ContactRow& row = contact.row;
    row.bond_area = m.area > 0 ? of_blocks.area * point.area / m.area : 0;
    if (row.memory < 0) row.offset = -row.gap_start;
    hold(of_blocks.face, recovery_time, row);
  }

  void add_point(const PairManifold& m, const PairPoint& point, int memory) {
    const auto ka = static_cast<size_t>(w.place[static_cast<size_t>(m.block_a)]);
    const auto kb = static_cast<size_t>(w.place[static_cast<size_t>(m.block_b)]);
    const Substep &sa = w.substeps[ka], &sb = w.substeps[kb];
    const BlockNumbers &ca = w.numbers[ka], &cb = w.numbers[kb];
    const Vec3& n = m.normal;
    const PointPath pa = path_of(sa, ca.inertia, point.point_b + point.gap * n);
    const PointPath pb = path_of(sb, cb.inertia, point.point_b);
    const Vec3 shift = w.island.position[ka] - w.island.position[kb];  // of B's arms from A's
    const Vec3 arm = (pa.start + pa.end + pb.start + pb.end) / 4 - shift / 2;
    const Vec3 arm_b = arm + shift;

    IslandContact contact;
    contact.a = m.block_a;
    contact.b = m.block_b;
    contact.key = point.key;
    contact.key.body_b = m.block_b;
    ContactRow& row = contact.row;
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
    row.friction = pair_class(scene, m).friction;
    contact.gap_free = point.gap + n.dot(row.free_move);

    const double approach = std::min(row.speed_start, n.dot(row.free_move) / sa.h);
    const double touch = pair_touch(ca, cb);
    if (memory >= 0 && !(row.gap_start > touch && approach < -ca.resting_speed))
      inherit(state.memory[static_cast<size_t>(m.block_a)][static_cast<size_t>(memory)], memory,
              Mat3::Identity(), touch, row);
    else
      row.offset = std::max(0.0, -row.gap_start);
    const Mobility Wa = mobility(ca.mass, ca.inertia, sa.R.transpose() * arm, sa.R.transpose() * n);
    const Mobility Wb =
        mobility(cb.mass, cb.inertia, sb.R.transpose() * arm_b, sb.R.transpose() * n);
    BlockNumbers c = ca;
    c.touch = touch;
    c.stiffness = std::max(ca.stiffness, cb.stiffness) * (ca.mass / std::min(ca.mass, cb.mass));
    set_law(scene, c, sa.h, {Wa.normal + Wb.normal, Wa.tangent + Wb.tangent}, approach, row);
    bond(m, point, c.recovery_time, contact);
    w.contacts.push_back(contact);
    push_row();
  }

  // A point on a fixed body: for the solver, on the ground. `n_closing`: points of the manifold
  // that close within the substep; they share the force with which a panel of a fence gives way.
  void add_fixed_point(const PairManifold& m, const PairPoint& point, int memory, int n_closing) {
    const auto k = static_cast<size_t>(w.place[static_cast<size_t>(m.block_a)]);
    const Substep& s = w.substeps[k];
    const Vec3& n = m.normal;
    BlockNumbers c = w.numbers[k];
    c.touch = pair_touch(c, c);
    const PointPath path = path_of(s, c.inertia, point.point_b + point.gap * n);

    IslandContact contact;
    contact.a = m.block_a;
    contact.fixed = m.block_b;
    contact.key = point.key;
    contact.key.body_b = m.block_b;
    ContactRow& row = contact.row;
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
    contact.gap_free = point.gap + n.dot(row.free_move);

    const double approach = std::min(row.speed_start, n.dot(row.free_move) / s.h);
    const FencePanel* panel = giving_way(scene, m.block_b, n);
    const bool knows = panel != nullptr && knows_body(m.block_a, m.block_b);
    if (memory >= 0 && (knows || !(row.gap_start > c.touch && approach < -c.resting_speed)))
      inherit(state.memory[static_cast<size_t>(m.block_a)][static_cast<size_t>(memory)], memory,
              Mat3::Identity(), c.touch, row);
    else
      row.offset = std::max(0.0, -row.gap_start);
    set_law(scene, c, s.h,
            mobility(c.mass, c.inertia, s.R.transpose() * row.point, s.R.transpose() * n), approach,
            row);
    if (panel != nullptr) row.normal_limit = panel->force * s.h / n_closing;
    if (knows) row.waits_for_impact = false;
    w.contacts.push_back(contact);
    push_row();
  }

  [[nodiscard]] int continued(const PairManifold& m, int p) const {
    return w.continued[static_cast<size_t>(p - m.point_begin)];
  }

  // Whether block a touched body b in the last step.
  [[nodiscard]] bool knows_body(int a, int b) const {
    const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(a)];
    return std::any_of(memory.begin(), memory.end(),
                       [b](const ContactMemory& m) { return m.key.body_b == b; });
  }

  void add_fixed_points(const PairManifold& m) {
    const auto k = static_cast<size_t>(w.place[static_cast<size_t>(m.block_a)]);
    const Substep& s = w.substeps[k];
    int n_closing = 0;
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
      const PointPath path = path_of(s, w.numbers[k].inertia, point.point_b + point.gap * m.normal);
      n_closing += point.gap + m.normal.dot(path.moved) <= 0;
    }
    for (int p = m.point_begin; p < m.point_end; ++p)
      add_fixed_point(m, w.pairs.points[static_cast<size_t>(p)], continued(m, p),
                      std::max(n_closing, 1));
  }

  static double pair_touch(const BlockNumbers& a, const BlockNumbers& b) {
    return pair_touch_ratio * std::min(a.radius, b.radius);
  }

  [[nodiscard]] bool in_island(const PairManifold& m) const {
    return w.place[static_cast<size_t>(m.block_a)] >= 0 &&
           (is_fixed(scene, m.block_b) ? stands(scene, state, m.block_b)
                                       : w.place[static_cast<size_t>(m.block_b)] >= 0);
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
    for (const PairManifold& m : w.pairs.manifolds) {
      if (!in_island(m)) continue;
      open_pair(w.place[static_cast<size_t>(m.block_a)], w.place[static_cast<size_t>(m.block_b)]);
      match_memories(m);
      if (is_fixed(scene, m.block_b)) {
        add_fixed_points(m);
        continue;
      }
      for (int p = m.point_begin; p < m.point_end; ++p)
        add_point(m, w.pairs.points[static_cast<size_t>(p)], continued(m, p));
    }
    return true;
  }

  [[nodiscard]] const BlockNumbers& numbers(int b) const {
    return w.numbers[static_cast<size_t>(w.place[static_cast<size_t>(b)])];
  }
  [[nodiscard]] double touch_of(const IslandContact& contact) const {
    const BlockNumbers& a = numbers(contact.a);
    if (contact.fixed >= 0) return pair_touch(a, a);
    return contact.b < 0 ? a.touch : pair_touch(a, numbers(contact.b));
  }

  [[nodiscard]] bool hits_now() const {
    return std::any_of(w.contacts.begin(), w.contacts.end(), [&](const IslandContact& contact) {
      const ContactRow& row = contact.row;
      const BlockNumbers& c = numbers(contact.a);
      const bool deep = contact.b < 0 && row.gap_start <= -1e4 * c.touch;
      const bool takes_impact = row.normal_limit >= no_normal_limit;
      return row.memory < 0 && row.gap_start <= touch_of(contact) && !deep && takes_impact &&
             row.speed_start < -c.resting_speed;
    });
  }

  // Change of a body's velocity by contact.
  [[nodiscard]] Vec6 change(int b) const {
    const auto k = static_cast<size_t>(w.place[static_cast<size_t>(b)]);
    return w.island.velocity[k] - w.island.free_velocity[k];
  }

  // Relative displacement of a contact's points by contact forces.
  [[nodiscard]] Vec3 moved(const IslandContact& contact, double h) const {
    Vec3 v = point_velocity<6>(change(contact.a), contact.row.point);
    if (contact.b >= 0) {
      const auto ka = static_cast<size_t>(w.place[static_cast<size_t>(contact.a)]);
      const auto kb = static_cast<size_t>(w.place[static_cast<size_t>(contact.b)]);
      const Vec3 arm_b = contact.row.point + w.island.position[ka] - w.island.position[kb];
      v -= point_velocity<6>(change(contact.b), arm_b);
    }
    return h / 2 * v;
  }

  // Time at which the first waiting contact is hit: 0 < time <= h; h + 1 when none is.
  [[nodiscard]] double first_hit(double h) const {
    double first = h + 1;
    for (const IslandContact& contact : w.contacts) {
      const ContactRow& row = contact.row;
      if (!row.waits_for_impact) continue;
      const double touch = touch_of(contact);
      const double gap_end = contact.gap_free + row.normal.dot(moved(contact, h));
      if (gap_end > touch) continue;
      const double v = row.speed_start, g = row.gap_start + 0.5 * touch;
      const double a = 2 * (gap_end + 0.5 * touch - g - v * h) / (h * h);
      const double root = std::sqrt(std::max(0.0, v * v - 2 * a * g));
      first = std::min(first, gap_end > -touch ? h : std::min(h, 2 * g / (root - v)));
    }
    return first;
  }

  // Presses on a panel of a fence that gives way.
  static bool pushes_on(const ContactRow& row) {
    return row.normal_limit < no_normal_limit && !row.waits_for_impact &&
           row.state != ContactState::open;
  }

  // What the blocks do to the panels that give way.
  void find_pushes(double h) {
    w.pushes.clear();
    for (const IslandContact& contact : w.contacts) {
      const ContactRow& row = contact.row;
      if (!pushes_on(row)) continue;
      const FencePanel& panel = *giving_way(scene, contact.fixed, row.normal);
      const double force = row.normal.dot(row.impulse) / h;
      const double along = row.normal.dot(row.free_move + moved(contact, h));
      PanelPush push;
      push.block = contact.a;
      push.panel = panel_number(scene, contact.fixed);
      push.work = -force * along;
      push.power = -force * row.speed_start;
      if (force * h >= (1 - 1e-12) * row.normal_limit)
        push.shift = std::min(0.0, row.gap_start + along) * row.normal.dot(panel.normal);
      add_push(push, w.pushes);
    }
  }

  // First touches, and what the touched panels left to their blocks.
  void note_touched_panels(double t) {
    for (const IslandContact& contact : w.contacts) {
      const ContactRow& row = contact.row;
      if (contact.fixed < 0 || row.waits_for_impact || row.state == ContactState::open ||
          panel_number(scene, contact.fixed) < 0)
        continue;
      const auto k = static_cast<size_t>(w.place[static_cast<size_t>(contact.a)]);
      const Motion& before = w.substeps[k].start;
      note_hit(scene, contact.a, contact.fixed, before.pose.position + row.point, t, before,
               motion(k), state.fence);
    }
  }

  // What the contacts keep for the next step, and the work they did.
  void remember(double h) {
    const double gravity = scene.gravity.norm();
    const double relax = std::min(0.3, 0.25 * gravity * h) * h;
    for (const int b : w.members) state.memory[static_cast<size_t>(b)].clear();
    for (const IslandContact& contact : w.contacts) {
      const ContactRow& row = contact.row;
      if (row.waits_for_impact || row.state == ContactState::open) continue;
      const Vec3 path = row.free_move + moved(contact, h);
      const double p_n = row.normal.dot(row.impulse);
      const Vec3 p_t = row.impulse - p_n * row.normal;
      const double along = row.normal.dot(path);
      if (!pushes_on(row)) state.ledger.contact -= p_n * along / h;
      state.ledger.friction -= p_t.dot(path) / h;
      ContactMemory memory;
      memory.key = contact.key;
      memory.normal = row.normal;
      memory.offset = contact.bond >= 0 ? row.offset : std::max(0.0, row.offset - relax);
      memory.gap_end = row.gap_start + row.offset + along - (row.offset - memory.offset);
      memory.normal_force = p_n / h;
      memory.state = static_cast<std::uint8_t>(row.state);
      memory.bond_area = contact.bond >= 0 ? 0 : row.bond_area;  // of the ground
      const double k_t = row.shear_damping / (numbers(contact.a).recovery_time * h);
      memory.shear = row.state == ContactState::slip ? Vec3(p_t / (-h * k_t))
                                                     : Vec3(row.shear + path - along * row.normal);
      state.memory[static_cast<size_t>(contact.a)].push_back(memory);
      ++report.n_closed;
      note_penetration(report, -(row.gap_start + along), numbers(contact.a).thickness);
    }
  }

  // Motion of a member at the end of the substep: the free one, corrected (theory 1.8, 1.10).
  [[nodiscard]] Motion end_of(size_t k) const {
    const Substep& s = w.substeps[k];
    const Vec6 dv = change(w.members[k]);
    Motion end = s.free;
    end.velocity += dv.head<3>();
    end.pose.position += s.h / 2 * dv.head<3>();
    end.pose.attitude = (rotation_by(s.h / 2 * dv.tail<3>()) * s.free.pose.attitude).normalized();
    end.angular_momentum += w.island.mass[k].bottomRightCorner<3, 3>() * dv.tail<3>();
    return end;
  }

  void finish(double t, double h) {
    for (size_t k = 0; k < w.members.size(); ++k) {
      const Substep& s = w.substeps[k];
      const Motion end = end_of(k);
      add_segment(w.members[k], false, t, h, s.start, end, work);
      set_rates(scene, w.members[k], s.start, end, h, state);
      const Vec3 external = s.free_acceleration - scene.gravity;
      if (!external.isZero(0))
        state.ledger.base +=
            w.numbers[k].mass * external.dot(end.pose.position - s.start.pose.position);
      motion(k) = end;
      if (!is_finite(end)) stop_at(s.start, block(k), state, report);
      state.local_time[block(k)] = t + h;
      ++report.substeps;
    }
    report.shortest_dt = report.shortest_dt > 0 ? std::min(report.shortest_dt, h) : h;
  }

  // Bonds that carry more than they hold are gone, and true: the substep is computed without them.
  bool break_bonds(double h) {
    w.bond_loads.clear();
    for (const IslandContact& contact : w.contacts) {
      const ContactRow& row = contact.row;
      if (row.bond_area == 0 || row.state == ContactState::open) continue;
      const double per_h = 1 / (h * numbers(contact.a).recovery_time);
      const Vec3 path = row.free_move + moved(contact, h);
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

  // Solves the island; true when the substep is to be repeated with half its length.
  bool solve(double& h, bool last) {
    IslandSettings settings;
    settings.tolerance = 1e-6 * scene.gravity.norm() * h;
    const IslandResult solved = solve_island(w.island, settings, w.solver);
    report.passes += solved.passes;
    if (!solved.converged) {
      if (!last && halvings < most_halvings) {
        h /= 2;
        ++halvings;
        ++state.counters.cut_back;
        return true;
      }
      ++report.n_unconverged;
      report.flags = report.flags | StepFlag::unconverged;
    }
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      w.contacts[r].row.impulse = w.island.rows[r].impulse;
      w.contacts[r].row.state = w.island.rows[r].state;
    }
    return false;
  }

  Attempt attempt(double t, double& h, bool last) {
    if (!assemble(t, h)) return Attempt::left;
    if (hits_now()) return Attempt::impact;
    if (solve(h, last) || break_bonds(h)) return Attempt::shorter;
    const double hit = first_hit(h);
    if (hit < h && !last) {
      h = hit;
      return Attempt::shorter;
    }
    find_pushes(h);
    const double broken = time_to_first_break(scene, state.fence, w.pushes, h);
    if (broken < h && !last) {
      h = broken;
      return Attempt::shorter;
    }
    remember(h);
    finish(t, h);
    note_touched_panels(t);
    push_panels(scene, w.pushes, t + h, state);
    return hit <= h ? Attempt::impact : Attempt::done;
  }

  // A touching contact of the impact at the poses of now.
  void add_impact_row(size_t ka, int kb, const Vec3& normal, const Vec3& x, const GroundClass& c) {
    const Vec6& va = w.island.free_velocity[ka];
    IslandRow row;
    row.normal = normal;
    row.arm = x - w.island.position[ka];
    Vec3 v = point_velocity<6>(va, row.arm);
    if (kb >= 0) {
      const auto b = static_cast<size_t>(kb);
      v -= point_velocity<6>(w.island.free_velocity[b], x - w.island.position[b]);
    }
    const double speed = normal.dot(v);
    row.bias = speed < -w.numbers[ka].resting_speed ? c.restitution * speed : 0.0;
    row.friction = c.friction;
    row.waits_for_impact = speed < -w.numbers[ka].resting_speed;  // marks it as a hit
    w.island.rows.push_back(row);
    w.island.pairs.back().row_end = static_cast<int>(w.island.rows.size());
  }

  void add_fixed_impact(const PairManifold& m) {
    const int a = w.place[static_cast<size_t>(m.block_a)];
    const BlockNumbers& c = w.numbers[static_cast<size_t>(a)];
    open_pair(a, -1);
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
      if (point.gap > 2 * pair_touch(c, c)) continue;
      if (panel_number(scene, m.block_b) >= 0)
        w.touched_panels.push_back({static_cast<int>(w.island.rows.size()), a, m.block_b});
      add_impact_row(static_cast<size_t>(a), -1, m.normal, point.point_b,
                     fixed_class(scene, m.block_b));
    }
  }

  // Panels that took an impulse; `before`: the motions of the members until then.
  void note_struck_panels(double t, const std::vector<Motion>& before) {
    for (const auto& [row, member, body] : w.touched_panels) {
      const IslandRow& struck = w.island.rows[static_cast<size_t>(row)];
      if (struck.impulse.isZero(0)) continue;
      const auto k = static_cast<size_t>(member);
      note_hit(scene, w.members[k], body, before[k].pose.position + struck.arm, t, before[k],
               motion(k), state.fence);
    }
  }

  void assemble_impact() {
    clear_island();
    for (size_t k = 0; k < w.members.size(); ++k) {
      const Motion& m = motion(k);
      Vec6 v;
      v << m.velocity, spin_of(m, w.numbers[k].inertia);
      add_body(w.numbers[k], m.pose.attitude.toRotationMatrix(), m.pose.position, v, v);
    }
    for (size_t k = 0; k < w.members.size(); ++k) {
      if (!scene.settings.trn_contacts) break;
      (void)find_contacts(scene.ground, scene.blocks.shapes, w.members[k], motion(k).pose,
                          Mat3::Identity(), 2 * w.numbers[k].touch, work.world_vertices,
                          work.contacts);
      if (work.contacts.empty()) continue;
      open_pair(static_cast<int>(k), -1);
      for (const Contact& c : work.contacts)
        add_impact_row(k, -1, c.normal, place(motion(k).pose, c.point_a),
                       scene.ground.classes[static_cast<size_t>(c.ground_class)]);
    }
    w.touched_panels.clear();
    for (const PairManifold& m : w.pairs.manifolds) {
      if (!in_island(m)) continue;
      if (is_fixed(scene, m.block_b)) {
        if (giving_way(scene, m.block_b, m.normal) == nullptr) add_fixed_impact(m);
        continue;
      }
      const int a = w.place[static_cast<size_t>(m.block_a)];
      const int b = w.place[static_cast<size_t>(m.block_b)];
      const double touch =
          2 * pair_touch(w.numbers[static_cast<size_t>(a)], w.numbers[static_cast<size_t>(b)]);
      open_pair(a, b);
      for (int p = m.point_begin; p < m.point_end; ++p) {
        const PairPoint& point = w.pairs.points[static_cast<size_t>(p)];
        if (point.gap > touch) continue;
        add_impact_row(static_cast<size_t>(a), b, m.normal,
                       point.point_b + point.gap / 2 * m.normal, pair_class(scene, m));
      }
    }
  }

  void impact() {
    assemble_impact();
    const std::vector<IslandRow>& rows = w.island.rows;
    if (std::none_of(rows.begin(), rows.end(),
                     [](const IslandRow& row) { return row.waits_for_impact; }))
      return;
    std::vector<Motion> before;
    if (!w.touched_panels.empty())
      for (size_t k = 0; k < w.members.size(); ++k) before.push_back(motion(k));
    const IslandImpactResult hit = apply_island_impact(w.island, ImpactSettings{}, w.impact);
    state.ledger.impact += hit.dissipated;
    ++report.n_impacts;
    report.passes += hit.passes;
    if (!hit.converged) ++report.n_unconverged;
    for (size_t k = 0; k < w.members.size(); ++k) {
      const Vec6& v = w.island.velocity[k];
      motion(k).velocity = v.head<3>();
      motion(k).angular_momentum = w.island.mass[k].bottomRightCorner<3, 3>() * v.tail<3>();
      state.acceleration[block(k)] = scene.gravity;
      state.spin_rate[block(k)].setZero();
    }
    note_struck_panels(state.local_time[block(0)], before);
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
    gather(stay);
  }

  void run(std::span<const int> blocks, double t_end) {
    gather(blocks);
    double t = state.time;
    int events = 0;
    while (t < t_end && !w.members.empty()) {
      search_pairs(t_end - t);
      double h = t_end - t;
      halvings = 0;
      Attempt outcome = Attempt::shorter;
      for (int tries = 1; outcome == Attempt::shorter; ++tries)
        outcome = attempt(t, h, tries >= most_tries);
      t = state.local_time[block(0)];
      if (t_end - t < 1e-9 * scene.settings.dt) t = t_end;
      if (outcome == Attempt::impact) {
        if (++events > most_island_events) {
          resting_factor *= 2;
          gather(std::vector<int>(w.members));
        }
        search_pairs(std::max(t_end - t, 0.0));
        impact();
      }
      stop_outsiders(t_end);
    }
    for (const int b : w.members) state.local_time[static_cast<size_t>(b)] = t_end;
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
  for (const auto& [a, b] : w.joined)
    for (const int i : {a, b})
      if (state.phase[static_cast<size_t>(i)] == Phase::flight)
        end_flight_now(scene, i, state, work);
  for (int b = 0; b < n; ++b)
    if (w.near_fixed[static_cast<size_t>(b)] != 0 &&
        state.phase[static_cast<size_t>(b)] == Phase::flight)
      end_flight_now(scene, b, state, work);
}

void advance_island(const Scene& scene, int k, double t_end, State& state, Work& work,
                    StepReport& report) {
  const IslandGroups& groups = work.islands.groups;
  const auto at = static_cast<size_t>(k);
  const std::vector<int> blocks(groups.blocks.begin() + groups.block_begin[at],
                                groups.blocks.begin() + groups.block_begin[at + 1]);
  AdvanceIsland advance{scene, state, work, report, work.islands};
  advance.run(blocks, t_end);
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
