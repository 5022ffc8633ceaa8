// libcore/io/scene_triangles.hpp
// All bodies of a scene as one list of triangles, and numbers as bytes of a file.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "io/block_scene.hpp"

namespace talus {

struct SceneTriangle {
  std::array<std::int32_t, 3> corners{};  ///< into SceneTriangles::points
  std::int32_t block = -1;                ///< -1: ground
  float speed = 0;                        ///< [m/s]
  float volume = 0;                       ///< of the block [m3]
};

struct SceneTriangles {
  std::vector<Vec3> points;  ///< map coordinates [m]
  std::vector<SceneTriangle> triangles;
};

/// Blocks in their order, then the ground.
[[nodiscard]] SceneTriangles triangles_of(const BlockScene& scene);

/// Appends a number in the order of bytes that the formats have.
template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t n = bytes.size();
  bytes.resize(n + sizeof value);
  std::memcpy(bytes.data() + n, &value, sizeof value);
}

/// Writes text or bytes to `path`, synced.
void write_scene(const std::string& path, const std::string& bytes);

}  // namespace talus
