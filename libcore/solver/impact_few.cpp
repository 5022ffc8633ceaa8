// The impact law for few contacts: one dense problem in their impulses.
#include "solver/impact_few.hpp"

#include <algorithm>
#include <cmath>

#include "contact/scales.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int most_steps = 24;  // of Newton
// Share of a contact's own mobility added to Newton's matrix alone: contacts that share a load
// share about evenly, and steps get nearer by this factor. Tried: 1e-7, 1e-3; fewer are found.
constexpr double regularization = 1e-5;

/// The problem at hand; a struct so that its parts share common data.
struct Few {
  std::span<const ImpactBody> bodies;
  std::span<ImpactContact> contacts;
  FewContacts& few;

  [[nodiscard]] Eigen::Index n() const { return static_cast<Eigen::Index>(3 * contacts.size()); }

  void set_responses() const {
    few.response.setZero(n(), n());
    const auto at = [&](int k, const Vec3& arm, const Vec3& from) {
      return response(bodies[static_cast<size_t>(k)], arm, from);
    };
    for (size_t i = 0; i < contacts.size(); ++i)
      for (size_t j = 0; j <= i; ++j) {
        const ImpactContact &ci = contacts[i], &cj = contacts[j];
        Mat3 W = Mat3::Zero();
        if (ci.a == cj.a) W += at(ci.a, ci.arm_a, cj.arm_a);
        if (ci.b >= 0 && ci.b == cj.b) W += at(ci.b, ci.arm_b, cj.arm_b);
        if (ci.a == cj.b) W -= at(ci.a, ci.arm_a, cj.arm_b);
        if (ci.b >= 0 && ci.b == cj.a) W -= at(ci.b, ci.arm_b, cj.arm_a);
        const auto at_i = static_cast<Eigen::Index>(3 * i), at_j = static_cast<Eigen::Index>(3 * j);
        few.response.block<3, 3>(at_i, at_j) = W;
        if (i != j) few.response.block<3, 3>(at_j, at_i) = W.transpose();
      }
  }

  // The law's impulse for `trial`, and its derivative.
  static Vec3 projected(const ImpactContact& c, const Vec3& trial, Mat3& by_trial) {
    by_trial.setIdentity();
    if (c.is_bond) return trial;
    const Vec3& n = c.normal;
    const double pressed = n.dot(trial);
    if (pressed <= 0) {
      by_trial.setZero();
      return Vec3::Zero();
    }
    const Vec3 across = trial - pressed * n;
    const double size = across.norm(), cap = c.friction * pressed;
    if (size <= cap) return trial;
    const Vec3 direction = across / size, side = n.cross(direction);
    by_trial =
        (n + c.friction * direction) * n.transpose() + (cap / size) * side * side.transpose();
    return pressed * n + cap * direction;
  }

  // Error of the impulses against the law [m/s]; sets Newton's equations.
  double set_equations() const {
    few.slip = few.slip_before;
    few.slip.noalias() += few.response * few.impulse;
    double worst = 0;
    for (size_t i = 0; i < contacts.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      const ImpactContact& c = contacts[i];
      const double feels = few.feels[i];
      const Vec3 p = few.impulse.segment<3>(at);
      const Vec3 missing = few.slip.segment<3>(at) - c.target * c.normal;
      Mat3 by_trial;
      const Vec3 error = p - projected(c, p - missing / feels, by_trial);
      worst = std::max(worst, feels * error.norm());
      few.residual.segment<3>(at) = -error;
      few.matrix.middleRows<3>(at).noalias() = (by_trial / feels) * few.response.middleRows<3>(at);
      few.matrix.block<3, 3>(at, at) += Mat3::Identity() - (1 - regularization) * by_trial;
    }
    return worst;
  }

  bool solve(const Eigen::VectorXd& velocity, double scale, int& passes) const {
    few.slip_before.resize(n());
    few.impulse.resize(n());
    few.residual.resize(n());
    few.matrix.resize(n(), n());
    for (size_t i = 0; i < contacts.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      few.slip_before.segment<3>(at) = point_velocity(velocity, contacts[i]);
      few.impulse.segment<3>(at) = contacts[i].impulse;
      few.feels[i] = few.response.block<3, 3>(at, at).trace() / 3;
    }
    for (int k = 0; k < most_steps; ++k) {
      ++passes;
      const double worst = set_equations();
      if (!std::isfinite(worst)) return false;
      if (worst <= last_figures * scale) return true;
      few.factor.compute(few.matrix);
      few.impulse += few.factor.solve(few.residual);
    }
    return false;
  }
};

}  // namespace

bool solve_few(std::span<const ImpactBody> bodies, std::span<ImpactContact> contacts,
               const Eigen::VectorXd& velocity, double scale, FewContacts& few, int& passes) {
  const Few problem{bodies, contacts, few};
  problem.set_responses();
  const bool found = problem.solve(velocity, scale, passes);
  for (size_t i = 0; i < contacts.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    contacts[i].impulse = found ? Vec3(few.impulse.segment<3>(at)) : Vec3(Vec3::Zero());
  }
  return found;
}

}  // namespace talus
