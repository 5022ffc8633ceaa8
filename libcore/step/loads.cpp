// Gravity, base motion, point loads and joint water on a block.
#include "step/loads.hpp"

#include <algorithm>
#include <cmath>

#include "motion/displacement.hpp"
#include "scene/bond_face.hpp"
#include "scene/sleep.hpp"
#include "solver/law_numbers.hpp"
#include "step/flight.hpp"

namespace talus {
namespace {

using std::size_t;

// Integral of the harmonic part, in closed form.
Vec3 harmonic_impulse(const HarmonicMotion& motion, double from, double to) {
  const double begin = std::max(from, motion.start), end = std::min(to, motion.end);
  if (!(begin < end)) return Vec3::Zero();
  // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2): right to rounding in short steps too.
  const double middle = motion.angular_frequency * (0.5 * (begin + end) - motion.start);
  const double half = 0.5 * motion.angular_frequency * (end - begin);
  return motion.amplitude * (2 * std::sin(middle) * std::sin(half) / motion.angular_frequency);
}

// Integral of the samples, linear in between and zero outside them.
Vec3 sampled_impulse(const AccelerationRecord& base, double from, double to) {
  const auto next = std::upper_bound(base.time.begin(), base.time.end(), from);
  Vec3 sum = Vec3::Zero();
  for (auto k = static_cast<size_t>(std::max<std::ptrdiff_t>(1, next - base.time.begin()));
       k < base.time.size() && base.time[k - 1] < to; ++k) {
    const double t0 = base.time[k - 1], length = base.time[k] - t0;
    const double begin = std::max(from, t0), end = std::min(to, base.time[k]);
    const double middle = ((begin - t0) + (end - t0)) / (2 * length);
    sum += (end - begin) *
           (base.acceleration[k - 1] + middle * (base.acceleration[k] - base.acceleration[k - 1]));
  }
  return sum;
}

// Linear between samples, zero outside them.
Vec3 base_acceleration(const AccelerationRecord& base, double t) {
  const auto next = std::upper_bound(base.time.begin(), base.time.end(), t);
  if (next == base.time.begin() || next == base.time.end()) return Vec3::Zero();
  const auto k = static_cast<size_t>(next - base.time.begin());
  const double share = (t - base.time[k - 1]) / (base.time[k] - base.time[k - 1]);
  return base.acceleration[k - 1] + share * (base.acceleration[k] - base.acceleration[k - 1]);
}

}  // namespace

double range_of_base(const AccelerationRecord& base, double from, double to) {
  Vec3 low = base_acceleration(base, from), high = low;
  const auto take = [&](const Vec3& a) { low = low.cwiseMin(a), high = high.cwiseMax(a); };
  take(base_acceleration(base, to));
  for (auto k = static_cast<size_t>(std::upper_bound(base.time.begin(), base.time.end(), from) -
                                    base.time.begin());
       k < base.time.size() && base.time[k] < to; ++k)
    take(base.acceleration[k]);
  return (high - low).norm();
}

Vec3 free_acceleration(const Scene& scene, int b, double t_start, double t_end,
                       std::span<const double> pressure) {
  Vec3 a = scene.gravity;
  if (shakes(scene.base))
    a -= (sampled_impulse(scene.base, t_start, t_end) +
          harmonic_impulse(scene.base.harmonic, t_start, t_end)) /
         (t_end - t_start);
  for (const PointLoad& load : loads_on(scene, b))
    a += force_of(load, pressure) / scene.blocks.mass[b];
  return a;
}

std::span<const PointLoad> loads_on(const Scene& scene, int b) {
  const auto first =
      std::lower_bound(scene.loads.begin(), scene.loads.end(), b,
                       [](const PointLoad& load, int block) { return load.block < block; });
  auto last = first;
  while (last != scene.loads.end() && last->block == b) ++last;
  return {first, last};
}

bool is_loaded(const Scene& scene, int b, std::span<const double> pressure) {
  const std::span<const PointLoad> loads = loads_on(scene, b);
  return std::any_of(loads.begin(), loads.end(),
                     [&](const PointLoad& load) { return !force_of(load, pressure).isZero(0); });
}

Vec3 load_torque(const Scene& scene, int b, const Quat& attitude,
                 std::span<const double> pressure) {
  Vec3 torque = Vec3::Zero();
  for (const PointLoad& load : loads_on(scene, b))
    torque += (attitude * load.point).cross(force_of(load, pressure));
  return torque;
}

Vec6 load_strain(const Scene& scene, int b, const Quat& attitude,
                 std::span<const double> pressure) {
  Vec6 sum = Vec6::Zero();
  for (const PointLoad& load : loads_on(scene, b))
    sum += strain_load(load.point, attitude.conjugate() * force_of(load, pressure));
  return sum;
}

Vec3 book_loads(const Scene& scene, int b, const Pose& from, const Pose& to, State& state) {
  Vec3 sum = Vec3::Zero();
  for (const PointLoad& load : loads_on(scene, b)) {
    const Vec3 force = force_of(load, state.pressure);
    (load.wet_face < 0 ? state.ledger.base : state.ledger.water) +=
        force.dot(place(to, load.point) - place(from, load.point));
    sum += force;
  }
  return sum;
}

namespace {

// By how far the faces have parted along the normal, and at all.
double pressure_left(const Scene& scene, const State& state, const WetFace& face) {
  const bool on_ground = face.block_b < 0;
  if (!takes_part(state, face.block_a) || !(on_ground || takes_part(state, face.block_b))) return 0;
  const Pose a = motion_at(scene, state, face.block_a, state.time).pose;
  const Vec3 there =
      on_ground ? face.point_b
                : place(motion_at(scene, state, face.block_b, state.time).pose, face.point_b);
  const Vec3 apart = place(a, face.point_a) - there;
  const double opening = std::max(0.0, apart.dot(a.attitude * face.normal));
  const double in_common = std::max(0.0, 1 - apart.norm() / face.extent);
  if (scene.drained_at > 0) return in_common * std::max(0.0, 1 - opening / scene.drained_at);
  const std::vector<double>& radius = scene.blocks.shapes.radius;
  const double smaller =
      on_ground ? radius[face.block_a] : std::min(radius[face.block_a], radius[face.block_b]);
  return opening > bonded_gap_ratio * smaller ? 0 : in_common;
}

bool is_asleep(const State& state, int b) { return b >= 0 && phase_of(state, b) == Phase::asleep; }

// Whether a loss of force moves a block of `mass`, did nothing else hold it.
bool moves(const Scene& scene, double lost, double mass) {
  return lost > law::least_speed * scene.gravity.norm() * mass;
}

}  // namespace

void drain_faces(const Scene& scene, State& state) {
  for (size_t f = 0; f < state.pressure.size(); ++f) {
    if (state.pressure[f] == 0) continue;
    const WetFace& face = scene.wet_faces[f];
    const double left = std::min(state.pressure[f], pressure_left(scene, state, face));
    const double lost = (state.pressure[f] - left) * face.force;
    bool is_felt = true;  // by those of its blocks that sleep
    for (const int b : {face.block_a, face.block_b})
      if (is_asleep(state, b)) is_felt &= left == 0 || moves(scene, lost, scene.blocks.mass[b]);
    if (!is_felt || lost == 0) continue;
    state.pressure[f] = left;
    for (const int b : {face.block_a, face.block_b})
      if (is_asleep(state, b)) wake_bonded(b, state.time, state);
  }
}

}  // namespace talus
