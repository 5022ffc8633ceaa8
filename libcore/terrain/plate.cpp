// Solves a thin plate under tension over the free nodes of a lattice, region by region.
#include "terrain/plate.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "base/disjoint_sets.hpp"

namespace talus {
namespace {

using Role = PlateProblem::Node;

// A free node shares squares with itself and with six nodes of lower number (and with six of higher
// number, which hold the same coefficients).
struct Offset {
  int i = 0, j = 0;
};
constexpr std::array<Offset, 7> lower_neighbors = {
    {{0, 0}, {-1, 0}, {-2, 0}, {-1, -1}, {0, -1}, {1, -1}, {0, -2}}};

// Coefficient of the height at node (i, j).
struct Term {
  int i = 0, j = 0;
  double coefficient = 0;
};

// The free nodes are the unknowns, numbered as they come. A bit a node and a count every 8 nodes,
// since most nodes are none.
class Unknowns {
 public:
  explicit Unknowns(const std::vector<Role>& node)
      : is_free_(node.size() / 8 + 1, 0), n_before_(is_free_.size(), 0) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      if (i % 8 == 0) n_before_[i / 8] = count();
      if (node[i] != Role::free) continue;
      is_free_[i / 8] |= static_cast<std::uint8_t>(1U << i % 8);
      node_.push_back(static_cast<int>(i));
    }
  }
  [[nodiscard]] int count() const { return static_cast<int>(node_.size()); }
  [[nodiscard]] std::size_t node(int unknown) const {
    return static_cast<std::size_t>(node_[unknown]);
  }
  // The unknown at a node, -1 when the node is not free.
  [[nodiscard]] int at(std::size_t node) const {
    const unsigned bit = 1U << node % 8, byte = is_free_[node / 8];
    if ((byte & bit) == 0) return -1;
    return n_before_[node / 8] + bits_in[byte & (bit - 1)];
  }

 private:
  // std::popcount is a call on a plain x86-64.
  static constexpr std::array<std::uint8_t, 128> bits_in = [] {
    std::array<std::uint8_t, 128> table{};
    for (unsigned byte = 0; byte < table.size(); ++byte)
      table[byte] = static_cast<std::uint8_t>(std::popcount(byte));
    return table;
  }();

  std::vector<std::uint8_t> is_free_;
  std::vector<int> n_before_;
  std::vector<int> node_;  // of each unknown
};

// Nodes of the problem by column and row.
class Nodes {
 public:
  explicit Nodes(const PlateProblem& problem)
      : problem_(problem), n_x_(static_cast<std::size_t>(problem.n_x)) {}
  [[nodiscard]] std::size_t number(int i, int j) const {
    return static_cast<std::size_t>(j) * n_x_ + static_cast<std::size_t>(i);
  }
  [[nodiscard]] std::array<int, 2> place(std::size_t node) const {
    return {static_cast<int>(node % n_x_), static_cast<int>(node / n_x_)};
  }
  [[nodiscard]] bool inside(int i, int j) const {
    return i >= 0 && j >= 0 && i < problem_.n_x && j < problem_.n_y &&
           problem_.node[number(i, j)] != Role::outside;
  }
  // Bilinear height at an anchor; coefficients of 0 where a corner of its cell is outside.
  [[nodiscard]] std::array<Term, 4> height_at(const Vec3& anchor) const {
    const int i = static_cast<int>(std::floor(anchor.x()));
    const int j = static_cast<int>(std::floor(anchor.y()));
    const double x = anchor.x() - i, y = anchor.y() - j;
    for (int corner = 0; corner < 4; ++corner)
      if (!inside(i + corner % 2, j + corner / 2)) return {};
    return {{{i, j, (1 - x) * (1 - y)},
             {i + 1, j, x * (1 - y)},
             {i, j + 1, (1 - x) * y},
             {i + 1, j + 1, x * y}}};
  }

 private:
  const PlateProblem& problem_;
  std::size_t n_x_;
};

// Items in groups: those of group g are items[begin[g]] to items[begin[g + 1] - 1], rising.
struct Groups {
  std::vector<int> begin, items;
  [[nodiscard]] std::span<const int> of(int group) const {
    const auto g = static_cast<std::size_t>(group);
    return std::span(items).subspan(static_cast<std::size_t>(begin[g]),
                                    static_cast<std::size_t>(begin[g + 1] - begin[g]));
  }
};

// Groups items by their group, -1 in none.
Groups grouped(const std::vector<int>& group_of_item, int n_groups) {
  Groups groups;
  groups.begin.assign(static_cast<std::size_t>(n_groups) + 1, 0);
  for (const int g : group_of_item)
    if (g >= 0) ++groups.begin[g];
  std::inclusive_scan(groups.begin.begin(), groups.begin.end(), groups.begin.begin());
  groups.items.resize(groups.begin.back());
  for (std::size_t i = group_of_item.size(); i-- > 0;)
    if (group_of_item[i] >= 0) groups.items[--groups.begin[group_of_item[i]]] = static_cast<int>(i);
  return groups;
}

// Region of each unknown: unknowns that may share a square, numbered by their first ones.
std::vector<int> find_regions(const Nodes& nodes, const Unknowns& unknowns, int& n_regions) {
  DisjointSets sets(static_cast<std::size_t>(unknowns.count()));
  for (int u = 0; u < unknowns.count(); ++u) {
    const auto [i, j] = nodes.place(unknowns.node(u));
    for (const Offset offset : lower_neighbors) {
      if (!nodes.inside(i + offset.i, j + offset.j)) continue;
      const int v = unknowns.at(nodes.number(i + offset.i, j + offset.j));
      if (v >= 0) sets.join(u, v);
    }
  }
  // A root is the lowest of its region, so it has the region's number before the rest reads it.
  std::vector<int> region(static_cast<std::size_t>(unknowns.count()));
  n_regions = 0;
  for (int u = 0; u < unknowns.count(); ++u)
    region[u] = sets.root(u) == u ? n_regions++ : region[sets.root(u)];
  return region;
}

// The normal equations of one region, K z = f, K by its lower half, unknowns by their place in the
// region.
class NormalEquations {
 public:
  NormalEquations(const PlateProblem& problem, const std::function<double(std::size_t)>& height_of,
                  const Nodes& nodes, const Unknowns& unknowns,
                  const std::vector<int>& region_of_unknown)
      : problem_(problem),
        height_of_(height_of),
        nodes_(nodes),
        unknowns_(unknowns),
        region_of_unknown_(region_of_unknown),
        local_(region_of_unknown.size(), -1) {}

  void assemble(int region, std::span<const int> members, std::span<const int> anchors) {
    region_ = region;
    members_ = members;
    rows_.assign(members.size(), {});
    right_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(members.size()));
    for (std::size_t k = 0; k < members.size(); ++k) local_[members[k]] = static_cast<int>(k);
    add_nodes();
    for (const int a : anchors) {
      const Vec3& anchor = problem_.anchors[a];
      add_square(nodes_.height_at(anchor), anchor.z(), problem_.anchor_weight);
    }
  }

  // Heights of the region's unknowns; empty when nothing holds them.
  [[nodiscard]] Eigen::VectorXd solved() const {
    const Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor(matrix());
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0)) return {};
    return factor.solve(right_);
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  [[nodiscard]] Matrix matrix() const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(rows_.size() * lower_neighbors.size());
    for (std::size_t u = 0; u < rows_.size(); ++u) {
      const auto [i, j] = nodes_.place(unknowns_.node(members_[u]));
      for (std::size_t k = 0; k < lower_neighbors.size(); ++k) {
        if (rows_[u][k] == 0) continue;
        const Offset offset = lower_neighbors[k];
        const int other = unknowns_.at(nodes_.number(i + offset.i, j + offset.j));
        entries.emplace_back(static_cast<int>(u), local_[other], rows_[u][k]);
      }
    }
    const auto n = static_cast<Eigen::Index>(rows_.size());
    Matrix lower(n, n);
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  // Squares at the region's nodes and at those beside them, each once and by rising number: the
  // nodes shifted by five offsets are five rising lists, which are merged.
  void add_nodes() {
    const auto n_x = static_cast<std::ptrdiff_t>(problem_.n_x);
    const std::array<std::ptrdiff_t, 5> offset = {-n_x, -1, 0, 1, n_x};
    const auto n_nodes = static_cast<std::ptrdiff_t>(problem_.node.size());
    std::array<std::size_t, 5> at{};
    const auto head = [&](std::size_t k) {
      return at[k] < members_.size()
                 ? static_cast<std::ptrdiff_t>(unknowns_.node(members_[at[k]])) + offset[k]
                 : n_nodes;
    };
    while (at.back() < members_.size()) {
      std::ptrdiff_t lowest = n_nodes;
      for (std::size_t k = 0; k < at.size(); ++k) lowest = std::min(lowest, head(k));
      for (std::size_t k = 0; k < at.size(); ++k) at[k] += head(k) == lowest ? 1 : 0;
      if (lowest >= n_nodes) return;
      if (lowest >= 0) add_node(static_cast<std::size_t>(lowest));
    }
  }

  // Bending and tension at a node.
  void add_node(std::size_t node) {
    const auto [i, j] = nodes_.place(node);
    if (!nodes_.inside(i, j)) return;
    std::array<Term, 5> laplacian;
    std::size_t n = 1;
    for (const Offset d : {Offset{1, 0}, Offset{0, 1}}) {
      if (!nodes_.inside(i - d.i, j - d.j) || !nodes_.inside(i + d.i, j + d.j)) continue;
      laplacian[n++] = {i - d.i, j - d.j, 1};
      laplacian[n++] = {i + d.i, j + d.j, 1};
    }
    laplacian[0] = {i, j, 1 - static_cast<double>(n)};
    if (n > 1) add_square(std::span(laplacian).first(n), 0, 1);
    for (const Offset d : {Offset{1, 0}, Offset{0, 1}}) {
      if (!nodes_.inside(i + d.i, j + d.j)) continue;
      const std::size_t next = nodes_.number(i + d.i, j + d.j);
      const double tau = 0.5 * (static_cast<double>(problem_.tension[node]) +
                                static_cast<double>(problem_.tension[next]));
      add_square(std::array{Term{i, j, 1}, Term{i + d.i, j + d.j, -1}}, 0, tau);
    }
  }

  // Adds weight * (sum coefficient z - target)^2, unless it is another region's: all unknowns of a
  // square are in one region.
  void add_square(std::span<const Term> terms, double target, double weight) {
    std::array<int, 5> local{};
    bool is_ours = false;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const int unknown = unknowns_.at(nodes_.number(terms[k].i, terms[k].j));
      local[k] = unknown < 0 ? -1 : local_[unknown];
      is_ours |= unknown >= 0 && region_of_unknown_[unknown] == region_;
    }
    if (!is_ours) return;
    for (std::size_t p = 0; p < terms.size(); ++p) {
      if (local[p] < 0) continue;
      const double scale = weight * terms[p].coefficient;
      right_[local[p]] += scale * target;
      for (std::size_t q = 0; q < terms.size(); ++q) {
        const double value = scale * terms[q].coefficient;
        if (local[q] < 0)
          right_[local[p]] -= value * height_of_(nodes_.number(terms[q].i, terms[q].j));
        else if (local[q] <= local[p])
          rows_[local[p]][slot(terms[p], terms[q])] += value;
      }
    }
  }

  // Which of lower_neighbors leads from p to q, a node of no higher number.
  static std::size_t slot(const Term& p, const Term& q) {
    if (p.j == q.j) return static_cast<std::size_t>(p.i - q.i);
    return p.j - q.j == 2 ? 6 : static_cast<std::size_t>(4 + q.i - p.i);
  }

  const PlateProblem& problem_;
  const std::function<double(std::size_t)>& height_of_;
  const Nodes& nodes_;
  const Unknowns& unknowns_;
  const std::vector<int>& region_of_unknown_;
  int region_ = -1;
  std::span<const int> members_;             // unknowns of the region
  std::vector<int> local_;                   // place of an unknown in its region (n_unknowns)
  std::vector<std::array<double, 7>> rows_;  // of K, by lower_neighbors
  Eigen::VectorXd right_;
};

}  // namespace

PlateSolution solve_plate(const PlateProblem& problem,
                          const std::function<double(std::size_t)>& height_of,
                          const ProgressFunction& progress) {
  const Nodes nodes(problem);
  const Unknowns unknowns(problem.node);
  PlateSolution solution;
  const std::vector<int> region_of_unknown = find_regions(nodes, unknowns, solution.n_regions);
  std::vector<int> region_of_anchor(problem.anchors.size(), -1);
  for (std::size_t a = 0; a < problem.anchors.size(); ++a)
    for (const Term& term : nodes.height_at(problem.anchors[a]))
      if (const int u = unknowns.at(nodes.number(term.i, term.j)); term.coefficient != 0 && u >= 0)
        region_of_anchor[a] = region_of_unknown[u];
  const Groups members = grouped(region_of_unknown, solution.n_regions);
  const Groups anchors = grouped(region_of_anchor, solution.n_regions);

  solution.height.assign(region_of_unknown.size(), std::numeric_limits<double>::quiet_NaN());
  NormalEquations equations(problem, height_of, nodes, unknowns, region_of_unknown);
  std::size_t n_done = 0;
  for (int region = 0; region < solution.n_regions; ++region) {
    const std::span<const int> of_region = members.of(region);
    equations.assemble(region, of_region, anchors.of(region));
    const Eigen::VectorXd height = equations.solved();
    if (height.size() == 0) solution.n_unsolved += static_cast<int>(of_region.size());
    for (Eigen::Index k = 0; k < height.size(); ++k) solution.height[of_region[k]] = height[k];
    n_done += of_region.size();
    if (progress)
      progress(static_cast<double>(n_done) / static_cast<double>(solution.height.size()));
  }
  return solution;
}

}  // namespace talus
