// A block's motion at any moment of a segment.
#include "record/motion.hpp"

#include "motion/rotation.hpp"

namespace talus {

double flight_turn(const Segment& segment, const Vec3& inertia) {
  const Motion& start = segment.start;
  return fastest_spin(start.pose.attitude, start.angular_momentum, inertia) *
         (segment.t_end - segment.t_start);
}

void SegmentMotion::follow(const Segment& segment, const Vec3& inertia) {
  segment_ = &segment;
  inertia_ = &inertia;
  has_spin_ = false;
}

Motion SegmentMotion::at(double t) {
  const Motion &a = segment_->start, &b = segment_->end;
  if (t <= segment_->t_start) return a;
  if (t >= segment_->t_end) return b;
  const double elapsed = t - segment_->t_start;
  if (segment_->flight) return in_flight(elapsed);
  const double duration = segment_->t_end - segment_->t_start, s = elapsed / duration;
  Motion motion;
  motion.pose.position = a.pose.position + s * (b.pose.position - a.pose.position) -
                         0.5 * elapsed * (duration - elapsed) * segment_->acceleration;
  motion.pose.attitude = a.pose.attitude.slerp(s, b.pose.attitude);
  motion.velocity = a.velocity + s * (b.velocity - a.velocity);
  motion.angular_momentum = a.angular_momentum + s * (b.angular_momentum - a.angular_momentum);
  return motion;
}

Motion SegmentMotion::in_flight(double elapsed) {
  const Motion& start = segment_->start;
  if (!has_spin_) spin_ = free_spin(start.pose.attitude, start.angular_momentum, *inertia_);
  has_spin_ = true;
  Motion motion;
  motion.pose.attitude = attitude_after(spin_, elapsed);
  motion.pose.position = start.pose.position + elapsed * start.velocity +
                         0.5 * elapsed * elapsed * segment_->acceleration;
  motion.velocity = start.velocity + elapsed * segment_->acceleration;
  motion.angular_momentum = start.angular_momentum;
  return motion;
}

Motion motion_at(const Segment& segment, const Vec3& inertia, double t) {
  SegmentMotion motion;
  motion.follow(segment, inertia);
  return motion.at(t);
}

double translational_energy(double mass, const Vec3& velocity) {
  return 0.5 * mass * velocity.squaredNorm();
}

double rotational_energy(const Motion& motion, const Vec3& inertia) {
  const Vec3 body = motion.pose.attitude.conjugate() * motion.angular_momentum;
  return 0.5 * body.cwiseAbs2().cwiseQuotient(inertia).sum();
}

}  // namespace talus
