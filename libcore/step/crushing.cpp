// Small blocks that are crushed by the load through them.
#include "step/crushing.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "solver/law_numbers.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

// Of the last step a share goes into the mean that a load which never changes does not see.
void renew_mean(double dt, BlockLoad& load) {
  const double kept = std::exp(-dt / law::load_time);
  load.press = kept * load.press + (1 - kept) / dt * load.step_press;
  load.push = kept * load.push + (1 - kept) / dt * load.step_push;
  load.step_press.setZero();
  load.step_push.setZero();
}

void crush(const Scene& scene, size_t b, double load, State& state) {
  Motion& motion = state.motion[b];
  state.ledger.breakage += kinetic_energy(scene, b, motion);
  motion.velocity.setZero();
  motion.angular_momentum.setZero();
  crush_to_debris(state, b);
  state.memory[b].clear();
  state.load[b] = {};
  state.crushed.push_back({static_cast<int>(b), state.time, load, scene.crush_load[b],
                           motion.pose.position, scene.blocks.volume[b], scene.blocks.mass[b]});
}

}  // namespace

double load_through(const BlockLoad& load) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(load.press);
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    const double pushed = std::abs(axes.eigenvectors().col(k).dot(load.push));
    largest = std::max(largest, (axes.eigenvalues()[k] - pushed) / 2);
  }
  return largest;
}

void crush_blocks(const Scene& scene, State& state) {
  for (size_t b = 0; b < state.load.size(); ++b) {
    if (std::isinf(scene.crush_load[b]) || does_not_move(state.phase[b])) continue;
    renew_mean(step_length(scene, state), state.load[b]);
    // the load through no axis is more than half the trace
    if (state.load[b].press.trace() <= 2 * scene.crush_load[b]) continue;
    if (state.phase[b] != Phase::near_ground) continue;
    const double load = load_through(state.load[b]);
    if (load > scene.crush_load[b]) crush(scene, b, load, state);
  }
}

}  // namespace talus
