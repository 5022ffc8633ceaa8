#include "store/motion.hpp"

namespace talus {

Motion motion_at(const Segment& segment, const Vec3& inertia, double t) {
  if (t <= segment.t_start) return segment.start;
  if (t >= segment.t_end) return segment.end;
  const double elapsed = t - segment.t_start, duration = segment.t_end - segment.t_start;
  const Motion& a = segment.start;
  const Motion& b = segment.end;
  Motion motion;
  if (segment.flight) {
    motion.pose.position =
        a.pose.position + elapsed * a.velocity + 0.5 * elapsed * elapsed * segment.acceleration;
    motion.pose.attitude = free_rotation(a.pose.attitude, a.angular_momentum, inertia, elapsed);
    motion.velocity = a.velocity + elapsed * segment.acceleration;
    motion.angular_momentum = a.angular_momentum;
    return motion;
  }
  const double s = elapsed / duration;
  motion.pose.position = a.pose.position + s * (b.pose.position - a.pose.position) -
                         0.5 * elapsed * (duration - elapsed) * segment.acceleration;
  motion.pose.attitude = a.pose.attitude.slerp(s, b.pose.attitude);
  motion.velocity = a.velocity + s * (b.velocity - a.velocity);
  motion.angular_momentum = a.angular_momentum + s * (b.angular_momentum - a.angular_momentum);
  return motion;
}

double translational_energy(double mass, const Vec3& velocity) {
  return 0.5 * mass * velocity.squaredNorm();
}

double rotational_energy(const Motion& motion, const Vec3& inertia) {
  const Vec3 body = motion.pose.attitude.conjugate() * motion.angular_momentum;
  return 0.5 * body.cwiseAbs2().cwiseQuotient(inertia).sum();
}

}  // namespace talus
