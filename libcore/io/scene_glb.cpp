// libcore/io/scene_glb.cpp
// A scene as binary glTF 2.0 (Khronos, 2021): a node and a mesh for each block and for the ground.
// glTF has y up, so local (x, y, z) becomes (x, z, -y). Without normals a reader shades flat.
#include "base/error.hpp"
#include "base/json.hpp"
#include "geometry/triangulate.hpp"
#include "io/scene_triangles.hpp"

namespace talus {
namespace {

// Numbers of the specification: sections 3.6.2.2 (types), 3.6.1.1 (targets), 4.4 (GLB).
constexpr int float_type = 5126, unsigned_int_type = 5125;
constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr double most_bytes = 4294967295;  // its lengths have 32 bits

// Vertices and corners of all meshes, in two views of one buffer.
struct Buffers {
  std::string vertices, corners;
};

Json vertices_of(const SceneBody& body, Buffers& to) {
  const std::size_t begin = to.vertices.size();
  std::array<float, 3> low{}, high{};
  bool is_first = true;
  for (const Polyhedron& surface : body.surfaces)
    for (const Vec3& v : surface.vertices) {
      const std::array<float, 3> p{static_cast<float>(v.x()), static_cast<float>(v.z()),
                                   static_cast<float>(-v.y())};
      if (is_first) low = high = p;
      is_first = false;
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
      append(to.vertices, p);
    }
  return {{"bufferView", 0},
          {"byteOffset", begin},
          {"componentType", float_type},
          {"count", (to.vertices.size() - begin) / sizeof low},
          {"type", "VEC3"},
          {"min", low},
          {"max", high}};
}

Json corners_of(const SceneBody& body, Buffers& to) {
  const std::size_t begin = to.corners.size();
  int first = 0;  // vertex of the surface
  for (const Polyhedron& surface : body.surfaces) {
    for (int f = 0; f < n_faces(surface); ++f)
      for (const auto& [a, b, c] : triangles_of_face(surface, f))
        append(to.corners, std::array{first + a, first + b, first + c});
    first += static_cast<int>(surface.vertices.size());
  }
  return {{"bufferView", 1},
          {"byteOffset", begin},
          {"componentType", unsigned_int_type},
          {"count", (to.corners.size() - begin) / sizeof(std::uint32_t)},
          {"type", "SCALAR"}};
}

void add_body(Json& gltf, Buffers& to, const SceneBody& body, const std::string& name,
              int material) {
  const std::size_t n = gltf["meshes"].size();
  gltf["accessors"].push_back(vertices_of(body, to));
  gltf["accessors"].push_back(corners_of(body, to));
  const Json primitive = {
      {"attributes", {{"POSITION", 2 * n}}}, {"indices", 2 * n + 1}, {"material", material}};
  gltf["meshes"].push_back({{"name", name}, {"primitives", Json::array({primitive})}});
  const Vec3& at = body.pose.position;
  const Quat q = body.pose.attitude.normalized();
  gltf["nodes"].push_back({{"name", name},
                           {"mesh", n},
                           {"translation", {at.x(), at.z(), -at.y()}},
                           {"rotation", {q.x(), q.z(), -q.y(), q.w()}}});
  if (body.volume > 0)
    gltf["nodes"].back()["extras"] = {{"volume_m3", body.volume}, {"speed_m_s", body.speed}};
  gltf["scenes"][0]["nodes"].push_back(n);
}

Json material(const char* name, double red, double green, double blue) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {red, green, blue, 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", 1.0}}}};
}

Json view(std::size_t begin, std::size_t n_bytes, int target) {
  Json json = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", n_bytes}, {"target", target}};
  if (target == array_buffer) json["byteStride"] = 3 * sizeof(float);  // many accessors share it
  return json;
}

void append_chunk(std::string& glb, std::uint32_t kind, std::string bytes, char filling) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filling);
  append(glb, static_cast<std::uint32_t>(bytes.size()));
  append(glb, kind);
  glb += bytes;
}

}  // namespace

void write_glb(const std::string& path, const BlockScene& scene) {
  Buffers data;
  const Vec3& origin = scene.origin;
  Json gltf = {{"asset", {{"version", "2.0"}, {"generator", scene.source}}}, {"scene", 0}};
  gltf["scenes"][0] = {{"name", "talus"}, {"nodes", Json::array()}};
  gltf["scenes"][0]["extras"] = {{"time_s", scene.time},
                                 {"origin_m", {origin.x(), origin.y(), origin.z()}},
                                 {"crs", scene.crs_wkt}};
  for (const char* list : {"nodes", "meshes", "accessors"}) gltf[list] = Json::array();
  gltf["materials"] =
      Json::array({material("rock", 0.45, 0.4, 0.36), material("ground", 0.36, 0.4, 0.3)});
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    add_body(gltf, data, scene.blocks[b], block_name(static_cast<int>(b)), 0);
  for (const SceneBody& ground : scene.ground) add_body(gltf, data, ground, "ground", 1);
  const std::size_t n_vertices = data.vertices.size(), n_corners = data.corners.size();
  gltf["bufferViews"] = Json::array(
      {view(0, n_vertices, array_buffer), view(n_vertices, n_corners, element_array_buffer)});
  gltf["buffers"][0] = {{"byteLength", n_vertices + n_corners}};
  const std::string json = gltf.dump();
  constexpr std::size_t n_header = 12;
  std::string chunks;
  append_chunk(chunks, json_chunk, json, ' ');
  append_chunk(chunks, binary_chunk, data.vertices + data.corners, '\0');
  if (static_cast<double>(n_header + chunks.size()) > most_bytes)
    throw InputError({path}, "would have more than 4 GiB, which GLB cannot hold",
                     "export with a coarser terrain, or without --trn");
  std::string glb;
  append(glb, glb_magic);
  append(glb, std::uint32_t{2});
  append(glb, static_cast<std::uint32_t>(n_header + chunks.size()));
  write_scene(path, glb + chunks);
}

}  // namespace talus
