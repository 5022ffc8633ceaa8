// Bonds of joint faces at the start, the faces that touch, and the class of two faces.
#include "scene/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/bond_face.hpp"

namespace talus {
namespace {

using std::size_t;

// Faces that are not parallel within this angle do not hold together [rad].
constexpr double bonded_angle = 1e-3;
// The normal of a face against the faces of a bond may differ by less than the first; two faces
// of one block that meet the same other one differ by more than the second.
constexpr double same_direction = 1 - 1e-5, still_its_face = 0.99;

GroundClass face_class(const Scene& scene, int block, int joint_set) {
  const JointClasses& joints = scene.joints;
  GroundClass made = joints.of_block.empty() ? scene.joint : joints.of_block[block];
  if (joint_set < 0 || static_cast<size_t>(joint_set) >= joints.of_set.size()) return made;
  const GroundClass& set = joints.of_set[joint_set];
  if (set.friction >= 0) made.friction = set.friction, made.residual = set.residual;
  made.roughness = set.roughness;
  made.wall_strength = set.wall_strength;
  made.weak_friction = std::min(made.weak_friction, made.friction);
  made.cohesion = set.cohesion;
  made.tension = set.tension;
  return made;
}

/// Orders bonds by their blocks.
struct ByBlocks {
  using Blocks = std::pair<int, int>;
  static Blocks of(const BlockBond& bond) { return {bond.block_a, bond.block_b}; }
  bool operator()(const BlockBond& bond, const Blocks& blocks) const { return of(bond) < blocks; }
  bool operator()(const Blocks& blocks, const BlockBond& bond) const { return blocks < of(bond); }
};

template <class Bonds>
auto bonds_of(Bonds& bonds, int block_a, int block_b) {
  return std::equal_range(bonds.begin(), bonds.end(), std::pair(block_a, block_b), ByBlocks());
}

GroundClass smaller(const GroundClass& a, const GroundClass& b) {
  GroundClass made{std::min(a.friction, b.friction), std::min(a.cohesion, b.cohesion),
                   std::min(a.tension, b.tension), std::min(a.restitution, b.restitution)};
  made.weak_friction = std::min(a.weak_friction, b.weak_friction);
  made.weakening_speed = std::min(a.weakening_speed, b.weakening_speed);
  made.roughness = std::min(a.roughness, b.roughness);
  made.wall_strength = std::min(a.wall_strength, b.wall_strength);
  made.residual = a.friction < b.friction ? a.residual : b.residual;
  return made;
}

bool has_strength(const GroundClass& c) { return c.cohesion > 0 || c.tension > 0; }

}  // namespace

GroundClass pair_class(const Scene& scene, const PairManifold& m) {
  if (scene.joints.of_block.empty() && scene.joints.of_set.empty()) return scene.joint;
  return smaller(face_class(scene, m.block_a, m.joint_set_a),
                 face_class(scene, m.block_b, m.joint_set_b));
}

double closed_gap(const Scene& scene) {
  const std::vector<double>& radius = scene.blocks.hulls.radius;
  double least_radius = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < radius.size(); ++b)
    if (is_fixed(scene, static_cast<int>(b)) || is_released(scene, b))
      least_radius = std::min(least_radius, radius[b]);
  return bonded_gap_ratio * least_radius;
}

std::vector<JointContact> closed_faces(const Scene& scene) {
  const Hulls& hulls = scene.blocks.hulls;
  std::vector<Pose> poses = scene.blocks.rest;
  poses.insert(poses.end(), scene.fixed.pose.begin(), scene.fixed.pose.end());
  PlacedHulls placed;
  place_hulls(hulls, poses, {}, {}, placed);
  std::vector<JointContact> faces = joint_contacts(hulls, placed, closed_gap(scene), bonded_angle);
  std::erase_if(faces, [&](const JointContact& c) {
    return is_fixed(scene, c.block_b) || !is_released(scene, c.block_a) ||
           !is_released(scene, c.block_b);
  });
  return faces;
}

std::vector<BlockBond> start_bonds(const Scene& scene) {
  std::vector<BlockBond> bonds;
  const JointClasses& joints = scene.joints;
  if (!scene.settings.block_contacts) return bonds;
  if (!std::any_of(joints.of_set.begin(), joints.of_set.end(), has_strength) &&
      !std::any_of(joints.of_block.begin(), joints.of_block.end(), has_strength))
    return bonds;
  for (const JointContact& c : closed_faces(scene)) {
    const GroundClass face = smaller(face_class(scene, c.block_a, c.joint_set_a),
                                     face_class(scene, c.block_b, c.joint_set_b));
    if (!has_strength(face)) continue;
    const Vec3 normal = scene.blocks.rest[c.block_a].attitude.conjugate() * c.normal;
    const auto [begin, end] = bonds_of(bonds, c.block_a, c.block_b);
    const auto same = std::find_if(begin, end, [&](const BlockBond& bond) {
      return bond.normal.dot(normal) > same_direction;
    });
    if (same != end)
      same->area += c.area;
    else
      bonds.insert(end, BlockBond{c.block_a, c.block_b, c.area, face, normal});
  }
  return bonds;
}

int find_bond(std::span<const BlockBond> bonds, int block_a, int block_b, const Quat& attitude,
              const Vec3& normal) {
  const auto [begin, end] = bonds_of(bonds, block_a, block_b);
  if (begin == end) return -1;
  const Vec3 in_a = attitude.conjugate() * normal;
  int found = -1;
  double nearest = still_its_face;
  for (auto bond = begin; bond != end; ++bond)
    if (bond->area > 0 && bond->normal.dot(in_a) > nearest) {
      nearest = bond->normal.dot(in_a);
      found = static_cast<int>(bond - bonds.begin());
    }
  return found;
}

}  // namespace talus
