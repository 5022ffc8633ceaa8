// libcore/paper/paper_work.hpp
// Scratch of a step of law paper: equations, contacts, matrix.
// paper: Zhang et al. 2018, Eq. (3), (8)-(24)
#pragma once

#include <utility>
#include <vector>

#include "base/types.hpp"
#include "contact/contact.hpp"
#include "solver/block_lu.hpp"

namespace talus {

/// The block's part of Eq. (3) without contacts, in local axes.
template <int Dof>
struct BlockEquations {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  using Mat = Eigen::Matrix<double, Dof, Dof>;
  Mat K;
  Vec F;
  Vec velocity;  ///< at the start of the step
  Mat3 R;        ///< body to local axes at the start
};

/// A contact over a step, between block A and block B or the ground; vectors in local axes. Its
/// strengths are forces: nothing is times dt.
struct PaperContact {
  ContactKey key;
  int a = 0, b = -1;     ///< members of the island; b = -1: the ground
  int ground_class = 0;  ///< where b is -1
  int bond = -1;         ///< index into State::bonds, -1: none
  int memory = -1;       ///< index into A's memory, -1: new
  ContactState state = ContactState::open;
  Vec3 normal = Vec3::Zero();          ///< unit, from B to A
  Vec3 arm_a = Vec3::Zero();           ///< from the centroid of A [m]
  Vec3 arm_b = Vec3::Zero();           ///< from the centroid of B [m]
  Vec3 shear = Vec3::Zero();           ///< s_n [m]
  Vec3 slip_direction = Vec3::Zero();  ///< e_s of the pass before, unit, or zero
  double gap_start = 0;                ///< at the start of the step, without `offset` [m]
  double offset = 0;                   ///< see ContactMemory [m]
  double friction = 0;                 ///< tan(phi) [-]
  double cohesion_force = 0;           ///< c A_c [N]
  double tension_force = 0;            ///< t A_c [N]
  double bond_area = 0;                ///< [m2]
  double held_friction = 0;            ///< friction that slips, of the pass before [N]
};

/// Scratch of an island's step.
template <int Dof>
struct OpenCloseWork {  // clang-format off
  using Vec = Eigen::Matrix<double, Dof, 1>;
  std::vector<BlockEquations<Dof>> equations;  ///<                                      (n_members)
  std::vector<PaperContact> contacts;          ///< grouped by A
  std::vector<std::size_t> contact_begin;      ///<                                  (n_members + 1)
  std::vector<std::pair<int, int>> edges;      ///< members that share contacts
  std::vector<int> outsiders;                  ///< members off the known ground, ascending
  BlockLu<Dof> lu;
  std::vector<Vec> D;                          ///< right-hand side, then solution       (n_members)
};  // clang-format on

struct PaperWork {
  OpenCloseWork<6> rigid;
  OpenCloseWork<12> strained;
  std::vector<int> manifolds;  ///< of the island at hand
};

}  // namespace talus
