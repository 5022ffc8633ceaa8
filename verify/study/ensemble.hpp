// verify/study/ensemble.hpp
// Error of a slide that has no closed form: the same slide from several slightly different starts,
// compared by the mean place of the rock, where nine tenths of it stay behind, and its spread.
// Single blocks scatter (their toe is never compared); these three hardly do.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "blocks/block_set.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/study/measure.hpp"

namespace talus {

/// Compared quantities, in the order of EnsembleResult::mean.
enum class Quantity { centre, p90, spread };
inline constexpr std::array<const char*, 3> quantity_names = {"centre", "p90", "spread"};

/// How far a block has come, from where it started and where it is [m].
using Progress = std::function<double(const Vec3& from, const Vec3& now)>;

/// Means over the runs of one setting. Blocks count by their mass; arrays by Quantity.
struct EnsembleResult {
  CaseSettings settings;
  std::string method;
  int n_blocks = 0, n_runs = 0;
  int n_broken = 0;              ///< runs that broke a limit, where run_ensemble() was given any
  std::array<double, 3> mean{};  ///< [m]
  std::array<double, 3> standard_error{};  ///< of the mean, from the scatter of the runs [m]
  double cpu = 0;          ///< of one run from its start, without the set-up of the scene, mean [s]
  double set_up_cpu = 0;   ///< of one scene, mean [s]
  double wall = 0;         ///< of one run with it, mean [s]
  cases::CaseResult sums;  ///< steps, passes, unconverged: of all runs
};

/// Whether a run that has ended broke a limit.
using Breaks = std::function<bool(const cases::Run&)>;

/// Runs the scene of each seed 1..n_runs for `duration` [s], by law paper where it has settings.
[[nodiscard]] EnsembleResult run_ensemble(const std::function<Scene(std::uint64_t seed)>& scene,
                                          int n_runs, double duration, const Progress& progress,
                                          const std::optional<PaperSettings>& paper = {},
                                          const Breaks& breaks = {});

/// Limit of the answer for short steps, and its uncertainty.
struct EnsembleReference {
  std::array<double, 3> mean{};  ///< [m]
  std::array<double, 3> band{};  ///< its standard error and how far the two shortest steps are from
                                 ///< it, together [m]
};
/// Extrapolates as Richardson does, errors taken as proportional to the step: the line of least
/// squares through the means of the three shortest steps, at a step of nothing. `results` end with
/// the settings to extrapolate (of one method, from the longest step), two steps at least.
[[nodiscard]] EnsembleReference reference_of(const std::vector<EnsembleResult>& results);

/// Rows of `case_name` for one quantity: error = distance to the reference [m], NaN
/// where a block fell through the ground or has no place.
[[nodiscard]] std::vector<VerifyRow> rows_of(const std::string& case_name, Quantity quantity,
                                             const std::vector<EnsembleResult>& results,
                                             const EnsembleReference& reference);

/// A slide as a terrain and blocks, each with velocity zero.
struct SlideData {
  Trn trn;
  std::vector<Body> bodies;
};
/// From an ESRI ASCII grid of node elevations and an OBJ file of closed convex blocks, as texts.
/// Throws InputError.
[[nodiscard]] SlideData read_slide(const std::string& grid, const std::string& obj);

/// Friction 25 degrees, COR 0.7, 2500 kg/m3, g = 10 m/s2; start velocities within 1 mm/s of zero
/// drawn from `seed`, none for 0.
[[nodiscard]] Scene slide_scene(const SlideData& data, const Settings& settings,
                                std::uint64_t seed);

}  // namespace talus
