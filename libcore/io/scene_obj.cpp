// libcore/io/scene_obj.cpp
// A scene as OBJ: an object for each block, with its faces as polygons.
#include "base/text.hpp"
#include "io/mesh.hpp"
#include "io/scene_triangles.hpp"

namespace talus {

void write_obj(const std::string& path, const BlockScene& scene) {
  std::string bytes = "# " + scene.source + "\n# time_s " + text(scene.time) + "\n";
  std::size_t n_before = 0;
  const auto add = [&](const SceneBody& body, const std::string& name) {
    std::vector<Polyhedron> surfaces = body.surfaces;
    for (Polyhedron& surface : surfaces)
      for (Vec3& v : surface.vertices) v = place(body.pose, v);
    bytes += obj_text(surfaces, name, scene.origin, n_before);
    for (const Polyhedron& surface : surfaces) n_before += surface.vertices.size();
  };
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    add(scene.blocks[b], block_name(static_cast<int>(b)));
  for (const SceneBody& ground : scene.ground) add(ground, "ground");
  write_scene(path, bytes);
}

}  // namespace talus
