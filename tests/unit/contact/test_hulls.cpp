// Convex parts of blocks: faces, active edges, cover, placement.
#include <gtest/gtest.h>

#include <numbers>

#include "base/error.hpp"
#include "blocks/block_set.hpp"
#include "convex_bodies.hpp"

namespace {

using namespace talus;
using namespace talus::test;

int n_internal(const Hulls& hulls, int p) {
  int n = 0;
  for (int f = 0; f < hulls.n_faces[p]; ++f)
    n += hulls.cover[hulls.face_begin[p] + f] == FaceCover::all;
  return n;
}

TEST(Hulls, BoxHasSixFacesAndTwelveActiveEdgesWithRightAngles) {
  Bodies bodies;
  add(bodies, box(Vec3(-1, -2, -3), Vec3(1, 2, 3)), {});
  const Hulls& hulls = bodies.hulls;
  EXPECT_EQ(hulls.n_faces[0], 6);
  EXPECT_EQ(n_vertices(hulls, 0), 8);
  EXPECT_EQ(hulls.n_active_edges[0], 12);
  EXPECT_NEAR(hulls.thickness[0], 2, 1e-15);
  EXPECT_NEAR(hulls.radius[0], std::sqrt(14.0), 1e-15);
  place(bodies);
  for (const HullEdge& edge : hulls.edges) {
    const Vec3 left = normal_at(bodies.placed, edge.arc_left);
    const Vec3 right = normal_at(bodies.placed, edge.arc_right);
    const Vec3 along =
        (bodies.placed.vertices[edge.b] - bodies.placed.vertices[edge.a]).normalized();
    EXPECT_NEAR(left.cross(right).dot(along), 1, 1e-15);
  }
}

TEST(Hulls, PlacedVerticesAndPlanesFollowThePose) {
  Draws random(1);
  Bodies bodies;
  add(bodies, convex_body(random, Vec3(1, 2, 0.5), 5), {Vec3(3, -4, 5), attitude(random)});
  place(bodies);
  const Hulls& hulls = bodies.hulls;
  for (int v = 0; v < n_vertices(hulls, 0); ++v) {
    const Vec3 expected = talus::place(bodies.poses[0], hulls.vertices[v]);
    EXPECT_LT((bodies.placed.vertices[v] - expected).norm(), 1e-14);
    EXPECT_LT(outside_by(hulls, bodies.placed, 0, expected), 1e-14);
  }
}

// A stretched body's normals must be normal to its stretched faces, not the turned old normals.
TEST(Hulls, NormalsFollowTheStretch) {
  Draws random(2);
  Bodies bodies;
  add(bodies, convex_body(random, Vec3(1, 1, 1), 6), {Vec3(1, 2, 3), attitude(random)});
  Mat3 stretch = Mat3::Identity();
  stretch(0, 0) += 0.02;
  stretch(0, 1) = stretch(1, 0) = 0.01;
  place_hulls(bodies.hulls, bodies.poses, std::span(&stretch, 1), {}, bodies.placed);
  const Polyhedron check = [&] {
    Polyhedron body;
    for (int v = 0; v < n_vertices(bodies.hulls, 0); ++v)
      body.vertices.push_back(bodies.placed.vertices[v]);
    for (int f = 0; f < bodies.hulls.n_faces[0]; ++f)
      add_face(body,
               std::span(bodies.hulls.loop_vertices)
                   .subspan(bodies.hulls.loop_begin[f],
                            bodies.hulls.loop_begin[f + 1] - bodies.hulls.loop_begin[f]),
               0);
    return body;
  }();
  for (int f = 0; f < n_faces(check); ++f)
    EXPECT_LT((face_normal(check, f) - normal_at(bodies.placed, f)).norm(), 1e-12);
}

TEST(Hulls, TurningBoundsTheMotionOfEveryVertex) {
  Draws random(3);
  Bodies bodies;
  add(bodies, convex_body(random, Vec3(1, 2, 3), 4), {});
  place(bodies);
  const PlacedHulls start = bodies.placed;
  for (int k = 0; k < 50; ++k) {
    bodies.poses[0].attitude =
        Quat(Eigen::AngleAxisd(uniform(random, 0, 0.05), direction(random))) *
        bodies.poses[0].attitude;
    place(bodies);
    for (int v = 0; v < n_vertices(bodies.hulls, 0); ++v)
      EXPECT_LE((bodies.placed.vertices[v] - start.vertices[v]).norm(),
                bodies.placed.turned[0] + 1e-14);
  }
}

// However narrow a face is, the edges on both sides of it are edges of the body: no tolerance of
// lengths decides.
TEST(Hulls, EdgesBesideASliverFaceAreActive) {
  Bodies bodies;
  add(bodies, box_with_sliver(Vec3(1, 2, 3)), {});
  EXPECT_EQ(bodies.hulls.n_faces[0], 7);
  EXPECT_EQ(bodies.hulls.n_active_edges[0], 15);
}

// Two boxes side by side: the faces between them are inside the body, the edges around the seam
// flat.
TEST(Hulls, SeamBetweenFlushPartsIsInactive) {
  Bodies bodies;
  const std::vector<Polyhedron> parts = {box(Vec3(-1, 0, 0), Vec3(0, 1, 1)),
                                         box(Vec3(0, 0, 0), Vec3(1, 1, 1))};
  add(bodies, parts, {});
  for (const int p : {0, 1}) {
    EXPECT_EQ(n_internal(bodies.hulls, p), 1);
    EXPECT_EQ(bodies.hulls.n_active_edges[p], 8);
  }
}

// An L of two boxes: the inner corner is concave; the long box's side is only partly covered, so it
// stays a surface.
TEST(Hulls, ConcaveEdgeOfAnLIsInactive) {
  Bodies bodies;
  const std::vector<Polyhedron> parts = {box(Vec3(0, 0, 0), Vec3(3, 1, 1)),
                                         box(Vec3(0, 0, 1), Vec3(1, 1, 2))};
  add(bodies, parts, {});
  EXPECT_EQ(n_internal(bodies.hulls, 0), 0);
  EXPECT_EQ(n_internal(bodies.hulls, 1), 1);
  // part 1: 4 edges at the joint; three run flush into the long box, one is the concave corner
  EXPECT_EQ(bodies.hulls.n_active_edges[1], 8);
}

// A cube cut along a diagonal plane: the two cut edges are still edges of the cube, with its right
// angle, not the 45 degrees of each half.
TEST(Hulls, EdgesOfACutCubeKeepTheCubesArc) {
  const Polyhedron cube = box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const Plane diagonal{Vec3(1, -1, 0).normalized(), 0};
  const std::vector<Polyhedron> halves = {clip_convex(cube, diagonal, 0, 1e-9),
                                          clip_convex(cube, flipped(diagonal), 0, 1e-9)};
  Bodies bodies;
  add(bodies, halves, {});
  place(bodies);
  for (const int p : {0, 1}) {
    EXPECT_EQ(n_internal(bodies.hulls, p), 1);
    // nine edges of a prism; the two diagonals of top and bottom are flat
    ASSERT_EQ(bodies.hulls.n_active_edges[p], 7);
    for (int e = 0; e < 7; ++e) {
      const HullEdge& edge = bodies.hulls.edges[bodies.hulls.edge_begin[p] + e];
      const int first = bodies.hulls.face_begin[p];
      EXPECT_NEAR(normal_at(bodies.placed, first + edge.arc_left)
                      .dot(normal_at(bodies.placed, first + edge.arc_right)),
                  0, 1e-12);
    }
  }
}

TEST(Hulls, PartThatIsNotConvexIsRefused) {
  Polyhedron dented = box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  dented.vertices[0] = Vec3(0.5, 0.5, 0.5);
  Bodies bodies;
  EXPECT_THROW(add(bodies, dented, {}), InputError);
  Polyhedron open = box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  open.face_begin.pop_back();
  open.face_tag.pop_back();
  open.face_vertices.resize(static_cast<std::size_t>(open.face_begin.back()));
  EXPECT_THROW(add(bodies, open, {}), InputError);
}

// Parts of a body that were told to meet but do not, and a part without any other: the bare faces
// are the body's surface.
TEST(Hulls, FaceInTheRockThatNothingCoversIsBare) {
  Polyhedron one = box(Vec3(-1, 0, 0), Vec3(0, 1, 1)), other = box(Vec3(2, 0, 0), Vec3(3, 1, 1));
  for (int f = 0; f < n_faces(one); ++f)
    if (face_normal(one, f).x() > 0.5) one.face_tag[static_cast<std::size_t>(f)] = face_internal;
  Bodies bodies;
  const std::vector<Polyhedron> parts = {one, other};
  add(bodies, parts, {});
  add(bodies, one, {});
  for (const int p : {0, 2}) {
    EXPECT_EQ(n_internal(bodies.hulls, p), 0);
    EXPECT_EQ(bodies.hulls.n_active_edges[p], 12);
  }
}

}  // namespace
