// tests/unit/solver/island_scenes.hpp
// Islands of boxes with contact rows made by hand, for the tests and the benchmark of the island
// solver: stack, wall, chain, loose pile, and a large block on four small ones.
#pragma once

#include <array>
#include <vector>

#include "base/random.hpp"
#include "motion/displacement.hpp"
#include "solver/island.hpp"

namespace talus::scenes {

/// Common data of all contacts of a scene. D = stiffness_ratio * reduced mass.
struct LawOfScene {
  double step = 1e-3;            ///< h [s]
  double stiffness_ratio = 0.3;  ///< k_n h^2 / m
  double friction = 0.5;         ///< tan(phi)
  double gravity = 10;           ///< [m/s2]
};

struct Box {
  Vec3 centre, half;
  double density = 2500;
};

inline int add_box(const Box& box, const LawOfScene& law, Island& island) {
  const Vec3& h = box.half;
  const double mass = box.density * 8 * h.prod();
  Mat6 M = Mat6::Zero();
  const double x = h.x() * h.x(), y = h.y() * h.y(), z = h.z() * h.z();
  M.diagonal() << Vec3::Constant(mass), mass / 3 * Vec3(y + z, x + z, x + y);
  Vec6 v = Vec6::Zero();
  island.velocity.push_back(v);
  v[2] = -law.gravity * law.step;
  island.mass.push_back(M);
  island.free_velocity.push_back(v);
  island.position.push_back(box.centre);
  island.radius.push_back(h.norm());
  return n_bodies(island) - 1;
}

/// Adds the contacts of bodies a and b (-1: ground) at `points`; overlap >= 0 presses [m].
inline void add_contacts(int a, int b, const Vec3& normal, const std::vector<Vec3>& points,
                         double overlap, const LawOfScene& law, Island& island) {
  const double m_a = island.mass[static_cast<std::size_t>(a)](0, 0);
  const double m_b = b < 0 ? 0 : island.mass[static_cast<std::size_t>(b)](0, 0);
  open_pair(a, b, island);
  for (const Vec3& point : points) {
    ContactRow row;
    row.normal = normal.normalized();
    row.arm = point - island.position[static_cast<std::size_t>(a)];
    row.normal_damping = law.stiffness_ratio * (b < 0 ? m_a : m_a * m_b / (m_a + m_b));
    row.shear_damping = row.normal_damping;
    row.friction = law.friction;
    row.bias = -overlap / law.step;
    add_row(row, island);
  }
}

/// Corners of the rectangle centre +- u +- v.
inline std::vector<Vec3> rectangle(const Vec3& centre, const Vec3& u, const Vec3& v) {
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

/// n unit cubes one on the other on the ground.
inline Island stack(int n, const LawOfScene& law) {
  Island island;
  const Vec3 u(0.5, 0, 0), v(0, 0.5, 0), up(0, 0, 1);
  for (int i = 0; i < n; ++i) {
    add_box({Vec3(0, 0, i + 0.5), Vec3::Constant(0.5)}, law, island);
    add_contacts(i, i - 1, up, rectangle(Vec3(0, 0, i), u, v), 0, law, island);
  }
  return island;
}

/// Wall in stretcher bond of 1 x 0.5 x 0.5 m blocks, `courses` high and `n` long.
inline Island wall(int courses, int n, const LawOfScene& law) {
  Island island;
  const Vec3 up(0, 0, 1), v(0, 0.25, 0);
  for (int i = 0; i < courses; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = j + 0.5 * (i % 2), z = 0.5 * i;
      const int a = add_box({Vec3(x, 0, z + 0.25), Vec3(0.5, 0.25, 0.25)}, law, island);
      if (j > 0)
        add_contacts(a, a - 1, Vec3(1, 0, 0),
                     rectangle(Vec3(x - 0.5, 0, z + 0.25), v, Vec3(0, 0, 0.25)), 0, law, island);
      if (i == 0)
        add_contacts(a, -1, up, rectangle(Vec3(x, 0, z), Vec3(0.5, 0, 0), v), 0, law, island);
      for (int k = -1; i > 0 && k <= 1; k += 2) {
        const int below = (i - 1) * n + j + (i % 2 ? (k + 1) / 2 : (k - 1) / 2);
        if (below < (i - 1) * n || below >= i * n) continue;
        add_contacts(a, below, up, rectangle(Vec3(x + 0.25 * k, 0, z), Vec3(0.25, 0, 0), v), 0, law,
                     island);
      }
    }
  return island;
}

/// Unit cubes on an n_x by n_y by n_z grid, each with contacts to its neighbours and the lowest to
/// the ground: normals, gaps and velocities at random, so that contacts stick, slide and open.
inline Island pile(const std::array<int, 3>& n, const LawOfScene& law, Random& random) {
  Island island;
  const auto spread = [&](double width) {
    Vec3 out;
    for (int k = 0; k < 3; ++k) out[k] = random.uniform(-width / 2, width / 2);
    return out;
  };
  const std::array<int, 3> stride = {n[1] * n[2], n[2], 1};
  for (int i = 0; i < n[0] * n[1] * n[2]; ++i) {
    const std::array<int, 3> at = {i / stride[0], i / stride[1] % n[1], i % n[2]};
    const Vec3 centre(at[0], at[1], at[2] + 0.5);
    add_box({centre, Vec3::Constant(0.5), 2500 * (0.5 + random.uniform())}, law, island);
    auto& free = island.free_velocity.back();
    free.head<3>() += law.gravity * law.step * spread(4);
    free.segment<3>(3) += law.gravity * law.step * spread(4);
    for (int axis = 0; axis < 3; ++axis) {
      const bool ground = at[static_cast<std::size_t>(axis)] == 0;
      if (ground && axis < 2) continue;
      const Vec3 normal = (Vec3::Unit(axis) + spread(0.3)).normalized();
      const Vec3 u = 0.4 * Vec3::Unit((axis + 1) % 3), v = 0.4 * Vec3::Unit((axis + 2) % 3);
      const int b = ground ? -1 : i - stride[static_cast<std::size_t>(axis)];
      const double overlap =
          (random.uniform() - 0.3) * law.gravity * law.step * law.step / law.stiffness_ratio;
      add_contacts(i, b, normal, rectangle(centre - 0.5 * Vec3::Unit(axis), u, v), overlap, law,
                   island);
    }
  }
  return island;
}

/// A cube of 10 m on four cubes of 0.1 m; `density` is that of the large one.
inline Island block_on_feet(double density, const LawOfScene& law) {
  Island island;
  const Vec3 up(0, 0, 1), u(0.05, 0, 0), v(0, 0.05, 0);
  add_box({Vec3(0, 0, 5.1), Vec3::Constant(5), density}, law, island);
  for (const double x : {-4.0, 4.0})
    for (const double y : {-4.0, 4.0}) {
      const int foot = add_box({Vec3(x, y, 0.05), Vec3::Constant(0.05)}, law, island);
      add_contacts(0, foot, up, rectangle(Vec3(x, y, 0.1), u, v), 0, law, island);
      add_contacts(foot, -1, up, rectangle(Vec3(x, y, 0), u, v), 0, law, island);
    }
  return island;
}

}  // namespace talus::scenes
