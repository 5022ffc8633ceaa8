// libcore/step/substep_end.hpp
// End of a substep that is accepted, for every step: blocks, energy taken by contacts, and fixed
// bodies that were touched. A lone block, an island and a mass share these.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/substep_numbers.hpp"

namespace talus {

/// Motion that block b begins a substep of `h` with: drag acts for half of it at the start, and for
/// half at the end; that of the ground where something presses the block then.
[[nodiscard]] Motion begin_drag(const Scene& scene, const State& state, std::size_t b, double h);

/// Block b ends substep `s` at time `t` with `end`, before drag: its motion, local time, and the
/// energies of drag, base motion and loads.
void end_block(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               const Motion& end, bool on_ground, double t, State& state, StepReport& report);

/// A contact at the end of a substep.
struct ContactEnd {
  int a = 0, b = -1, fixed = -1;  ///< blocks and fixed body, as in KeptContact
  Vec3 normal, impulse;           ///< on A [N s]
  double p_n = 0;                 ///< [N s]
  Vec3 path;                      ///< per time, that the impulse works on [m/s]
  bool is_hit = false, yields = false;

  /// Normal energy that it took; < 0: other contacts drove its bodies apart [J].
  [[nodiscard]] double loss() const { return -p_n * normal.dot(path); }
};

/// Energy that a contact took, by kind, and the load that it puts on its blocks; push_bodies() adds
/// that of yielding bodies.
void book(const Scene& scene, const ContactEnd& contact, State& state);

/// Adds the push of a contact on the fixed body that yields to it over a substep of `h` to
/// `pushes`. `speed_start`: normal velocity at the start; `is_limited`: the body yields, to
/// `gap_end`; `pose`: of the fixed body, where it was searched.
void push(const Scene& scene, const State& state, const ContactEnd& contact, double h,
          double speed_start, bool is_limited, double gap_end, std::span<const Pose> poses,
          std::vector<YieldPush>& pushes);

/// Block `a` has touched fixed body `fixed` at `at` and time `t`, a panel or a stem. Before that it
/// moved with `before`.
void note_touch(const Scene& scene, int a, int fixed, const Vec3& at, double t,
                const Motion& before, State& state);

/// The pushes of an accepted substep that ends at `t`.
void take_pushes(const Scene& scene, std::span<const YieldPush> pushes, double t, State& state);

}  // namespace talus
