// Triangles of all bodies of a scene, and numbers as bytes of a file.
#include "io/scene_triangles.hpp"

#include "base/write_bytes.hpp"
#include "geometry/triangulate.hpp"

namespace talus {
namespace {

void add_body(SceneTriangles& all, const SceneBody& body, int block, const Vec3& origin) {
  for (const Polyhedron& surface : body.surfaces) {
    const auto first = static_cast<std::int32_t>(all.points.size());
    for (const Vec3& v : surface.vertices) all.points.push_back(place(body.pose, v) + origin);
    for (int f = 0; f < n_faces(surface); ++f)
      for (const auto& [a, b, c] : triangles_of_face(surface, f))
        all.triangles.push_back({{first + a, first + b, first + c},
                                 block,
                                 static_cast<float>(body.speed),
                                 static_cast<float>(body.volume)});
  }
}

}  // namespace

SceneTriangles triangles_of(const BlockScene& scene) {
  SceneTriangles all;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    add_body(all, scene.blocks[b], static_cast<int>(b), scene.origin);
  for (const SceneBody& ground : scene.ground) add_body(all, ground, -1, scene.origin);
  return all;
}

void write_scene(const std::string& path, const std::string& bytes) {
  write_bytes(path, {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

}  // namespace talus
