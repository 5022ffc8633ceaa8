// tests/unit/contact/many_parts.hpp
// Random pairs of bodies of several parts that overlap, and where their contacts take them.
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "body_overlap.hpp"
#include "contact/block_pairs.hpp"
#include "convex_bodies.hpp"

namespace talus::test {

// A convex body cut into parts by random planes, one after the other through a random part; of some
// bodies a part is left out, so that they are not convex.
inline std::vector<Polyhedron> parts_of_a_body(Draws& random) {
  Vec3 half;
  for (const int axis : {2, 1, 0}) half[axis] = uniform(random, 0.4, 1);
  std::vector<Polyhedron> parts = {convex_body(random, half, static_cast<int>(random() % 3))};
  const std::size_t n = 2 + random() % 3;
  for (int trial = 0; parts.size() < n && trial < 20; ++trial) {
    const std::size_t which = random() % parts.size();
    Vec3 centre = Vec3::Zero();
    for (const Vec3& v : parts[which].vertices) centre += v;
    centre /= static_cast<double>(parts[which].vertices.size());
    const Vec3 normal = random() % 2 ? direction(random) : Vec3(Vec3::Unit(random() % 3));
    const Plane plane{normal, normal.dot(centre) + uniform(random, -0.1, 0.1)};
    const Polyhedron one = clip_convex(parts[which], plane, 0, 1e-6);
    const Polyhedron two = clip_convex(parts[which], {-normal, -plane.offset}, 0, 1e-6);
    if (n_faces(one) < 4 || n_faces(two) < 4) continue;
    parts[which] = one;
    parts.push_back(two);
  }
  if (parts.size() > 2 && random() % 2) parts.erase(parts.begin() + random() % parts.size());
  return parts;
}

/// Two bodies that overlap by at most `share` of the thinnest part, along a random direction.
struct Pressed {
  Bodies bodies;
  double thickness = std::numeric_limits<double>::infinity();
  double path = 0;  ///< back against their pressing, out of all parts [m]
};

inline Pressed press_together(Draws& random, double share) {
  Pressed pair;
  for (int i = 0; i < 2; ++i) {
    const std::vector<Polyhedron> parts = parts_of_a_body(random);
    add(pair.bodies, parts,
        {i == 0 ? Vec3(0.3 * direction(random)) : Vec3::Zero(),
         random() % 4 ? attitude(random) : Quat::Identity()});
  }
  for (const double t : pair.bodies.hulls.thickness) pair.thickness = std::min(pair.thickness, t);
  place(pair.bodies);
  const Vec3 away = random() % 4 ? direction(random) : Vec3(Vec3::Unit(random() % 3));
  const double out = path_along(ways_out_of_bodies(pair.bodies, 0, 1), away);
  pair.bodies.poses[0].position += (out - share * pair.thickness) * away;
  place(pair.bodies);
  pair.path = share * pair.thickness;
  return pair;
}

/// A contact that is in.
struct Push {
  Vec3 normal;
  double depth;
};

inline std::vector<Push> pushes(const Bodies& bodies) {
  PairState state;
  PairWork work;
  PlacedHulls placed = bodies.placed;
  (void)find_pair_contacts(bodies.hulls, placed, {}, {}, state, work);
  std::vector<Push> list;
  for (const PairManifold& m : work.manifolds)
    for (int k = m.point_begin; k < m.point_end; ++k) {
      const double gap = work.points[static_cast<std::size_t>(k)].gap;
      if (gap < 0) list.push_back({m.normal, -gap});
    }
  return list;
}

inline double deepest(const std::vector<Push>& list) {
  double depth = 0;
  for (const Push& push : list) depth = std::max(depth, push.depth);
  return depth;
}

// The smallest motion that all contacts give together: the direction of their forces' sum.
inline Vec3 motion_of(const std::vector<Push>& list) {
  Vec3 motion = Vec3::Zero();
  std::vector<double> force(list.size(), 0);
  for (int sweep = 0; sweep < 300; ++sweep)
    for (std::size_t k = 0; k < list.size(); ++k) {
      const double next = std::max(0.0, force[k] + list[k].depth - list[k].normal.dot(motion));
      motion += (next - force[k]) * list[k].normal;
      force[k] = next;
    }
  return motion;
}

/// Where the contacts take the first body.
struct Followed {
  double path = 0;  ///< of all motions [m]
  double left = 0;  ///< overlap at the end [m]
};

inline Followed follow_contacts(Bodies bodies) {
  Followed followed;
  Vec3 path = Vec3::Zero();
  for (int round = 0; round < 20; ++round) {
    const Vec3 motion = motion_of(pushes(bodies));
    path += motion;
    bodies.poses[0].position += motion;
    place(bodies);
  }
  followed.path = path.norm();
  followed.left = least_path(ways_out_of_bodies(bodies, 0, 1));
  return followed;
}

// Whatever the parts and poses: bodies that overlap have a contact that is in, and their contacts
// together push along the least path that frees the bodies, not one that frees two parts. In
// corners the next best path may be a quarter longer: of how many of `n_pairs`.
inline int follow_pairs(int n_pairs) {
  Draws random(71);
  int n = 0, n_longer = 0;
  for (int k = 0; k < n_pairs; ++k) {
    const double share = std::array{0.1, 0.03, 0.01, 1e-3}[static_cast<std::size_t>(k % 4)];
    const Pressed pair = press_together(random, share);
    const double least = std::min(pair.path, least_path(ways_out_of_bodies(pair.bodies, 0, 1)));
    const double bar = 2e-3 * pair.thickness;
    if (pair.thickness < 0.05 || least < 1e-5 * pair.thickness) continue;
    ++n;
    EXPECT_GT(deepest(pushes(pair.bodies)), 0.1 * least) << k;
    const Followed followed = follow_contacts(pair.bodies);
    EXPECT_LE(followed.path, 1.25 * least + bar) << k << ", least " << least;
    EXPECT_LE(followed.left, 1e-3 * least) << k << ", least " << least;
    n_longer += followed.path > 1.1 * least + bar;
  }
  EXPECT_GT(n, 0.99 * n_pairs);
  return n_longer;
}

}  // namespace talus::test
