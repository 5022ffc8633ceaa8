// libcore/blocks/block_set.hpp: public
// The blocks of a site as flat arrays: written by talus-blocks, moved by talus-dda.
// in:    the cut rock mass, meshes or shapes
// out:   bodies at rest, in place, relative to `origin`; see docs/reference/formats.md for the HDF5
// names
//
// A body is one or several convex parts that move as one. The parts are its collision shape; the
// shell is its closed outward surface, for moments, friction by face and for looking at. Both index
// the same vertices; where there is one part, its faces and the shell are the same.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "geometry/polyhedron.hpp"

namespace talus {

/// Origin of a face; joint sets count from 0.
enum FaceOrigin : int {
  face_terrain = -1,      ///< the ground surface, or any face of a block that was not cut here
  face_failure = -2,      ///< the failure surface below the mass
  face_internal = -3,     ///< in the rock: between convex parts, or where a ring was parted
  face_source_side = -4,  ///< the vertical wall along the outline of the source
};

struct BlockSet {  // clang-format off
  Vec3 origin = Vec3::Zero();   ///< map coordinates of the local zero [m]
  std::string crs_wkt;          ///< projected, metres; empty when unknown
  std::string content_hash;     ///< SHA-256 over inputs and options that made the blocks
  std::vector<std::string> ground_digests;  ///< trn_digest of the terrains that they were made for
  std::vector<std::string> material_names;   ///< names of [material.*]               (n_materials)
  std::vector<std::string> joint_set_names;  ///< names of [joints.*]                 (n_joint_sets)

  // geometry; vertices are ordered by block
  std::vector<Vec3> vertices;              ///< local coordinates [m]                     (n_vertices)
  std::vector<int> block_vertex_begin{0};  ///< vertices of block b: [b], [b + 1)         (n_blocks + 1)
  // shells
  std::vector<int> face_vertices;          ///< into `vertices`, counter-clockwise from outside
  std::vector<int> face_begin{0};          ///< first entry of face f in `face_vertices`  (n_faces + 1)
  std::vector<int> joint_set;              ///< FaceOrigin or joint set of face f         (n_faces)
  std::vector<int> block_face_begin{0};    ///< shell of block b: faces [b], [b + 1)      (n_blocks + 1)
  // convex parts
  std::vector<int> part_face_vertices;     ///< into `vertices`, counter-clockwise from outside
  std::vector<int> part_face_begin{0};     ///< first entry of face f                     (n_part_faces + 1)
  std::vector<int> part_joint_set;         ///< FaceOrigin or joint set of face f         (n_part_faces)
  std::vector<int> part_begin{0};          ///< faces of part p: [p], [p + 1)             (n_parts + 1)
  std::vector<int> convex_part_begin{0};   ///< parts of block b: [b], [b + 1)            (n_blocks + 1)

  // bodies
  std::vector<int> material;                 ///< index into `material_names`         (n_blocks)
  std::vector<double> volume;                ///< [m3]                                (n_blocks)
  std::vector<Vec3> centroid;                ///< local coordinates [m]               (n_blocks)
  std::vector<Mat3> second_moment;           ///< central, world axes, theory 1.3 [m5]  (n_blocks)
  std::vector<Vec3> velocity;                ///< at the start [m/s]                  (n_blocks)
  std::vector<Vec3> spin;                    ///< at the start, world axes [rad/s]    (n_blocks)
  std::vector<double> weight;  ///< in statistics, e.g. events a year; empty: 1 each  (n_blocks)

  // bodies that share a joint face as cut, for reports; a < b, sorted. Bonds act on the faces that
  // start_bonds() finds where the blocks are.
  std::vector<std::array<int, 2>> pair_blocks;  ///< a, b                             (n_pairs)
  std::vector<int> pair_joint_set;              ///< joint set of the shared face     (n_pairs)
  std::vector<double> pair_area;                ///< shared area [m2]  (n_pairs)
  std::vector<Vec3> pair_normal;                ///< unit, from a to b                (n_pairs)
  std::vector<Vec3> pair_point;                 ///< centre of the shared face [m]    (n_pairs)
};  // clang-format on

[[nodiscard]] inline int n_blocks(const BlockSet& set) {
  return static_cast<int>(set.volume.size());
}
[[nodiscard]] inline int n_parts(const BlockSet& set) {
  return static_cast<int>(set.part_begin.size()) - 1;
}

/// A body to be added.
struct Body {
  std::vector<Polyhedron>
      parts;         ///< convex, no overlap, at least one; face_tag = FaceOrigin or set
  Polyhedron shell;  ///< closed surface of the union; without faces: those of the parts
  int material = 0;
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]
  double weight = 1;             ///< in statistics
};
/// Appends a body; its moments are those of its shell, or of its parts taken together.
void add_body(BlockSet& set, const Body& body);

/// The shell of block b, or convex part p, as a polyhedron of its own.
[[nodiscard]] Polyhedron block_shell(const BlockSet& set, int b);
[[nodiscard]] Polyhedron convex_part(const BlockSet& set, int p);

/// Outer surfaces of block b: its shell where that is one connected surface, as of blocks that were
/// kept exact; else its convex parts, since only their common place says that they are one body.
[[nodiscard]] std::vector<Polyhedron> block_surfaces(const BlockSet& set, int b);

/// Names the first promise of this header that `set` breaks (sizes, indices, order, finite numbers,
/// closed shells); empty when it keeps all.
[[nodiscard]] std::string broken_promise(const BlockSet& set);

}  // namespace talus
