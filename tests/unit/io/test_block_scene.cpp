// Scenes of blocks as files of other programs.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>

#include "io/block_scene.hpp"
#include "io/mesh.hpp"

namespace {

using namespace talus;

std::string written(void (*write)(const std::string&, const BlockScene&), const BlockScene& scene) {
  const std::string path = testing::TempDir() + "block_scene";
  write(path, scene);
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  return bytes;
}

void add(Polyhedron& to, const Polyhedron& body) {
  const int first = static_cast<int>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), body.vertices.begin(), body.vertices.end());
  for (int f = 0; f < n_faces(body); ++f) {
    std::vector<int> corners(face(body, f).begin(), face(body, f).end());
    for (int& v : corners) v += first;
    add_face(to, corners, 0);
  }
}

// An L of unit thickness: 3 m2 in plan, with faces that are not convex.
Polyhedron angle_bar() {
  Polyhedron body;
  for (const double z : {0., 1.})
    for (const Vec2& p : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 1), Vec2(1, 1), Vec2(1, 2), Vec2(0, 2)})
      body.vertices.emplace_back(p.x(), p.y(), z);
  add_face(body, std::array{5, 4, 3, 2, 1, 0}, 0);
  add_face(body, std::array{6, 7, 8, 9, 10, 11}, 0);
  for (int i = 0; i < 6; ++i) add_face(body, std::array{i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i}, 0);
  return body;
}

SceneBody turned(const Polyhedron& surface, const Vec3& position) {
  SceneBody body{
      connected_surfaces(surface), {position, Quat::Identity()}, moments(surface).volume, 2.5};
  body.pose.attitude = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
  return body;
}

// The triangles of a face that is not convex cover it and nothing else.
TEST(BlockScene, PlyKeepsVolumesOfBodiesThatAreNotConvex) {
  BlockScene scene;
  scene.origin = {500000, 5200000, 0};
  scene.blocks = {turned(angle_bar(), {10, 20, 30}), turned(box({0, 0, 0}, {1, 2, 3}), {0, 0, 0})};
  const std::vector<MeshBody> back = bodies_of(parse_ply(written(write_ply, scene), "scene.ply"));
  ASSERT_EQ(back.size(), 2u);
  EXPECT_NEAR(moments(back[0].surface).volume, 3, 1e-6);
  EXPECT_NEAR(moments(back[1].surface).volume, 6, 1e-6);
  EXPECT_EQ(check_surface(back[0].surface).fault, SurfaceFault::none);
  const Vec3 expected = place(scene.blocks[0].pose, moments(angle_bar()).centroid) + scene.origin;
  EXPECT_LT((moments(back[0].surface).centroid - expected).norm(), 1e-6);
}

// A block of two convex parts is one object of two parts, and the next object counts on from it.
TEST(BlockScene, ObjNamesThePartsOfABlock) {
  Polyhedron two = box({0, 0, 0}, {1, 1, 1});
  add(two, box({1, 0, 0}, {2, 1, 1}));
  BlockScene scene;
  scene.blocks = {turned(two, {0, 0, 0}), turned(angle_bar(), {5, 5, 5})};
  const std::vector<MeshBody> back = bodies_of(parse_obj(written(write_obj, scene), "scene.obj"));
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].name, "block_000000");
  EXPECT_EQ(back[0].parts.size(), 2u);
  EXPECT_EQ(back[1].name, "block_000001");
  EXPECT_NEAR(moments(back[1].surface).volume, 3, 1e-12);
}

// Two of the eight triangles meet at an unknown corner, and no vertex is left without a triangle.
TEST(BlockScene, GroundIsTheKnownTriangles) {
  Trn trn{3, 3, 2, {0, 4}, {100, 200, 0}, "", std::vector<double>(9, 7), {}};
  trn.elevation[0] = std::numeric_limits<double>::quiet_NaN();
  const SceneBody ground = ground_body(trn, {100, 100, 0});
  EXPECT_EQ(n_faces(ground.surfaces[0]), 6);
  EXPECT_EQ(ground.surfaces[0].vertices.size(), 8u);
  Vec3 area = Vec3::Zero();
  for (int f = 0; f < n_faces(ground.surfaces[0]); ++f)
    area += face_area_vector(ground.surfaces[0], f);
  EXPECT_NEAR(area.z(), 6 * 2, 1e-12);  // counter-clockwise seen from above
  for (const Vec3& v : ground.surfaces[0].vertices) EXPECT_GE(place(ground.pose, v).y(), 100);
}

}  // namespace
