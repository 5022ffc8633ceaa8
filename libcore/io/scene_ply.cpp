// libcore/io/scene_ply.cpp
// A scene as binary PLY: all triangles with their block, its speed and volume.
#include "base/text.hpp"
#include "io/scene_triangles.hpp"
#include "io/tin_ply.hpp"

namespace talus {

void write_ply(const std::string& path, const BlockScene& scene) {
  const SceneTriangles all = triangles_of(scene);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment " + scene.source +
                      "\ncomment time_s " + text(scene.time) + "\n" + crs_comments(scene.crs_wkt) +
                      "element vertex " + std::to_string(all.points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(all.triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nproperty int block\n"
                      "property float speed_m_s\nproperty float volume_m3\nend_header\n";
  for (const Vec3& p : all.points)
    for (const double x : p) append(bytes, x);
  for (const SceneTriangle& t : all.triangles) {
    append(bytes, std::uint8_t{3});
    static_assert(sizeof t == 3 * 4 + 4 + 4 + 4);  // as the header says
    append(bytes, t);
  }
  write_scene(path, bytes);
}

}  // namespace talus
