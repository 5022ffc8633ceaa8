// libcore/run/law.hpp: public
// The law that moves the blocks of a run: talus, that of the engine, or paper in its place.
#pragma once

#include <optional>

#include "paper/paper_step.hpp"
#include "step/step.hpp"

namespace talus {

/// Law paper, or none: law talus, whose state is State alone.
using RunLaw = std::optional<PaperLaw>;

[[nodiscard]] inline RunLaw law_of(const std::optional<PaperSettings>& paper) {
  if (!paper) return std::nullopt;
  return PaperLaw{*paper, {}, {}};
}
/// start() of the law.
[[nodiscard]] inline State start_by(RunLaw& law, const Scene& scene, Work& work) {
  return law ? paper_start(scene, work, *law) : start(scene, work);
}
/// step() of the law.
inline StepReport step_by(RunLaw& law, const Scene& scene, State& state, Work& work) {
  return law ? paper_step(scene, state, work, *law) : step(scene, state, work);
}

}  // namespace talus
