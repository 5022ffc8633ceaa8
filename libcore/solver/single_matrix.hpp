// libcore/solver/single_matrix.hpp
// 6 x 6 matrices and vectors of rigid motion in single precision, for what only has to point the
// way: the direction that conjugate gradients find is good to a few hundredths, and the residual
// that decides is computed in double. Four numbers at a time: a register of any x86-64 or arm64.
#pragma once

#include "base/types.hpp"
#include "motion/displacement.hpp"
#include "solver/packed_matrix.hpp"

namespace talus {

using Four __attribute__((vector_size(16))) = float;

/// A motion (velocity, spin) or an impulse (linear, angular), each with a fourth number that is 0.
struct SingleVector {
  Four linear = {0, 0, 0, 0}, angular = {0, 0, 0, 0};
};

/// By columns, upper half, then lower half.
struct SingleMatrix {
  Four upper[6], lower[6];
};

[[nodiscard]] inline Four single(const Vec3& v) {
  return Four{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
}
[[nodiscard]] inline SingleVector single(const Vec6& v) {
  return {single(Vec3(v.head<3>())), single(Vec3(v.tail<3>()))};
}
[[nodiscard]] inline Vec6 in_double(const SingleVector& v) {
  Vec6 out;
  out << v.linear[0], v.linear[1], v.linear[2], v.angular[0], v.angular[1], v.angular[2];
  return out;
}
[[nodiscard]] inline SingleMatrix single(const Packed<6>& a) {
  SingleMatrix out;
  const auto at = [&](int i, int j) { return static_cast<float>(i < j ? a(j, i) : a(i, j)); };
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    out.upper[j] = Four{at(0, j), at(1, j), at(2, j), 0};
    out.lower[j] = Four{at(3, j), at(4, j), at(5, j), 0};
  }
  return out;
}

[[gnu::always_inline]] inline SingleVector operator+(const SingleVector& a, const SingleVector& b) {
  return {a.linear + b.linear, a.angular + b.angular};
}
[[gnu::always_inline]] inline SingleVector operator-(const SingleVector& a, const SingleVector& b) {
  return {a.linear - b.linear, a.angular - b.angular};
}
[[gnu::always_inline]] inline SingleVector operator*(float s, const SingleVector& a) {
  return {s * a.linear, s * a.angular};
}

[[gnu::always_inline]] inline double dot(const SingleVector& a, const SingleVector& b) {
  const Four product = a.linear * b.linear + a.angular * b.angular;
  return static_cast<double>(product[0] + product[1] + product[2]);
}

[[gnu::always_inline]] inline Four cross(const Four& a, const Four& b) {
  const Four a_next = __builtin_shufflevector(a, a, 1, 2, 0, 3);
  const Four b_next = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const Four out = a * b_next - a_next * b;
  return __builtin_shufflevector(out, out, 1, 2, 0, 3);
}

[[gnu::always_inline]] inline SingleVector product(const SingleMatrix& A, const SingleVector& x) {
  const Four x0 = __builtin_shufflevector(x.linear, x.linear, 0, 0, 0, 0);
  const Four x1 = __builtin_shufflevector(x.linear, x.linear, 1, 1, 1, 1);
  const Four x2 = __builtin_shufflevector(x.linear, x.linear, 2, 2, 2, 2);
  const Four x3 = __builtin_shufflevector(x.angular, x.angular, 0, 0, 0, 0);
  const Four x4 = __builtin_shufflevector(x.angular, x.angular, 1, 1, 1, 1);
  const Four x5 = __builtin_shufflevector(x.angular, x.angular, 2, 2, 2, 2);
  return {(A.upper[0] * x0 + A.upper[1] * x1) + (A.upper[2] * x2 + A.upper[3] * x3) +
              (A.upper[4] * x4 + A.upper[5] * x5),
          (A.lower[0] * x0 + A.lower[1] * x1) + (A.lower[2] * x2 + A.lower[3] * x3) +
              (A.lower[4] * x4 + A.lower[5] * x5)};
}

}  // namespace talus
