// Solves an island by semismooth Newton steps with line search and pseudo-time.
#include "solver/island_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/law_numbers.hpp"
#include "solver/one_contact.hpp"
#include "solver/relax.hpp"
#include "solver/row_groups.hpp"

namespace talus {
namespace {

using std::size_t;

using law::slack;

/// One solve; a struct so that its parts share common data.
struct Solve {
  Island& island;
  const IslandSettings& settings;
  IslandWork& work;
  IslandResult result;
  double tolerance = 0;
  double best_residual = std::numeric_limits<double>::infinity();
  bool direct = false;
  bool inherits = false;  // a row comes with a state: the first evaluation is not the law's

  // Of the points of a body without contact.
  [[nodiscard]] double free_speed_of(int body) const {
    const auto i = static_cast<size_t>(body);
    const Vec6& free = island.free_velocity[i];
    return free.head<3>().norm() + island.radius[i] * free.tail<3>().norm();
  }

  // Lowers the rows of pair `p` that are too stiff, and notes the tolerance that they and the
  // velocities allow: in a very short substep contacts press with little more than rounding, and
  // impulses about a large body's centroid turn a small one by the rounding of a long lever.
  void prepare_pair(size_t p) {
    const BodyPair& pair = island.pairs[p];
    const double mass = reduced_mass(island, pair), limit = settings.stiffest * mass;
    const double free_speed =
        std::max(free_speed_of(pair.a), pair.b < 0 ? 0 : free_speed_of(pair.b));
    const double turned =
        pair.b < 0 ? 0 : pair.shift.norm() * work.per_impulse[pair.b].tail<3>().maxCoeff();
    const double per_impulse = std::max(1 / mass, turned);
    for (RowGroup& group : groups_of(island, pair))
      for (int lane = 0; lane < 2; ++lane) {
        inherits |= group.state[lane] != 0;
        double stiffness = std::max(group.normal_damping[lane], group.shear_damping[lane]);
        if (stiffness > limit) {
          ++result.n_lowered;
          group.normal_damping[lane] = std::min(group.normal_damping[lane], limit);
          group.shear_damping[lane] = std::min(group.shear_damping[lane], limit);
          stiffness = limit;
        }
        work.stiffness_ratio = std::max(work.stiffness_ratio, stiffness / mass);
        const double changed = stiffness * per_impulse * (std::abs(group.bias[lane]) + free_speed);
        work.rounding = std::max(
            work.rounding, 8 * std::numeric_limits<double>::epsilon() * (changed + free_speed));
      }
  }

  void prepare() {
    const size_t n = island.mass.size(), n_pairs = island.pairs.size();
    work.per_impulse.resize(n);
    for (size_t i = 0; i < n; ++i) {
      work.per_impulse[i] = island.mass[i].diagonal().cwiseInverse();
      work.per_impulse[i].tail<3>() *= island.radius[i];
    }
    work.rounding = work.stiffness_ratio = 0;
    for (size_t p = 0; p < n_pairs; ++p) prepare_pair(p);
    prepare_matrix(island, work.matrix);
    set_heights(island, settings.down, work.factor);
    for (auto* vectors : {&work.residual, &work.step, &work.from}) vectors->resize(n);
    work.speed.resize(n);
    work.pair_impulse.assign(n_pairs, Vec6::Zero());
    work.touched_bodies.reset(n);
    work.touched_pairs.reset(n_pairs);
    work.velocity = island.velocity;
    for (size_t i = 0; i < n; ++i)
      if (!work.velocity[i].allFinite()) work.velocity[i] = island.free_velocity[i];
  }

  // Goes on where the last solution was found, with the pairs that changed since.
  void prepare_changed() {
    work.touched_bodies.clear();
    work.touched_pairs.clear();
    work.start.clear();
    for (size_t p = 0; p < island.pairs.size(); ++p) {
      const BodyPair& pair = island.pairs[p];
      if (!pair.changed) continue;
      prepare_pair(p);
      talus::prepare_pair(island, p, work.matrix);
      work.start.push_back(pair.a);
      if (pair.b >= 0) work.start.push_back(pair.b);
    }
    activate(island, work.start, work.matrix);
  }

  // The couples of pairs whose rows were evaluated, at their relative spin. Their tangents count as
  // changed: few pairs have one, and the bound follows every impulse.
  void evaluate_couples(std::span<const int> pairs, std::span<PairEvaluation> evaluations) {
    for (size_t i = 0; i < pairs.size(); ++i) {
      const BodyPair& pair = island.pairs[pairs[i]];
      if (pair.angular < 0) continue;
      PairEvaluation& now = evaluations[i];
      AngularRow& turn = island.angular[pair.angular];
      talus::evaluate(Vec3(now.motion.tail<3>()), couple_bounds(island, pair), turn);
      for (int k = 0; k < 3; ++k) now.sum[3 + k][0] += turn.couple[k];
      now.changed = true;
    }
  }

  using FewPairs = std::array<PairEvaluation, chunk_size>;  // few enough to stay near

  [[gnu::always_inline]] void evaluate_few(std::span<const int> pairs, Evaluation evaluation,
                                           FewPairs& now) {
    for (size_t i = 0; i < pairs.size(); ++i) {
      const auto p = static_cast<size_t>(pairs[i]);
      const BodyPair& pair = island.pairs[p];
      now[i].groups = groups_of(island, pair);
      now[i].motion = work.velocity[pair.a];
      if (pair.b >= 0)
        now[i].motion = relative_motion(now[i].motion, work.velocity[pair.b], work.matrix.shift[p]);
    }
    evaluate_pairs(std::span(now).first(pairs.size()), evaluation, direct ? 0 : slack);
    if (!island.angular.empty()) evaluate_couples(pairs, now);
  }

  void take_impulse(int p, bool changed, const Vec6& impulse) {
    if (changed) work.matrix.changed_pairs.add(p);
    add_impulse(static_cast<size_t>(p), impulse);
  }

  // Contacts of active bodies; former impulses on a body at rest are replaced.
  [[gnu::flatten]] void evaluate_contacts(std::span<const int> pairs, Evaluation evaluation) {
    if (are_shared(work.matrix.workers, pairs.size())) return evaluate_shared(pairs, evaluation);
    FewPairs now;
    for (size_t begin = 0; begin < pairs.size(); begin += now.size()) {
      const auto some = pairs.subspan(begin, std::min(now.size(), pairs.size() - begin));
      evaluate_few(some, evaluation, now);
      for (size_t i = 0; i < some.size(); ++i)
        take_impulse(some[i], now[i].changed, now[i].impulse());
    }
  }

  // The same in several threads; contributions to the residual are added afterwards, in order.
  void evaluate_shared(std::span<const int> pairs, Evaluation evaluation) {
    std::vector<PairImpulse>& found = work.evaluated;
    if (found.size() < pairs.size()) found.resize(pairs.size());
    in_chunks(work.matrix.workers, pairs.size(),
              [&](size_t begin, size_t end) { evaluate_part(pairs, begin, end, evaluation); });
    for (size_t i = 0; i < pairs.size(); ++i)
      take_impulse(pairs[i], found[i].changed, found[i].impulse);
  }

  [[gnu::flatten]] void evaluate_part(std::span<const int> pairs, size_t begin, size_t end,
                                      Evaluation evaluation) {
    FewPairs now;
    evaluate_few(pairs.subspan(begin, end - begin), evaluation, now);
    for (size_t i = begin; i < end; ++i)
      work.evaluated[i] = {now[i - begin].impulse(), now[i - begin].changed};
  }

  void add_impulse(size_t p, const Vec6& f) {
    const BodyPair& pair = island.pairs[p];
    const auto a = static_cast<size_t>(pair.a), b = static_cast<size_t>(pair.b);
    const IndexSet& active = work.matrix.active.bodies;
    const Vec6 change = f - work.pair_impulse[p];
    work.pair_impulse[p] = f;
    work.residual[a] -= active.contains(pair.a) ? f : change;
    if (pair.b >= 0)
      work.residual[b] += carried_to_b(active.contains(pair.b) ? f : change, work.matrix.shift[p]);
  }

  // The residual as a velocity: impulse over mass, angular impulse over inertia times radius.
  void find_speeds(const IndexSet& bodies) {
    for (const int body : bodies.items) {
      const auto i = static_cast<size_t>(body);
      work.speed[i] = work.residual[i].cwiseAbs().cwiseProduct(work.per_impulse[i]).maxCoeff();
    }
  }

  static void add_to(IndexSet& set, const std::vector<int>& items) {
    if (set.items.size() == set.has.size()) return;  // it has them all
    for (const int i : items) set.add(i);
  }

  // The largest of all bodies; NaN where there is one.
  [[nodiscard]] double residual_speed() const {
    const auto n = static_cast<Eigen::Index>(work.speed.size());
    return n == 0 ? 0 : Eigen::ArrayXd::Map(work.speed.data(), n).maxCoeff<Eigen::PropagateNaN>();
  }

  [[gnu::flatten]] double evaluate(Evaluation evaluation) {
    ++result.passes;
    const ActiveBodies& active = work.matrix.active;
    for (const int body : active.bodies.items) {
      const auto i = static_cast<size_t>(body);
      work.residual[i] = times_mass(island.mass[i], work.velocity[i] - island.free_velocity[i]);
    }
    evaluate_contacts(active.pairs, evaluation);
    add_to(work.touched_pairs, active.pairs);
    for (const IndexSet* bodies : {&active.bodies, &active.others}) {
      find_speeds(*bodies);
      add_to(work.touched_bodies, bodies->items);
    }
    result.residual = residual_speed();
    if (evaluation == Evaluation::coupled) best_residual = std::min(best_residual, result.residual);
    return result.residual;
  }

  // Subtracts the targets of couples that are about to hold from the residual.
  void aim_couples() {
    for (const int p : work.matrix.active.pairs) {
      const BodyPair& pair = island.pairs[p];
      if (pair.angular < 0) continue;
      const Vec3 couple = aimed(island.angular[pair.angular]);
      work.residual[pair.a].tail<3>() += couple;
      if (pair.b >= 0) work.residual[pair.b].tail<3>() -= couple;
    }
  }

  // K step = -residual.
  void find_step() {
    if (island.angular.empty()) return find_step_to_residual();
    work.unaimed = work.residual;
    aim_couples();
    find_step_to_residual();
    work.residual.swap(work.unaimed);
  }
  void find_step_to_residual() {
    update_tangents(island, direct ? Tangent::exact : Tangent::symmetric, work.matrix);
    if (direct) {
      activate_all(island, work.matrix);
      ++result.factorisations;
      solve_direct(island, work.matrix, work.residual, work.step);
      return;
    }
    activate_all(island, work.matrix);
    eliminate(island, work.matrix, work.factor);
    const LinearResult linear =
        solve_conjugate_gradients(work.factor, work.residual, settings.linear_tolerance,
                                  settings.max_linear_iterations, work.step);
    result.linear_iterations += linear.iterations;
    direct = !linear.converged && n_bodies(island) <= settings.direct_fallback;
  }

  [[nodiscard]] double slope() const {
    double sum = 0;
    for (const int body : work.matrix.active.bodies.items)
      sum += work.residual[body].dot(work.step[body]);
    return sum;
  }

  void go_along(double fraction) {
    for (const int body : work.matrix.active.bodies.items) {
      const auto k = static_cast<size_t>(body);
      work.velocity[k] = work.from[k] + fraction * work.step[k];
    }
  }

  void keep_from() {
    for (const int body : work.matrix.active.bodies.items)
      work.from[static_cast<size_t>(body)] = work.velocity[static_cast<size_t>(body)];
  }

  // A Newton step; with `search` it is shortened: with the exact derivative until the residual
  // falls, else until the residual's work along the step is at most half of its value at the start.
  double advance(bool search) {
    find_step();
    const double start_residual = result.residual;
    const double start_slope = std::abs(slope());
    keep_from();
    double fraction = 1;
    for (int i = 0;; ++i, fraction /= 2) {
      go_along(fraction);
      const double residual = evaluate(Evaluation::coupled);
      if (!search || i >= law::most_step_halvings || residual <= tolerance) return residual;
      if (direct ? residual < start_residual : slope() <= 0.5 * start_slope) return residual;
    }
  }

  // Given up where the smallest residual does not fall by half within some steps.
  bool solve_coupled() {
    const double at_start =
        evaluate(settings.continues ? Evaluation::coupled : Evaluation::inherited);
    if ((settings.continues || !inherits) && at_start <= tolerance) return true;
    double before = std::numeric_limits<double>::infinity();
    for (int steps = 0; result.passes < settings.max_passes; ++steps) {
      const double residual = advance(steps >= law::free_steps);
      if (residual <= tolerance) return true;
      if (!std::isfinite(residual)) return false;
      if (steps % law::patience != law::patience - 1) continue;
      if (best_residual > 0.5 * before) return false;
      before = best_residual;
    }
    return false;
  }

  [[nodiscard]] static double energy(const Mat6& mass, const Vec6& r) {
    return r.dot(solve_mass(mass, r));
  }

  bool solve_relaxing() {
    direct = n_bodies(island) <= settings.direct_fallback;
    work.velocity = island.free_velocity;
    work.matrix.changed_pairs.fill();
    activate_all(island, work.matrix);
    evaluate(Evaluation::coupled);
    const auto advance = [&](double time) {
      double before = 0, left = 0;
      for (size_t i = 0; i < work.residual.size(); ++i)
        before += energy(island.mass[i], work.residual[i]);
      scale_masses(1 + 1 / time, work.matrix);
      find_step();
      keep_from();
      go_along(1);
      evaluate(Evaluation::coupled);
      for (size_t i = 0; i < work.residual.size(); ++i)
        left += energy(island.mass[i],
                       work.residual[i] + times_mass(island.mass[i], work.step[i]) / time);
      left = std::sqrt(left / before);
      if (left < 1) return left;
      go_along(0);
      evaluate(Evaluation::coupled);
      return left;
    };
    const auto is_open = [&] { return result.residual > tolerance; };
    relax(work.stiffness_ratio, 3 * settings.max_passes, is_open, advance);
    scale_masses(1, work.matrix);
    return result.residual <= tolerance;
  }

  // Velocities that are handed back: v - M^-1 residual, so that exchanged momenta add up to
  // nothing whatever the tolerance. That moves them by no more than the tolerance, but a solution
  // that continues starts from v: a stiff contact makes many tolerances of that move.
  void keep_momentum() {
    for (const int body : work.touched_bodies.items) {
      const auto i = static_cast<size_t>(body);
      island.velocity[i] = work.velocity[i] - solve_mass(island.mass[i], work.residual[i]);
    }
  }

  void run() {
    if (settings.continues)
      prepare_changed();
    else
      prepare();
    tolerance = std::max(settings.tolerance, work.rounding);
    direct = n_bodies(island) <= settings.direct_bodies;
    result.converged = solve_coupled() || solve_relaxing();
    if (result.converged) {
      keep_momentum();
    } else {
      island.velocity = work.velocity;
    }
    for (const int p : work.touched_pairs.items) island.pairs[p].changed = false;
  }
};

}  // namespace

IslandResult solve_island(Island& island, const IslandSettings& settings, IslandWork& work) {
  Solve solve{island, settings, work, {}};
  solve.run();
  return solve.result;
}

}  // namespace talus
