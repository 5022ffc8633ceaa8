#include "step/loads.hpp"

#include <algorithm>
#include <cmath>

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

Vec3 free_acceleration(const Scene& scene, int b, double t_start, double t_end) {
  Vec3 a = scene.gravity;
  if (shakes(scene.base))
    a -= (sampled_impulse(scene.base, t_start, t_end) +
          harmonic_impulse(scene.base.harmonic, t_start, t_end)) /
         (t_end - t_start);
  for (const PointLoad& load : scene.loads)
    if (load.block == b) a += load.force / scene.blocks.mass[b];
  return a;
}

Vec3 load_torque(const Scene& scene, int b, const Quat& attitude) {
  Vec3 torque = Vec3::Zero();
  for (const PointLoad& load : scene.loads)
    if (load.block == b) torque += (attitude * load.point).cross(load.force);
  return torque;
}

}  // namespace talus
