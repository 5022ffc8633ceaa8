// Scenes with and without each item that the scene plan leaves out.
#include "verify/study/leaving_out.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/percentile.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
#include "run/runner.hpp"
#include "scene/fence.hpp"
#include "setup/site_scene.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/cases.hpp"

namespace talus {
namespace {

using namespace cases;

// --- scenes --------------------------------------------------------------------------------------

double bumps(double x, double y) { return 0.8 * std::sin(0.4 * x) * std::cos(0.5 * y) - 0.5 * x; }

// Slabs that tumble down rough ground, 40 m from one another; start velocities within 1 mm/s drawn
// from `seed`, none for 0.
Scene rocks(int n, const Settings& settings = {}, std::uint64_t seed = 0) {
  Random random(seed, "start jitter");
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i) {
    const double y = 40.0 * (i - 1);
    const Vec3 low(-60, y, bumps(-60, y) + 2);
    Vec3 velocity(3, 0.1 * i, 0);
    if (seed != 0) velocity += 1e-3 * Vec3(random.normal(), random.normal(), random.normal());
    bodies.push_back(body_of(box(low, low + Vec3(1.6, 1.1, 0.7)), velocity, {0.4, 1.0 + i, 0.2}));
  }
  return scene_of(make_trn(bumps, 1, 128), ground_of(30, 0.4), bodies, settings);
}

// A cube of `side` on a plane of 30 degrees.
Scene cube_on_plane(double side, const GroundClass& ground, const Material& material = {}) {
  const double h = side / 2;
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-h, -h, 0), Vec3(h, h, side)));
  return scene_of(plane_trn(frame, side / 2, 64 * side), ground, {cube}, {}, material);
}

// So soft that its own weight strains it by a hundredth.
Scene soft_cube() {
  Material rock;
  rock.young = 1e7;
  return cube_on_plane(4, ground_of(20, 0.3), rock);
}

// Four cubes that a joint set with this strength holds together, on a slope that they slide down.
Scene bonded_column(double cohesion) {
  const SlopeFrame frame = slope_frame(25, 30);
  std::vector<Body> bodies;
  for (int i = 0; i < 4; ++i) {
    bodies.push_back(
        body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, i), Vec3(0.5, 0.5, i + 1))));
    bodies.back().parts[0].face_tag.assign(6, 0);
  }
  Scene scene = scene_of(plane_trn(frame, 1, 40), ground_of(15), bodies, {});
  scene.joint = ground_of(30);
  GroundClass set = ground_of(30);
  set.cohesion = set.tension = cohesion;
  scene.joints.of_set = {set};
  return scene;
}

// Across the path of the rocks at `x`.
StandingFence fence_at(double x, double from, double to) {
  StandingFence fence;
  for (double y = from; y <= to; y += 10) {
    fence.posts.push_back(Vec3(x, y, bumps(x, y)));
    if (y < to) fence.depth.push_back(0.5);
  }
  fence.height = 4;
  return fence;
}

Scene fenced(Scene scene, const StandingFence& fence) {
  add_fence(scene, fence);
  return scene;
}

// --- runs ----------------------------------------------------------------------------------------

void note_ends(const Scene& scene, const State& state, OmissionRun& out) {
  for (int b = 0; b < n_blocks(scene); ++b) {
    const Motion m = motion_at(scene, state, b, state.time);
    const auto keep = [&out](const auto& numbers) {
      out.numbers.insert(out.numbers.end(), numbers.data(), numbers.data() + numbers.size());
    };
    keep(m.pose.position);
    keep(m.pose.attitude.coeffs());
    keep(m.velocity);
    out.places.push_back(m.pose.position);
    const Vec3& from = scene.blocks.rest[b].position;
    out.path = std::max(out.path, (m.pose.position - from).norm());
  }
}

// Count of events that have to come up in a scene for an omission to show.
using Shown = std::function<long(const State&)>;

long impacts(const State& state) { return state.counters.impacts; }
long skips(const State& state) { return state.counters.flight_skips; }
long sleepers(const State& state) { return std::ranges::count(state.phase, Phase::asleep); }
long anything(const State&) { return 1; }

OmissionRun run_scene(Scene scene, double duration, const Shown& shown = anything) {
  OmissionRun out;
  Run run(std::move(scene), {});
  run.advance_to(duration);
  out.cpu = run.counted().cpu;
  note_ends(run.scene, run.state, out);
  out.shown = shown(run.state);
  return out;
}

OmissionRun run_recorded(const Scene& scene, const RunOptions& options,
                         const std::vector<RecordLine>& lines) {
  OmissionRun out;
  RunFile file;
  file.blocks.mass = scene.blocks.mass;
  const double begin = processor_seconds();
  Runner runner = begin_run(scene, options, lines, std::move(file));
  while (!is_over(runner)) advance(runner);
  finish(runner);
  update_file(runner, false);
  out.cpu = processor_seconds() - begin;
  note_ends(scene, runner.state, out);
  out.shown = impacts(runner.state);
  return out;
}

// Mean path of many starts.
OmissionRun run_many(const std::function<Scene(std::uint64_t seed)>& scene, int n,
                     double duration) {
  const auto path = [](const Vec3& from, const Vec3& now) { return (now - from).norm(); };
  const EnsembleResult result = run_ensemble(scene, n, duration, path);
  OmissionRun out;
  out.path = result.mean[0];
  out.places = {Vec3(out.path, 0, 0)};
  out.uncertainty = result.standard_error[0];
  out.cpu = result.cpu;
  out.shown = result.sums.steps;
  return out;
}

// --- plans ---------------------------------------------------------------------------------------

// Facts that decide about strains and contacts; the rest decides about the content of files.
PlanFacts facts_of(const Scene& scene, const std::string& strain) {
  PlanFacts facts;
  facts.n_blocks = n_blocks(scene);
  facts.strain = strain;
  const Blocks& blocks = scene.blocks;
  for (std::size_t b = 0; b < blocks.mass.size(); ++b)
    facts.largest_weight_strain =
        std::max(facts.largest_weight_strain, blocks.mass[b] / blocks.volume[b] * g * 2 *
                                                  blocks.shapes.radius[b] / blocks.young[b]);
  return facts;
}

// The scene with the settings of its plan, or of the full one.
Scene planned(Scene scene, bool full, const std::string& strain = "auto") {
  SolverSettings solver;
  solver.strain = strain;
  scene.settings = settings_of(solver, make_plan(facts_of(scene, strain), full));
  return scene;
}

void add_plans(const SlideData& slide, bool full, std::vector<Omission>& out) {
  const auto lone = [](std::uint64_t seed) { return rocks(1, {}, seed); };
  const auto slope = [&slide](std::uint64_t seed) { return slide_scene(slide, {}, seed); };
  const auto stack = [](std::uint64_t) { return tower(10, 0, 30, {}); };
  const auto soft = [](std::uint64_t) { return soft_cube(); };
  const auto cohesive = [](std::uint64_t) { return bonded_column(1e6); };
  const auto fence = [](std::uint64_t seed) {
    return fenced(rocks(3, {}, seed), fence_at(-25, -60, 60));
  };
  // Blocks that sleep do not tremble by their last bits.
  const auto add_rigid = [&out](const std::string& scene, double duration, const auto& make) {
    out.push_back({"all but strains", scene, 1e-9, 0, [=](bool kept) {
                     const bool strains = planned(make(0), false).settings.strains;
                     return run_scene(planned(make(0), kept, strains ? "on" : "off"), duration);
                   }});
  };
  // Strains that are left out change no block by more than this relative size.
  const auto add_all = [&out](const std::string& scene, double duration, const auto& make) {
    out.push_back({"all", scene, 1e-9, strain_that_matters,
                   [=](bool kept) { return run_scene(planned(make(0), kept), duration); }});
  };
  const auto add_many = [&out](const std::string& scene, int n, double duration, const auto& make) {
    out.push_back(
        {"all", scene + ", mean of " + std::to_string(n) + " starts", 0, 0, [=](bool kept) {
           const auto scene_of_seed = [&](std::uint64_t s) { return planned(make(s), kept); };
           return run_many(scene_of_seed, n, duration);
         }});
  };
  add_rigid("lone rock, 12 s", 12, lone);
  add_many("lone rock, 12 s", 48, 12, lone);
  add_rigid("slide of 39 blocks, 2 s", 2, slope);
  // until the mass is chaotic: from 1.7 s on whatever differs grows sixfold in 0.2 s
  add_all("slide of 39 blocks, 1.5 s", 1.5, slope);
  if (full) add_many("slide of 39 blocks, 20 s", 8, 20, slope);
  add_rigid("stack of ten at rest, 20 s", 20, stack);
  add_all("stack of ten at rest, 20 s", 20, stack);
  add_rigid("soft cube, 3 s", 3, soft);
  add_all("soft cube, 3 s", 3, soft);
  add_rigid("four bonded cubes, 3 s", 3, cohesive);
  add_all("four bonded cubes, 3 s", 3, cohesive);
  add_rigid("three rocks and a fence, 8 s", 8, fence);
  add_many("three rocks and a fence, 8 s", 48, 8, fence);
}

// --- items ---------------------------------------------------------------------------------------

void add_items_of_blocks(std::vector<Omission>& out) {
  out.push_back({"strains", "cube slides, 2 s", 0, strain_that_matters, [](bool kept) {
                   Scene scene = cube_on_plane(1, ground_of(20));
                   scene.settings.strains = kept;
                   return run_scene(std::move(scene), 2);
                 }});
  out.push_back({"strains", "soft cube slides, 3 s", 0, strain_that_matters,
                 [](bool kept) {
                   Scene scene = soft_cube();
                   scene.settings.strains = kept;
                   return run_scene(std::move(scene), 3);
                 },
                 true});
  out.push_back(
      {"contacts between blocks", "three rocks that do not meet, 6 s", 0, 0, [](bool kept) {
         Settings settings;
         settings.block_contacts = kept;
         return run_scene(rocks(3, settings), 6, impacts);
       }});
  out.push_back({"contacts between blocks", "one rock, 6 s", 0, 0, [](bool kept) {
                   Settings settings;
                   settings.block_contacts = kept;
                   return run_scene(rocks(1, settings), 6, impacts);
                 }});
  out.push_back({"shear terms", "cube slides without friction, 1 s", 1e-11, 0, [](bool kept) {
                   GroundClass ground;
                   ground.friction = kept ? 1e-14 : 0;
                   return run_scene(cube_on_plane(1, ground), 1);
                 }});
  out.push_back({"bonded areas", "cube slides, 1 s", 1e-9, 0, [](bool kept) {
                   GroundClass ground = ground_of(20);
                   ground.cohesion = kept ? 1e-9 : 0;
                   return run_scene(cube_on_plane(1, ground), 1);
                 }});
  out.push_back({"sleep", "stack of ten at rest, 20 s", 1e-9, 0, [](bool kept) {
                   Settings settings;
                   settings.sleep = !kept;
                   return run_scene(tower(10, 0, 30, settings), 20, kept ? anything : sleepers);
                 }});
}

void add_items_of_ground(std::vector<Omission>& out) {
  // edges of a plane that are looked at carry a part of the weight, each at a point of its own
  out.push_back({"terrain edges and nodes", "cube slides on a plane, 2 s", 0, 1e-5, [](bool kept) {
                   Scene scene = cube_on_plane(1, ground_of(20));
                   const std::uint8_t all = trn_flag::convex_east | trn_flag::convex_south |
                                            trn_flag::convex_diagonal | trn_flag::convex_vertex;
                   if (kept) std::fill(scene.ground.flags.begin(), scene.ground.flags.end(), all);
                   return run_scene(std::move(scene), 2);
                 }});
  out.push_back({"terrain beyond the blocks' reach", "one rock, a hundred times the cells, 6 s", 0,
                 0, [](bool kept) {
                   Scene scene = rocks(1);
                   if (kept) {
                     const GroundClass ground = scene.ground.classes[0];
                     scene.ground = make_ground(make_trn(bumps, 1, 1280), ground);
                   }
                   return run_scene(std::move(scene), 6, impacts);
                 }});
  out.push_back({"base motion", "one rock until it lands, 0.25 s", 1e-12, 0, [](bool kept) {
                   Scene scene = rocks(1);
                   if (kept) scene.base = {{0, 1e9}, {Vec3::Zero(), Vec3::Zero()}, {}};
                   return run_scene(std::move(scene), 0.25);
                 }});
  out.push_back({"flight without search", "three rocks, 6 s", 0, 0, [](bool kept) {
                   Settings settings;
                   settings.flight = !kept;
                   return run_scene(rocks(3, settings), 6, kept ? impacts : skips);
                 }});
}

void add_items_of_fences(std::vector<Omission>& out) {
  out.push_back(
      {"standing fences", "one rock and a fence that it does not reach, 4 s", 0, 0, [](bool kept) {
         Scene scene = rocks(1);
         if (kept) scene = fenced(std::move(scene), fence_at(80, -80, -60));
         const bool stands = n_fixed(scene) > 0;
         return run_scene(std::move(scene), 4,
                          [=](const State& state) { return stands == kept ? impacts(state) : 0; });
       }});
  out.push_back({"turning of rocks far from fences",
                 "three rocks, each as if alone, and a fence, 7 s", 0, 0, [](bool kept) {
                   Settings settings;
                   settings.block_contacts = false;
                   settings.flight = !kept;
                   return run_scene(fenced(rocks(3, settings), fence_at(-25, -60, 60)), 7,
                                    [kept](const State& state) {
                                      const auto hits = static_cast<long>(state.fence.hits.size());
                                      return kept ? hits : std::min(hits, skips(state));
                                    });
                 }});
}

void add_items_of_files(std::vector<Omission>& out) {
  const auto options = [] {
    RunOptions made;
    made.duration = 6;
    made.frame_interval = 0.1;
    made.limits.max_lost_share = 1;
    made.passages = false;
    return made;
  };
  const std::string scene = "three rocks, 6 s";
  out.push_back({"passages", scene, 0, 0, [options](bool kept) {
                   RunOptions wanted = options();
                   wanted.passages = kept;
                   return run_recorded(rocks(3), wanted, {});
                 }});
  out.push_back({"crossings", scene, 0, 0, [options](bool kept) {
                   std::vector<RecordLine> lines;
                   if (kept) lines = {record_line("low", {{-25, -60, 0}, {-25, 60, 0}})};
                   return run_recorded(rocks(3), options(), lines);
                 }});
  out.push_back({"strains in frames", scene + ", strains computed", 0, 0, [options](bool kept) {
                   Settings settings;
                   settings.strains = true;
                   RunOptions wanted = options();
                   wanted.strain = kept;
                   return run_recorded(rocks(3, settings), wanted, {});
                 }});
}

}  // namespace

std::vector<Omission> omissions(const SlideData& slide, bool full) {
  std::vector<Omission> out;
  add_plans(slide, full, out);
  add_items_of_blocks(out);
  add_items_of_ground(out);
  add_items_of_fences(out);
  add_items_of_files(out);
  return out;
}

OmissionRow compare(const Omission& omission, int n) {
  OmissionRow row;
  row.about = omission;
  std::vector<double> kept_cpu, left_out_cpu;
  OmissionRun kept, left_out;
  for (int i = 0; i < n; ++i) {
    kept = omission.run(true);
    left_out = omission.run(false);
    kept_cpu.push_back(kept.cpu);
    left_out_cpu.push_back(left_out.cpu);
  }
  row.kept_cpu = median(kept_cpu);
  row.left_out_cpu = median(left_out_cpu);
  row.path = kept.path;
  row.shown = std::min(kept.shown, left_out.shown);
  for (std::size_t b = 0; b < kept.places.size(); ++b)
    row.apart = std::max(row.apart, (kept.places[b] - left_out.places[b]).norm());
  row.limit = omission.tolerance + omission.tolerance_share * row.path +
              3 * std::hypot(kept.uncertainty, left_out.uncertainty);
  row.holds = row.limit > 0 ? (row.apart <= row.limit) != omission.matters
                            : kept.numbers == left_out.numbers;
  return row;
}

std::string omission_table(const std::vector<OmissionRow>& rows) {
  std::string table =
      "| Item | Scene | CPU ms, kept | left out | ratio | m apart | allowed | m moved | it is |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const OmissionRow& row : rows)
    table += "| " + row.about.item + " | " + row.about.scene + " | " + text(row.kept_cpu * 1e3, 3) +
             " | " + text(row.left_out_cpu * 1e3, 3) + " | " +
             text(row.kept_cpu / row.left_out_cpu, 3) + " | " + text(row.apart, 2) + " | " +
             (row.limit > 0 ? text(row.limit, 2) : "the same bits") + " | " + text(row.path, 4) +
             " | " + (row.about.matters ? "kept by the plan" : "left out") +
             (row.holds ? "" : ", **does not hold**") + " |\n";
  return table;
}

}  // namespace talus
