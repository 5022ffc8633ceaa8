// Contact impulses of one block: semismooth Newton on the balance of its momentum.
#include "solver/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/law_numbers.hpp"
#include "solver/one_contact.hpp"
#include "solver/relax.hpp"

namespace talus {
namespace {

template <int Dof>
using Vec = typename BlockSystem<Dof>::Vec;
template <int Dof>
using Mat = typename BlockSystem<Dof>::Mat;

// H += J^T A J with J = [I, -S, strain columns], S = skew(X).
template <int Dof>
void add_tangent(const Vec3& X, const Mat3& A, Mat<Dof>& H) {
  if constexpr (Dof == 12) {
    const Mat3x12 T = displacement_matrix(X);
    H.noalias() += T.transpose() * (A * T).eval();
    return;
  }
  const double x = X.x(), y = X.y(), z = X.z();
  double B[3][6];  // A J
  for (int i = 0; i < 3; ++i) {
    const double a = A(i, 0), b = A(i, 1), c = A(i, 2);
    B[i][0] = a;
    B[i][1] = b;
    B[i][2] = c;
    B[i][3] = y * c - z * b;
    B[i][4] = z * a - x * c;
    B[i][5] = x * b - y * a;
  }
  for (int j = 0; j < 6; ++j) {
    H(0, j) += B[0][j];
    H(1, j) += B[1][j];
    H(2, j) += B[2][j];
    H(3, j) += y * B[2][j] - z * B[1][j];
    H(4, j) += z * B[0][j] - x * B[2][j];
    H(5, j) += x * B[1][j] - y * B[0][j];
  }
}

// The bounds that the normal impulses give to an angular row.
template <int Dof>
CoupleBounds bounds_of(const BlockSystem<Dof>& system, const AngularRow& turn,
                       std::span<const ContactRow> rows) {
  CoupleBounds bounds;
  if (turn.is_off) return bounds;
  for (int i = turn.row_begin; i < turn.row_end; ++i) {
    const ContactRow& row = rows[i];
    if (row.waits || row.state == ContactState::open) continue;
    bounds.add(system.arms[turn.arm_begin + i - turn.row_begin], row.normal.dot(row.impulse),
               row.normal);
  }
  if (!turn.held_normal.isZero(0)) bounds.normal = turn.held_normal;
  return bounds;
}

// Terms of angular rows in the residual, after their rows were evaluated, and in its derivative:
// apart, since few blocks have them.
template <int Dof>
[[gnu::noinline]] void add_couples(const BlockSystem<Dof>& system, std::span<const ContactRow> rows,
                                   Vec<Dof>& r) {
  for (AngularRow& turn : system.angular) {
    evaluate(Vec3(system.velocity.template segment<3>(3)), bounds_of(system, turn, rows), turn);
    r.template segment<3>(3) -= turn.couple;
  }
}

template <int Dof>
[[gnu::noinline]] void add_couple_tangents(const BlockSystem<Dof>& system,
                                           std::span<const ContactRow> rows, Mat<Dof>& H) {
  for (const AngularRow& turn : system.angular) {
    H.template block<3, 3>(3, 3) += tangent(turn);
    if (turn.is_off) continue;
    for (int i = turn.row_begin; i < turn.row_end; ++i) {  // the bound follows the normal impulse
      const ContactRow& row = rows[i];
      if (row.waits || row.state == ContactState::open || row.normal.dot(row.impulse) <= 0)
        continue;
      const RowArm& arm = system.arms[turn.arm_begin + i - turn.row_begin];
      H.template middleRows<3>(3) -= (row.normal_tangent * by_bound(turn, arm)) *
                                     generalised<Dof>(row.arm, row.normal).transpose();
    }
  }
}

// Momentum that is missing at the system's velocity.
template <int Dof>
Vec<Dof> residual(const BlockSystem<Dof>& system, std::span<ContactRow> rows) {
  Vec<Dof> r;
  if constexpr (Dof == 6)
    r = system.mass.diagonal().cwiseProduct(system.velocity - system.free_velocity);
  else
    r.noalias() = system.mass * (system.velocity - system.free_velocity);
  for (ContactRow& row : rows) {
    if (row.waits) continue;
    const Vec3 w = point_velocity<Dof>(system.velocity, row.arm) + row.drift;
    evaluate(w, row);
    if (row.state == ContactState::open) continue;
    r.template head<3>() -= row.impulse;  // part by part: whole, it would be put together in memory
    r.template segment<3>(3) -= row.arm.cross(row.impulse);
    if constexpr (Dof == 12) r.template tail<6>() -= strain_load(row.arm, row.impulse);
  }
  if (!system.angular.empty()) add_couples<Dof>(system, rows, r);
  return r;
}

// Derivative of the residual where it was last evaluated, with `scale` times the mass.
template <int Dof>
Mat<Dof> derivative(const BlockSystem<Dof>& system, std::span<const ContactRow> rows,
                    double scale) {
  Mat<Dof> H = scale * system.mass;
  for (const ContactRow& row : rows) {
    if (row.waits || row.state == ContactState::open) continue;
    add_tangent<Dof>(row.arm, tangent(row), H);
  }
  if (!system.angular.empty()) add_couple_tangents<Dof>(system, rows, H);
  return H;
}

// Column k of the elimination, with row pivoting, which leaves 1 / pivot on the diagonal. Column by
// column, and with sizes that the compiler knows, so that it can take two rows at a time.
template <int Dof, int k>
[[gnu::always_inline]] inline void eliminate(Mat<Dof>& H, Vec<Dof>& b) {
  int pivot = k;
  for (int i = k + 1; i < Dof; ++i)
    if (std::abs(H(i, k)) > std::abs(H(pivot, k))) pivot = i;
  if (pivot != k) {
    H.row(k).swap(H.row(pivot));
    std::swap(b[k], b[pivot]);
  }
  H(k, k) = 1 / H(k, k);
  constexpr int below = Dof - 1 - k;
  if constexpr (below > 0) {
    const Eigen::Matrix<double, below, 1> factor = H.template block<below, 1>(k + 1, k) * H(k, k);
    for (int j = k + 1; j < Dof; ++j) H.template block<below, 1>(k + 1, j) -= H(k, j) * factor;
    b.template tail<below>() -= b[k] * factor;
  }
}

// Back substitution for row k, whose unknown is the last one not yet known.
template <int Dof, int k>
[[gnu::always_inline]] inline void substitute(const Mat<Dof>& H, Vec<Dof>& b) {
  b[k] *= H(k, k);
  if constexpr (k > 0) b.template head<k>() -= b[k] * H.template block<k, 1>(0, k);
}

// Makes b the x with H x = b, by elimination; H is a few rows and regular (M is in it).
template <int Dof>
void solve_dense(Mat<Dof>& H, Vec<Dof>& b) {
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (eliminate<Dof, k>(H, b), ...);
    (substitute<Dof, Dof - 1 - k>(H, b), ...);
  }
  (std::make_integer_sequence<int, Dof>());
}

// The residual as a velocity of the block's points: impulse over mass; angular impulse over
// inertia, times the radius of gyration about that axis.
template <int Dof>
bool is_small(const BlockSystem<Dof>& s, const Vec<Dof>& r) {
  const double limit = s.tolerance * s.tolerance * s.mass(0, 0);
  for (int i = 0; i < Dof; ++i)
    if (!(r[i] * r[i] <= limit * s.mass(i, i))) return false;
  return true;
}

// The residual as an energy, twice: line searches reduce it.
template <int Dof>
double size_of(const BlockSystem<Dof>& s, const Vec<Dof>& r) {
  return r.cwiseAbs2().cwiseQuotient(s.mass.diagonal()).sum();
}

// The step of Newton from where the residual r was evaluated.
template <int Dof>
Vec<Dof> newton_step(const BlockSystem<Dof>& system, std::span<const ContactRow> rows,
                     const Vec<Dof>& r, double mass_scale) {
  Mat<Dof> H = derivative<Dof>(system, rows, mass_scale);
  Vec<Dof> step = -r;
  for (const AngularRow& turn : system.angular) step.template segment<3>(3) -= aimed(turn);
  solve_dense<Dof>(H, step);
  return step;
}

// Newton steps until the residual is small; from the seventh on they are shortened until it falls.
// In one piece: as separate calls, the law and its derivative make an impact a seventh dearer.
template <int Dof>
[[gnu::flatten]] NewtonResult solve_coupled(BlockSystem<Dof>& system, std::span<ContactRow> rows,
                                            int max_passes) {
  using namespace law;
  NewtonResult result;
  Vec<Dof> r = residual(system, rows);
  ++result.passes;
  for (int steps = 0;; ++steps) {
    result.converged = is_small(system, r);
    if (result.converged || result.passes >= max_passes) return result;
    const bool is_free = steps < free_steps;
    const double size = is_free ? 0 : size_of(system, r);
    const Vec<Dof> from = system.velocity, step = newton_step<Dof>(system, rows, r, 1);
    double fraction = 1;
    for (int i = 0;; ++i, fraction /= 2) {
      system.velocity = from + fraction * step;
      r = residual(system, rows);
      ++result.passes;
      if (is_free || i == most_step_halvings) break;
      if (size_of(system, r) < (1 - least_gain * fraction) * size) break;
    }
  }
}

// With couples about the mean normal of the contacts as they press without couples. Where a block
// spins about an axis all but across its mean normal, its pivoting changes sign with that normal,
// which follows the impulses: then no velocity may be found that agrees with itself.
template <int Dof>
NewtonResult solve_holding_normals(BlockSystem<Dof>& system, std::span<ContactRow> rows,
                                   int max_passes) {
  system.velocity = system.free_velocity;
  for (AngularRow& turn : system.angular) turn.is_off = true;
  const NewtonResult without = solve_coupled(system, rows, max_passes);
  for (AngularRow& turn : system.angular) {
    turn.is_off = false;
    turn.held_normal = bounds_of(system, turn, rows).normal;
  }
  const NewtonResult with = solve_coupled(system, rows, max_passes);
  for (AngularRow& turn : system.angular) turn.held_normal.setZero();
  return {with.converged, without.passes + with.passes};
}

// Solutions that steps of Newton do not find, to no less than the rounding of velocities and
// impulses.
template <int Dof>
NewtonResult solve_relaxing(BlockSystem<Dof>& system, std::span<ContactRow> rows, int most_steps) {
  double stiffness = 0;
  const double speed = system.free_velocity.template head<3>().norm(),
               spin = system.free_velocity.template segment<3>(3).norm();
  for (const ContactRow& row : rows) {
    const double free_speed = speed + spin * row.arm.norm();
    const double of_row = std::max(row.normal_damping, row.shear_damping) / system.mass(0, 0);
    stiffness = std::max(stiffness, of_row);
    system.tolerance =
        std::max(system.tolerance, 8 * std::numeric_limits<double>::epsilon() *
                                       (of_row * (std::abs(row.bias) + free_speed) + free_speed));
  }
  NewtonResult result;
  Vec<Dof> r;
  const auto go_to = [&](const Vec<Dof>& velocity) {
    system.velocity = velocity;
    r = residual(system, rows);
    ++result.passes;
  };
  go_to(system.velocity);
  if (!is_small(system, r)) go_to(system.free_velocity);
  const auto advance = [&](double time) {
    const double before = size_of(system, r);
    const Vec<Dof> from = system.velocity;
    const Vec<Dof> step = newton_step<Dof>(system, rows, r, 1 + 1 / time);
    go_to(from + step);
    const double left = std::sqrt(size_of<Dof>(system, r + system.mass * step / time) / before);
    if (!(left < 1)) go_to(from);
    return left;
  };
  const auto is_open = [&] { return !is_small(system, r); };
  relax(stiffness, most_steps, is_open, advance);
  result.converged = is_small(system, r);
  return result;
}

}  // namespace

template <int Dof>
NewtonResult solve_contacts(BlockSystem<Dof>& system, std::span<ContactRow> rows, int max_passes) {
  NewtonResult result = solve_coupled(system, rows, max_passes);
  const auto go_on = [&](const NewtonResult& next) {
    result = {next.converged, result.passes + next.passes};
  };
  if (!result.converged && !system.angular.empty())
    go_on(solve_holding_normals(system, rows, max_passes));
  if (!result.converged) go_on(solve_relaxing(system, rows, 12 * max_passes));
  return result;
}

template NewtonResult solve_contacts<6>(BlockSystem<6>&, std::span<ContactRow>, int);
template NewtonResult solve_contacts<12>(BlockSystem<12>&, std::span<ContactRow>, int);

}  // namespace talus
