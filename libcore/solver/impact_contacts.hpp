// libcore/solver/impact_contacts.hpp
// The bodies and contacts of an impact (impact_solve.hpp).
#pragma once

#include <Eigen/Dense>

#include "contact/contact.hpp"
#include "contact/ground_law.hpp"
#include "motion/displacement.hpp"
#include "solver/angular_row.hpp"

namespace talus {

/// A body at the time of the impact; local axes.
struct ImpactBody {
  double inverse_mass = 0;                  ///< [1/kg]
  Mat3 inertia = Mat3::Identity();          ///< [kg m2]
  Mat3 inverse_inertia = Mat3::Identity();  ///< its inverse [1/(kg m2)]
  Vec3 position = Vec3::Zero();             ///< of the centroid [m]
  Vec6 velocity = Vec6::Zero();             ///< of the centroid, and spin; in: before, out: after
};

/// A contact of two of the bodies, or of one with the ground. One point, common to both bodies.
struct ImpactContact {
  int a = 0, b = -1;           ///< bodies; b = -1: the ground
  Vec3 normal = Vec3::Zero();  ///< unit, from B to A
  Vec3 point = Vec3::Zero();   ///< local axes [m]
  double friction = 0;         ///< tan(phi) [-]
  double restitution = 0;      ///< of the normal speed, at no speed [-]
  RestitutionFall fall;        ///< ... at the approach
  RowArm arm;                  ///< of the couple on A that resists its rolling on the ground
  Dent dent;                   ///< ... and makes both arms at least that of the approach
  double resting_speed = 0;    ///< a slower approach returns nothing [m/s]
  bool is_bond = false;        ///< holds A to B whatever the force
  // for the search of hits
  ContactKey key;
  int pair = 0;    ///< of the island
  double gap = 0;  ///< [m]
  // out
  double approach = 0;          ///< normal speed before, < 0: approaches [m/s]
  Vec3 impulse = Vec3::Zero();  ///< on A; B gets the opposite [N s]
  double loss = 0;              ///< normal energy that it took; < 0: it gave back [J]
  // while it is solved
  Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero();  ///< from the centroids [m]
  double target = 0;                                ///< normal speed that is asked for [m/s]
  double normal_damping = 0, shear_damping = 0;     ///< [kg]
  Vec3 expected = Vec3::Zero();      ///< impulse that the solution is sought around [N s]
  double slip = 0;                   ///< taken as known, in the convex form [m/s]
  double missing_slip = 0;           ///< of the last round [m/s]
  Mat3 tangent = Mat3::Zero();       ///< - d impulse / d velocity [kg]
  Vec3 full_impulse = Vec3::Zero();  ///< with all of the restitution [N s]
};

/// Speed of a contact's point at velocities v, six numbers a body.
[[nodiscard]] inline Vec3 point_velocity(const Eigen::VectorXd& v, const ImpactContact& c) {
  const auto at = [&](int k, const Vec3& arm) -> Vec3 {
    return v.segment<3>(6 * k) + v.segment<3>(6 * k + 3).cross(arm);
  };
  return c.b < 0 ? at(c.a, c.arm_a) : Vec3(at(c.a, c.arm_a) - at(c.b, c.arm_b));
}

[[nodiscard]] inline Mat3 cross_matrix(const Vec3& x) {
  Mat3 X;
  X << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
  return X;
}

/// Velocity at an arm of a body per impulse at another arm of it.
[[nodiscard]] inline Mat3 response(const ImpactBody& body, const Vec3& at, const Vec3& from) {
  return body.inverse_mass * Mat3::Identity() -
         cross_matrix(at) * body.inverse_inertia * cross_matrix(from);
}

}  // namespace talus
