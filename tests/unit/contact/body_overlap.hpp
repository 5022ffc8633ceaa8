// tests/unit/contact/body_overlap.hpp
// Displacements that free two bodies of several convex parts, by brute force, independent of
// contacts. Out of one part may be into the next, so paths and displacements count only where they
// leave all of them.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "convex_bodies.hpp"

namespace talus::test {

/// A part of A is out of a part of B once A has moved by x with u . x >= h for one of these.
struct WaysOut {
  std::vector<Vec3> u;        ///< unit
  std::vector<double> h;      ///< [m]
  std::vector<bool> is_face;  ///< of the surface that bounds all x at which the parts overlap
};

/// Do parts meet in more than a line along `u`, which leads out of B? Their corners farthest in
/// that direction, within 1e-12 m, then span a plane.
inline bool meet_in_face(const Hulls& hulls, const PlacedHulls& placed, int a, int b, const Vec3& u,
                         double h) {
  std::vector<Vec3> list;
  double low_a = std::numeric_limits<double>::infinity();
  for (int v = hulls.vertex_begin[a]; v < hulls.vertex_begin[a + 1]; ++v)
    low_a = std::min(low_a, u.dot(placed.vertices[v]));
  for (const auto& [part, level] : {std::pair{a, low_a}, std::pair{b, low_a + h}}) {
    const Vec3* first = nullptr;
    for (int v = hulls.vertex_begin[part]; v < hulls.vertex_begin[part + 1]; ++v) {
      const Vec3& x = placed.vertices[v];
      if (std::abs(u.dot(x) - level) > 1e-12) continue;
      if (first != nullptr) list.push_back(x - *first);
      if (first == nullptr) first = &x;
    }
    if (first == nullptr) return false;
  }
  for (const Vec3& one : list)
    for (const Vec3& two : list)
      if (one.cross(two).norm() > 1e-9) return true;
  return false;
}

/// Faces, and all products of edges of both signs.
inline WaysOut ways_out(const Hulls& hulls, const PlacedHulls& placed, int a, int b) {
  WaysOut ways;
  const auto add_way = [&](const Vec3& n, bool is_face) {
    const double h = -separation_along(hulls, placed, a, b, n);
    ways.u.push_back(n);
    ways.h.push_back(h);
    ways.is_face.push_back(is_face || meet_in_face(hulls, placed, a, b, n, h));
  };
  for (int f = 0; f < hulls.n_faces[a]; ++f)
    add_way(-normal_at(placed, hulls.face_begin[a] + f), true);
  for (int f = 0; f < hulls.n_faces[b]; ++f)
    add_way(normal_at(placed, hulls.face_begin[b] + f), true);
  const auto directions = [&](int p) {
    std::vector<Vec3> list;
    for (int e = hulls.edge_begin[p]; e < hulls.edge_begin[p + 1]; ++e) {
      const Vec3 along = (placed.vertices[hulls.vertex_begin[p] + hulls.edges[e].b] -
                          placed.vertices[hulls.vertex_begin[p] + hulls.edges[e].a])
                             .normalized();
      bool known = false;
      for (const Vec3& other : list) known |= std::abs(other.dot(along)) > 1 - 1e-12;
      if (!known) list.push_back(along);
    }
    return list;
  };
  for (const Vec3& u : directions(a))
    for (const Vec3& v : directions(b)) {
      const Vec3 n = u.cross(v);
      if (n.norm() < 1e-9) continue;
      add_way(n.normalized(), false);
      add_way(-n.normalized(), false);
    }
  return ways;
}

inline std::vector<WaysOut> ways_out_of_bodies(const Bodies& bodies, int body_a, int body_b) {
  std::vector<WaysOut> list;
  const Hulls& hulls = bodies.hulls;
  for (int a = hulls.part_begin[body_a]; a < hulls.part_begin[body_a + 1]; ++a)
    for (int b = hulls.part_begin[body_b]; b < hulls.part_begin[body_b + 1]; ++b)
      list.push_back(ways_out(hulls, bodies.placed, a, b));
  return list;
}

/// How far A moves along `direction` until it is out of all of B, past all parts on the path.
inline double path_along(const std::vector<WaysOut>& pairs, const Vec3& direction) {
  double at = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (const WaysOut& ways : pairs) {
      double begin = -infinity, end = infinity;
      for (std::size_t k = 0; k < ways.u.size(); ++k) {
        const double rate = ways.u[k].dot(direction);
        if (rate > 1e-12)
          end = std::min(end, ways.h[k] / rate);
        else if (rate < -1e-12)
          begin = std::max(begin, ways.h[k] / rate);
        else if (ways.h[k] <= 0)
          begin = infinity;
      }
      if (begin > at + 1e-12 || !(end > at + 1e-12) || begin >= end) continue;
      at = end;
      moved = true;
    }
  }
  return at;
}

/// The least path out of those along the axes of parts that overlap; 0: none do. Any axis may lead
/// it: a path may leave through another face, before its own axis' depth.
inline double least_path(const std::vector<WaysOut>& pairs) {
  double least = std::numeric_limits<double>::infinity();
  bool overlap = false;
  for (const WaysOut& ways : pairs) {
    if (*std::min_element(ways.h.begin(), ways.h.end()) <= 0) continue;
    overlap = true;
    for (std::size_t k = 0; k < ways.u.size(); ++k)
      if (ways.is_face[k]) least = std::min(least, path_along(pairs, ways.u[k]));
  }
  return overlap ? least : 0;
}

/// Is A out of all parts of B once it has moved by x?
inline bool is_out(const std::vector<WaysOut>& pairs, const Vec3& x) {
  return std::all_of(pairs.begin(), pairs.end(), [&x](const WaysOut& ways) {
    for (std::size_t k = 0; k < ways.u.size(); ++k)
      if (ways.u[k].dot(x) >= ways.h[k] - 1e-9) return true;
    return false;
  });
}

/// The least displacement in any direction: it ends on one, two or three planes of faces. All of
/// these ends are tried that are nearer than `least`.
inline double least_displacement(const std::vector<WaysOut>& pairs, double least) {
  std::vector<Vec3> u;
  std::vector<double> h;
  for (const WaysOut& ways : pairs)
    for (std::size_t k = 0; k < ways.u.size(); ++k)
      if (ways.is_face[k] && std::abs(ways.h[k]) < least) {
        u.push_back(ways.u[k]);
        h.push_back(ways.h[k]);
      }
  const auto try_end = [&](const Vec3& x) {
    if (x.norm() < least && is_out(pairs, x)) least = x.norm();
  };
  for (std::size_t i = 0; i < u.size(); ++i) {
    try_end(h[i] * u[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 along = u[i].cross(u[j]);
      const double square = along.squaredNorm();
      if (square < 1e-12) continue;
      const Vec3 foot = (h[i] * u[j] - h[j] * u[i]).cross(along) / square;
      if (foot.norm() >= least) continue;
      try_end(foot);
      for (std::size_t k = 0; k < j; ++k)
        if (const double rate = u[k].dot(along); std::abs(rate) > 1e-9)
          try_end(foot + (h[k] - u[k].dot(foot)) / rate * along);
    }
  }
  return least;
}

}  // namespace talus::test
