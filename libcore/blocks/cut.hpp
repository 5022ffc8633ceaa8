// libcore/blocks/cut.hpp
// Cuts the mass between ground and bed by joints into convex cells that know their neighbours.
// in:    ground and bed TRN, outline of the mass, joints
// out:   a cell complex: one cell for each part of a triangle's column in each joint cell
// method: the mass starts as sewn prisms (CGAL Linear_cell_complex), one a triangle of the TRN, and
//         is cut along a binary tree of joint cells. Faces, edges and vertices are shared, so the
//         cells fill the mass exactly whatever the rounding of the cut points is.
#pragma once

#include <vector>

#include "base/progress.hpp"
#include "blocks/area.hpp"
#include "blocks/joint_sets.hpp"
#include "geometry/polyhedron.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Origin of a face of the complex, besides joints (>= 0: index of the joint).
enum CutFace : int {
  cut_terrain = -1,
  cut_failure = -2,
  cut_wall = -3,  ///< vertical, in the rock: there is rock on both sides
  cut_side = -4,  ///< vertical, along the outline of the mass
};

/// Darts (half-edges of half-faces): each cell has each of its faces once, each face of a cell runs
/// counter-clockwise from outside. Arrays over darts have (n_darts), over half-faces (n_faces).
struct CellComplex {  // clang-format off
  std::vector<Vec3> vertices;        ///< local [m]                                       (n_vertices)
  std::vector<int> dart_vertex;      ///< where the dart starts
  std::vector<int> dart_next;        ///< around its face
  std::vector<int> dart_twin;        ///< other face of the same cell at this edge
  std::vector<int> dart_opposite;    ///< same edge and face in the neighbour cell, -1 = outside
  std::vector<int> dart_face;        ///< half-face of the dart
  std::vector<int> face_dart;        ///< a dart of the half-face                         (n_faces)
  std::vector<int> face_made_by;     ///< CutFace or index of the joint
  std::vector<int> face_cell;        ///< cell that the half-face belongs to
  std::vector<int> cell_leaf;        ///< leaf that the cell lies in                      (n_cells)
  std::vector<Polyhedron> leaves;    ///< joint cells, convex, within the box of the mass; cut by
                                     ///< the sides of the outline that cross them     (n_leaves)
  std::vector<int> leaf_joint_cell;  ///< joint cell of each leaf; leaves are ordered by joint cell
  int n_uncut = 0;                   ///< cells that a joint should have cut and could not; 0 is sound
};  // clang-format on

/// One cell as a convex polyhedron; face_tag = CutFace or joint.
[[nodiscard]] std::vector<Polyhedron> cells_as_polyhedra(const CellComplex& complex);

/// Cuts the mass inside `area`; without rings, all rock between ground and bed. Rock on both sides
/// of the line of a side that ends in a joint cell, as at a re-entrant corner, hangs together
/// through a cut_wall there. Vertices nearer to a joint than 1e-8 of the mass's diagonal lie on it,
/// which makes joints that coincide with grid lines, with the bed or with each other harmless.
///
/// A joint with discs cuts a joint cell only when its discs cover all of its section there, so
/// that rock which it does not separate stays in one piece, whatever the order of the joints.
[[nodiscard]] CellComplex cut_mass(const Trn& ground, const Trn& bed, const Area& area,
                                   const std::vector<Joint>& joints,
                                   const ProgressFunction& progress = {});

}  // namespace talus
