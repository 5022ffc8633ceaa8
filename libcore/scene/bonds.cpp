#include "scene/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contact/start_contacts.hpp"
#include "solver/contact_law.hpp"

namespace talus {
namespace {

using std::size_t;

// Faces farther apart, as a share of the smallest block's size, do not hold together ...
constexpr double bonded_gap_ratio = 1e-4;
// ... nor do those that are not parallel within this angle [rad].
constexpr double bonded_angle = 1e-3;

GroundClass face_class(const Scene& scene, int block, int joint_set) {
  const JointClasses& joints = scene.joints;
  GroundClass made = joints.of_block.empty() ? scene.joint : joints.of_block[block];
  if (joint_set < 0 || static_cast<size_t>(joint_set) >= joints.of_set.size()) return made;
  const GroundClass& set = joints.of_set[joint_set];
  if (set.friction >= 0) made.friction = set.friction;
  made.cohesion = set.cohesion;
  made.tension = set.tension;
  return made;
}

auto order(const BlockBond& bond) { return std::tuple(bond.block_a, bond.block_b); }

GroundClass smaller(const GroundClass& a, const GroundClass& b) {
  return {std::min(a.friction, b.friction), std::min(a.cohesion, b.cohesion),
          std::min(a.tension, b.tension), std::min(a.restitution, b.restitution)};
}

bool has_strength(const GroundClass& c) { return c.cohesion > 0 || c.tension > 0; }

}  // namespace

GroundClass pair_class(const Scene& scene, const PairManifold& m) {
  if (scene.joints.of_block.empty() && scene.joints.of_set.empty()) return scene.joint;
  return smaller(face_class(scene, m.block_a, m.joint_set_a),
                 face_class(scene, m.block_b, m.joint_set_b));
}

std::vector<BlockBond> start_bonds(const Scene& scene) {
  std::vector<BlockBond> bonds;
  const JointClasses& joints = scene.joints;
  if (!std::any_of(joints.of_set.begin(), joints.of_set.end(), has_strength) &&
      !std::any_of(joints.of_block.begin(), joints.of_block.end(), has_strength))
    return bonds;
  const Hulls& hulls = scene.blocks.hulls;
  std::vector<Pose> poses = scene.blocks.rest;
  poses.insert(poses.end(), scene.fixed.pose.begin(), scene.fixed.pose.end());
  PlacedHulls placed;
  place_hulls(hulls, poses, {}, {}, placed);
  double least_radius = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < hulls.radius.size(); ++b)
    if (is_fixed(scene, static_cast<int>(b)) || is_released(scene, b))
      least_radius = std::min(least_radius, hulls.radius[b]);
  const double gap = bonded_gap_ratio * least_radius;
  for (const JointContact& c : joint_contacts(hulls, placed, gap, bonded_angle)) {
    if (is_fixed(scene, c.block_b) || !is_released(scene, c.block_a) ||
        !is_released(scene, c.block_b))
      continue;
    const GroundClass face = smaller(face_class(scene, c.block_a, c.joint_set_a),
                                     face_class(scene, c.block_b, c.joint_set_b));
    if (!has_strength(face)) continue;
    const BlockBond bond{c.block_a, c.block_b, c.area, face};
    const auto at = std::lower_bound(
        bonds.begin(), bonds.end(), bond,
        [](const BlockBond& p, const BlockBond& q) { return order(p) < order(q); });
    if (at != bonds.end() && order(*at) == order(bond))
      at->area += bond.area;
    else
      bonds.insert(at, bond);
  }
  return bonds;
}

int find_bond(std::span<const BlockBond> bonds, int block_a, int block_b) {
  const auto at =
      std::lower_bound(bonds.begin(), bonds.end(), std::tuple(block_a, block_b),
                       [](const BlockBond& bond, const auto& pair) { return order(bond) < pair; });
  const bool found = at != bonds.end() && order(*at) == std::tuple(block_a, block_b);
  return found && at->area > 0 ? static_cast<int>(at - bonds.begin()) : -1;
}

void add_load(double N, const Vec3& shear, double area, const GroundClass& face, BondLoad& load) {
  load.shear += shear;
  double bound;
  Strength<double>{face.friction, face.cohesion * area, 0}.bound(N, bound);
  load.strength += bound;
  load.torn |= face.tension > 0 && -N > face.tension * area;
}

}  // namespace talus
