// Overlap of bodies against brute force.
#include <gtest/gtest.h>

#include "contact/body_overlap.hpp"
#include "many_parts.hpp"

using namespace talus;
using namespace talus::test;

// Against faces and all products of edges, pair of parts by pair.
TEST(BodyOverlap, IsTheLeastDisplacementOutOfAllParts) {
  Draws random(7);
  BodyOverlapScratch scratch;
  int n_other = 0, n_askew = 0;
  for (int trial = 0; trial < 1600; ++trial) {
    const Pressed pair = press_together(random, uniform(random, 0, 0.6));
    const std::vector<WaysOut> ways = ways_out_of_bodies(pair.bodies, 0, 1);
    double deepest = 0;  // of the parts alone: no displacement is less
    for (const WaysOut& way : ways)
      deepest = std::max(deepest, *std::min_element(way.h.begin(), way.h.end()));
    const double along_axes = least_path(ways);
    const bool is_bound = along_axes <= deepest + 1e-9;
    const double least = is_bound ? along_axes : least_displacement(ways, along_axes);
    const double found = body_overlap(pair.bodies.hulls, pair.bodies.placed, 0, 1, 0, scratch);
    EXPECT_NEAR(found, least, 1e-8) << "trial " << trial;
    n_other += least > 1.01 * deepest;
    n_askew += least < 0.99 * along_axes;
  }
  EXPECT_GT(n_other, 20) << "no pair in which the parts alone say something else";
  EXPECT_GT(n_askew, 5) << "no pair that is freed askew";
}

// A cube in the corner of a floor and a wall, 0.1 and 0.05 m in them: along an axis it would have
// to move to the end of one of the two.
TEST(BodyOverlap, InANotchLeadsOutOfBothFlanks) {
  Bodies bodies;
  add(bodies, box(Vec3(0, 0, 0), Vec3(1, 1, 1)), {Vec3(-0.1, 1, -0.05), Quat::Identity()});
  add(bodies, std::vector{box(Vec3(-1, 0, 0), Vec3(0, 3, 3)), box(Vec3(0, 0, -1), Vec3(3, 3, 0))},
      {Vec3::Zero(), Quat::Identity()});
  place(bodies);
  BodyOverlapScratch scratch;
  EXPECT_NEAR(body_overlap(bodies.hulls, bodies.placed, 0, 1, 0, scratch), std::hypot(0.1, 0.05),
              1e-12);
}

TEST(BodyOverlap, OfBodiesApartIsNone) {
  Draws random(8);
  BodyOverlapScratch scratch;
  for (int trial = 0; trial < 50; ++trial) {
    Pressed pair = press_together(random, 0);
    pair.bodies.poses[0].position += 10 * Vec3::UnitX();
    place(pair.bodies);
    EXPECT_EQ(body_overlap(pair.bodies.hulls, pair.bodies.placed, 0, 1, 0, scratch), 0);
  }
}

// Convex bodies, and bodies of several parts, each second.
TEST(BodyOverlap, WhatIsIgnoredIsAtMostThatDeep) {
  Draws random(9);
  BodyOverlapScratch scratch;
  int n_left_out = 0, n_found = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Bodies bodies;
    if (trial % 2 == 0) {
      for (int i = 0; i < 2; ++i) {
        const Polyhedron body = convex_body(random, Vec3(0.5, 0.7, 0.9), 2);
        const double away = uniform(random, 0.3, 0.6) * i;
        add(bodies, body, {away * direction(random), attitude(random)});
      }
      place(bodies);
    } else {
      bodies = press_together(random, uniform(random, 0, 0.6)).bodies;
    }
    const auto overlap = [&](double ignored) {
      return body_overlap(bodies.hulls, bodies.placed, 0, 1, ignored, scratch);
    };
    const double all = overlap(0), ignored = uniform(random, 0, 1.2) * all;
    const double found = overlap(ignored);
    if (all > ignored) {
      EXPECT_EQ(found, all) << "trial " << trial;
    }
    EXPECT_TRUE(found == all || found == 0) << "trial " << trial;
    n_left_out += all > 0 && found == 0;
    n_found += all > 0 && found == all;
  }
  EXPECT_GT(n_left_out, 10);
  EXPECT_GT(n_found, 100);
}
