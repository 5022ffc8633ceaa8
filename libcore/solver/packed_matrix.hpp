// libcore/solver/packed_matrix.hpp
// Small symmetric matrices, lower triangle by rows: less to read and to add up than a full matrix.
// Loops are unrolled by the compiler; the order of the sums is that of the code.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace talus {

template <int N>
struct Packed {
  static constexpr int size = N * (N + 1) / 2;
  std::array<double, size> value{};

  static constexpr int at(int i, int j) { return i * (i + 1) / 2 + j; }  // i >= j
  double& operator()(int i, int j) { return value[at(i, j)]; }
  double operator()(int i, int j) const { return value[at(i, j)]; }
};

/// The lower triangle of `full`.
template <int N>
[[nodiscard]] inline Packed<N> packed(const Eigen::Matrix<double, N, N>& full) {
  Packed<N> out;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j) out(i, j) = full(i, j);
  return out;
}

template <int N>
[[nodiscard]] inline Eigen::Matrix<double, N, N> unpacked(const Packed<N>& a) {
  Eigen::Matrix<double, N, N> out;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j) out(i, j) = out(j, i) = a(i, j);
  return out;
}

template <int N>
inline void add(const Packed<N>& b, Packed<N>& a) {
#pragma GCC unroll 1
  for (std::size_t k = 0; k < a.value.size(); ++k) a.value[k] += b.value[k];
}

template <int N>
inline void subtract(const Packed<N>& b, Packed<N>& a) {
#pragma GCC unroll 1
  for (std::size_t k = 0; k < a.value.size(); ++k) a.value[k] -= b.value[k];
}

/// Inverse of a positive definite matrix, by A = L D L^T.
template <int N>
[[nodiscard]] inline Packed<N> inverse(const Packed<N>& a) {
  Packed<N> L, V, out;            // V = L D; L, of unit diagonal, becomes its inverse
  std::array<double, N> per_d{};  // 1 / D
#pragma GCC unroll 12
  for (int j = 0; j < N; ++j) {
#pragma GCC unroll 12
    for (int i = j; i < N; ++i) {
      double s = a(i, j);
#pragma GCC unroll 12
      for (int k = 0; k < j; ++k) s -= V(i, k) * L(j, k);
      V(i, j) = s;
    }
    per_d[j] = 1 / V(j, j);
#pragma GCC unroll 12
    for (int i = j + 1; i < N; ++i) L(i, j) = V(i, j) * per_d[j];
  }
#pragma GCC unroll 12
  for (int i = 0; i < N; ++i) {
    L(i, i) = 1;
#pragma GCC unroll 12
    for (int j = 0; j < i; ++j) {
      double s = L(i, j);
#pragma GCC unroll 12
      for (int k = j + 1; k < i; ++k) s += L(i, k) * L(k, j);
      L(i, j) = -s;
    }
  }
#pragma GCC unroll 12
  for (int i = 0; i < N; ++i)
#pragma GCC unroll 12
    for (int k = i; k < N; ++k) V(k, i) = L(k, i) * per_d[k];
#pragma GCC unroll 12
  for (int i = 0; i < N; ++i)
#pragma GCC unroll 12
    for (int j = 0; j <= i; ++j) {
      double s = 0;
#pragma GCC unroll 12
      for (int k = i; k < N; ++k) s += V(k, i) * L(k, j);
      out(i, j) = s;
    }
  return out;
}

}  // namespace talus
