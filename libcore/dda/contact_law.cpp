#include "dda/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Slip direction in the middle of the step and its derivative by the trial velocity.
struct SlipDirection {
  Vec3 e;
  Mat3 change;  // d e / d trial
};

// `threshold`: trial speed at which the contact begins to slip. There the direction is that of the
// trial, so that the impulse is continuous; the start's direction comes in as slip takes over.
SlipDirection slip_direction(const ContactRow& row, const Vec3& trial, double speed,
                             double threshold) {
  const Vec3 end = trial / speed;
  const Mat3 end_change = (Mat3::Identity() - end * end.transpose()) / speed;
  const double along = row.slip_start.dot(end);
  if (!(along > 0)) return {end, end_change};
  const double share = 1 - threshold / speed;
  const Vec3 sum = end + (share * along) * row.slip_start;
  const double length = sum.norm();
  const Vec3 e = sum / length;
  const Vec3 share_change = along * threshold / (speed * speed) * end;
  const Vec3 along_change = share * (end_change * row.slip_start);
  const Mat3 sum_change =
      end_change + row.slip_start * (share_change + along_change).transpose();
  return {e, (Mat3::Identity() - e * e.transpose()) * sum_change / length};
}

}  // namespace

ContactResponse contact_response(const ContactRow& row, const Vec3& velocity, double cap) {
  const Vec3& n = row.normal;
  const double speed_n = n.dot(velocity);
  const double p_n = -row.normal_damping * (speed_n + row.bias);
  if (p_n <= -row.tension_impulse)
    return {Vec3::Zero(), Mat3::Zero(), ContactState::open};
  ContactResponse response;
  const bool coupled = cap < 0;
  if (coupled) cap = row.friction * std::max(p_n, 0.0) + row.cohesion_impulse;
  response.impulse = p_n * n;
  response.tangent = row.normal_damping * n * n.transpose();
  const Vec3 trial = velocity - speed_n * n + row.shear / row.shear_time;
  const double speed = trial.norm();
  if (row.shear_damping * speed <= cap) {
    response.state = ContactState::stick;
    response.impulse -= row.shear_damping * trial;
    response.tangent += row.shear_damping * (Mat3::Identity() - n * n.transpose());
    return response;
  }
  response.state = ContactState::slip;
  if (cap <= 0) return response;
  const SlipDirection slip = slip_direction(row, trial, speed, cap / row.shear_damping);
  response.impulse -= cap * slip.e;
  response.tangent += cap * (slip.change - (slip.change * n) * n.transpose());
  if (coupled) response.tangent -= (row.friction * row.normal_damping) * slip.e * n.transpose();
  return response;
}

}  // namespace talus
