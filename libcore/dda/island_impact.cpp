#include "dda/island_impact.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

using std::size_t;

constexpr double gain_rounding = 1e-13;                      // of the energy before: not a gain
constexpr double stiffest_round = 100, softest_round = 0.2;  // D / m

/// One impact; a struct so that its parts share what they all need.
template <int Dof>
struct Impact {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  Island<Dof>& island;
  const ImpactSettings& settings;
  ImpactWork<Dof>& work;
  IslandImpactResult result;
  IslandSettings inner;
  double speed = 0;  // of the fastest body
  double part = 1;   // of the restitution that is solved for

  [[nodiscard]] double energy_product(const std::vector<Vec>& a, const std::vector<Vec>& b) const {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += 0.5 * a[i].dot(island.mass[i] * b[i]);
    return sum;
  }

  void prepare() {
    for (size_t i = 0; i < island.mass.size(); ++i)
      speed = std::max(
          speed, island.free_velocity[i].template head<3>().norm() +
                     island.radius[i] * island.free_velocity[i].template segment<3>(3).norm());
    work.asked.resize(island.rows.size());
    for (size_t r = 0; r < island.rows.size(); ++r) {
      IslandRow& row = island.rows[r];
      work.asked[r] = std::min(row.bias, 0.0);
      row.cohesion_impulse = row.tension_impulse = 0;
      row.slip_start.setZero();  // friction against the end velocity never gains energy
      row.waits_for_impact = false;
    }
    inner.tolerance = 0.1 * settings.tolerance * speed;
  }

  void set_stiffness(double ratio) {
    for (const BodyPair& pair : island.pairs) {
      const double mass = reduced_mass(island, pair);
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        IslandRow& row = island.rows[static_cast<size_t>(r)];
        row.normal_damping = row.shear_damping = ratio * mass;
      }
    }
  }

  // The springs of a round carry the impulses of the last one.
  void load_springs() {
    for (size_t r = 0; r < island.rows.size(); ++r) {
      IslandRow& row = island.rows[r];
      const double p_n = row.normal.dot(row.impulse);
      row.bias = part * work.asked[r] - p_n / row.normal_damping;
      row.shear_velocity = (p_n * row.normal - row.impulse) / row.shear_damping;
    }
  }

  // Impulses change from round to round by the stiffness times the error of their conditions.
  [[nodiscard]] double largest_violation() const {
    double largest = 0;
    for (size_t r = 0; r < island.rows.size(); ++r) {
      const IslandRow& row = island.rows[r];
      const Vec3 before = -row.shear_damping * row.shear_velocity +
                          row.normal_damping * (part * work.asked[r] - row.bias) * row.normal;
      largest = std::max(largest, (row.impulse - before).norm() / row.normal_damping);
    }
    return largest;
  }

  // Velocities and impulses for `part` of the restitution asked for.
  bool solve(double restitution_part) {
    part = restitution_part;
    for (IslandRow& row : island.rows) {
      row.impulse.setZero();
      row.state = ContactState::open;
    }
    std::copy(island.free_velocity.begin(), island.free_velocity.end(), island.velocity.begin());
    double stiffness = settings.stiffness;
    bool settled = false;
    for (int round = 0; round < settings.max_rounds && !settled; ++round) {
      set_stiffness(stiffness);
      load_springs();
      const IslandResult solved = solve_island(island, inner, work.solver);
      ++result.rounds;
      result.passes += solved.passes;
      result.violation = largest_violation();
      settled = solved.converged && result.violation <= settings.tolerance * speed;
      stiffness = solved.converged ? std::min(2 * stiffness, stiffest_round)
                                   : std::max(0.2 * stiffness, softest_round);
    }
    follow_impulses();
    return settled;
  }

  // v = v- + M^-1 sum B^T p: momentum is kept to rounding, converged or not.
  void follow_impulses() {
    std::copy(island.free_velocity.begin(), island.free_velocity.end(), island.velocity.begin());
    for (const BodyPair& pair : island.pairs) {
      Vec f = Vec::Zero();
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        const IslandRow& row = island.rows[static_cast<size_t>(r)];
        f += generalised<Dof>(row.arm, row.impulse);
      }
      const auto a = static_cast<size_t>(pair.a), b = static_cast<size_t>(pair.b);
      island.velocity[a] += solve_mass<Dof>(island.mass[a], f);
      if (pair.b < 0) continue;
      const Vec3 shift = island.position[a] - island.position[b];
      island.velocity[b] -= solve_mass<Dof>(island.mass[b], carried_to_b<Dof>(f, shift));
    }
  }

  // Largest s in [0, 1] with E(v_0 + s (v_e - v_0)) <= E before; `change` = v_e - v_0.
  [[nodiscard]] double part_without_gain(const std::vector<Vec>& v_0,
                                         const std::vector<Vec>& change, double before) const {
    const double a = energy_product(change, change), b = energy_product(v_0, change);
    const double c = std::min(0.0, energy_product(v_0, v_0) - before);  // a s^2 + 2 b s + c <= 0
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    const double s = b > 0 ? -c / (b + root) : (root - b) / a;
    return std::clamp(s, 0.0, 1.0);
  }

  // Moves velocities and impulses, now at those of `island`, towards those kept in `work` as far as
  // the energy stays below that before.
  double blend(double before) {
    for (size_t i = 0; i < work.outcome.size(); ++i) work.outcome[i] -= island.velocity[i];
    const double s = part_without_gain(island.velocity, work.outcome, before);
    for (size_t i = 0; i < work.outcome.size(); ++i) island.velocity[i] += s * work.outcome[i];
    for (size_t r = 0; r < island.rows.size(); ++r)
      island.rows[r].impulse += s * (work.impulses[r] - island.rows[r].impulse);
    return s;
  }

  void keep_outcome() {
    work.outcome.assign(island.velocity.begin(), island.velocity.end());
    work.impulses.resize(island.rows.size());
    for (size_t r = 0; r < island.rows.size(); ++r) work.impulses[r] = island.rows[r].impulse;
  }

  [[nodiscard]] bool gains(double before) const {
    return !(energy_product(island.velocity, island.velocity) <= before * (1 + gain_rounding));
  }

  void run() {
    prepare();
    const double before = energy_product(island.free_velocity, island.free_velocity);
    result.converged = solve(1);
    if (gains(before)) {
      keep_outcome();
      result.converged &= solve(0);
      if (gains(before)) {  // not converged: from no impulse towards those of e = 0
        keep_outcome();
        std::copy(island.free_velocity.begin(), island.free_velocity.end(),
                  island.velocity.begin());
        for (IslandRow& row : island.rows) row.impulse.setZero();
      }
      result.restitution_part = blend(before);
    }
    result.dissipated = before - energy_product(island.velocity, island.velocity);
  }
};

}  // namespace

template <int Dof>
IslandImpactResult apply_island_impact(Island<Dof>& island, const ImpactSettings& settings,
                                       ImpactWork<Dof>& work) {
  Impact<Dof> impact{island, settings, work, {}, {}};
  impact.run();
  return impact.result;
}

template IslandImpactResult apply_island_impact<6>(Island<6>&, const ImpactSettings&,
                                                   ImpactWork<6>&);
template IslandImpactResult apply_island_impact<12>(Island<12>&, const ImpactSettings&,
                                                    ImpactWork<12>&);

}  // namespace talus
