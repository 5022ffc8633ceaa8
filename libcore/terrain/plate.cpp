#include "terrain/plate.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "base/error.hpp"

namespace talus {
namespace {

using Role = PlateProblem::Node;

// A free node is coupled to itself and to six nodes of lower number (and to six of higher number,
// which hold the same coefficient).
struct Offset {
  int i = 0, j = 0;
};
constexpr std::array<Offset, 7> lower_neighbors = {
    {{0, 0}, {-1, 0}, {-2, 0}, {-1, -1}, {0, -1}, {1, -1}, {0, -2}}};

struct Term {
  std::size_t node = 0;
  double coefficient = 0;
};

// The normal equations of the sum of squares, K z = f, K by its lower half.
class NormalEquations {
 public:
  NormalEquations(const PlateProblem& problem, const std::function<double(std::size_t)>& height_of)
      : problem_(problem), height_of_(height_of), unknown_(problem.node.size(), -1) {
    for (std::size_t node = 0; node < problem.node.size(); ++node)
      if (problem.node[node] == Role::free) unknown_[node] = n_unknowns_++;
    rows_.resize(static_cast<std::size_t>(n_unknowns_));
    right_.assign(rows_.size(), 0);
    for (std::size_t node = 0; node < problem.node.size(); ++node)
      if (unknown_[node] >= 0) node_of_.push_back(node);
    for (int j = 0; j < problem.n_y; ++j)
      for (int i = 0; i < problem.n_x; ++i) add_node(i, j);
    for (const Vec3& anchor : problem.anchors) add_anchor(anchor);
  }

  [[nodiscard]] int n_unknowns() const { return n_unknowns_; }
  [[nodiscard]] double coefficient(int u, std::size_t k) const {
    return rows_[static_cast<std::size_t>(u)][k];
  }
  [[nodiscard]] double right(int u) const { return right_[static_cast<std::size_t>(u)]; }
  // The unknown coupled to u by lower_neighbors[k]; -1 when there is none.
  [[nodiscard]] int coupled(int u, std::size_t k) const {
    if (rows_[static_cast<std::size_t>(u)][k] == 0) return -1;
    const Offset offset = lower_neighbors[k];
    const auto step = static_cast<std::ptrdiff_t>(offset.j) * problem_.n_x + offset.i;
    return unknown_[static_cast<std::size_t>(
        static_cast<std::ptrdiff_t>(node_of_[static_cast<std::size_t>(u)]) + step)];
  }

 private:
  [[nodiscard]] std::size_t number(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(problem_.n_x) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] bool inside(int i, int j) const {
    return i >= 0 && j >= 0 && i < problem_.n_x && j < problem_.n_y &&
           problem_.node[number(i, j)] != Role::outside;
  }

  // Whether the node or one of its four neighbours is free: only there is anything to add.
  [[nodiscard]] bool near_free(int i, int j) const {
    const auto is_free = [this](std::size_t node) { return problem_.node[node] == Role::free; };
    const std::size_t node = number(i, j), row = static_cast<std::size_t>(problem_.n_x);
    return is_free(node) || (i > 0 && is_free(node - 1)) ||
           (i + 1 < problem_.n_x && is_free(node + 1)) || (j > 0 && is_free(node - row)) ||
           (j + 1 < problem_.n_y && is_free(node + row));
  }

  // Adds weight * (sum coefficient z - target)^2.
  void add_square(std::span<const Term> terms, double target, double weight) {
    for (const Term& p : terms) {
      if (unknown_[p.node] < 0) continue;
      const auto row = static_cast<std::size_t>(unknown_[p.node]);
      const double scale = weight * p.coefficient;
      right_[row] += scale * target;
      for (const Term& q : terms) {
        const double value = scale * q.coefficient;
        if (unknown_[q.node] < 0)
          right_[row] -= value * height_of_(q.node);
        else if (q.node <= p.node)
          rows_[row][slot(p.node, q.node)] += value;
      }
    }
  }

  // Which of lower_neighbors leads from node p to q, q <= p.
  [[nodiscard]] std::size_t slot(std::size_t p, std::size_t q) const {
    const auto n_x = static_cast<std::size_t>(problem_.n_x);
    const int i = static_cast<int>(q % n_x) - static_cast<int>(p % n_x);
    const int j = static_cast<int>(q / n_x) - static_cast<int>(p / n_x);
    if (j == 0) return static_cast<std::size_t>(-i);
    return j == -2 ? 6 : static_cast<std::size_t>(4 + i);
  }

  [[nodiscard]] bool any_free(std::span<const Term> terms) const {
    return std::any_of(terms.begin(), terms.end(),
                       [this](const Term& t) { return unknown_[t.node] >= 0; });
  }

  // Bending and tension at node (i, j).
  void add_node(int i, int j) {
    if (!inside(i, j) || !near_free(i, j)) return;
    std::array<Term, 5> laplacian;
    std::size_t n = 1;
    const auto add_direction = [&](int di, int dj) {
      if (!inside(i - di, j - dj) || !inside(i + di, j + dj)) return;
      laplacian[n++] = {number(i - di, j - dj), 1};
      laplacian[n++] = {number(i + di, j + dj), 1};
    };
    add_direction(1, 0);
    add_direction(0, 1);
    laplacian[0] = {number(i, j), 1 - static_cast<double>(n)};
    const std::span<const Term> terms(laplacian.data(), n);
    if (n > 1 && any_free(terms)) add_square(terms, 0, 1);
    add_tension(i, j, i + 1, j);
    add_tension(i, j, i, j + 1);
  }

  void add_tension(int i, int j, int i2, int j2) {
    if (!inside(i2, j2)) return;
    const std::array<Term, 2> difference = {{{number(i, j), 1}, {number(i2, j2), -1}}};
    if (!any_free(difference)) return;
    const double tau = 0.5 * (static_cast<double>(problem_.tension[difference[0].node]) +
                              static_cast<double>(problem_.tension[difference[1].node]));
    add_square(difference, 0, tau);
  }

  void add_anchor(const Vec3& anchor) {
    const int i = static_cast<int>(std::floor(anchor.x()));
    const int j = static_cast<int>(std::floor(anchor.y()));
    const double x = anchor.x() - i, y = anchor.y() - j;
    for (int corner = 0; corner < 4; ++corner)
      if (!inside(i + corner % 2, j + corner / 2)) return;
    const std::array<Term, 4> bilinear = {{{number(i, j), (1 - x) * (1 - y)},
                                           {number(i + 1, j), x * (1 - y)},
                                           {number(i, j + 1), (1 - x) * y},
                                           {number(i + 1, j + 1), x * y}}};
    if (any_free(bilinear)) add_square(bilinear, anchor.z(), problem_.anchor_weight);
  }

  const PlateProblem& problem_;
  const std::function<double(std::size_t)>& height_of_;
  int n_unknowns_ = 0;
  std::vector<int> unknown_;                 // of each node, -1 when it is not free
  std::vector<std::size_t> node_of_;         // of each unknown
  std::vector<std::array<double, 7>> rows_;  // of K, by lower_neighbors
  std::vector<double> right_;
};

// Groups of unknowns that hang together, each rising, in the order of their first unknowns.
std::vector<std::vector<int>> find_regions(const NormalEquations& equations) {
  const int n = equations.n_unknowns();
  std::vector<int> root(static_cast<std::size_t>(n));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int u) {
    while (root[static_cast<std::size_t>(u)] != u) {
      int& above = root[static_cast<std::size_t>(u)];
      above = root[static_cast<std::size_t>(above)];
      u = above;
    }
    return u;
  };
  for (int u = 0; u < n; ++u)
    for (std::size_t k = 1; k < lower_neighbors.size(); ++k) {
      const int v = equations.coupled(u, k);
      if (v < 0) continue;
      const int root_u = find(u), root_v = find(v);
      root[static_cast<std::size_t>(std::max(root_u, root_v))] = std::min(root_u, root_v);
    }
  std::vector<int> region_of_root(static_cast<std::size_t>(n), -1);
  std::vector<std::vector<int>> regions;
  for (int u = 0; u < n; ++u) {
    int& region = region_of_root[static_cast<std::size_t>(find(u))];
    if (region < 0) {
      region = static_cast<int>(regions.size());
      regions.emplace_back();
    }
    regions[static_cast<std::size_t>(region)].push_back(u);
  }
  return regions;
}

// Heights of one region into `height`; false when nothing holds it.
bool solve_region(const NormalEquations& equations, const std::vector<int>& region,
                  std::vector<int>& local, std::vector<double>& height) {
  const auto n = static_cast<Eigen::Index>(region.size());
  for (std::size_t i = 0; i < region.size(); ++i)
    local[static_cast<std::size_t>(region[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(region.size() * lower_neighbors.size());
  Eigen::VectorXd right(n);
  for (std::size_t i = 0; i < region.size(); ++i) {
    right[static_cast<Eigen::Index>(i)] = equations.right(region[i]);
    for (std::size_t k = 0; k < lower_neighbors.size(); ++k) {
      const int other = equations.coupled(region[i], k);
      if (other >= 0)
        entries.emplace_back(static_cast<int>(i), local[static_cast<std::size_t>(other)],
                             equations.coefficient(region[i], k));
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  entries = {};
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(matrix);
  const bool held = factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0;
  if (held) right = factor.solve(right);
  for (std::size_t i = 0; i < region.size(); ++i)
    height[static_cast<std::size_t>(region[i])] =
        held ? right[static_cast<Eigen::Index>(i)] : std::numeric_limits<double>::quiet_NaN();
  return held;
}

}  // namespace

PlateSolution solve_plate(const PlateProblem& problem,
                          const std::function<double(std::size_t)>& height_of,
                          const ProgressFunction& progress) {
  const NormalEquations equations(problem, height_of);
  PlateSolution solution;
  solution.height.resize(static_cast<std::size_t>(equations.n_unknowns()));
  std::vector<int> local(solution.height.size());
  std::size_t n_done = 0;
  for (const std::vector<int>& region : find_regions(equations)) {
    ++solution.n_regions;
    if (!solve_region(equations, region, local, solution.height))
      solution.n_unsolved += static_cast<int>(region.size());
    n_done += region.size();
    if (progress)
      progress(static_cast<double>(n_done) / static_cast<double>(solution.height.size()));
  }
  return solution;
}

}  // namespace talus
