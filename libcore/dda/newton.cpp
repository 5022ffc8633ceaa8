#include "dda/newton.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "dda/contact_law.hpp"

namespace talus {
namespace {

Mat3 skew(const Vec3& x) {
  Mat3 S;
  S << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
  return S;
}

/// Residual and its derivative at the system's velocity.
template <int Dof>
struct Linearised {
  typename BlockSystem<Dof>::Vec residual;
  typename BlockSystem<Dof>::Mat matrix;
};

template <int Dof>
void add_contact(const Vec3& X, const ContactResponse& r, Linearised<Dof>& out) {
  out.residual -= generalised<Dof>(X, r.impulse);
  const Mat3& A = r.tangent;
  if constexpr (Dof == 6) {
    const Mat3 S = skew(X);  // J = [I, -S]
    const Mat3 SA = S * A;
    out.matrix.template topLeftCorner<3, 3>() += A;
    out.matrix.template topRightCorner<3, 3>() -= A * S;
    out.matrix.template bottomLeftCorner<3, 3>() += SA;
    out.matrix.template bottomRightCorner<3, 3>() -= SA * S;
  } else {
    const Mat3x12 T = displacement_matrix(X);
    out.matrix += T.transpose() * A * T;
  }
}

// `lagged`: friction bounds are those of the rows' last impulses, kept in cap_of(row).
template <int Dof>
void linearise(const BlockSystem<Dof>& system, std::span<ContactRow> rows, bool lagged,
               Linearised<Dof>& out) {
  out.residual = system.mass * (system.velocity - system.free_velocity);
  out.matrix = system.mass;
  for (ContactRow& row : rows) {
    if (row.waits_for_impact) continue;
    const Vec3 w = point_velocity<Dof>(system.velocity, row.point) + row.drift;
    const ContactResponse r = contact_response(row, w, lagged ? row.held_cap : -1.0);
    row.impulse = r.impulse;
    row.state = r.state;
    if (r.state != ContactState::open) add_contact<Dof>(row.point, r, out);
  }
}

// The residual as a velocity of the block's points: impulse over mass; angular impulse over inertia,
// times the radius of gyration about that axis.
template <int Dof>
double residual_speed(const BlockSystem<Dof>& s, const typename BlockSystem<Dof>::Vec& r) {
  double largest = 0;
  for (int i = 0; i < Dof; ++i)
    largest = std::max(largest, std::abs(r[i]) / std::sqrt(s.mass(i, i) * s.mass(0, 0)));
  return largest;
}

double cap_of(const ContactRow& row) {
  return row.friction * std::max(row.impulse.dot(row.normal), 0.0) + row.cohesion_impulse;
}

// Newton with the bound held: the step is shortened until the residual's work along it changes sign
// no more, which for this convex problem always makes progress.
template <int Dof>
int solve_held(BlockSystem<Dof>& system, std::span<ContactRow> rows, int max_passes, bool& settled) {
  Linearised<Dof> at;
  int passes = 1;
  linearise(system, rows, true, at);
  settled = residual_speed(system, at.residual) <= system.tolerance;
  while (!settled && passes < max_passes) {
    const typename BlockSystem<Dof>::Vec step = at.matrix.partialPivLu().solve(-at.residual);
    const typename BlockSystem<Dof>::Vec from = system.velocity;
    const double slope = std::abs(at.residual.dot(step));
    double fraction = 1;
    for (int i = 0; i < 8; ++i, fraction /= 2) {
      system.velocity = from + fraction * step;
      linearise(system, rows, true, at);
      ++passes;
      if (at.residual.dot(step) <= 0.5 * slope) break;
    }
    settled = residual_speed(system, at.residual) <= system.tolerance;
  }
  return passes;
}

template <int Dof>
NewtonResult solve_lagged(BlockSystem<Dof>& system, std::span<ContactRow> rows, int max_passes) {
  NewtonResult result;
  for (ContactRow& row : rows) row.held_cap = cap_of(row);
  double relax = 1;
  while (result.passes < max_passes) {
    bool settled = false;
    result.passes += solve_held(system, rows, max_passes - result.passes, settled);
    double change = 0;
    for (ContactRow& row : rows) {
      const double next = cap_of(row);
      change = std::max(change, std::abs(next - row.held_cap));
      row.held_cap += relax * (next - row.held_cap);
    }
    if (settled && change <= system.tolerance * system.mass(0, 0)) {
      result.converged = true;
      return result;
    }
    relax = std::max(0.3, 0.9 * relax);
  }
  return result;
}

}  // namespace

template <int Dof>
NewtonResult solve_contacts(BlockSystem<Dof>& system, std::span<ContactRow> rows, int max_passes) {
  Linearised<Dof> at;
  NewtonResult result;
  const int coupled_passes = std::max(8, max_passes / 3);
  while (result.passes < coupled_passes) {
    linearise(system, rows, false, at);
    ++result.passes;
    if (residual_speed(system, at.residual) <= system.tolerance) {
      result.converged = true;
      return result;
    }
    system.velocity -= at.matrix.partialPivLu().solve(at.residual);
  }
  if (!system.velocity.allFinite()) system.velocity = system.free_velocity;
  NewtonResult lagged = solve_lagged(system, rows, max_passes);
  lagged.passes += result.passes;
  return lagged;
}

template NewtonResult solve_contacts<6>(BlockSystem<6>&, std::span<ContactRow>, int);
template NewtonResult solve_contacts<12>(BlockSystem<12>&, std::span<ContactRow>, int);

}  // namespace talus
