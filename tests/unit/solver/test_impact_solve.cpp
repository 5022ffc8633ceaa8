// The impact law: restitution, momentum, energy, dents.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "solver/impact_solve.hpp"

namespace {

using namespace talus;

// A box of density 1 at `position`.
ImpactBody box_body(const Vec3& size, const Vec3& position, const Vec3& velocity,
                    const Vec3& spin = Vec3::Zero()) {
  ImpactBody body;
  const double mass = size.prod();
  const Vec3 sq = size.cwiseAbs2();
  const Vec3 moments = mass / 12 * Vec3(sq.y() + sq.z(), sq.x() + sq.z(), sq.x() + sq.y());
  body.inverse_mass = 1 / mass;
  body.inertia = moments.asDiagonal();
  body.inverse_inertia = moments.cwiseInverse().asDiagonal();
  body.position = position;
  body.velocity << velocity, spin;
  return body;
}

ImpactContact contact(int a, int b, const Vec3& normal, const Vec3& point, double restitution,
                      double friction = 0) {
  ImpactContact c;
  c.a = a;
  c.b = b;
  c.normal = normal.normalized();
  c.point = point;
  c.restitution = restitution;
  c.friction = friction;
  return c;
}

double energy(const std::vector<ImpactBody>& bodies) {
  double sum = 0;
  for (const ImpactBody& b : bodies) {
    const Vec3 v = b.velocity.head<3>(), w = b.velocity.tail<3>();
    sum += v.squaredNorm() / b.inverse_mass / 2 + w.dot(b.inertia * w) / 2;
  }
  return sum;
}

Vec3 momentum(const std::vector<ImpactBody>& bodies) {
  Vec3 sum = Vec3::Zero();
  for (const ImpactBody& b : bodies) sum += b.velocity.head<3>() / b.inverse_mass;
  return sum;
}

Vec3 angular_momentum(const std::vector<ImpactBody>& bodies) {
  Vec3 sum = Vec3::Zero();
  for (const ImpactBody& b : bodies)
    sum +=
        b.position.cross(b.velocity.head<3>()) / b.inverse_mass + b.inertia * b.velocity.tail<3>();
  return sum;
}

// Velocity of A's point relative to B's.
Vec3 at(const std::vector<ImpactBody>& bodies, const ImpactContact& c) {
  const auto of = [&](int k) -> Vec3 {
    const ImpactBody& body = bodies[k];
    return body.velocity.head<3>() + body.velocity.tail<3>().cross(c.point - body.position);
  };
  return c.b < 0 ? of(c.a) : Vec3(of(c.a) - of(c.b));
}

Vec3 random_vector(Random& random, double size) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = random.uniform(-size, size);
  return v;
}

// Spinning boxes that meet at one point return their restitution to rounding.
TEST(SolveImpact, OneContactReturnsItsRestitution) {
  Random random(1);
  ImpactWork work;
  for (int i = 0; i < 300; ++i) {
    const double e = random.uniform();
    std::vector<ImpactBody> bodies{
        box_body(Vec3::Ones() + random_vector(random, 0.5), Vec3(0, 0, 1), random_vector(random, 5),
                 random_vector(random, 15)),
        box_body(Vec3::Ones() + random_vector(random, 0.5), Vec3::Zero(), random_vector(random, 5),
                 random_vector(random, 15))};
    std::vector<ImpactContact> contacts{contact(0, 1, Vec3(0, 0, 1) + random_vector(random, 0.5),
                                                Vec3(0, 0, 0.5) + random_vector(random, 0.5), e)};
    const double before = contacts[0].normal.dot(at(bodies, contacts[0]));
    if (before > -0.1) continue;
    const double energy_before = energy(bodies);
    const Impact impact = solve_impact(bodies, contacts, work);
    EXPECT_TRUE(impact.converged);
    EXPECT_NEAR(contacts[0].normal.dot(at(bodies, contacts[0])), -e * before, 1e-10);
    EXPECT_NEAR(impact.dissipated, (1 - e * e) / 2 * contacts[0].impulse.norm() * -before / (1 + e),
                1e-9 * energy_before);
  }
}

// The k-th of a column that meets a body below. Drawn one by one: arguments have no order.
ImpactBody random_box(Random& random, int k) {
  const Vec3 spin = random_vector(random, 3);
  const Vec3 velocity = Vec3(0, 0, -2.0 * k) + random_vector(random, 1);
  const Vec3 size = Vec3::Ones() + random_vector(random, 0.4);
  return box_body(size, Vec3(0, 0, k), velocity, spin);
}

// Any contacts with any restitutions and friction: no energy is gained, nothing approaches
// afterwards, impulses are in their cones, momenta are kept.
TEST(SolveImpact, KeepsWhatMustBeKept) {
  Random random(2);
  ImpactWork work;
  int n_lowered = 0, n_unsettled = 0, n_unsettled_small = 0;
  for (int i = 0; i < 400; ++i) {
    const int n = 2 + i % 7;
    std::vector<ImpactBody> bodies;
    for (int k = 0; k < n; ++k) bodies.push_back(random_box(random, k));
    std::vector<ImpactContact> contacts;
    for (int k = 1; k < n; ++k)
      for (int j = 0; j < 1 + i % 4; ++j) {
        const double friction = random.uniform(0, 1.2);
        const double restitution = i % 4 == 3 ? 1 : random.uniform();
        const Vec3 point = Vec3(0, 0, k - 0.5) + random_vector(random, 0.4);
        const Vec3 normal = Vec3(0, 0, 1) + random_vector(random, 0.1);
        const ImpactContact c = contact(k, k - 1, normal, point, restitution, friction);
        if (c.normal.dot(at(bodies, c)) < 0) contacts.push_back(c);
      }
    const double before = energy(bodies);
    const Vec3 p = momentum(bodies), L = angular_momentum(bodies);
    const Impact impact = solve_impact(bodies, contacts, work);
    n_unsettled += !impact.converged;
    n_unsettled_small += !impact.converged && n <= 4;
    EXPECT_LE(energy(bodies) / before - 1, 1e-11) << i << " " << impact.share;
    EXPECT_NEAR(impact.dissipated, before - energy(bodies), 1e-9 * before) << i;
    EXPECT_LT((momentum(bodies) - p).norm(), 1e-12) << i;
    EXPECT_LT((angular_momentum(bodies) - L).norm(), 1e-11) << i;
    n_lowered += impact.share < 1;
    for (const ImpactContact& c : contacts) {
      const double p_n = c.normal.dot(c.impulse);
      EXPECT_GE(p_n, -1e-12) << i;
      EXPECT_LE((c.impulse - p_n * c.normal).norm(), c.friction * p_n + 1e-8) << i;
      EXPECT_GE(c.normal.dot(at(bodies, c)), -1e-8) << i;
    }
  }
  EXPECT_GT(n_lowered, 0);
  // with up to 28 contacts and friction up to 50 degrees; those keep all of the above
  EXPECT_EQ(n_unsettled_small, 0);
  EXPECT_LE(n_unsettled, 4);
}

// A plate that lands flat on a slope, with friction, does not begin to turn; whatever the order of
// its corners.
// A ball that rolls and hits yielding ground: friction holds its point, so the couple
// arm p_n takes (arm / R) p_n / (m + I / R^2) of its speed.
struct RollingBall {
  static constexpr double m = 780, radius = 0.41, e = 0.5;
  GroundClass ground;
  ImpactWork work;
  double speed = 8;

  explicit RollingBall(double strength) { ground.bearing = strength; }

  void hit(double approach) {
    std::vector<ImpactBody> bodies(1);
    bodies[0].inverse_mass = 1 / m;
    bodies[0].inertia = 0.4 * m * radius * radius * Mat3::Identity();
    bodies[0].inverse_inertia = bodies[0].inertia.inverse();
    bodies[0].velocity << speed, 0, -approach, 0, speed / radius, 0;
    std::vector<ImpactContact> contacts = {
        contact(0, -1, Vec3::UnitZ(), Vec3(0, 0, -radius), e, 0.8)};
    contacts[0].dent = dent_in(ground, m, radius);
    const Impact impact = solve_impact(bodies, contacts, work);
    EXPECT_TRUE(impact.converged);
    EXPECT_GT(impact.by_rolling, 0);
    EXPECT_NEAR(bodies[0].velocity[2], e * approach, 1e-9);
    speed = bodies[0].velocity[0];
    EXPECT_NEAR(bodies[0].velocity[4], speed / radius, 1e-6);
  }
};

TEST(SolveImpact, ADentTakesItsShareOfARoll) {
  for (const double approach : {0.5, 2.0, 6.0}) {
    RollingBall ball(3e6);
    ball.hit(approach);
    const double arm = dent_in(ball.ground, ball.m, ball.radius).arm_at(approach);
    EXPECT_NEAR(8 - ball.speed, 5.0 / 7 * arm / ball.radius * (1 + ball.e) * approach, 1e-6);
  }
}

// Over the rebounds of a fall the losses are a geometric series: each approach is e of the last,
// and an arm goes with the root of it.
TEST(SolveImpact, DentsOfAllReboundsAddUp) {
  RollingBall ball(3e6);
  const double first = 5, arm = dent_in(ball.ground, ball.m, ball.radius).arm_at(first);
  for (double approach = first; approach > 1e-6; approach *= ball.e) ball.hit(approach);
  EXPECT_NEAR(8 - ball.speed,
              5.0 / 7 * arm / ball.radius * (1 + ball.e) * first / (1 - std::pow(ball.e, 1.5)),
              1e-6);
}

TEST(SolveImpact, AFlatLandingStaysFlat) {
  ImpactWork work;
  for (const double slip : {0.3, 3.0}) {
    std::vector<ImpactBody> bodies{box_body(Vec3(2, 1, 0.3), Vec3(0, 0, 0.15), Vec3(slip, 0, -5))};
    std::vector<ImpactContact> contacts;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-0.5, 0.5})
        contacts.push_back(contact(0, -1, Vec3(0, 0, 1), Vec3(x, y, 0), 0.8, std::tan(0.436)));
    std::vector<ImpactBody> reversed = bodies;
    EXPECT_TRUE(solve_impact(bodies, contacts, work).converged);
    EXPECT_NEAR(bodies[0].velocity[2], 4, 1e-11);
    EXPECT_LT(bodies[0].velocity.tail<3>().norm(), 1e-11) << slip;
    std::reverse(contacts.begin(), contacts.end());
    EXPECT_TRUE(solve_impact(reversed, contacts, work).converged);
    EXPECT_LT((reversed[0].velocity - bodies[0].velocity).norm(), 1e-11);
  }
}

// A beam that falls flat on two cubes leaves them alike.
TEST(SolveImpact, HitsOfOneTimeAreSymmetric) {
  ImpactWork work;
  std::vector<ImpactBody> bodies{box_body(Vec3(4, 1, 0.5), Vec3(0, 0, 1.25), Vec3(0, 0, -5)),
                                 box_body(Vec3::Ones(), Vec3(-1, 0, 0.5), Vec3::Zero()),
                                 box_body(Vec3::Ones(), Vec3(1, 0, 0.5), Vec3::Zero())};
  std::vector<ImpactContact> contacts;
  for (const int b : {1, 2})
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        contacts.push_back(contact(0, b, Vec3(0, 0, 1), Vec3((b == 1 ? -1 : 1) + x, y, 1), 0.7));
  EXPECT_TRUE(solve_impact(bodies, contacts, work).converged);
  EXPECT_NEAR(bodies[1].velocity[2], bodies[2].velocity[2], 1e-11);
  EXPECT_LT(bodies[0].velocity.tail<3>().norm(), 1e-11);
  EXPECT_NEAR(bodies[0].velocity[2] - bodies[1].velocity[2], 0.7 * 5, 1e-10);
}

// Bonded bodies are hit as one.
TEST(SolveImpact, BondsHoldThroughTheHit) {
  ImpactWork work;
  std::vector<ImpactBody> bodies{box_body(Vec3::Ones(), Vec3(0, 0, 0.5), Vec3(0, 0, -4)),
                                 box_body(Vec3::Ones(), Vec3(0, 0, 1.5), Vec3(0, 0, -4))};
  std::vector<ImpactContact> contacts;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      contacts.push_back(contact(0, -1, Vec3(0, 0, 1), Vec3(x, y, 0), 0.5));
      contacts.push_back(contact(1, 0, Vec3(0, 0, 1), Vec3(x, y, 1), 0.9));
      contacts.back().is_bond = true;
    }
  EXPECT_TRUE(solve_impact(bodies, contacts, work).converged);
  EXPECT_NEAR(bodies[0].velocity[2], 2, 1e-9);
  EXPECT_NEAR(bodies[1].velocity[2], 2, 1e-9);
}

// Many bodies hit at one time: the matrix is sparse, the answer the same law, and the same bits in
// several threads.
TEST(SolveImpact, LargeGroupsKeepWhatMustBeKept) {
  Random random(3);
  ImpactWork work;
  std::vector<ImpactBody> bodies;
  std::vector<ImpactContact> contacts;
  const int n = 40;
  for (int k = 0; k < n; ++k)
    bodies.push_back(box_body(Vec3::Ones(), Vec3(0, 0, k + 0.5), Vec3(0, 0, -0.1 * k),
                              random_vector(random, 0.02)));
  for (int k = 1; k < n; ++k)
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        contacts.push_back(contact(k, k - 1, Vec3(0, 0, 1), Vec3(x, y, k), 0.5, 0.5));
  const double before = energy(bodies);
  const std::vector<ImpactBody> bodies_before = bodies;
  const std::vector<ImpactContact> contacts_before = contacts;
  EXPECT_TRUE(solve_impact(bodies, contacts, work).converged);
  EXPECT_LT(energy(bodies), before);
  for (const ImpactContact& c : contacts) EXPECT_GE(c.normal.dot(at(bodies, c)), -1e-9);
  for (const int n_threads : {2, 3}) {
    Workers workers(n_threads);
    ImpactWork shared_work;
    shared_work.workers = &workers;
    std::vector<ImpactBody> shared = bodies_before;
    std::vector<ImpactContact> shared_contacts = contacts_before;
    EXPECT_TRUE(solve_impact(shared, shared_contacts, shared_work).converged);
    for (int k = 0; k < n; ++k) EXPECT_EQ(shared[k].velocity, bodies[k].velocity) << k;
  }
}

}  // namespace
