#include "solver/impact_few.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

using std::size_t;

constexpr int most_steps = 24;       // of Newton
constexpr double tolerance = 1e-12;  // of the fastest approach: what contacts miss
// Of what a contact feels, added to Newton's matrix alone: contacts that share a load then share it
// about evenly, and steps get nearer by this factor. Tried: 1e-7, 1e-3; fewer are found.
constexpr double regularization = 1e-5;

Mat3 cross_matrix(const Vec3& x) {
  Mat3 X;
  X << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
  return X;
}

/// The problem at hand; a struct so that its parts share what they all need.
struct Few {
  std::span<const ImpactBody> bodies;
  std::span<const ImpactContact> contacts;
  std::span<ImpactRow> rows;
  FewContacts& few;

  [[nodiscard]] Eigen::Index n() const { return static_cast<Eigen::Index>(3 * contacts.size()); }

  // Velocity at an arm of body k per impulse at another arm of it.
  [[nodiscard]] Mat3 response(int k, const Vec3& at, const Vec3& from) const {
    const ImpactBody& body = bodies[static_cast<size_t>(k)];
    return body.per_mass * Mat3::Identity() -
           cross_matrix(at) * body.per_inertia * cross_matrix(from);
  }

  void set_responses() const {
    few.response.setZero(n(), n());
    for (size_t i = 0; i < contacts.size(); ++i)
      for (size_t j = 0; j <= i; ++j) {
        const ImpactContact &ci = contacts[i], &cj = contacts[j];
        const ImpactRow &ri = rows[i], &rj = rows[j];
        Mat3 W = Mat3::Zero();
        if (ci.a == cj.a) W += response(ci.a, ri.arm_a, rj.arm_a);
        if (ci.b >= 0 && ci.b == cj.b) W += response(ci.b, ri.arm_b, rj.arm_b);
        if (ci.a == cj.b) W -= response(ci.a, ri.arm_a, rj.arm_b);
        if (ci.b >= 0 && ci.b == cj.a) W -= response(ci.b, ri.arm_b, rj.arm_a);
        const auto at_i = static_cast<Eigen::Index>(3 * i), at_j = static_cast<Eigen::Index>(3 * j);
        few.response.block<3, 3>(at_i, at_j) = W;
        if (i != j) few.response.block<3, 3>(at_j, at_i) = W.transpose();
      }
  }

  [[nodiscard]] Vec3 point_velocity(const Eigen::VectorXd& v, size_t i) const {
    const ImpactContact& c = contacts[i];
    const auto of = [&](int k, const Vec3& arm) -> Vec3 {
      return v.segment<3>(6 * k) + v.segment<3>(6 * k + 3).cross(arm);
    };
    Vec3 u = of(c.a, rows[i].arm_a);
    if (c.b >= 0) u -= of(c.b, rows[i].arm_b);
    return u;
  }

  // What the law makes of `trial`, and how that changes with it.
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

  // What the impulses miss of the law [m/s]; sets Newton's equations.
  double set_equations() const {
    few.slip = few.slip_before;
    few.slip.noalias() += few.response * few.impulse;
    double worst = 0;
    for (size_t i = 0; i < contacts.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      const ImpactContact& c = contacts[i];
      const double feels = few.feels[i];
      const Vec3 p = few.impulse.segment<3>(at);
      const Vec3 missing = few.slip.segment<3>(at) - rows[i].target * c.normal;
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
      few.slip_before.segment<3>(at) = point_velocity(velocity, i);
      few.impulse.segment<3>(at) = rows[i].impulse;
      few.feels[i] = few.response.block<3, 3>(at, at).trace() / 3;
    }
    for (int k = 0; k < most_steps; ++k) {
      ++passes;
      const double worst = set_equations();
      if (!std::isfinite(worst)) return false;
      if (worst <= tolerance * scale) return true;
      few.factor.compute(few.matrix);
      few.impulse += few.factor.solve(few.residual);
    }
    return false;
  }
};

}  // namespace

bool solve_few(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
               const Eigen::VectorXd& velocity, double scale, std::span<ImpactRow> rows,
               FewContacts& few, int& passes) {
  const Few problem{bodies, contacts, rows, few};
  problem.set_responses();
  const bool found = problem.solve(velocity, scale, passes);
  for (size_t i = 0; i < contacts.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    rows[i].impulse = found ? Vec3(few.impulse.segment<3>(at)) : Vec3(Vec3::Zero());
  }
  return found;
}

}  // namespace talus
