#include "dda/island_matrix.hpp"

#include <cmath>

namespace talus {
namespace {

using std::size_t;

/// Sum of the stick stiffness k T(r)^T T(r) of a pair's contacts. For rigid bodies its moments do:
/// T^T T = [I, -S; S, |r|^2 I - r r^T] with S = [r]x.
template <int Dof>
struct StickSum {
  Packed<Dof> sum;
  void add(double k, const Vec3& arm) {
    for (int axis = 0; axis < 3; ++axis)
      add_outer<Dof>(k, generalised<Dof>(arm, Vec3::Unit(axis)), sum);
  }
  void add_to(Packed<Dof>& W) const { talus::add(sum, W); }
};

template <>
struct StickSum<6> {
  double k_sum = 0;
  Vec3 first = Vec3::Zero();  // sum k r
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  // sum k r r^T
  void add(double k, const Vec3& arm) {
    const Vec3 kr = k * arm;
    k_sum += k;
    first += kr;
    xx += kr.x() * arm.x(), yy += kr.y() * arm.y(), zz += kr.z() * arm.z();
    xy += kr.x() * arm.y(), xz += kr.x() * arm.z(), yz += kr.y() * arm.z();
  }
  void add_to(Packed<6>& W) const {
    for (int i = 0; i < 3; ++i) W(i, i) += k_sum;
    W(3, 1) -= first.z(), W(3, 2) += first.y();
    W(4, 0) += first.z(), W(4, 2) -= first.x();
    W(5, 0) -= first.y(), W(5, 1) += first.x();
    W(3, 3) += yy + zz, W(4, 4) += xx + zz, W(5, 5) += xx + yy;
    W(4, 3) -= xy, W(5, 3) -= xz, W(5, 4) -= yz;
  }
};

// q of a contact acting along `direction`.
template <int Dof>
Eigen::Matrix<double, Dof, 1> along(const IslandRow& row, const Vec3& direction) {
  return generalised<Dof>(row.arm, direction);
}

// A slipping contact: k_n n n^T and the stiffness across the slip. Exact: the mean direction e turns
// with that at the end of the step, and the friction bound adds -tan(phi) k_n e n^T.
template <int Dof>
void add_slip(const IslandRow& row, Packed<Dof>& W, Eigen::Matrix<double, Dof, Dof>* rest) {
  const Vec3& n = row.normal;
  const Eigen::Matrix<double, Dof, 1> q_n = along<Dof>(row, n);
  add_outer<Dof>(row.normal_damping, q_n, W);
  if (!(row.slip_stiffness > 0)) return;
  const double p_n = n.dot(row.impulse);
  const Vec3 e = (p_n * n - row.impulse).normalized();
  const Vec3 across = n.cross(e);
  if (!rest) return add_outer<Dof>(row.slip_stiffness, along<Dof>(row, across), W);
  const double cosine = e.dot(row.slip_start);
  const Vec3 end = cosine > 0 ? Vec3((2 * e - cosine * row.slip_start).normalized()) : e;
  *rest += row.slip_stiffness * along<Dof>(row, across) * along<Dof>(row, n.cross(end)).transpose();
  if (p_n > 0) *rest -= row.friction * row.normal_damping * along<Dof>(row, e) * q_n.transpose();
}

// W of one pair, and whether a contact presses. Stick: k_t I + (k_n - k_t) n n^T.
template <int Dof>
[[gnu::flatten]] bool sum_tangents(std::span<const IslandRow> rows, Packed<Dof>& W_out,
                  Eigen::Matrix<double, Dof, Dof>* rest) {
  Packed<Dof> W;
  StickSum<Dof> stick;
  bool closed = false;
  for (const IslandRow& row : rows) {
    if (row.waits_for_impact || row.state == ContactState::open) continue;
    closed = true;
    if (row.state == ContactState::stick) {
      stick.add(row.shear_damping, row.arm);
      if (row.normal_damping != row.shear_damping)
        add_outer<Dof>(row.normal_damping - row.shear_damping, along<Dof>(row, row.normal), W);
    } else {
      add_slip<Dof>(row, W, rest);
    }
  }
  stick.add_to(W);
  W_out = W;
  return closed;
}

template <int Dof>
Eigen::Matrix<double, Dof, Dof> shift_matrix(const Vec3& shift) {
  Eigen::Matrix<double, Dof, Dof> X = Eigen::Matrix<double, Dof, Dof>::Identity();
  X.template topRows<3>() = displacement_matrix(shift).template leftCols<Dof>();
  return X;
}

// D += X^T W X, what the pair adds to the diagonal block of B.
template <int Dof>
void add_carried(const Packed<Dof>& W, const Vec3& shift, Packed<Dof>& D) {
  const Eigen::Matrix<double, Dof, Dof> X = shift_matrix<Dof>(shift);
  add(packed<Dof>(X.transpose() * unpacked(W) * X), D);
}

// For rigid bodies X = [I, -S; 0, I] with S = [shift]x: W = [K, .; L, C] becomes
// [K, .; L + S K, C - L S + S (L + S K)^T].
template <>
void add_carried<6>(const Packed<6>& W, const Vec3& shift, Packed<6>& D) {
  const Mat3 K = (Mat3() << W(0, 0), W(1, 0), W(2, 0), W(1, 0), W(1, 1), W(2, 1), W(2, 0), W(2, 1),
                  W(2, 2))
                     .finished();
  const Mat3 L = (Mat3() << W(3, 0), W(3, 1), W(3, 2), W(4, 0), W(4, 1), W(4, 2), W(5, 0), W(5, 1),
                  W(5, 2))
                     .finished();
  Mat3 carried;
  for (int j = 0; j < 3; ++j) carried.col(j) = L.col(j) + shift.cross(K.col(j));
  for (int i = 0; i < 3; ++i) {
    const Vec3 left = shift.cross(L.row(i));         // -(L S)_ij, row i
    const Vec3 right = shift.cross(carried.row(i));  // (S carried^T)_ji, column i
    for (int j = 0; j <= i; ++j) D(i, j) += W(i, j);
    for (int j = 0; j < 3; ++j) D(3 + i, j) += carried(i, j);
    for (int j = 0; j <= i; ++j) D(3 + i, 3 + j) += W(3 + i, 3 + j) + left[j];
    for (int j = i; j < 3; ++j) D(3 + j, 3 + i) += right[j];
  }
}

template <int Dof>
double dot(std::span<const Eigen::Matrix<double, Dof, 1>> x,
           std::span<const Eigen::Matrix<double, Dof, 1>> y) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += x[i].dot(y[i]);
  return sum;
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
  matrix.pair.resize(n_pairs);
  matrix.pair_closed.resize(n_pairs);
  for (auto* blocks : {&matrix.own, &matrix.diagonal, &matrix.inverse}) blocks->resize(n);
  for (auto* vectors : {&matrix.residual, &matrix.preconditioned, &matrix.direction, &matrix.product})
    vectors->resize(n);
}

template <int Dof>
void update_tangents(const Island<Dof>& island, Tangent tangent, IslandMatrix<Dof>& matrix) {
  const size_t n_pairs = island.pairs.size();
  if (tangent != matrix.tangent) matrix.pair_changed.assign(n_pairs, 1);
  matrix.tangent = tangent;
  const bool exact = tangent == Tangent::exact;
  if (exact) matrix.rest.resize(n_pairs);
  matrix.coupled.clear();
  for (size_t p = 0; p < n_pairs; ++p) {
    const BodyPair& pair = island.pairs[p];
    if (matrix.pair_changed[p]) {
      const std::span<const IslandRow> rows(island.rows.data() + pair.row_begin,
                                            static_cast<size_t>(pair.row_end - pair.row_begin));
      if (exact) matrix.rest[p].setZero();
      matrix.pair_closed[p] =
          sum_tangents<Dof>(rows, matrix.pair[p], exact ? &matrix.rest[p] : nullptr);
      matrix.pair_changed[p] = 0;
      matrix.body_changed[static_cast<size_t>(pair.a)] = 1;
      if (pair.b >= 0) matrix.body_changed[static_cast<size_t>(pair.b)] = 1;
    }
    if (pair.b >= 0 && matrix.pair_closed[p]) matrix.coupled.push_back(static_cast<int>(p));
  }
}

template <int Dof>
[[gnu::flatten]] void update_diagonals(const Island<Dof>& island, IslandMatrix<Dof>& matrix) {
  for (size_t i = 0; i < island.mass.size(); ++i)
    if (matrix.body_changed[i]) matrix.own[i] = matrix.diagonal[i] = packed<Dof>(island.mass[i]);
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    if (!matrix.pair_closed[p]) continue;
    const BodyPair& pair = island.pairs[p];
    const auto a = static_cast<size_t>(pair.a);
    if (matrix.body_changed[a]) {
      add(matrix.pair[p], matrix.diagonal[a]);
      if (pair.b < 0) add(matrix.pair[p], matrix.own[a]);
    }
    if (pair.b >= 0 && matrix.body_changed[static_cast<size_t>(pair.b)])
      add_carried<Dof>(matrix.pair[p], matrix.shift[p], matrix.diagonal[static_cast<size_t>(pair.b)]);
  }
  for (size_t i = 0; i < island.mass.size(); ++i) {
    if (matrix.body_changed[i]) matrix.inverse[i] = inverse(matrix.diagonal[i]);
    matrix.body_changed[i] = 0;
  }
}

template <int Dof>
[[gnu::flatten]] void multiply(const Island<Dof>& island, const IslandMatrix<Dof>& matrix,
              std::span<const Eigen::Matrix<double, Dof, 1>> x,
              std::span<Eigen::Matrix<double, Dof, 1>> y) {
  for (size_t i = 0; i < x.size(); ++i) y[i] = product(matrix.own[i], x[i]);
  for (const int p : matrix.coupled) {
    const auto k = static_cast<size_t>(p);
    const auto a = static_cast<size_t>(island.pairs[k].a);
    const auto b = static_cast<size_t>(island.pairs[k].b);
    const Eigen::Matrix<double, Dof, 1> f =
        product<Dof>(matrix.pair[k], relative_motion<Dof>(x[a], x[b], matrix.shift[k]));
    y[a] += f;
    y[b] -= carried_to_b<Dof>(f, matrix.shift[k]);
  }
}

template <int Dof>
[[gnu::flatten]] LinearResult solve_conjugate_gradients(const Island<Dof>& island, IslandMatrix<Dof>& matrix,
                                       std::span<const Eigen::Matrix<double, Dof, 1>> b,
                                       double tolerance, int max_iterations,
                                       std::span<Eigen::Matrix<double, Dof, 1>> x) {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  const size_t n = island.mass.size();
  auto& r = matrix.residual;
  auto& z = matrix.preconditioned;
  auto& p = matrix.direction;
  auto& q = matrix.product;
  double rz = 0;
  for (size_t i = 0; i < n; ++i) {
    x[i].setZero();
    r[i] = b[i];
    p[i] = product(matrix.inverse[i], r[i]);
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
      z[i] = product(matrix.inverse[i], r[i]);
      rz_next += r[i].dot(z[i]);
    }
    const double ratio = rz_next / rz;
    rz = rz_next;
    for (size_t i = 0; i < n; ++i) p[i] = z[i] + ratio * p[i];
  }
  result.converged = rz <= goal;
  return result;
}

namespace {

template <int Dof>
void sum_blocks(const Island<Dof>& island, IslandMatrix<Dof>& matrix) {
  using Mat = typename IslandMatrix<Dof>::Mat;
  BlockLu<Dof>& lu = matrix.lu;
  const auto diagonal_of = [&](int body) -> Mat& {
    return lu.diagonal[static_cast<size_t>(lu.pattern.place[static_cast<size_t>(body)])];
  };
  for (int i = 0; i < n_bodies(island); ++i) diagonal_of(i) = island.mass[static_cast<size_t>(i)];
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    if (!matrix.pair_closed[p]) continue;
    const BodyPair& pair = island.pairs[p];
    Mat W = unpacked(matrix.pair[p]);
    if (matrix.tangent == Tangent::exact) W += matrix.rest[p];
    diagonal_of(pair.a) += W;
    if (pair.b < 0) continue;
    const Mat X = shift_matrix<Dof>(matrix.shift[p]);
    const Mat WX = W.lazyProduct(X), XtW = X.transpose().lazyProduct(W);
    diagonal_of(pair.b) += X.transpose().lazyProduct(WX);
    add_blocks<Dof>(lu, pair.a, pair.b, -WX, -XtW);
  }
}

}  // namespace

template <int Dof>
void solve_direct(const Island<Dof>& island, IslandMatrix<Dof>& matrix,
                  std::span<const Eigen::Matrix<double, Dof, 1>> b,
                  std::span<Eigen::Matrix<double, Dof, 1>> x) {
  matrix.edges.clear();
  for (const int p : matrix.coupled) {
    const BodyPair& pair = island.pairs[static_cast<size_t>(p)];
    matrix.edges.emplace_back(pair.a, pair.b);
  }
  analyse_pattern(n_bodies(island), matrix.edges, matrix.lu.pattern);
  clear_matrix(matrix.lu);
  sum_blocks(island, matrix);
  factor(matrix.lu);
  solve<Dof>(matrix.lu, b, x);
}

#define TALUS_INSTANTIATE(Dof)                                                                     \
  template void prepare_matrix<Dof>(const Island<Dof>&, IslandMatrix<Dof>&);                       \
  template void update_tangents<Dof>(const Island<Dof>&, Tangent, IslandMatrix<Dof>&);  \
  template void update_diagonals<Dof>(const Island<Dof>&, IslandMatrix<Dof>&);  \
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
