#include "dda/island_matrix.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace talus {
namespace {

using std::size_t;

Mat3 skew(const Vec3& x) {
  Mat3 S;
  S << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
  return S;
}

/// Sum of the stick stiffness k T(r)^T T(r) of a pair's contacts. For rigid bodies its moments do:
/// T^T T = [I, -S; S, |r|^2 I - r r^T] with S = [r]x.
template <int Dof>
struct StickSum {
  Eigen::Matrix<double, Dof, Dof> sum = Eigen::Matrix<double, Dof, Dof>::Zero();
  void add(double k, const Vec3& arm) {
    const Mat3x12 T = displacement_matrix(arm);
    sum.noalias() += k * (T.transpose() * T);
  }
  void add_to(Eigen::Matrix<double, Dof, Dof>& W) const { W += sum; }
};

template <>
struct StickSum<6> {
  double k_sum = 0;
  Vec3 first = Vec3::Zero();   // sum k r
  Mat3 second = Mat3::Zero();  // sum k r r^T
  void add(double k, const Vec3& arm) {
    k_sum += k;
    const Vec3 weighted = k * arm;
    first += weighted;
    second.noalias() += weighted.lazyProduct(arm.transpose());
  }
  void add_to(Mat6& W) const {
    const Mat3 S = skew(first);
    W.topLeftCorner<3, 3>().diagonal().array() += k_sum;
    W.topRightCorner<3, 3>() -= S;
    W.bottomLeftCorner<3, 3>() += S;
    W.bottomRightCorner<3, 3>() -= second;
    W.bottomRightCorner<3, 3>().diagonal().array() += second.trace();
  }
};

// W += k q r^T with q = T(arm)^T left, r = T(arm)^T right.
template <int Dof>
void add_product(double k, const Vec3& arm, const Vec3& left, const Vec3& right,
                 Eigen::Matrix<double, Dof, Dof>& W) {
  const Eigen::Matrix<double, Dof, 1> q = k * generalised<Dof>(arm, left);
  W.noalias() += q.lazyProduct(generalised<Dof>(arm, right).transpose());
}

// A slipping contact: k_n n n^T and the stiffness across the slip; exact: the turn of the mean
// direction e with that at the end of the step, and the friction bound's tan(phi) k_n e n^T.
template <int Dof>
void add_slip(const IslandRow& row, Tangent tangent, Eigen::Matrix<double, Dof, Dof>& W) {
  const Vec3& n = row.normal;
  const double p_n = n.dot(row.impulse);
  Vec3 normal_part = n;
  if (row.slip_stiffness > 0) {
    const Vec3 e = (p_n * n - row.impulse).normalized();
    const Vec3 across = n.cross(e);
    Vec3 across_end = across;
    const double along = e.dot(row.slip_start);
    if (tangent == Tangent::exact && along > 0)
      across_end = n.cross((2 * e - along * row.slip_start).normalized());
    add_product<Dof>(row.slip_stiffness, row.arm, across, across_end, W);
    if (tangent == Tangent::exact && p_n > 0) normal_part -= row.friction * e;
  }
  add_product<Dof>(row.normal_damping, row.arm, normal_part, n, W);
}

// W of one pair, and whether a contact presses. Stick: k_t I + (k_n - k_t) n n^T.
template <int Dof>
bool sum_tangents(std::span<const IslandRow> rows, Tangent tangent,
                  Eigen::Matrix<double, Dof, Dof>& W) {
  W.setZero();
  StickSum<Dof> stick;
  bool closed = false;
  for (const IslandRow& row : rows) {
    if (row.waits_for_impact || row.state == ContactState::open) continue;
    closed = true;
    if (row.state == ContactState::stick) {
      stick.add(row.shear_damping, row.arm);
      add_product<Dof>(row.normal_damping - row.shear_damping, row.arm, row.normal, row.normal, W);
    } else {
      add_slip<Dof>(row, tangent, W);
    }
  }
  stick.add_to(W);
  return closed;
}

template <int Dof>
Eigen::Matrix<double, Dof, Dof> shift_matrix(const Vec3& shift) {
  Eigen::Matrix<double, Dof, Dof> X = Eigen::Matrix<double, Dof, Dof>::Identity();
  X.template topRows<3>() = displacement_matrix(shift).template leftCols<Dof>();
  return X;
}

// X^T W X, what the pair adds to the diagonal block of B.
template <int Dof>
Eigen::Matrix<double, Dof, Dof> carried_tangent(const Eigen::Matrix<double, Dof, Dof>& W,
                                                const Vec3& shift) {
  if constexpr (Dof == 6) {
    const Mat3 S = skew(shift);  // X = [I, -S; 0, I]
    Mat6 out;
    const Mat3 K = W.template topLeftCorner<3, 3>();
    const Mat3 B = W.template topRightCorner<3, 3>() - K * S;
    const Mat3 C = W.template bottomLeftCorner<3, 3>();
    out.topLeftCorner<3, 3>() = K;
    out.topRightCorner<3, 3>() = B;
    out.bottomLeftCorner<3, 3>() = C + S * K;
    out.bottomRightCorner<3, 3>() = W.template bottomRightCorner<3, 3>() - C * S + S * B;
    return out;
  } else {
    const Mat12 X = shift_matrix<12>(shift);
    return X.transpose() * W * X;
  }
}

template <int Dof>
double dot(std::span<const Eigen::Matrix<double, Dof, 1>> x,
           std::span<const Eigen::Matrix<double, Dof, 1>> y) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += x[i].dot(y[i]);
  return sum;
}

template <int Dof>
void sum_diagonals(const Island<Dof>& island, IslandMatrix<Dof>& matrix) {
  for (size_t i = 0; i < island.mass.size(); ++i)
    if (matrix.body_changed[i]) matrix.own[i] = matrix.diagonal[i] = island.mass[i];
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    const auto a = static_cast<size_t>(island.pairs[p].a);
    if (matrix.body_changed[a]) {
      matrix.diagonal[a] += matrix.pair[p];
      if (island.pairs[p].b < 0) matrix.own[a] += matrix.pair[p];
    }
    if (island.pairs[p].b < 0) continue;
    const auto b = static_cast<size_t>(island.pairs[p].b);
    if (matrix.body_changed[b])
      matrix.diagonal[b] += carried_tangent<Dof>(matrix.pair[p], matrix.shift[p]);
  }
}

template <int Dof>
void invert_diagonals(IslandMatrix<Dof>& matrix) {
  using Mat = typename IslandMatrix<Dof>::Mat;
  for (size_t i = 0; i < matrix.inverse.size(); ++i) {
    if (!matrix.inverse_stale[i]) continue;
    matrix.inverse[i] = matrix.diagonal[i].llt().solve(Mat::Identity());
    matrix.inverse_stale[i] = 0;
  }
}

}  // namespace

template <int Dof>
void prepare_matrix(const Island<Dof>& island, IslandMatrix<Dof>& matrix) {
  const size_t n = island.mass.size(), n_pairs = island.pairs.size();
  matrix.shift.resize(n_pairs);
  for (size_t p = 0; p < n_pairs; ++p) {
    const BodyPair& pair = island.pairs[p];
    matrix.shift[p] = pair.b < 0 ? Vec3(Vec3::Zero())
                                 : Vec3(island.position[static_cast<size_t>(pair.a)] -
                                        island.position[static_cast<size_t>(pair.b)]);
  }
  matrix.pair_changed.assign(n_pairs, 1);
  matrix.body_changed.assign(n, 1);
  matrix.inverse_stale.assign(n, 1);
  matrix.pair.resize(n_pairs);
  matrix.pair_closed.resize(n_pairs);
  matrix.own.resize(n);
  matrix.diagonal.resize(n);
  matrix.inverse.resize(n);
  for (auto* vectors : {&matrix.residual, &matrix.preconditioned, &matrix.direction, &matrix.product})
    vectors->resize(n);
}

template <int Dof>
void update_matrix(const Island<Dof>& island, Tangent tangent, IslandMatrix<Dof>& matrix) {
  matrix.coupled.clear();
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    const BodyPair& pair = island.pairs[p];
    const std::span<const IslandRow> rows(
        island.rows.data() + pair.row_begin, static_cast<size_t>(pair.row_end - pair.row_begin));
    if (matrix.pair_changed[p]) {
      matrix.pair_closed[p] = sum_tangents<Dof>(rows, tangent, matrix.pair[p]);
      matrix.pair_changed[p] = 0;
      matrix.body_changed[static_cast<size_t>(pair.a)] = 1;
      if (pair.b >= 0) matrix.body_changed[static_cast<size_t>(pair.b)] = 1;
    }
    if (pair.b >= 0 && matrix.pair_closed[p]) matrix.coupled.push_back(static_cast<int>(p));
  }
  sum_diagonals(island, matrix);
  for (size_t i = 0; i < island.mass.size(); ++i) {
    matrix.inverse_stale[i] |= matrix.body_changed[i];
    matrix.body_changed[i] = 0;
  }
}

template <int Dof>
void multiply(const Island<Dof>& island, const IslandMatrix<Dof>& matrix,
              std::span<const Eigen::Matrix<double, Dof, 1>> x,
              std::span<Eigen::Matrix<double, Dof, 1>> y) {
  for (size_t i = 0; i < x.size(); ++i) y[i].noalias() = matrix.own[i].lazyProduct(x[i]);
  for (const int p : matrix.coupled) {
    const auto k = static_cast<size_t>(p);
    const auto a = static_cast<size_t>(island.pairs[k].a);
    const auto b = static_cast<size_t>(island.pairs[k].b);
    const Eigen::Matrix<double, Dof, 1> f =
        matrix.pair[k].lazyProduct(relative_motion<Dof>(x[a], x[b], matrix.shift[k]));
    y[a] += f;
    y[b] -= carried_to_b<Dof>(f, matrix.shift[k]);
  }
}

template <int Dof>
LinearResult solve_conjugate_gradients(const Island<Dof>& island, IslandMatrix<Dof>& matrix,
                                       std::span<const Eigen::Matrix<double, Dof, 1>> b,
                                       double tolerance, int max_iterations,
                                       std::span<Eigen::Matrix<double, Dof, 1>> x) {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  const size_t n = island.mass.size();
  invert_diagonals(matrix);
  auto& r = matrix.residual;
  auto& z = matrix.preconditioned;
  auto& p = matrix.direction;
  auto& q = matrix.product;
  double rz = 0;
  for (size_t i = 0; i < n; ++i) {
    x[i].setZero();
    r[i] = b[i];
    p[i].noalias() = matrix.inverse[i].lazyProduct(r[i]);
    rz += r[i].dot(p[i]);
  }
  const double goal = tolerance * tolerance * rz;
  LinearResult result;
  while (rz > goal && result.iterations < max_iterations) {
    ++result.iterations;
    multiply<Dof>(island, matrix, p, q);
    const double curvature = dot<Dof>(std::span<const Vec>(p), std::span<const Vec>(q));
    if (!(curvature > 0)) return result;
    const double step = rz / curvature;
    double rz_next = 0;
    for (size_t i = 0; i < n; ++i) {
      x[i] += step * p[i];
      r[i] -= step * q[i];
      z[i].noalias() = matrix.inverse[i].lazyProduct(r[i]);
      rz_next += r[i].dot(z[i]);
    }
    const double ratio = rz_next / rz;
    rz = rz_next;
    for (size_t i = 0; i < n; ++i) p[i] = z[i] + ratio * p[i];
  }
  result.converged = rz <= goal;
  return result;
}

template <int Dof>
void solve_direct(const Island<Dof>& island, IslandMatrix<Dof>& matrix,
                  std::span<const Eigen::Matrix<double, Dof, 1>> b,
                  std::span<Eigen::Matrix<double, Dof, 1>> x) {
  using Mat = typename IslandMatrix<Dof>::Mat;
  matrix.edges.clear();
  for (const int p : matrix.coupled) {
    const BodyPair& pair = island.pairs[static_cast<size_t>(p)];
    matrix.edges.emplace_back(pair.a, pair.b);
  }
  BlockLu<Dof>& lu = matrix.lu;
  analyse_pattern(n_bodies(island), matrix.edges, lu.pattern);
  clear_matrix(lu);
  for (size_t i = 0; i < island.mass.size(); ++i)
    lu.diagonal[static_cast<size_t>(lu.pattern.place[i])] = matrix.diagonal[i];
  for (const int p : matrix.coupled) {
    const auto k = static_cast<size_t>(p);
    const Mat X = shift_matrix<Dof>(matrix.shift[k]);
    const Mat ab = -(matrix.pair[k] * X), ba = -(X.transpose() * matrix.pair[k]);
    add_blocks<Dof>(lu, island.pairs[k].a, island.pairs[k].b, ab, ba);
  }
  factor(lu);
  solve<Dof>(lu, b, x);
}

#define TALUS_INSTANTIATE(Dof)                                                                     \
  template void prepare_matrix<Dof>(const Island<Dof>&, IslandMatrix<Dof>&);                       \
  template void update_matrix<Dof>(const Island<Dof>&, Tangent, IslandMatrix<Dof>&);                        \
  template void multiply<Dof>(const Island<Dof>&, const IslandMatrix<Dof>&,                        \
                              std::span<const Eigen::Matrix<double, Dof, 1>>,                      \
                              std::span<Eigen::Matrix<double, Dof, 1>>);                           \
  template LinearResult solve_conjugate_gradients<Dof>(                                            \
      const Island<Dof>&, IslandMatrix<Dof>&, std::span<const Eigen::Matrix<double, Dof, 1>>,      \
      double, int, std::span<Eigen::Matrix<double, Dof, 1>>);                                      \
  template void solve_direct<Dof>(const Island<Dof>&, IslandMatrix<Dof>&,                          \
                                  std::span<const Eigen::Matrix<double, Dof, 1>>,                  \
                                  std::span<Eigen::Matrix<double, Dof, 1>>);

TALUS_INSTANTIATE(6)
TALUS_INSTANTIATE(12)
#undef TALUS_INSTANTIATE

}  // namespace talus
