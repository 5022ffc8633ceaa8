// The impact law for few contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/random.hpp"
#include "solver/impact_few.hpp"

namespace {

using namespace talus;

Vec3 random_vector(Random& random, double size) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = random.uniform(-size, size);
  return v;
}

// Two boxes, the upper one on the lower one or, with `grounded`, one box on the ground.
struct Landing {
  std::vector<ImpactBody> bodies;
  std::vector<ImpactContact> contacts;
  Eigen::VectorXd before;

  Landing(Random& random, int n_contacts, bool grounded) {
    for (int k = 0; k < (grounded ? 1 : 2); ++k) {
      ImpactBody body;
      body.inverse_mass = random.uniform(0.2, 2);
      const Vec3 moments = Vec3::Constant(random.uniform(0.1, 1)) + random_vector(random, 0.05);
      body.inertia = moments.asDiagonal();
      body.inverse_inertia = moments.cwiseInverse().asDiagonal();
      body.position = Vec3(0, 0, k == 0 ? 0.5 : -0.5);
      body.velocity << Vec3(0, 0, k == 0 ? -2 : 1) + random_vector(random, 1),
          random_vector(random, 1);
      bodies.push_back(body);
    }
    before.resize(static_cast<Eigen::Index>(6 * bodies.size()));
    for (std::size_t k = 0; k < bodies.size(); ++k)
      before.segment<6>(static_cast<Eigen::Index>(6 * k)) = bodies[k].velocity;
    for (int i = 0; i < n_contacts; ++i) {
      ImpactContact c;
      c.b = grounded ? -1 : 1;
      c.normal = (Vec3(0, 0, 1) + random_vector(random, 0.1)).normalized();
      c.point =
          Vec3(i % 2 == 0 ? 0.5 : -0.5, i % 4 < 2 ? 0.5 : -0.5, 0) + random_vector(random, 0.1);
      c.friction = random.uniform(0, 0.8);
      c.arm_a = c.point - bodies[0].position;
      if (!grounded) c.arm_b = c.point - bodies[1].position;
      c.target = random.uniform(0, 0.5);
      contacts.push_back(c);
    }
  }

  // Velocity of contact i's point after the impulses.
  [[nodiscard]] Vec3 after(std::size_t i) const {
    const auto of = [&](std::size_t k, double sign) -> Vec3 {
      const ImpactBody& body = bodies[k];
      Vec3 v = body.velocity.head<3>(), spin = body.velocity.tail<3>();
      for (std::size_t j = 0; j < contacts.size(); ++j) {
        const Vec3 p = sign * contacts[j].impulse;
        v += body.inverse_mass * p;
        spin += body.inverse_inertia * (contacts[j].point - body.position).cross(p);
      }
      return v + spin.cross(contacts[i].point - body.position);
    };
    return bodies.size() == 1 ? of(0, 1) : Vec3(of(0, 1) - of(1, -1));
  }
};

// A result fulfils the law: no point comes slower than asked for, open contacts carry nothing, slip
// is against its friction; and most problems have a result, also where more contacts share a load
// than there are degrees of freedom.
TEST(SolveFew, WhatIsFoundIsTheLaw) {
  Random random(3);
  FewContacts few;
  int n_found = 0, n_open = 0, n_slide = 0, n_stick = 0;
  constexpr int n_tried = 400;
  for (int k = 0; k < n_tried; ++k) {
    Landing landing(random, 1 + k % 8, k % 2 == 0);
    int passes = 0;
    const bool found = solve_few(landing.bodies, landing.contacts, landing.before, 3, few, passes);
    EXPECT_GT(passes, 0);
    n_found += found;
    for (std::size_t i = 0; i < landing.contacts.size(); ++i) {
      const Vec3& p = landing.contacts[i].impulse;
      if (!found) {
        EXPECT_TRUE(p.isZero(0));
        continue;
      }
      const Vec3& n = landing.contacts[i].normal;
      const Vec3 u = landing.after(i);
      const double p_n = n.dot(p), cap = landing.contacts[i].friction * p_n;
      const Vec3 p_t = p - p_n * n, slip = u - n.dot(u) * n;
      EXPECT_GE(n.dot(u), landing.contacts[i].target - 1e-10);
      EXPECT_GE(p_n, -1e-11);
      EXPECT_LE(p_t.norm(), cap + 1e-10);
      if (p_n < 1e-9) {
        ++n_open;
        continue;
      }
      EXPECT_NEAR(n.dot(u), landing.contacts[i].target, 1e-10);
      const bool slides = slip.norm() > 1e-6;
      ++(slides ? n_slide : n_stick);
      if (!slides) continue;
      EXPECT_LT((p_t + cap * slip.normalized()).norm(), 1e-6);
    }
  }
  EXPECT_GT(n_found, n_tried / 2) << "three in four are found";
  for (const int n : {n_open, n_slide, n_stick}) EXPECT_GT(n, 50);
}

// Four corners of a cube that falls flat without friction share its momentum evenly.
TEST(SolveFew, CornersOfAFlatFaceShareTheLoad) {
  Random random(4);
  FewContacts few;
  Landing landing(random, 4, true);
  landing.bodies[0].velocity << 0, 0, -2, 0, 0, 0;
  landing.before = landing.bodies[0].velocity;
  for (std::size_t i = 0; i < 4; ++i) {
    ImpactContact& c = landing.contacts[i];
    c.normal = Vec3::UnitZ();
    c.point = Vec3(i % 2 == 0 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5, 0);
    c.friction = 0;
    landing.contacts[i].arm_a = c.point - landing.bodies[0].position;
    landing.contacts[i].target = 1;
  }
  int passes = 0;
  ASSERT_TRUE(solve_few(landing.bodies, landing.contacts, landing.before, 2, few, passes));
  for (const ImpactContact& c : landing.contacts)
    EXPECT_NEAR(c.impulse.z(), 3 / landing.bodies[0].inverse_mass / 4, 1e-6);
}

}  // namespace
