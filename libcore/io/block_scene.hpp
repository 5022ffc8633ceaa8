// libcore/io/block_scene.hpp: public
// Blocks at one moment, and the ground below them, as files that other programs open.
// in:    blocks in body axes with their poses, the terrain if it is wanted
// out:   PLY, OBJ, GLB (glTF 2.0) or VTP (VTK); contents: docs/tools/talus-export.md
//
// Formats of double precision have map coordinates. GLB has single precision, and local ones.
#pragma once

#include <string>
#include <vector>

#include "geometry/polyhedron.hpp"
#include "motion/pose.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A block, or the ground as a body of its own.
struct SceneBody {
  std::vector<Polyhedron> surfaces;  ///< one, or those of its parts; body axes [m]
  Pose pose{};                       ///< local
  double volume = 0;                 ///< 0: the ground [m3]
  double speed = 0;                  ///< [m/s]
};

struct BlockScene {
  std::vector<SceneBody> blocks;
  std::vector<SceneBody> ground;  ///< one, or none
  Vec3 origin = Vec3::Zero();     ///< map coordinates of the local zero [m]
  std::string crs_wkt;            ///< empty when unknown
  std::string source;             ///< tool and run of its origin, in words
  double time = 0;                ///< [s]
};

/// The surfaces that a shell is made of; face tags are those of `shell` and must be 0.
[[nodiscard]] std::vector<Polyhedron> connected_surfaces(Polyhedron shell);

/// The known triangles of a terrain as one open surface, local to `origin`.
[[nodiscard]] SceneBody ground_body(const Trn& trn, const Vec3& origin);

/// "block_000012": the name of block 12 in files.
[[nodiscard]] std::string block_name(int block);

/// Writes to `path`, synced. Equal scenes give equal bytes. Throws InputError when it cannot be
/// written.
void write_ply(const std::string& path, const BlockScene& scene);
void write_obj(const std::string& path, const BlockScene& scene);
void write_glb(const std::string& path, const BlockScene& scene);
void write_vtp(const std::string& path, const BlockScene& scene);

}  // namespace talus
