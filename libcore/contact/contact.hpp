// libcore/contact/contact.hpp: public
// One contact of a block, and its memory from step to step.
// paper: Zhang et al. 2018, Fig. 7 (modes) and Eq. (8)-(24); theory 1.6: one form for the modes
#pragma once

#include <cstdint>

#include "base/types.hpp"

namespace talus {

/// Fig. 7. The first feature is the block's, the second the ground's (or block B's).
enum class ContactMode : std::uint8_t {
  vertex_face = 1,  ///< mode 1
  face_vertex = 2,  ///< mode 2
  edge_edge = 3,    ///< mode 3
};

/// Names a contact across steps. A vertex on the ground is named by the vertex alone, so that its
/// friction does not know which triangle carries it.
struct ContactKey {
  ContactMode mode = ContactMode::vertex_face;
  int body_b = -1;     ///< -1: the ground
  int feature_a = -1;  ///< vertex, face or edge of A
  int feature_b = -1;  ///< node, or 4 node + edge kind; -1 in mode 1 with the ground
  bool operator==(const ContactKey&) const = default;
};

/// A candidate contact of a block, A, with the ground, B, at the pose for which it was searched.
struct Contact {
  ContactKey key;
  int block_a = 0;
  int ground_class = 0;
  Vec3 normal = Vec3::Zero();   ///< unit, local axes, from B to A
  Vec3 point_a = Vec3::Zero();  ///< contact point of A, body axes of A [m]
  Vec3 point_b = Vec3::Zero();  ///< contact point of the ground, local axes [m]
  double gap = 0;               ///< n . (a - b), > 0 open [m]. The paper's d_n is -gap.
};

/// State from step to step of a contact that pressed or may press again.
struct ContactMemory {
  ContactKey key;
  Vec3 normal = Vec3::Zero();  ///< of the last step, unit, local axes
  Vec3 shear = Vec3::Zero();   ///< elastic shear spring s_n, s_n . n = 0 [m]
  double offset = 0;           ///< overlap that presses nothing, >= 0; relaxed with time [m]
  double gap_end = 0;          ///< gap + offset at the end of the last step [m]
  double normal_force = 0;     ///< N of the last step, >= 0 [N]
  double stiffness = 0;        ///< k_n of the last step; 0: of a bond [N/m]
  double bond_area = 0;        ///< A_c, share of bonded area; 0 once the bond is broken [m2]
  std::uint8_t state = 0;      ///< ContactState of the last step
  std::uint8_t cooldown_steps =
      0;  ///< steps until it may stiffen again, since forces were hard to find
};

enum class ContactState : std::uint8_t { open = 0, slip = 1, stick = 2 };

}  // namespace talus
