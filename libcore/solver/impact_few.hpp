// libcore/solver/impact_few.hpp
// The impact law for few contacts, in their impulses: u = u- + W p with the velocities that
// impulses give each other's points. One dense matrix for all, however many bodies there are. in:
// bodies, contacts, their rows with arms and targets out:   impulses in the rows; false: not found,
// and impulses are none theory 1.12; Alart and Curnier 1991
#pragma once

#include <span>

#include "solver/impact_solve.hpp"

namespace talus {

/// More contacts are for bodies: the work here goes with the cube of their number.
constexpr std::size_t most_few = FewContacts::most;

/// Solves from the impulses in `rows`. `velocity` is that before the impact, six numbers a body;
/// `scale` the fastest approach [m/s]; `passes` counts evaluations.
bool solve_few(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
               const Eigen::VectorXd& velocity, double scale, ImpactWork& work, int& passes);

}  // namespace talus
