// libcore/scene/bond_face.hpp: public
// Whether a bonded face holds its load: one rule for faces between blocks and on the ground.
// in:    the corners of the face, the forces there, their shares of the area and its strength
// theory 1.7 and "Bonds"; docs/guide/limits.md
#pragma once

#include <span>
#include <vector>

#include "contact/ground.hpp"

namespace talus {

/// A bond ends where its face has opened wider than this part of the smaller block's radius; faces
/// farther apart do not begin bonded.
inline constexpr double bonded_gap_ratio = 1e-4;

/// A corner of a bonded face.
struct BondCorner {
  Vec3 point = Vec3::Zero();  ///< [m]
  Vec3 force = Vec3::Zero();  ///< on A [N]
  double area = 0;            ///< its share of the face [m2]
  double cohesion = 0;        ///< [Pa]
  double tension = 0;         ///< tensile strength [Pa]
  double friction = 0;        ///< tan(phi) [-]
  int polygon = 0;            ///< corners of one convex part of the face have the same number
};

/// A bonded face and its load over a substep.
struct BondFace {
  int bond = -1;               ///< index into State::bonds; -1: with the ground
  int block = -1;              ///< A
  Vec3 normal = Vec3::Zero();  ///< unit, from B to A
  bool opened = false;         ///< a corner is open, wider than bonded_gap_ratio allows
  std::vector<BondCorner> corners;
};

/// The face of `faces` that a contact belongs to; begins one where there is none.
[[nodiscard]] BondFace& face_of(int bond, int block, const Vec3& normal,
                                std::vector<BondFace>& faces);

/// Whether two normals of contacts of one block with the ground are of one bonded face.
[[nodiscard]] inline bool is_same_face(const Vec3& normal, const Vec3& other) {
  constexpr double same = 1 - 1e-4;
  return normal.dot(other) > same;
}

/// Whether stresses exist over the face that balance the forces on it and exceed its strength
/// nowhere: tension up to t, any pressure, and shear up to c + tan(phi) N / A, with N the normal
/// force where that presses, else 0.
[[nodiscard]] bool holds(const BondFace& face);

}  // namespace talus
