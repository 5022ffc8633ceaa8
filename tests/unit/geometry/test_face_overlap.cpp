// Common parts of two faces.
#include <gtest/gtest.h>

#include <vector>

#include "geometry/face_overlap.hpp"

namespace {

using namespace talus;

TEST(FaceOverlap, ShiftedSquaresHaveTheRectangleInCommon) {
  const std::vector<Vec3> one = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::vector<Vec3> other = {{0.3, 0.6, 1e-3}, {0.3, 1.6, 0}, {1.3, 1.6, 0}, {1.3, 0.6, 0}};
  const FaceOverlap common = face_overlap(one, Vec3::UnitZ(), other);
  EXPECT_NEAR(common.area, 0.7 * 0.4, 1e-15);
  EXPECT_LT((common.centre - Vec3(0.65, 0.8, 0)).norm(), 1e-15);
  for (Vec3& p : other) p.x() += 1;
  EXPECT_EQ(face_overlap(one, Vec3::UnitZ(), other).area, 0);
}

}  // namespace
