// libcore/scene/scene.hpp: public
// Input of a run, read once and const afterwards: ground, blocks at rest, loads, settings.
// in:    plain data; make_scene() in scene/make_scene.hpp fills it from a block set
// paper: Zhang et al. 2018, Sect. 2; docs/theory/theory.md
#pragma once

#include <vector>

#include "base/types.hpp"
#include "blocks/fragments.hpp"
#include "contact/ground.hpp"
#include "contact/hulls.hpp"
#include "contact/shapes.hpp"
#include "motion/displacement.hpp"
#include "motion/pose.hpp"
#include "scene/canopy.hpp"
#include "scene/fixed_bodies.hpp"
#include "scene/forest.hpp"
#include "scene/joint_classes.hpp"
#include "site/acceleration_record.hpp"

namespace talus {

/// How a run is computed. The defaults of law talus serve every scene; those that a site file may
/// change are its defaults too (SolverSettings).
struct Settings {
  bool strains = false;         ///< 12 degrees of freedom a block instead of 6
  double dt = 0.005;            ///< time step, > 0; law talus shortens it where it must [s]
  double normal_stiffness = 0;  ///< k_n, > 0; 0 lets law talus choose [N/m]
  double shear_ratio = 0.4;     ///< k_s / k_n [-]
  double accuracy = 0.005;      ///< law talus: error of the displacement of moving blocks, as a
                                ///< share [-]
  double tolerance_factor = 1;  ///< law talus: on the residual at which forces count as found [-]
  int max_passes = 50;          ///< law talus, a lone block: of Newton, before a step is repeated
  bool static_start = true;     ///< law talus: blocks at rest start in equilibrium with the ground
  bool flight = true;           ///< law talus: no search while nothing can be hit; same motion
  bool block_contacts = true;   ///< blocks touch each other; off, each moves as if alone
  bool trn_contacts = true;  ///< law talus: blocks touch the TRN; off, fixed bodies are the slope
  bool masses = true;        ///< law talus: many moving blocks take the mass step
  bool sleep = true;         ///< law talus: blocks at rest are left out
};

/// A force on a material point of a block, constant in local axes but for the loss of a wet face.
struct PointLoad {
  int block = 0;
  Vec3 point = Vec3::Zero();  ///< body axes [m]
  Vec3 force = Vec3::Zero();  ///< local axes [N]
  int wet_face = -1;          ///< whose pressure it is, of Scene::wet_faces; -1: of none
};

/// A face of block A with water in it at the start, against block B or the ground. Its pressure is
/// in Scene::loads; State::pressure says how much of it is left.
struct WetFace {
  int block_a = 0, block_b = -1;  ///< B -1: the ground
  Vec3 point_a = Vec3::Zero();    ///< centre of pressure, body axes of A [m]
  Vec3 point_b = Vec3::Zero();    ///< body axes of B; of the ground local axes [m]
  Vec3 normal = Vec3::Zero();     ///< unit, into A, body axes of A
  double force = 0;               ///< on A along the normal [N]
  double extent = 0;              ///< diameter of the circle of its area [m]
};

/// Bodies at rest. Body axes: origin at the centroid, axes along the principal axes of inertia.
struct Blocks {  // clang-format off
  std::vector<double> mass;           ///< [kg]                                        (n_blocks)
  std::vector<double> volume;         ///< [m3]                                        (n_blocks)
  std::vector<Vec3> inertia;          ///< principal moments of inertia [kg m2]        (n_blocks)
  std::vector<Vec3> second_moment;    ///< S_xx, S_yy, S_zz, body axes [m5]            (n_blocks)
  std::vector<double> young;          ///< E [Pa]                                      (n_blocks)
  std::vector<double> poisson;        ///< nu [-]                                      (n_blocks)
  std::vector<Pose> rest;             ///< as cut: the attitude turns body to local axes (n_blocks)
  std::vector<Vec3> velocity;         ///< at the start [m/s]                          (n_blocks)
  std::vector<Vec3> spin;             ///< at the start, local axes [rad/s]            (n_blocks)
  std::vector<Vec6> initial_stress;   ///< sx sy sz tyz tzx txy, body axes; may be empty [Pa]
  Shapes shapes;                      ///< surfaces, as the search of the ground reads them
  Hulls hulls;                        ///< convex parts, as the search of other blocks reads them;
                                      ///< after the blocks, those of the fixed bodies
};  // clang-format on

/// How blocks break when they are hit (step/breakage.hpp). The defaults are those of a site file.
struct Fragmentation {
  double energy = 3e5;             ///< effective work of fracture [J/m2]
  double spread = 2;               ///< exponent of the chance; the larger the sharper [-]
  double separation_share = 0.01;  ///< of the energy of a hit, that drives pieces apart [-]
  std::uint64_t seed = 1;
};

struct Scene {
  Ground ground;
  GroundClass joint;    ///< contacts between blocks where `joints` says nothing else
  JointClasses joints;  ///< by joint set and by block
  Blocks blocks;
  std::vector<double> crush_load;   ///< that crushes a block; empty: none is [N] (n_blocks)
  std::vector<Fragment> fragments;  ///< empty: nothing breaks                    (n_blocks)
  Fragmentation fragmentation;
  FixedBodies fixed;                 ///< law talus: fences, blocky slope; found through hulls
  Forest forest;                     ///< law talus: stems of trees, found by place
  std::vector<Canopy> canopies;      ///< law talus: forests that drag
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s2]
  std::vector<PointLoad> loads;      ///< sorted by block
  std::vector<WetFace> wet_faces;    ///< by A                                    (n_wet_faces)
  double drained_at = 0;             ///< opening at which their pressure is gone [m]
  AccelerationRecord base;           ///< empty: the ground does not move
  Settings settings;
};

[[nodiscard]] inline int n_blocks(const Scene& scene) {
  return static_cast<int>(scene.blocks.mass.size());
}
[[nodiscard]] inline int n_fixed(const Scene& scene) {
  return static_cast<int>(scene.fixed.pose.size());
}

/// Whether block b is there when the run begins: no piece of another.
[[nodiscard]] inline bool is_released(const Scene& scene, std::size_t b) {
  return scene.fragments.empty() || scene.fragments[b].parent < 0;
}

// Blocks::hulls numbers blocks and fixed bodies in one row, for the search of pairs alone.

/// Is body `b` of Blocks::hulls a fixed one?
[[nodiscard]] inline bool is_fixed(const Scene& scene, int b) { return b >= n_blocks(scene); }
/// Id of the fixed body that is body `b` of Blocks::hulls.
[[nodiscard]] inline int fixed_of(const Scene& scene, int b) { return b - n_blocks(scene); }
[[nodiscard]] inline int hull_of_fixed(const Scene& scene, int id) { return id + n_blocks(scene); }
/// Name in ContactKey of the other side of a contact of two bodies of Blocks::hulls.
[[nodiscard]] inline int name_of_body(const Scene& scene, int b) {
  return is_fixed(scene, b) ? name_of_fixed(fixed_of(scene, b)) : b;
}

}  // namespace talus
