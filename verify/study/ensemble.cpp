// Means and errors of a slide from many slightly different starts.
#include "verify/study/ensemble.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <sstream>
#include <utility>

#include "base/error.hpp"
#include "base/percentile.hpp"
#include "base/processor_time.hpp"
#include "base/random.hpp"
#include "io/mesh.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace talus {
namespace {

using std::size_t;

// Mean, 90 % quantile and standard deviation of `values`, weighted.
std::array<double, 3> quantities_of(const std::vector<double>& values,
                                    const std::vector<double>& weights) {
  double total = 0, mean = 0, square = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    total += weights[i];
    mean += weights[i] * values[i];
  }
  mean /= total;
  std::vector<WeightedValue> sorted;
  for (size_t i = 0; i < values.size(); ++i) {
    square += weights[i] * (values[i] - mean) * (values[i] - mean);
    sorted.push_back({values[i], weights[i]});
  }
  sort_values(sorted);
  const double p90 = weighted_percentile(sorted, 0.9);
  return {mean, p90, std::sqrt(square / total)};
}

std::array<double, 3> answer_of(const cases::Run& run, const Progress& progress) {
  std::vector<double> values;
  for (int b = 0; b < n_blocks(run.scene); ++b)
    values.push_back(progress(run.scene.blocks.rest[b].position, run.motion(b).pose.position));
  return quantities_of(values, run.scene.blocks.mass);
}

}  // namespace

EnsembleResult run_ensemble(const std::function<Scene(std::uint64_t seed)>& scene, int n_runs,
                            double duration, const Progress& progress,
                            const std::optional<PaperSettings>& paper, const Breaks& breaks) {
  EnsembleResult out;
  out.n_runs = n_runs;
  std::vector<std::array<double, 3>> answers;
  const auto wall_begin = std::chrono::steady_clock::now();
  for (int seed = 1; seed <= n_runs; ++seed) {
    const double begin = processor_seconds();
    Scene started = scene(static_cast<std::uint64_t>(seed));
    out.set_up_cpu += (processor_seconds() - begin) / n_runs;
    cases::Run run(std::move(started), paper);
    run.advance_to(duration);
    answers.push_back(answer_of(run, progress));
    out.n_broken += breaks && breaks(run) ? 1 : 0;
    cases::add_counts(run.counted(), out.sums);
    out.settings = {run.scene.settings, paper};
    out.n_blocks = n_blocks(run.scene);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_begin;
  out.cpu = out.sums.cpu / n_runs;
  out.wall = wall.count() / n_runs;
  for (size_t q = 0; q < out.mean.size(); ++q) {
    double square = 0;
    for (const auto& answer : answers) out.mean[q] += answer[q] / n_runs;
    for (const auto& answer : answers)
      square += (answer[q] - out.mean[q]) * (answer[q] - out.mean[q]);
    if (n_runs > 1) out.standard_error[q] = std::sqrt(square / (n_runs - 1) / n_runs);
  }
  return out;
}

EnsembleReference reference_of(const std::vector<EnsembleResult>& results) {
  const auto begin = std::find_if(results.rbegin(), results.rend(), [&](const EnsembleResult& r) {
                       return r.method != results.back().method;
                     }).base();
  const auto n = std::min<std::ptrdiff_t>(3, results.end() - begin);
  const std::vector<EnsembleResult> shortest(results.end() - n, results.end());
  double mean_step = 0, square = 0;
  for (const EnsembleResult& r : shortest) mean_step += r.settings.dt / static_cast<double>(n);
  for (const EnsembleResult& r : shortest) square += std::pow(r.settings.dt - mean_step, 2);
  EnsembleReference out;
  for (size_t q = 0; q < out.mean.size(); ++q) {
    double variance = 0, off = 0;
    for (const EnsembleResult& r : shortest) {
      const double share =
          1 / static_cast<double>(n) - mean_step * (r.settings.dt - mean_step) / square;
      out.mean[q] += share * r.mean[q];
      variance += std::pow(share * r.standard_error[q], 2);
    }
    for (size_t i = shortest.size() - 2; i < shortest.size(); ++i)
      off = std::max(off, std::abs(shortest[i].mean[q] - out.mean[q]));
    out.band[q] = std::hypot(std::sqrt(variance), off);
  }
  return out;
}

std::vector<VerifyRow> rows_of(const std::string& case_name, Quantity quantity,
                               const std::vector<EnsembleResult>& results,
                               const EnsembleReference& reference) {
  const auto q = static_cast<size_t>(quantity);
  std::vector<VerifyRow> rows;
  for (const EnsembleResult& result : results) {
    VerifyRow row;
    row.case_name = case_name;
    row.method = result.method;
    row.law = result.settings.paper ? "paper" : "talus";
    row.strains = result.settings.strains;
    row.dof = result.n_blocks * (row.strains ? 12 : 6);
    row.dt = result.settings.dt;
    row.normal_stiffness = result.settings.normal_stiffness;
    row.tolerance_factor = result.settings.tolerance_factor;
    row.runs = result.n_runs;
    row.steps = result.sums.steps;
    // a block that leaves the terrain counts where it left
    const bool is_lost = has(result.sums.flags, StepFlag::fell_through) ||
                         has(result.sums.flags, StepFlag::not_finite);
    row.error = is_lost ? std::nan("") : std::abs(result.mean[q] - reference.mean[q]);
    row.norm = "m";
    row.cpu = result.cpu;
    row.set_up_cpu = result.set_up_cpu;
    row.wall = result.wall;
    row.iterations = result.sums.passes;
    row.unconverged = result.sums.unconverged;
    row.largest_penetration = result.sums.largest_penetration;
    row.flags = result.sums.flags;
    rows.push_back(row);
  }
  return rows;
}

SlideData read_slide(const std::string& grid, const std::string& obj) {
  SlideData data;
  std::istringstream in(grid);
  std::string key;
  double x0 = 0, y0 = 0, unknown = 0;
  Trn& trn = data.trn;
  in >> key >> trn.n_cols >> key >> trn.n_rows >> key >> x0 >> key >> y0 >> key >> trn.cell_size >>
      key >> unknown;
  if (!in) throw InputError({"terrain of the slide"}, "is not an ESRI ASCII grid");
  trn.node0 = Vec2(x0, y0 + (trn.n_rows - 1) * trn.cell_size);
  trn.elevation.resize(static_cast<size_t>(trn.n_cols) * static_cast<size_t>(trn.n_rows));
  for (double& z : trn.elevation) in >> z;
  if (!in) throw InputError({"terrain of the slide"}, "ends early");
  for (MeshBody& mesh : bodies_of(parse_obj(obj, "blocks of the slide"))) {
    Body body;
    body.parts = std::move(mesh.parts);
    if (body.parts.empty()) body.parts = {std::move(mesh.surface)};
    data.bodies.push_back(std::move(body));
  }
  return data;
}

Scene slide_scene(const SlideData& data, const Settings& settings, std::uint64_t seed) {
  std::vector<Body> bodies = data.bodies;
  Random random(seed);
  for (Body& body : bodies)
    if (seed != 0)
      body.velocity =
          1e-3 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  const GroundClass ground = cases::ground_of(25, 0.7);
  return cases::scene_of(data.trn, ground, bodies, settings, {2500, 5e10, 0.25});
}

}  // namespace talus
