// Which blocks of an island touch nothing but the ground: tried, then checked.
#include "step/island/untouched.hpp"

#include <algorithm>
#include <limits>

#include "contact/scales.hpp"
#include "motion/rotation.hpp"
#include "scene/bonds.hpp"
#include "scene/stems.hpp"
#include "scene/worlds.hpp"
#include "solver/law_numbers.hpp"
#include "solver/mass_numbers.hpp"
#include "step/flight.hpp"
#include "step/island/stages.hpp"
#include "step/island/stems.hpp"
#include "step/lone/step_talus.hpp"
#include "step/substep.hpp"
#include "step/work.hpp"

namespace talus {
namespace {

using std::size_t;

void keep(const State& state, const DeepWork& deep, int b, LoneBefore& before) {
  const auto i = static_cast<size_t>(b);
  before.block = b;
  before.phase = state.phase[i];
  before.local_time = state.local_time[i];
  before.flight_end = state.flight_end[i];
  before.rest_pose = state.rest_pose[i];
  before.rest_steps = state.rest_steps[i];
  before.motion = state.motion[i];
  before.acceleration = state.acceleration[i];
  before.spin_rate = state.spin_rate[i];
  before.support = state.support[i];
  before.memory = state.memory[i];
  before.is_suspect = deep.is_suspect[i];
  if (!state.strain.empty()) {
    before.strain = state.strain[i];
    before.strain_rate = state.strain_rate[i];
  }
  if (!state.mass.empty()) before.mass = state.mass[i];
  if (!state.slid.empty()) before.slid = state.slid[i];
  if (!state.hit_loss.empty()) before.hit_loss = state.hit_loss[i];
}

void put_back(const LoneBefore& before, State& state, DeepWork& deep) {
  const auto i = static_cast<size_t>(before.block);
  state.phase[i] = before.phase;
  state.local_time[i] = before.local_time;
  state.flight_end[i] = before.flight_end;
  state.rest_pose[i] = before.rest_pose;
  state.rest_steps[i] = before.rest_steps;
  state.motion[i] = before.motion;
  state.acceleration[i] = before.acceleration;
  state.spin_rate[i] = before.spin_rate;
  state.support[i] = before.support;
  state.memory[i] = before.memory;
  deep.is_suspect[i] = before.is_suspect;
  if (!state.strain.empty()) {
    state.strain[i] = before.strain;
    state.strain_rate[i] = before.strain_rate;
  }
  if (!state.mass.empty()) state.mass[i] = before.mass;
  if (!state.slid.empty()) state.slid[i] = before.slid;
  if (!state.hit_loss.empty()) state.hit_loss[i] = before.hit_loss;
}

/// Heights along a direction.
struct Heights {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double at) { low = std::min(low, at), high = std::max(high, at); }
};

/// A direction, and the velocity of the frame in which heights along it are taken from `time` on.
struct Sight {
  Vec3 along, velocity;
  double time = 0;
  [[nodiscard]] double height(const Vec3& x, double t) const {
    return along.dot(x - (t - time) * velocity);
  }
};

/// Checks the islands of a step; a struct so that its parts share common data.
struct UntouchedCheck {
  const Scene& scene;
  State& state;
  Work& work;
  double t_end;
  size_t first_segment;  // of the island at hand
  double impact_displacement =
      0;  // hits may move a block of the island that is not alone by this more [m]

  // Contacts of the blocks that are not alone with each other and the ground throw none of them
  // faster than twice the speed of their fastest point.
  void see_throws(std::span<const int> members) {
    impact_displacement = 0;
    for (const int b : members)
      if (!is_alone(b))
        impact_displacement =
            std::max(impact_displacement, 2 * (search().step[b].norm() + search().turn[b]));
  }

  [[nodiscard]] const PairSearch& search() const { return work.search; }
  [[nodiscard]] bool is_alone(int b) const { return work.untouched.alone[b] != 0; }

  // Adds the vertices of `part` of a body at `pose` and time `t`.
  void add_part(int part, const Pose& pose, double t, const Sight& sight, Heights& heights) const {
    const Hulls& hulls = scene.blocks.hulls;
    const Vec3 along = pose.attitude.conjugate() * sight.along;
    const double centre = sight.height(pose.position, t);
    for (int v = hulls.vertex_begin[part]; v < hulls.vertex_begin[part + 1]; ++v)
      heights.add(centre + along.dot(hulls.vertices[v]));
  }

  // How far a point leaves the chord of its path between two motions, seen along `along`; `a`: the
  // acceleration of the centroid between them, `h` apart [m].
  [[nodiscard]] double off_chord(int b, const Motion& from, const Motion& to, const Vec3& a,
                                 double h, const Vec3& along) const {
    const auto i = static_cast<size_t>(b);
    const Vec3& inertia = scene.blocks.inertia[i];
    const auto spin = [&](const Motion& m) {
      return angular_velocity(m.pose.attitude, m.angular_momentum, inertia);
    };
    const Vec3 first = spin(from), last = spin(to);
    const double fastest =
        std::max(fastest_spin(from.pose.attitude, from.angular_momentum, inertia),
                 fastest_spin(to.pose.attitude, to.angular_momentum, inertia));
    const double unequal = (inertia.maxCoeff() - inertia.minCoeff()) / inertia.minCoeff();
    // a turn about `along` moves nothing along it; free spin turns the spin, too
    const double across = std::max(first.cross(along).norm(), last.cross(along).norm()) +
                          unequal * fastest * fastest * h;
    const double bend = across * fastest * h * h + (last - first).cross(along).norm() * h;
    return (std::abs(along.dot(a)) * h * h + scene.blocks.shapes.radius[i] * bend) / 8;
  }

  // Heights of `part` of block b over the step: as it moved, if it moved alone, else as it moves
  // ahead without contact.
  [[nodiscard]] Heights heights_of(int b, int part, const Sight& sight) const {
    const auto i = static_cast<size_t>(b);
    Heights heights;
    double off = 0;
    add_part(part, search().poses[i], sight.time, sight, heights);
    if (!is_alone(b)) {
      Pose ahead = search().poses[i];
      ahead.position += search().step[i];
      ahead.attitude = (rotation_by(search().rotation[i]) * ahead.attitude).normalized();
      add_part(part, ahead, t_end, sight, heights);
      const double h = t_end - sight.time, turn = search().rotation[i].norm();
      off = impact_displacement + search_margin(numbers_of(scene, b), h) +
            scene.blocks.shapes.radius[i] * turn * turn / 8;
    } else {
      for (size_t at = first_segment; at < work.segments.size(); ++at) {
        const Segment& s = work.segments[at];
        if (s.block != b || s.t_end <= sight.time) continue;
        if (s.t_start > sight.time) add_part(part, s.start.pose, s.t_start, sight, heights);
        add_part(part, s.end.pose, s.t_end, sight, heights);
        off = std::max(off, off_chord(b, s.start, s.end, s.acceleration,
                                      s.t_end - std::max(s.t_start, sight.time), sight.along));
      }
      const Motion end = motion_at(scene, state, b, t_end);
      add_part(part, end.pose, t_end, sight, heights);
      if (state.phase[i] == Phase::flight)
        off = std::max(off,
                       off_chord(b, state.motion[i], end, scene.gravity,
                                 t_end - std::max(state.local_time[i], sight.time), sight.along));
    }
    heights.low -= off;
    heights.high += off;
    return heights;
  }

  [[nodiscard]] Heights heights_of_fixed(const PairManifold& m, const Sight& sight) const {
    Heights heights;
    const int fixed = fixed_of(scene, m.block_b);
    if (is_stem(scene, fixed)) {
      const int stem = stem_of(scene, fixed);
      const Vec2 axis = axis_of_stem(scene, state, world_of(scene, m.block_a), stem);
      heights.add(sight.along.head<2>().dot(axis) + scene.forest.stems[stem].radius);
    } else {
      add_part(m.part_b, search().poses[m.block_b], sight.time, sight, heights);
    }
    return heights;
  }

  // Mean velocity of a block over the step.
  [[nodiscard]] Vec3 mean_velocity(int b) const {
    const auto i = static_cast<size_t>(b);
    const double h = t_end - state.time;
    if (!is_alone(b)) return search().step[i] / h;
    return (motion_at(scene, state, b, t_end).pose.position - search().poses[i].position) / h;
  }

  [[nodiscard]] bool keeps_apart_along(const PairManifold& m, const Vec3& along) const {
    Sight sight{along, Vec3::Zero(), state.time};
    const bool is_fixed_b = is_fixed(scene, m.block_b);
    if (!is_fixed_b) sight.velocity = mean_velocity(m.block_b);
    const Heights b =
        is_fixed_b ? heights_of_fixed(m, sight) : heights_of(m.block_b, m.part_b, sight);
    return heights_of(m.block_a, m.part_a, sight).low - b.high >
           negligible * scene.blocks.shapes.radius[m.block_a];
  }

  // Whether the parts of a manifold keep apart over the whole step: along its normal, or along
  // that of a face of either, as it was when the step began; from a stem, as seen from above.
  [[nodiscard]] bool keeps_apart(const PairManifold& m) const {
    if (keeps_apart_along(m, m.normal)) return true;
    const Hulls& hulls = scene.blocks.hulls;
    const bool is_on_stem = m.part_b < 0;
    const auto does_at_face_of = [&](int part) {
      const double sign = part == m.part_a ? -1 : 1;
      for (int f = hulls.face_begin[part]; f < hulls.face_begin[part] + hulls.n_faces[part]; ++f) {
        Vec3 along = sign * normal_at(state.placed, f);
        if (is_on_stem) along = Vec3(along.x(), along.y(), 0).normalized();
        if (keeps_apart_along(m, along)) return true;
      }
      return false;
    };
    return does_at_face_of(m.part_a) || (!is_on_stem && does_at_face_of(m.part_b));
  }
};

// Whether a block knows the other body of a manifold, is bonded to it, or presses it.
bool touches_now(const Scene& scene, const State& state, const PairSearch& search,
                 const PairManifold& m) {
  const int name = name_of_body(scene, m.block_b);
  for (const ContactMemory& memory : state.memory[m.block_a])
    if (memory.key.body_b == name) return true;
  if (!is_fixed(scene, m.block_b) &&
      find_bond(state.bonds, m.block_a, m.block_b, state.motion[m.block_a].pose.attitude,
                m.normal) >= 0)
    return true;
  for (int p = m.point_begin; p < m.point_end; ++p)
    if (search.pairs.points[p].gap <= 0) return true;
  return false;
}

// Blocks of the island that may move alone: small islands, of which the block touches nothing.
void find_candidates(const Scene& scene, const State& state, const PairSearch& search, int k,
                     UntouchedScratch& w) {
  w.blocks.clear();
  const std::span<const int> members = blocks_of(search.groups, k);
  const auto is_near_fixed = [&](int b) { return search.near_fixed[b] != 0; };
  if (members.size() >= static_cast<size_t>(mass::least_size) ||
      (members.size() == 1 && !is_near_fixed(members[0])))
    return;
  for (const int b : members) w.alone[b] = does_not_move(state.phase[b]) ? 0 : 1;
  for (int p = search.groups.pair_begin[k]; p < search.groups.pair_begin[k + 1]; ++p) {
    const PairManifold& m = search.pairs.manifolds[search.joined_manifold[search.groups.pairs[p]]];
    if (!touches_now(scene, state, search, m)) continue;
    w.alone[m.block_a] = 0;
    if (!is_fixed(scene, m.block_b)) w.alone[m.block_b] = 0;
  }
  for (const int b : members)
    if (w.alone[b] != 0) w.blocks.push_back(b);
}

// Tries the candidates of island `k` alone; those that meet something, until none does, are put
// back.
void try_alone(const Scene& scene, int k, double t_end, State& state, Work& work,
               StepReport& report) {
  UntouchedScratch& w = work.untouched;
  PairSearch& search = work.search;
  find_candidates(scene, state, search, k, w);
  if (w.before.size() < w.blocks.size()) w.before.resize(w.blocks.size());
  for (size_t i = 0; i < w.blocks.size(); ++i) keep(state, work.deep, w.blocks[i], w.before[i]);
  const EnergyLedger ledger = state.ledger;
  const RunCounters counters = state.counters;
  const StepReport reported = report;
  const size_t n_segments = work.segments.size();
  UntouchedCheck check{scene, state, work, t_end, n_segments};
  for (bool again = !w.blocks.empty(); again;) {
    again = false;
    for (const int b : w.blocks)
      if (w.alone[b] != 0) advance_lone(scene, b, t_end, state, work, report);
    check.see_throws(blocks_of(search.groups, k));
    for (int p = search.groups.pair_begin[k]; p < search.groups.pair_begin[k + 1]; ++p) {
      const PairManifold& m =
          search.pairs.manifolds[search.joined_manifold[search.groups.pairs[p]]];
      const bool is_pair = !is_fixed(scene, m.block_b);
      if (w.alone[m.block_a] == 0 && !(is_pair && w.alone[m.block_b] != 0)) continue;
      if (!is_pair) place_own_fixed(scene, m.block_a, state, search);
      if (check.keeps_apart(m)) continue;
      w.alone[m.block_a] = 0;
      if (is_pair) w.alone[m.block_b] = 0;
      again = true;
    }
    place_own_fixed(scene, -1, state, search);
    if (!again) return;
    for (size_t i = 0; i < w.blocks.size(); ++i) put_back(w.before[i], state, work.deep);
    state.ledger = ledger;
    state.counters = counters;
    report = reported;
    work.segments.resize(n_segments);
  }
}

// Islands of the blocks that are left.
void leave_out(const Scene& scene, const UntouchedScratch& w, PairSearch& search) {
  const auto is_alone = [&](int b) { return b >= 0 && w.alone[b] != 0; };
  size_t n = 0;
  search.near_fixed.assign(search.near_fixed.size(), 0);
  for (size_t j = 0; j < search.joined.size(); ++j) {
    const auto [a, b] = search.joined[j];
    if (is_alone(a) || is_alone(b)) continue;
    if (b < 0) search.near_fixed[a] = 1;
    search.joined[n] = search.joined[j];
    search.joined_manifold[n++] = search.joined_manifold[j];
  }
  search.joined.resize(n);
  search.joined_manifold.resize(n);
  find_islands(n_blocks(scene), search.joined, {}, search.groups);
}

}  // namespace

void move_untouched(const Scene& scene, double t_end, State& state, Work& work,
                    StepReport& report) {
  UntouchedScratch& w = work.untouched;
  PairSearch& search = work.search;
  w.alone.assign(n_blocks(scene), 0);
  if (scene.settings.trn_contacts)
    for (int k = 0; k < n_islands(search.groups); ++k)
      try_alone(scene, k, t_end, state, work, report);
  if (std::any_of(w.alone.begin(), w.alone.end(), [](std::uint8_t is) { return is != 0; }))
    leave_out(scene, w, search);
  for (const auto& [a, b] : search.joined)
    for (const int of : {a, b})
      if (of >= 0 && state.phase[of] == Phase::flight)
        end_flight(scene, of, state.time, state, work);
}

}  // namespace talus
