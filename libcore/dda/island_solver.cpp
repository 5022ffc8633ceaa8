#include "dda/island_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace talus {
namespace {

using std::size_t;

constexpr int free_steps = 3;      // Newton steps before the line search looks at them
constexpr int most_halvings = 8;   // of a step
constexpr double slack = 0.5;      // of a slip stiffness before its tangent is summed again
constexpr double first_ratio = 1;  // D / m at which stiffening starts
constexpr double ratio_growth = 4;
constexpr double soft_tolerance = 1e-3;  // of a stage before the last, relative to its start
constexpr int all_every = 8;             // every so many linear solutions move all bodies
constexpr size_t few = 2;                // the neighbourhood alone where fewer than half move
constexpr double hopeless = 1e5;  // growth of the residual at which coupled steps are given up

/// One solve; a struct so that its parts share what they all need.
struct Solve {
  Island& island;
  const IslandSettings& settings;
  IslandWork& work;
  IslandResult result;
  double tolerance = 0;
  double best_residual = std::numeric_limits<double>::infinity();
  bool direct = false;
  bool tracking = true;
  bool inherits = false;  // a row comes with a state: the first evaluation is not the law's
  int n_linear = 0;       // linear solutions by conjugate gradients

  // Packs the rows, and sets the tolerance above the rounding of the stiffest impulse.
  void prepare() {
    const size_t n = island.mass.size(), n_pairs = island.pairs.size();
    const bool only_changed = settings.continues && work.as_packed;
    work.limit.resize(n_pairs);
    if (!only_changed) work.rounding = work.stiffness_ratio = 0;
    for (size_t p = 0; p < n_pairs; ++p) {
      const BodyPair& pair = island.pairs[p];
      if (only_changed && !pair.changed) continue;
      const double mass = reduced_mass(island, pair);
      work.limit[p] = settings.stiffest * mass;
      const double free_speed = island.free_velocity[static_cast<size_t>(pair.a)].head<3>().norm();
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        const IslandRow& row = island.rows[static_cast<size_t>(r)];
        inherits |= row.state != ContactState::open;
        const double stiffness =
            std::min(std::max(row.normal_damping, row.shear_damping), work.limit[p]);
        work.stiffness_ratio = std::max(work.stiffness_ratio, stiffness / mass);
        work.rounding =
            std::max(work.rounding, 8 * std::numeric_limits<double>::epsilon() *
                                        (stiffness / mass) * (std::abs(row.bias) + free_speed));
      }
    }
    tolerance = std::max(settings.tolerance, work.rounding);
    result.n_lowered = pack_rows(island.pairs, island.rows, work.limit, only_changed, work.rows);
    prepare_matrix(island, only_changed, work.matrix);
    work.as_packed = true;
    for (auto* vectors : {&work.residual, &work.step, &work.from, &work.best}) vectors->resize(n);
    work.speed.resize(n);
    work.moves.resize(n);
    work.per_impulse.resize(n);
    for (size_t i = 0; i < n; ++i) {
      work.per_impulse[i] = island.mass[i].diagonal().cwiseInverse();
      work.per_impulse[i].tail<3>() *= island.radius[i];
    }
    work.pair_impulse.resize(n_pairs);
    activate_all();
    direct = n_bodies(island) <= settings.direct_bodies;
    for (size_t i = 0; i < n; ++i)
      if (!island.velocity[i].allFinite()) island.velocity[i] = island.free_velocity[i];
  }

  void activate_all() {
    work.matrix.is_active.assign(island.mass.size(), 1);
    work.matrix.active.resize(island.mass.size());
    std::iota(work.matrix.active.begin(), work.matrix.active.end(), 0);
    work.matrix.active_coupled = work.matrix.coupled;
  }

  // Contacts of an active body; what a body at rest had from them before is replaced.
  [[gnu::flatten]] void evaluate_contacts(size_t p, Evaluation evaluation) {
    const BodyPair& pair = island.pairs[p];
    const auto a = static_cast<size_t>(pair.a), b = static_cast<size_t>(pair.b);
    const std::vector<std::uint8_t>& active = work.matrix.is_active;
    const bool active_b = pair.b >= 0 && active[b];
    if (!active[a] && !active_b) return;
    const Vec3& shift = work.matrix.shift[p];
    const Vec6 u = pair.b < 0 ? island.velocity[a]
                              : relative_motion(island.velocity[a], island.velocity[b], shift);
    Vec6 f;
    if (evaluate_pair(groups_of(work.rows, p), u, evaluation, direct ? 0 : slack, f))
      work.matrix.pair_changed[p] = 1;
    const Vec6 change = f - work.pair_impulse[p];
    work.pair_impulse[p] = f;
    work.residual[a] -= active[a] ? f : change;
    if (pair.b >= 0) work.residual[b] += carried_to_b(active_b ? f : change, shift);
  }

  // The largest residual as a velocity: impulse over mass, angular impulse over inertia times
  // radius.
  [[nodiscard]] double residual_speed() {
    double largest = 0;
    for (size_t i = 0; i < island.mass.size(); ++i) {
      work.speed[i] = work.residual[i].cwiseAbs().cwiseProduct(work.per_impulse[i]).maxCoeff();
      if (!(work.speed[i] <= largest)) largest = work.speed[i];  // NaN stays
      if (std::isnan(largest)) return largest;
    }
    return largest;
  }

  [[gnu::flatten]] double evaluate(Evaluation evaluation) {
    ++result.passes;
    for (const int body : work.matrix.active) {
      const auto i = static_cast<size_t>(body);
      work.residual[i] = times_mass(island.mass[i], island.velocity[i] - island.free_velocity[i]);
    }
    for (size_t p = 0; p < island.pairs.size(); ++p) evaluate_contacts(p, evaluation);
    result.residual = residual_speed();
    if (tracking && evaluation == Evaluation::coupled && result.residual < best_residual) {
      best_residual = result.residual;
      std::copy(island.velocity.begin(), island.velocity.end(), work.best.begin());
    }
    return result.residual;
  }

  // Do so few bodies move that their neighbourhood is worth a linear solution of its own? Not in
  // every step: a push that travels far needs them all.
  bool few_move() {
    size_t n = 0;
    for (size_t i = 0; i < work.moves.size(); ++i) {
      work.moves[i] = !(work.speed[i] <= tolerance);
      n += work.moves[i];
    }
    return ++n_linear % all_every != 0 && few * n < work.moves.size();
  }

  // K step = -residual.
  void find_step() {
    update_tangents(island, direct ? Tangent::exact : Tangent::symmetric, work.rows, work.matrix);
    for (Vec6& r : work.residual) r = -r;
    if (direct) {
      activate_all();
      ++result.factorisations;
      solve_direct(island, work.matrix, work.residual, work.step);
    } else {
      update_diagonals(island, work.matrix);
      if (few_move())
        choose_active(island, work.moves, work.matrix);
      else
        activate_all();
      const LinearResult linear =
          solve_conjugate_gradients(island, work.matrix, work.residual, settings.linear_tolerance,
                                    settings.max_linear_iterations, work.step);
      result.linear_iterations += linear.iterations;
      direct = !linear.converged && n_bodies(island) <= settings.direct_fallback;
    }
    for (Vec6& r : work.residual) r = -r;
  }

  [[nodiscard]] double slope() const {
    double sum = 0;
    for (size_t i = 0; i < work.step.size(); ++i) sum += work.residual[i].dot(work.step[i]);
    return sum;
  }

  // A Newton step; with `search` it is shortened: with the exact derivative until the residual
  // falls, else until the residual's work along the step is at most half of what it was at the
  // start.
  double advance(bool search) {
    find_step();
    const double start_residual = result.residual;
    const double start_slope = std::abs(slope());
    std::copy(island.velocity.begin(), island.velocity.end(), work.from.begin());
    double fraction = 1;
    for (int i = 0;; ++i, fraction /= 2) {
      for (size_t k = 0; k < work.step.size(); ++k)
        island.velocity[k] = work.from[k] + fraction * work.step[k];
      const double residual = evaluate(Evaluation::coupled);
      if (!search || i >= most_halvings || residual <= tolerance) return residual;
      if (direct ? residual < start_residual : slope() <= 0.5 * start_slope) return residual;
    }
  }

  bool solve_coupled(int max_passes) {
    const double at_start =
        evaluate(settings.continues ? Evaluation::coupled : Evaluation::inherited);
    if ((settings.continues || !inherits) && at_start <= tolerance) return true;
    for (int steps = 0; result.passes < max_passes; ++steps) {
      const double residual = advance(steps >= free_steps);
      if (residual <= tolerance) return true;
      if (!(residual < hopeless * best_residual)) return false;
    }
    return false;
  }

  // The law with D_n and D_t at most `ratio` times the reduced mass.
  double soften(double ratio) {
    for (size_t p = 0; p < work.limit.size(); ++p)
      work.limit[p] = ratio * reduced_mass(island, island.pairs[p]);
    (void)pack_rows(island.pairs, island.rows, work.limit, false, work.rows);
    work.as_packed = false;
    work.matrix.pair_changed.assign(island.pairs.size(), 1);
    activate_all();
    return evaluate(Evaluation::coupled);
  }

  // From rest in the free motion, at a stiffness where Newton finds its way, then at higher ones
  // from there; factored, since slipping contacts that are stiff couple through their friction
  // bounds.
  bool solve_stiffening() {
    std::copy(island.free_velocity.begin(), island.free_velocity.end(), island.velocity.begin());
    direct = n_bodies(island) <= settings.direct_fallback;
    for (double ratio = first_ratio;; ratio *= ratio_growth) {
      tracking = ratio >= work.stiffness_ratio;
      double residual = soften(std::min(ratio, settings.stiffest));
      const double goal = tracking ? tolerance : tolerance + soft_tolerance * residual;
      for (int steps = 0; residual > goal && result.passes < settings.max_passes; ++steps)
        residual = advance(steps >= free_steps);
      if (tracking) return residual <= tolerance;
      if (!std::isfinite(residual) || result.passes >= settings.max_passes) return false;
    }
  }

  void restore(double residual) {
    const std::vector<Vec6>& good = std::isfinite(residual) ? work.best : island.free_velocity;
    std::copy(good.begin(), good.end(), island.velocity.begin());
  }

  // v -= M^-1 residual: not more than the tolerance, and what the bodies exchange adds up to
  // nothing whatever the tolerance. A solution that continues starts from where this one was found:
  // a stiff contact makes many tolerances of that one.
  void keep_momentum() {
    work.found = island.velocity;
    for (size_t i = 0; i < island.mass.size(); ++i)
      island.velocity[i] -= solve_mass(island.mass[i], work.residual[i]);
  }

  void run() {
    if (settings.continues) island.velocity = work.found;
    prepare();
    result.converged = solve_coupled(settings.max_passes / 3) || solve_stiffening();
    if (!result.converged) {
      restore(best_residual);
      result.residual = soften(settings.stiffest);
    }
    if (result.converged) keep_momentum();
    unpack_rows(island.pairs, work.rows, island.rows);
  }
};

}  // namespace

IslandResult solve_island(Island& island, const IslandSettings& settings, IslandWork& work) {
  Solve solve{island, settings, work, {}};
  solve.run();
  return solve.result;
}

}  // namespace talus
