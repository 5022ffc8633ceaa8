// libcore/terrain/plate.hpp
// A thin plate under tension over the free nodes of a lattice: the surface that follows the slopes
// around it with the least bending.
//
//   minimise  sum (Lap z)^2 + sum tau (dz)^2 + w sum (z(anchor) - h)^2        (in units of a node)
//
// Lap is the five-point Laplacian (the two-point second difference along an open border), dz the
// difference of neighbouring nodes, z(anchor) the bilinear height at a point that is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/progress.hpp"
#include "base/types.hpp"

namespace talus {

/// Nodes row by row, number j * n_x + i, unit spacing.
struct PlateProblem {
  enum class Node : std::uint8_t { outside, known, free };
  int n_x = 0, n_y = 0;
  std::vector<Node> node;      ///< role of each node                          (n_x * n_y)
  std::vector<float> tension;  ///< tau at each node, >= 0 [-]                 (n_x * n_y)
  std::vector<Vec3> anchors;   ///< x, y in nodes from node (0, 0); height [m]
  double anchor_weight = 100;  ///< w [-]
};

/// Heights of the free nodes in the order of their numbers [m].
struct PlateSolution {
  std::vector<double> height;
  int n_regions = 0;   ///< groups of nodes solved independently
  int n_unsolved = 0;  ///< free nodes in groups that nothing holds: their height is NaN
};

/// `height_of` gives the height of a known node by its number [m].
[[nodiscard]] PlateSolution solve_plate(const PlateProblem& problem,
                                        const std::function<double(std::size_t)>& height_of,
                                        const ProgressFunction& progress = {});

}  // namespace talus
