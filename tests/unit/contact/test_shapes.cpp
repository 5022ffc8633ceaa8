// Surfaces of blocks for the contact search: edges and thickness.
#include <gtest/gtest.h>

#include "contact/shapes.hpp"

namespace {

using namespace talus;

// All twelve edges of a box are convex; with a convex part missing (an L), the inner edge is not.
TEST(Shapes, KeepConvexEdgesOnly) {
  Shapes shapes;
  const Polyhedron cube = box(Vec3::Zero(), Vec3::Constant(2));
  add_shape(shapes, std::span(&cube, 1), cube, Vec3::Ones(), Mat3::Identity(), -3);
  EXPECT_EQ(edges_of(shapes, 0).size(), 12U);
  EXPECT_EQ(vertices_of(shapes, 0).size(), 8U);
  EXPECT_NEAR(shapes.radius[0], std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(shapes.thickness[0], 2, 1e-15);

  Polyhedron ell;  // L of unit thickness: 12 vertices, 18 edges, one of them concave
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0., 0.}, {2., 0.}, {2., 1.}, {1., 1.}, {1., 2.}, {0., 2.}})
      ell.vertices.emplace_back(x, y, z);
  const int bottom[] = {5, 4, 3, 2, 1, 0}, top[] = {6, 7, 8, 9, 10, 11};
  add_face(ell, bottom, -1);
  add_face(ell, top, -1);
  for (int k = 0; k < 6; ++k) {
    const int n = (k + 1) % 6, side[] = {k, n, 6 + n, 6 + k};
    add_face(ell, side, -1);
  }
  add_shape(shapes, std::span(&ell, 1), ell, Vec3(0.8, 0.8, 0.5), Mat3::Identity(), -3);
  EXPECT_EQ(edges_of(shapes, 1).size(), 17U);
}

// A column on a thin foot: the foot's upper face lies deep inside the body's extent.
TEST(Shapes, ThicknessIsTheSmallestExtentOfTheWholeBody) {
  const Polyhedron parts[] = {box(Vec3(0, 0, 0), Vec3(2, 1, 0.1)),
                              box(Vec3(0, 0, 0.1), Vec3(1, 1, 2))};
  Shapes shapes;
  add_shape(shapes, parts, parts[1], Vec3(0.5, 0.5, 1), Mat3::Identity(), -3);
  EXPECT_NEAR(shapes.thickness[0], 1, 1e-12);
}

}  // namespace
