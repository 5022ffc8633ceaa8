// Side of a line, exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "geometry/orient2d.hpp"

namespace {

using talus::orient2d;
using talus::Vec2;

// Whole numbers below 2^40 have exact products in 128 bits: the closed form without rounding.
int exact_sign(const Vec2& a, const Vec2& b, const Vec2& c) {
  __extension__ using Wide = __int128;
  const auto wide = [](double value) { return static_cast<Wide>(std::llround(value)); };
  const Wide area = (wide(a.x()) - wide(c.x())) * (wide(b.y()) - wide(c.y())) -
                    (wide(a.y()) - wide(c.y())) * (wide(b.x()) - wide(c.x()));
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

TEST(Orient2d, HasTheSignOfTheExactAreaNearCollinearity) {
  talus::Random random(1, "orient2d");
  int n_zero = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 a(static_cast<double>(random.below(1ULL << 40)),
                 static_cast<double>(random.below(1ULL << 40)));
    const Vec2 step(static_cast<double>(random.below(1000)) + 1,
                    static_cast<double>(random.below(1000)));
    const Vec2 b = a + step * static_cast<double>(random.below(100000) + 1);
    Vec2 c = a + step * static_cast<double>(random.below(100000));
    c.x() += static_cast<double>(random.below(3)) - 1;  // on the line, or one unit beside it
    const int expected = exact_sign(a, b, c);
    n_zero += expected == 0 ? 1 : 0;
    ASSERT_EQ(orient2d(a, b, c), expected)
        << a.transpose() << " " << b.transpose() << " " << c.transpose();
  }
  EXPECT_GT(n_zero, 1000);
}

TEST(Orient2d, TurnsItsSignWithTheOrderOfThePoints) {
  const Vec2 a(0.1, 0.1), b(0.1 + 1e-17, 0.7), c(0.3, 0.1 + 1e-16);
  EXPECT_EQ(orient2d(a, b, c), -orient2d(b, a, c));
  EXPECT_EQ(orient2d(a, b, c), orient2d(b, c, a));
  EXPECT_EQ(orient2d(a, a, c), 0);
}

}  // namespace
