#include "dda/island_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dda/island_law.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int free_steps = 3;         // Newton steps before the line search looks at them
constexpr int most_halvings = 8;      // of a step
constexpr double hopeless = 1e5;      // growth of the residual at which coupled steps are given up
constexpr double least_relaxation = 0.3;  // of the held friction bounds

/// How the rows are evaluated: with the states they came with, with the law, or with the law and the
/// friction bounds held.
enum class Mode { inherited, coupled, held };

/// One solve; a struct so that its parts share what they all need.
template <int Dof>
struct Solve {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  Island<Dof>& island;
  const IslandSettings& settings;
  IslandWork<Dof>& work;
  IslandResult result;
  double tolerance = 0;
  double best_residual = std::numeric_limits<double>::infinity();
  bool direct = false;

  [[nodiscard]] std::span<IslandRow> rows_of(const BodyPair& pair) const {
    return {island.rows.data() + pair.row_begin, static_cast<size_t>(pair.row_end - pair.row_begin)};
  }

  [[nodiscard]] double reduced_mass(const BodyPair& pair) const {
    const double m_a = island.mass[static_cast<size_t>(pair.a)](0, 0);
    if (pair.b < 0) return m_a;
    const double m_b = island.mass[static_cast<size_t>(pair.b)](0, 0);
    return m_a * (m_b / (m_a + m_b));
  }

  // Lowers what is too stiff, and sets the tolerance above the rounding of the stiffest impulse.
  void prepare() {
    double floor = 0;
    for (const BodyPair& pair : island.pairs) {
      const double mass = reduced_mass(pair), limit = settings.stiffest * mass;
      for (IslandRow& row : rows_of(pair)) {
        if (row.normal_damping > limit || row.shear_damping > limit) ++result.n_lowered;
        row.normal_damping = std::min(row.normal_damping, limit);
        row.shear_damping = std::min(row.shear_damping, limit);
        const double speed = std::abs(row.bias) + row.shear_velocity.norm() +
                             island.free_velocity[static_cast<size_t>(pair.a)].template head<3>().norm();
        floor = std::max(floor, std::max(row.normal_damping, row.shear_damping) / mass * speed);
      }
    }
    tolerance = std::max(settings.tolerance, 8 * std::numeric_limits<double>::epsilon() * floor);
    prepare_matrix(island, work.matrix);
    for (auto* vectors : {&work.residual, &work.step, &work.from, &work.best})
      vectors->resize(island.mass.size());
    direct = n_bodies(island) <= settings.direct_bodies;
    for (size_t i = 0; i < island.mass.size(); ++i)
      if (!island.velocity[i].allFinite()) island.velocity[i] = island.free_velocity[i];
  }

  // True when a row's tangent is another one now.
  static bool apply(IslandRow& row, const Vec3& w, Mode mode) {
    const ContactState state = row.state;
    const double stiffness = row.slip_stiffness;
    if (mode == Mode::inherited)
      apply_inherited(row, w);
    else
      apply_law(row, w, mode == Mode::held);
    return row.state != state || row.slip_stiffness != stiffness;
  }

  [[gnu::flatten]] void evaluate_pair(size_t p, Mode mode) {
    const BodyPair& pair = island.pairs[p];
    const auto a = static_cast<size_t>(pair.a), b = static_cast<size_t>(pair.b);
    const Vec3& shift = work.matrix.shift[p];
    const Vec u = pair.b < 0 ? island.velocity[a]
                             : relative_motion<Dof>(island.velocity[a], island.velocity[b], shift);
    Vec f = Vec::Zero();
    bool changed = false;
    for (IslandRow& row : rows_of(pair)) {
      if (row.waits_for_impact) continue;
      changed |= apply(row, point_velocity<Dof>(u, row.arm), mode);
      if (row.state != ContactState::open) f += generalised<Dof>(row.arm, row.impulse);
    }
    if (changed) work.matrix.pair_changed[p] = 1;
    work.residual[a] -= f;
    if (pair.b >= 0) work.residual[b] += carried_to_b<Dof>(f, shift);
  }

  // The largest residual as a velocity: impulse over mass, angular impulse over inertia times radius.
  [[nodiscard]] double residual_speed() const {
    double largest = 0;
    for (size_t i = 0; i < island.mass.size(); ++i) {
      const Vec speed = work.residual[i].cwiseAbs().cwiseQuotient(island.mass[i].diagonal());
      const double turning = speed.template tail<Dof - 3>().maxCoeff() * island.radius[i];
      const double of_body = std::max(speed.template head<3>().maxCoeff(), turning);
      if (!(of_body <= largest)) largest = of_body;  // NaN stays
      if (std::isnan(largest)) return largest;
    }
    return largest;
  }

  double evaluate(Mode mode) {
    ++result.passes;
    for (size_t i = 0; i < island.mass.size(); ++i)
      work.residual[i].noalias() =
          island.mass[i].lazyProduct(island.velocity[i] - island.free_velocity[i]);
    for (size_t p = 0; p < island.pairs.size(); ++p) evaluate_pair(p, mode);
    result.residual = residual_speed();
    if (mode == Mode::coupled && result.residual < best_residual) {
      best_residual = result.residual;
      std::copy(island.velocity.begin(), island.velocity.end(), work.best.begin());
    }
    return result.residual;
  }

  // K step = -residual. Factored, K is the exact derivative while the friction bounds are coupled.
  void find_step(Mode mode) {
    const Tangent tangent =
        direct && mode == Mode::coupled ? Tangent::exact : Tangent::symmetric;
    update_tangents(island, tangent, work.matrix);
    for (Vec& r : work.residual) r = -r;
    if (direct) {
      ++result.factorisations;
      solve_direct<Dof>(island, work.matrix, work.residual, work.step);
    } else {
      update_diagonals(island, work.matrix);
      const LinearResult linear = solve_conjugate_gradients<Dof>(
          island, work.matrix, work.residual, settings.linear_tolerance,
          settings.max_linear_iterations, work.step);
      result.linear_iterations += linear.iterations;
      direct = !linear.converged && n_bodies(island) <= settings.direct_fallback;
    }
    for (Vec& r : work.residual) r = -r;
  }

  [[nodiscard]] double slope() const {
    double sum = 0;
    for (size_t i = 0; i < work.step.size(); ++i) sum += work.residual[i].dot(work.step[i]);
    return sum;
  }

  // A Newton step; with `search` it is shortened until the residual's work along it is at most half
  // of what it was at the start: there the step does not overshoot.
  double advance(Mode mode, bool search) {
    find_step(mode);
    const double start_slope = std::abs(slope());
    std::copy(island.velocity.begin(), island.velocity.end(), work.from.begin());
    double fraction = 1;
    for (int i = 0;; ++i, fraction /= 2) {
      for (size_t k = 0; k < work.step.size(); ++k)
        island.velocity[k] = work.from[k] + fraction * work.step[k];
      const double residual = evaluate(mode);
      if (!search || i >= most_halvings || residual <= tolerance) return residual;
      if (slope() <= 0.5 * start_slope) return residual;
    }
  }

  bool solve_coupled(int max_passes) {
    evaluate(Mode::inherited);
    for (int steps = 0; result.passes < max_passes; ++steps) {
      const double residual = advance(Mode::coupled, steps >= free_steps);
      if (residual <= tolerance) return true;
      if (!(residual < hopeless * best_residual)) return false;
    }
    return false;
  }

  void renew_bounds(double part) {
    for (IslandRow& row : island.rows) {
      const double next = friction_bound(row, row.normal.dot(row.impulse));
      row.held_cap += part * (next - row.held_cap);
    }
  }

  bool solve_held() {
    restore(std::numeric_limits<double>::infinity());
    evaluate(Mode::coupled);
    restore(best_residual);
    evaluate(Mode::coupled);
    for (IslandRow& row : island.rows) row.held_cap = 0;
    double relaxation = 1;
    while (result.passes < settings.max_passes) {
      renew_bounds(relaxation);
      double residual = evaluate(Mode::held);
      while (residual > tolerance && result.passes < settings.max_passes)
        residual = advance(Mode::held, true);
      if (!std::isfinite(residual)) return false;
      if (evaluate(Mode::coupled) <= tolerance) return true;
      relaxation = std::max(least_relaxation, 0.9 * relaxation);
    }
    return false;
  }

  void restore(double residual) {
    const std::vector<Vec>& good = std::isfinite(residual) ? work.best : island.free_velocity;
    std::copy(good.begin(), good.end(), island.velocity.begin());
  }

  void run() {
    prepare();
    result.converged = solve_coupled(settings.max_passes / 2) || solve_held();
    if (result.converged) return;
    restore(best_residual);
    evaluate(Mode::coupled);
  }
};

}  // namespace

template <int Dof>
IslandResult solve_island(Island<Dof>& island, const IslandSettings& settings,
                          IslandWork<Dof>& work) {
  Solve<Dof> solve{island, settings, work, {}};
  solve.run();
  return solve.result;
}

template IslandResult solve_island<6>(Island<6>&, const IslandSettings&, IslandWork<6>&);
template IslandResult solve_island<12>(Island<12>&, const IslandSettings&, IslandWork<12>&);

}  // namespace talus
