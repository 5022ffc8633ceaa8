// The thin plate: planes, energy, bounds.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/random.hpp"
#include "terrain/plate.hpp"

namespace {

using talus::PlateProblem;
using talus::PlateSolution;
using talus::Vec3;
using Role = PlateProblem::Node;

PlateProblem frame(int n_x, int n_y) {
  PlateProblem problem;
  problem.n_x = n_x;
  problem.n_y = n_y;
  problem.node.assign(static_cast<std::size_t>(n_x * n_y), Role::known);
  problem.tension.assign(problem.node.size(), 0);
  return problem;
}

// The energy of plate.hpp, written down from its definition.
double energy(const PlateProblem& p, const std::vector<double>& z) {
  const auto role = [&](int i, int j) {
    const bool inside = i >= 0 && j >= 0 && i < p.n_x && j < p.n_y;
    return inside ? p.node[static_cast<std::size_t>(j * p.n_x + i)] : Role::outside;
  };
  const auto at = [&](int i, int j) { return z[static_cast<std::size_t>(j * p.n_x + i)]; };
  double sum = 0;
  for (int j = 0; j < p.n_y; ++j)
    for (int i = 0; i < p.n_x; ++i) {
      if (role(i, j) == Role::outside) continue;
      double laplacian = 0;
      for (const auto& [di, dj] : {std::pair(1, 0), std::pair(0, 1)}) {
        if (role(i + di, j + dj) != Role::outside) {
          const double tau = (p.tension[static_cast<std::size_t>(j * p.n_x + i)] +
                              p.tension[static_cast<std::size_t>((j + dj) * p.n_x + i + di)]) /
                             2;
          sum += tau * std::pow(at(i + di, j + dj) - at(i, j), 2);
          if (role(i - di, j - dj) != Role::outside)
            laplacian += at(i + di, j + dj) + at(i - di, j - dj) - 2 * at(i, j);
        }
      }
      sum += laplacian * laplacian;
    }
  for (const Vec3& a : p.anchors) {
    const int i = static_cast<int>(a.x()), j = static_cast<int>(a.y());
    const double x = a.x() - i, y = a.y() - j;
    const double height = (1 - x) * (1 - y) * at(i, j) + x * (1 - y) * at(i + 1, j) +
                          (1 - x) * y * at(i, j + 1) + x * y * at(i + 1, j + 1);
    sum += p.anchor_weight * std::pow(height - a.z(), 2);
  }
  return sum;
}

TEST(Plate, WithoutTensionContinuesAPlane) {
  PlateProblem problem = frame(12, 9);
  for (int j = 2; j < 7; ++j)
    for (int i = 2; i < 10; ++i) problem.node[static_cast<std::size_t>(j * 12 + i)] = Role::free;
  const auto plane = [](std::size_t node) {
    return 3 + 0.7 * static_cast<double>(node % 12) - 0.2 * static_cast<double>(node / 12);
  };
  const PlateSolution solution = talus::solve_plate(problem, plane);
  ASSERT_EQ(solution.height.size(), 40U);
  EXPECT_EQ(solution.n_regions, 1);
  std::size_t unknown = 0;
  for (std::size_t node = 0; node < problem.node.size(); ++node)
    if (problem.node[node] == Role::free) {
      EXPECT_NEAR(solution.height[unknown++], plane(node), 1e-10);
    }
}

// Any nudge of any free node raises the energy, whatever the shape of the region: it is the
// minimum.
TEST(Plate, MinimisesTheEnergyOfItsDefinition) {
  talus::Random random(7, "plate");
  for (int scene = 0; scene < 20; ++scene) {
    PlateProblem problem = frame(11, 8);
    std::vector<double> z(problem.node.size());
    for (std::size_t node = 0; node < z.size(); ++node) {
      const double draw = random.uniform();
      problem.node[node] = draw < 0.45 ? Role::free : draw < 0.55 ? Role::outside : Role::known;
      problem.tension[node] = static_cast<float>(random.uniform(0.01, 0.5));
      z[node] = random.uniform(0, 10);
    }
    for (int i = 0; i < 6; ++i) {
      const Vec3 anchor(random.uniform(0, 10), random.uniform(0, 7), random.uniform(0, 10));
      const int corner = static_cast<int>(anchor.y()) * 11 + static_cast<int>(anchor.x());
      bool whole = true;
      for (const int step : {0, 1, 11, 12})
        whole &= problem.node[static_cast<std::size_t>(corner + step)] != Role::outside;
      if (whole) problem.anchors.push_back(anchor);
    }
    const PlateSolution solution =
        talus::solve_plate(problem, [&](std::size_t node) { return z[node]; });
    ASSERT_EQ(solution.n_unsolved, 0);
    std::size_t unknown = 0;
    for (std::size_t node = 0; node < z.size(); ++node)
      if (problem.node[node] == Role::free) z[node] = solution.height[unknown++];
    const double least = energy(problem, z);
    for (std::size_t node = 0; node < z.size(); ++node) {
      if (problem.node[node] != Role::free) continue;
      for (const double nudge : {1e-3, -1e-3}) {
        z[node] += nudge;
        EXPECT_GT(energy(problem, z), least);
        z[node] -= nudge;
      }
    }
  }
}

TEST(Plate, LeavesUnknownWhatNothingHolds) {
  PlateProblem problem = frame(8, 8);
  for (auto& node : problem.node) node = Role::outside;
  for (const std::size_t node : {27U, 28U, 35U, 36U}) problem.node[node] = Role::free;
  const PlateSolution solution = talus::solve_plate(problem, [](std::size_t) { return 0.0; });
  EXPECT_EQ(solution.n_unsolved, 4);
  for (const double height : solution.height) EXPECT_TRUE(std::isnan(height));
}

}  // namespace
