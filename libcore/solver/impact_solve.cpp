// The impact law for many contacts: Newton's method on the velocities of the bodies.
#include "solver/impact_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/scales.hpp"
#include "solver/law_numbers.hpp"
#include "solver/one_contact.hpp"

namespace talus {
namespace {

using std::size_t;

// A contact yields by 1/D of the error of its expected impulse: four figures a round.
constexpr double stiffness_ratio = 9e3;   // D over the mass that the contact feels
constexpr double first_stiffness = 1e3;   // in the first round
constexpr double settled = 1e-5;          // of the fastest approach: largest error of a contact's
                                          // velocity
constexpr double tolerance = 1e-13;       // of the same: residual of the balance of momentum
constexpr double loose_tolerance = 1e-7;  // ... where a step hardly helps
constexpr int most_rounds = 12;           // of expected impulses ...
constexpr int most_convex_rounds = 500;   // ... and in the convex form, where these do not settle
constexpr double most_renewed = 20;       // of the error of a slip, and at least its inverse
constexpr int most_steps = 30, most_convex_steps = 100;  // of Newton in a round

/// An impact being solved; a struct so that its parts share common data.
struct Solver {
  std::span<const ImpactBody> bodies;
  std::span<ImpactContact> contacts;
  ImpactWork& w;
  double scale = 0;          // fastest approach [m/s]
  double rounding = 0;       // of velocities [m/s]
  double renewed = 1;        // share of the error of a slip that a round adds
  bool has_missing = false;  // of the round before
  bool is_convex = false;    // slips and the bounds of couples are those expected
  int passes = 0;

  [[nodiscard]] static Vec6 of(const Eigen::VectorXd& v, int k) { return v.segment<6>(6 * k); }

  // Speed of a contact's point per impulse along the normal, and the largest along a tangent.
  [[nodiscard]] std::pair<double, double> mobility(const ImpactContact& c) const {
    double along = 0, all = 0;
    const auto add = [&](const ImpactBody& body, const Vec3& arm) {
      const Vec3 turn = arm.cross(c.normal);
      along += body.inverse_mass + turn.dot(body.inverse_inertia * turn);
      all += 3 * body.inverse_mass + body.inverse_inertia.trace() * arm.squaredNorm() -
             arm.dot(body.inverse_inertia * arm);
    };
    add(bodies[c.a], c.arm_a);
    if (c.b >= 0) add(bodies[c.b], c.arm_b);
    return {along, std::max(along, all - along)};
  }

  void begin() {
    const auto n = static_cast<Eigen::Index>(6 * bodies.size());
    w.before.resize(n);
    double fastest = 0;
    for (size_t k = 0; k < bodies.size(); ++k) {
      w.before.segment<6>(static_cast<Eigen::Index>(6 * k)) = bodies[k].velocity;
      fastest = std::max(fastest, bodies[k].velocity.head<3>().norm());
    }
    for (ImpactContact& c : contacts) {
      c.impulse.setZero();
      c.arm_a = c.point - bodies[c.a].position;
      if (c.b >= 0) c.arm_b = c.point - bodies[c.b].position;
      const auto [normal, tangent] = mobility(c);
      c.normal_damping = 1 / normal;
      c.shear_damping = 1 / tangent;
      const Vec3 u = point_velocity(w.before, c);
      scale = std::max(scale, u.norm());
      c.approach = c.normal.dot(u);
      c.target = !c.is_bond && c.approach < -c.resting_speed
                     ? -c.fall.at(c.restitution, -c.approach) * c.approach
                     : 0;
      c.arm = c.arm.at_least(c.dent.arm_at(std::max(0.0, -c.approach)));
    }
    rounding = 1e-14 * fastest;
    list_turns();
  }

  void list_turns() {
    w.turns.clear();
    w.turn_of.clear();
    for (const ImpactContact& c : contacts) {
      if (c.b >= 0 || (c.arm.rolling == 0 && c.arm.spinning == 0)) continue;
      if (w.turn_of.empty()) w.turn_of.assign(bodies.size(), -1);
      int& at = w.turn_of[static_cast<size_t>(c.a)];
      if (at < 0) {
        at = static_cast<int>(w.turns.size());
        w.turns.push_back({});
        w.turns.back().body = c.a;
        w.turns.back().damping = 1 / bodies[static_cast<size_t>(c.a)].inverse_inertia.trace();
      }
      ImpactWork::Turn& turn = w.turns[static_cast<size_t>(at)];
      turn.lever = std::max(turn.lever, c.arm_a.norm());
    }
  }

  // Turn of a contact that bounds one; nullptr: it bounds none.
  [[nodiscard]] ImpactWork::Turn* turn_of(const ImpactContact& c) const {
    if (c.b >= 0 || w.turn_of.empty() || w.turn_of[static_cast<size_t>(c.a)] < 0) return nullptr;
    return &w.turns[static_cast<size_t>(w.turn_of[static_cast<size_t>(c.a)])];
  }

  // Couples at velocities v, whose contacts are evaluated: about the expected ones, within the
  // bounds from the normal impulses; in the convex form within the bounds that were expected.
  void add_couples(const Eigen::VectorXd& v) {
    for (ImpactWork::Turn& turn : w.turns) turn.bounds = {};
    for (const ImpactContact& c : contacts)
      if (ImpactWork::Turn* turn = turn_of(c))
        turn->bounds.add(c.arm, c.normal.dot(c.impulse), c.normal);
    for (ImpactWork::Turn& turn : w.turns) {
      const Vec3 spin = v.segment<3>(6 * turn.body + 3) - turn.expected / turn.damping;
      turn.law.damping = turn.damping;
      talus::evaluate(spin, is_convex ? turn.held : turn.bounds, turn.law);
      turn.couple = turn.law.couple;
      turn.tangent = tangent(turn.law);
      w.residual.segment<3>(6 * turn.body + 3) -= turn.couple;
    }
  }

  void add_couple_tangents() {
    for (const ImpactWork::Turn& turn : w.turns)
      w.matrix.diagonal[w.matrix.pattern.place[static_cast<size_t>(turn.body)]]
          .bottomRightCorner<3, 3>() += turn.tangent;
    if (is_convex) return;
    for (const ImpactContact& c : contacts) {
      const ImpactWork::Turn* turn = turn_of(c);
      if (turn == nullptr || !(c.normal.dot(c.impulse) > 0)) continue;
      const Vec3 by_velocity = c.tangent.transpose() * c.normal;  // -d p_n / d u
      Vec6 by_motion;
      by_motion << by_velocity, c.arm_a.cross(by_velocity);
      w.matrix.diagonal[w.matrix.pattern.place[static_cast<size_t>(c.a)]].bottomRows<3>() -=
          by_bound(turn->law, c.arm) * by_motion.transpose();
    }
  }

  // The law at velocity `u` of the contact's point: impulse and tangent.
  void evaluate(const Vec3& u, ImpactContact& c) const {
    const Vec3& n = c.normal;
    const Mat3 across = Mat3::Identity() - n * n.transpose();
    if (c.is_bond) {
      c.impulse =
          c.expected - c.normal_damping * u.dot(n) * n - c.shear_damping * (u - u.dot(n) * n);
      c.tangent = c.normal_damping * n * n.transpose() + c.shear_damping * across;
      return;
    }
    c.impulse.setZero();
    c.tangent.setZero();
    if (is_convex) return evaluate_convex(u, c);
    const double pressed = n.dot(c.expected) - c.normal_damping * (n.dot(u) - c.target);
    if (pressed <= 0) return;
    const Vec3 trial = across * (c.shear_damping * u - c.expected);
    const double size = trial.norm(), cap = c.friction * pressed;
    c.tangent = c.normal_damping * n * n.transpose();
    if (size <= cap) {
      c.impulse = pressed * n - trial;
      c.tangent += c.shear_damping * across;
      return;
    }
    const Vec3 direction = trial / size, side = n.cross(direction);
    c.impulse = pressed * n - cap * direction;
    c.tangent += (cap * c.shear_damping / size) * side * side.transpose() -
                 (c.friction * c.normal_damping) * direction * n.transpose();
  }

  // The same where the slip `c.slip` is taken as known (de Saxce): the impulse is the point of the
  // friction cone nearest to that of a damper which aims at a normal velocity higher by friction
  // times the slip.
  static void evaluate_convex(const Vec3& u, ImpactContact& c) {
    const Vec3& n = c.normal;
    const double D = c.shear_damping, mu = c.friction;
    const Vec3 pull = c.expected - D * (u + (mu * c.slip - c.target) * n);
    const double pressed = n.dot(pull);
    const Vec3 across = pull - pressed * n;
    const double size = across.norm();
    if (size <= mu * pressed) {
      c.impulse = pull;
      c.tangent = D * Mat3::Identity();
      return;
    }
    if (mu * size <= -pressed) return;
    const Vec3 direction = size > 0 ? Vec3(across / size) : Vec3(Vec3::Zero());
    const Vec3 ray = n + mu * direction, side = n.cross(direction);
    const double p_n = (pressed + mu * size) / (1 + mu * mu);
    c.impulse = p_n * ray;
    c.tangent = (D / (1 + mu * mu)) * ray * ray.transpose();
    if (size > 0) c.tangent += (D * mu * p_n / size) * side * side.transpose();
  }

  // M (v - v-) - sum J^T p per body, as a velocity: the largest.
  double balance(const Eigen::VectorXd& v) {
    ++passes;
    w.residual.resize(v.size());
    for (size_t k = 0; k < bodies.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(6 * k);
      const Vec6 dv = v.segment<6>(at) - w.before.segment<6>(at);
      w.residual.segment<3>(at) = dv.head<3>() / bodies[k].inverse_mass;
      w.residual.segment<3>(at + 3) = bodies[k].inertia * dv.tail<3>();
    }
    in_chunks(w.workers, contacts.size(), [&](size_t begin, size_t end) {
      for (ImpactContact& c : contacts.subspan(begin, end - begin))
        evaluate(point_velocity(v, c), c);
    });
    for (const ImpactContact& c : contacts) {
      w.residual.segment<3>(6 * c.a) -= c.impulse;
      w.residual.segment<3>(6 * c.a + 3) -= c.arm_a.cross(c.impulse);
      if (c.b < 0) continue;
      w.residual.segment<3>(6 * c.b) += c.impulse;
      w.residual.segment<3>(6 * c.b + 3) += c.arm_b.cross(c.impulse);
    }
    if (!w.turns.empty()) add_couples(v);
    double worst = 0;
    for (size_t k = 0; k < bodies.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(6 * k);
      const Vec3 r = w.residual.segment<3>(at), m = w.residual.segment<3>(at + 3);
      worst = std::max(
          worst, std::sqrt(bodies[k].inverse_mass * (bodies[k].inverse_mass * r.squaredNorm() +
                                                     m.dot(bodies[k].inverse_inertia * m))));
    }
    return worst;
  }

  // T(arm)^T K T(arm') of a contact's tangent.
  static Mat6 block(const Mat3& K, const Vec3& arm_left, const Vec3& arm_right) {
    const Mat3 left = cross_matrix(arm_left), right = cross_matrix(arm_right);
    Mat6 B;
    B << K, -K * right, left * K, -left * K * right;
    return B;
  }

  void find_pattern() {
    w.edges.clear();
    for (const ImpactContact& c : contacts)
      if (c.b >= 0) w.edges.emplace_back(std::min(c.a, c.b), std::max(c.a, c.b));
    std::sort(w.edges.begin(), w.edges.end());
    w.edges.erase(std::unique(w.edges.begin(), w.edges.end()), w.edges.end());
    analyse_pattern(static_cast<int>(bodies.size()), w.edges, w.matrix.pattern);
    w.blocks.resize(bodies.size());
  }

  void set_matrix() {
    clear_matrix(w.matrix);
    for (size_t k = 0; k < bodies.size(); ++k) {
      Mat6& M = w.matrix.diagonal[w.matrix.pattern.place[k]];
      M.topLeftCorner<3, 3>().diagonal().setConstant(1 / bodies[k].inverse_mass);
      M.bottomRightCorner<3, 3>() = bodies[k].inertia;
    }
    for (const ImpactContact& c : contacts) {
      if (c.tangent.isZero(0)) continue;
      const auto add = [&](int k, const Vec3& arm) {
        w.matrix.diagonal[w.matrix.pattern.place[k]] += block(c.tangent, arm, arm);
      };
      add(c.a, c.arm_a);
      if (c.b < 0) continue;
      add(c.b, c.arm_b);
      add_blocks<6>(w.matrix, c.a, c.b, -block(c.tangent, c.arm_a, c.arm_b),
                    -block(c.tangent, c.arm_b, c.arm_a));
    }
    if (!w.turns.empty()) add_couple_tangents();
  }

  // Newton's step from the residual of balance(); false where the matrix is singular.
  bool find_step() {
    set_matrix();
    factor(w.matrix);
    for (size_t k = 0; k < bodies.size(); ++k)
      w.blocks[k] = -w.residual.segment<6>(static_cast<Eigen::Index>(6 * k));
    talus::solve<6>(w.matrix, w.blocks, w.blocks);
    w.step.resize(w.residual.size());
    for (size_t k = 0; k < bodies.size(); ++k)
      w.step.segment<6>(static_cast<Eigen::Index>(6 * k)) = w.blocks[k];
    return w.step.allFinite();
  }

  // How far to go along Newton's step where slips are taken as known: the work of all is convex
  // then, and least where its slope along the step is zero. Leaves `tried` near there.
  double go_to_least() {
    constexpr double flat = 0.1;  // of the slope at the start
    const double steep = std::abs(w.residual.dot(w.step));
    double low = 0, high = 1, share = 1, error = 0;
    for (int cut = 0; cut < 20; ++cut) {
      w.tried = w.velocity + share * w.step;
      error = balance(w.tried);
      const double slope = w.residual.dot(w.step);
      if (std::abs(slope) <= flat * steep || (slope < 0 && share == 1)) break;
      (slope > 0 ? high : low) = share;
      share = (low + high) / 2;
    }
    return error;
  }

  // The same where friction follows the normal impulses: as far as the error falls.
  double go_on(int k, double error) {
    double share = 1, next = 0;
    for (int cut = 0; cut < 8; ++cut, share /= 2) {
      w.tried = w.velocity + share * w.step;
      next = balance(w.tried);
      if (k < law::free_steps || next < error) break;
    }
    return next;
  }

  // One round: the velocities that belong to the expected impulses.
  bool solve_round() {
    const double enough = tolerance * scale + rounding, nearly = loose_tolerance * scale + rounding;
    const int most = is_convex ? most_convex_steps : most_steps;
    double error = balance(w.velocity);
    for (int k = 0; k < most && error > enough; ++k) {
      if (!find_step()) return false;
      const double next = is_convex ? go_to_least() : go_on(k, error);
      if (next >= error / 2 && error <= 1e3 * enough) {  // no better, for rounding
        (void)balance(w.velocity);
        return true;
      }
      w.velocity.swap(w.tried);
      error = next;
    }
    return error <= nearly;
  }

  void scale_stiffness(double factor) {
    for (ImpactContact& c : contacts) c.normal_damping *= factor, c.shear_damping *= factor;
    for (ImpactWork::Turn& turn : w.turns) turn.damping *= factor;
  }

  // Couples found are those expected from now on, and so are their bounds.
  double renew_couples() {
    double gives = 0;
    for (ImpactWork::Turn& turn : w.turns) {
      gives = std::max(gives, turn.lever * (turn.couple - turn.expected).norm() / turn.damping);
      turn.expected = turn.couple;
      if (!is_convex) continue;
      const double missing = std::abs(turn.bounds.rolling - turn.held.rolling) +
                             std::abs(turn.bounds.spinning - turn.held.spinning);
      gives = std::max(gives, turn.lever * missing *
                                  bodies[static_cast<size_t>(turn.body)].inverse_inertia.trace());
      turn.held = turn.bounds;
    }
    return gives;
  }

  // Rounds until no contact yields any more, with ever stiffer contacts: sticking, sliding and
  // opening are found while they are soft. In the convex form slips are renewed with the impulses:
  // velocities do not depend on how contacts share impulses, so neither do they.
  bool solve_rounds() {
    begin_rounds();
    double gives = 0, last = std::numeric_limits<double>::infinity(), stiffness = first_stiffness;
    scale_stiffness(stiffness);
    for (int round = 0; round < (is_convex ? most_convex_rounds : most_rounds); ++round) {
      const bool solved = solve_round();
      if (!solved && !is_convex) {
        gives = scale;
        break;
      }
      gives = renew();
      if (solved && (gives <= last_figures * scale + rounding ||
                     (gives <= settled * scale && gives > last / 2)))
        break;
      last = gives;
      if (stiffness < stiffness_ratio) {
        stiffness *= 10;
        scale_stiffness(10);
        has_missing = false;
      }
    }
    scale_stiffness(1 / stiffness);
    return gives <= settled * scale + rounding;
  }

  // Impulses and slips found are those expected from now on: by how much they were not [m/s].
  double renew() {
    double gives = renew_couples(), along_change = 0, change = 0;
    for (ImpactContact& c : contacts) {
      const Vec3& n = c.normal;
      const Vec3 error = c.impulse - c.expected;
      const double along = n.dot(error), damping = is_convex ? c.shear_damping : c.normal_damping;
      gives = std::max(
          {gives, std::abs(along) / damping, (error - along * n).norm() / c.shear_damping});
      c.expected = c.impulse;
      if (!is_convex || c.is_bond) continue;
      const Vec3 u = point_velocity(w.velocity, c);
      const double slip = (u - n.dot(u) * n).norm(), missing = slip - c.slip;
      if (!c.impulse.isZero(0)) gives = std::max(gives, c.friction * std::abs(missing));
      const double turned = missing - c.missing_slip;
      along_change += c.missing_slip * turned;
      change += turned * turned;
      c.missing_slip = missing;
    }
    if (!is_convex) return gives;
    // Aitken: less where slips swing, more where they creep
    if (has_missing && change > 0)
      renewed = std::clamp(-renewed * along_change / change, 1 / most_renewed, most_renewed);
    has_missing = true;
    for (ImpactContact& c : contacts) c.slip = std::max(0.0, c.slip + renewed * c.missing_slip);
    return gives;
  }

  void begin_rounds() {
    w.velocity = w.before;
    for (ImpactContact& c : contacts) c.expected.setZero(), c.slip = 0;
    for (ImpactWork::Turn& turn : w.turns) {
      turn.expected.setZero();
      turn.held = {};
    }
    has_missing = false;
    renewed = 1;
  }

  // Newton's method with friction that follows the normal impulses is quick, and fails where many
  // contacts stick and slide. The convex form then finds which do. An unsettled result is nearly a
  // solution, and whatever its slips are it gains no energy without restitution (theory 1.12).
  bool solve() {
    find_pattern();
    for (const bool convex : {false, true}) {
      is_convex = convex;
      if (solve_rounds()) return true;
    }
    (void)balance(w.velocity);
    return false;
  }

  // From the impulses in the rows where contacts are few.
  bool solve_any() {
    if (contacts.size() <= FewContacts::most && w.turns.empty() &&
        solve_few(bodies, contacts, w.before, scale, w.few, passes))
      return true;
    return solve();
  }

  [[nodiscard]] double energy(const Eigen::VectorXd& v) const {
    double sum = 0;
    for (size_t k = 0; k < bodies.size(); ++k) {
      const Vec6 u = of(v, static_cast<int>(k));
      sum += u.head<3>().squaredNorm() / bodies[k].inverse_mass +
             u.tail<3>().dot(bodies[k].inertia * u.tail<3>());
    }
    return sum / 2;
  }

  [[nodiscard]] double work_of(const Eigen::VectorXd& v, const Eigen::VectorXd& u) const {
    double sum = 0;
    for (size_t k = 0; k < bodies.size(); ++k) {
      const Vec6 a = of(v, static_cast<int>(k)), b = of(u, static_cast<int>(k));
      sum += a.head<3>().dot(b.head<3>()) / bodies[k].inverse_mass +
             a.tail<3>().dot(bodies[k].inertia * b.tail<3>());
    }
    return sum;
  }

  // Velocities are those that the impulses give: momentum is kept to rounding, and energies are
  // those of the returned result.
  void take_impulses() {
    w.velocity = w.before;
    const auto add = [&](int k, const Vec3& arm, const Vec3& p) {
      const ImpactBody& body = bodies[k];
      w.velocity.segment<3>(6 * k) += body.inverse_mass * p;
      w.velocity.segment<3>(6 * k + 3) += body.inverse_inertia * arm.cross(p);
    };
    for (const ImpactContact& c : contacts) {
      add(c.a, c.arm_a, c.impulse);
      if (c.b >= 0) add(c.b, c.arm_b, -c.impulse);
    }
    for (const ImpactWork::Turn& turn : w.turns)
      w.velocity.segment<3>(6 * turn.body + 3) +=
          bodies[static_cast<size_t>(turn.body)].inverse_inertia * turn.couple;
  }

  // The largest share of the restitution that gains no energy.
  bool lower_restitution(Impact& out) {
    w.full = w.velocity;
    for (ImpactContact& c : contacts) c.full_impulse = c.impulse, c.target = 0;
    for (ImpactWork::Turn& turn : w.turns) turn.full_couple = turn.couple;
    const bool solved = solve_any();
    take_impulses();
    w.full -= w.velocity;
    const Eigen::VectorXd& gained = w.full;
    const double square = work_of(gained, gained) / 2;
    if (square <= 0) return solved;
    out.share =
        largest_share(square, work_of(w.velocity, gained), energy(w.velocity) - energy(w.before));
    w.velocity += out.share * gained;
    for (ImpactContact& c : contacts) c.impulse += out.share * (c.full_impulse - c.impulse);
    for (ImpactWork::Turn& turn : w.turns)
      turn.couple += out.share * (turn.full_couple - turn.couple);
    return solved;
  }
};

}  // namespace

double largest_share(double square, double linear, double constant) {
  const double discriminant = linear * linear - 4 * square * constant;
  return std::clamp((-linear + std::sqrt(std::max(0.0, discriminant))) / (2 * square), 0.0, 1.0);
}

Impact solve_impact(std::span<ImpactBody> bodies, std::span<ImpactContact> contacts,
                    ImpactWork& work) {
  Impact out;
  Solver solver{bodies, contacts, work};
  solver.begin();
  const double before = solver.energy(work.before);
  out.converged = solver.solve_any();
  solver.take_impulses();
  if (solver.energy(work.velocity) > (1 + last_figures) * before)
    out.converged = solver.lower_restitution(out) && out.converged;
  out.passes = solver.passes;
  if (!work.velocity.allFinite()) {
    out.converged = false;
    for (ImpactContact& c : contacts) c.impulse.setZero();
    return out;
  }
  for (size_t k = 0; k < bodies.size(); ++k)
    bodies[k].velocity = work.velocity.segment<6>(static_cast<Eigen::Index>(6 * k));
  out.dissipated = before - solver.energy(work.velocity);
  for (const ImpactContact& c : contacts) {
    const Vec3 mean = (point_velocity(work.before, c) + point_velocity(work.velocity, c)) / 2;
    out.by_friction -= (c.impulse - c.normal.dot(c.impulse) * c.normal).dot(mean);
  }
  for (const ImpactWork::Turn& turn : work.turns) {
    const Eigen::Index at = 6 * turn.body + 3;
    out.by_rolling -=
        turn.couple.dot(Vec3(work.before.segment<3>(at) + work.velocity.segment<3>(at)) / 2);
  }
  // many contacts that jam bodies may press them and each other arbitrarily: their total counts
  out.by_friction =
      std::clamp(out.by_friction, 0.0, std::max(0.0, out.dissipated - out.by_rolling));
  return out;
}

}  // namespace talus
