// libcore/solver/impact_few.hpp
// The impact law for few contacts, in their impulses: u = u- + W p with the velocities that
// impulses give each other's points. One dense matrix for all, however many bodies there are.
// in:    bodies, contacts with arms, targets and first impulses
// out:   impulses of the contacts
// theory 1.12; Alart and Curnier 1991
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <span>

#include "solver/impact_contacts.hpp"

namespace talus {

/// Scratch of the solution in the impulses of few contacts (impact_few.hpp). Sizes are bounded, so
/// that nothing of it is on the heap.
struct FewContacts {
  static constexpr std::size_t most = 16;  ///< contacts
  template <int columns>
  using Array = Eigen::Matrix<double, Eigen::Dynamic, columns, 0, 3 * static_cast<int>(most),
                              columns == 1 ? 1 : 3 * static_cast<int>(most)>;
  Array<Eigen::Dynamic> response;    ///< velocity per impulse [1/kg]
  Array<Eigen::Dynamic> matrix;      ///< of Newton's equations [-]
  Array<1> impulse, residual;        ///< [N s]
  Array<1> slip_before, slip;        ///< velocities of the contacts' points [m/s]
  std::array<double, most> feels{};  ///< velocity per impulse of a contact alone [1/kg]
  Eigen::PartialPivLU<Array<Eigen::Dynamic>> factor;
};

/// Newton's method from the contacts' impulses. False where it does not find them: then they are
/// none. `velocity` is that before the impact, six numbers a body; `scale` the fastest approach
/// [m/s]; at most FewContacts::most contacts; `passes` counts evaluations.
bool solve_few(std::span<const ImpactBody> bodies, std::span<ImpactContact> contacts,
               const Eigen::VectorXd& velocity, double scale, FewContacts& few, int& passes);

}  // namespace talus
