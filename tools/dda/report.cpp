// Outcome of a run: the JSON of talus-dda, its one line, and the health of the run.
#include "tools/dda/report.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/text.hpp"
#include "base/words.hpp"
#include "post/fragment_sizes.hpp"
#include "record/deep_rows.hpp"
#include "record/pieces.hpp"
#include "tools/frame/moved_json.hpp"

namespace talus {
namespace {

using std::size_t;

// Passages that are not in runner.file.
size_t n_earlier(const Runner& runner) { return runner.earlier ? runner.earlier->size() : 0; }

// Of all moments where passages are recorded, else of those of the frames.
double largest_speed(const Runner& runner) {
  const RunFile& file = runner.file;
  float largest = 0;
  for (size_t i = 0; i < n_earlier(runner); ++i)
    largest = std::max(largest, (*runner.earlier)[i].largest.speed);
  for (const Passage& row : file.passages) largest = std::max(largest, row.largest.speed);
  if (n_earlier(runner) > 0 || !file.passages.empty()) return largest;
  const std::vector<float>& v = file.frames.velocity;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3)
    largest = std::max(largest, std::hypot(v[i], v[i + 1], v[i + 2]));
  return largest;
}

// Mean displacement of the blocks by mass, from the first frame to the last.
Vec3 mean_displacement(const RunFile& file) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (int b = 0; b < n_blocks(file); ++b) {
    const double m = file.blocks.mass[b];
    sum += m * (frame_block(file, n_frames(file.frames) - 1, b).position -
                frame_block(file, 0, b).position);
    mass += m;
  }
  return sum / mass;
}

// Panels of built fences, and those that broke, when and by which block; of rocks that fell one by
// one as they were at the start, and as each rock left those that it pushed.
Json fences_on(const Runner& runner) {
  Json list = Json::array();
  for (const PanelRow& row : runner.file.panels) {
    Json panel = {{"fence", runner.file.lines[row.line].name},
                  {"panel", row.panel},
                  {"work_kj", row.work / 1e3},
                  {"deflection_m", row.deflection},
                  {"broken", row.broken_by >= 0}};
    if (row.broken_by >= 0) {
      panel["broken_at_s"] = row.broken_at;
      panel["broken_by_block"] = row.broken_by;
    }
    if (row.rock >= 0) panel["rock"] = row.rock;
    list.push_back(std::move(panel));
  }
  return list;
}

// When and by which block: of the first few.
std::string broken_panels(const Json& panels) {
  constexpr int most = 5;
  std::string words;
  int n = 0;
  for (const Json& panel : panels) {
    if (!panel["broken"].get<bool>()) continue;
    if (n++ == most) return words + "; all with --json)";
    words += (n == 1 ? " (" : "; ") + panel["fence"].get<std::string>() + " panel " +
             panel["panel"].dump() + " at " + text(panel["broken_at_s"].get<double>(), 4) +
             " s by block " + panel["broken_by_block"].dump();
  }
  return n == 0 ? words : words + ")";
}

std::string fence_summary(const Json& report, const RunFile& file) {
  const Json& panels = report["fences"];
  if (panels.empty()) return "";
  const std::string hits =
      "; " + counted(report["n_fence_hits"].get<std::int64_t>(), "hit") + " on fences, ";
  std::set<int> rocks;  // that broke a panel
  std::int64_t n_broken = 0;
  for (const PanelRow& row : file.panels)
    if (row.broken_by >= 0) ++n_broken, rocks.insert(row.rock);
  if (file.info.independent)
    return hits + "panels broken by " + std::to_string(rocks.size()) + " of " +
           counted(count_different(worlds_of(file)), "rock") + broken_panels(panels);
  return hits + std::to_string(n_broken) + " of " +
         counted(static_cast<std::int64_t>(panels.size()), "panel") + " broken" +
         broken_panels(panels);
}

// Stems of the run, those that were hit, and those that broke; of rocks that fell one by one rock
// by rock.
Json trees_on(const RunFile& file) {
  std::set<std::tuple<int, int, int>> hit, broken;  // world, forest, stem
  const std::vector<int> worlds = worlds_of(file);
  double work = 0;
  for (const TreeHitRow& row : file.tree_hits) {
    const std::tuple stem(worlds[static_cast<std::size_t>(row.hit.block)], row.forest, row.stem);
    hit.insert(stem);
    if (row.broken_by >= 0) broken.insert(stem);
    work += row.hit.work;
  }
  std::int64_t n = 0;
  for (const ForestInfo& forest : file.forests) n += forest.n_stems;
  return {{"n_stems", n},
          {"n_stems_hit", hit.size()},
          {"n_stems_broken", broken.size()},
          {"n_hits", file.tree_hits.size()},
          {"work_kj", work / 1e3}};
}

std::string tree_summary(const Json& report, const RunFile& file) {
  if (!report.contains("trees")) return "";
  const Json& trees = report["trees"];
  if (file.info.independent)
    return "; " + counted(trees["n_stems_hit"].get<std::int64_t>(), "hit") + " on the " +
           counted(trees["n_stems"].get<std::int64_t>(), "stem") + " that each rock met, " +
           trees["n_stems_broken"].dump() + " of them broken";
  return "; " + trees["n_stems_hit"].dump() + " of " +
         counted(trees["n_stems"].get<std::int64_t>(), "stem") + " hit, " +
         trees["n_stems_broken"].dump() + " broken";
}

// Faults that a user must not miss, if any.
std::string trouble_summary(const Json& report) {
  const auto said = [&report](const char* key, const std::string& of, const std::string& what) {
    const auto n = report[key].get<std::int64_t>();
    return n == 0 ? "" : ", " + counted(n, of) + what;
  };
  return said("n_breaks", "break", " into two") +
         said("left_domain", "block", " left the terrain") +
         said("unconverged", "block step", " accepted unconverged");
}

// The remedy for a broken limit, by its name.
std::string health_hint(const std::string& check) {
  const auto is_of = [&check](const char* word) { return check.find(word) != std::string::npos; };
  if (is_of("more than a tenth") || is_of("in the toe"))
    return "take a smaller time_step_s, or merge small blocks ([source] min_block_volume_m3); "
           "max_penetration_m says instead how deep is deep";
  if (is_of("penetration"))
    return "take a smaller time_step_s, or give max_penetration_m if that depth will do";
  if (is_of("left the terrain"))
    return "take a larger terrain, or give max_lost_share if blocks may leave it";
  if (is_of("energy gained") || is_of("not finite") || is_of("below the ground"))
    return "take a smaller time_step_s";
  return "";
}

// Blocks that were deep in something: which block, inside which body, when, where, how deep.
Json deep_blocks_of(const RunFile& file) {
  Json list = Json::array();
  for (const DeepRow& row : file.deep) {
    const Vec3 at = row.place + file.info.origin;
    list.push_back({{"block", row.block},
                    {"partner", partner_name(row, file.lines)},
                    {"depth_m", row.depth},
                    {"thickness_m", row.thickness},
                    {"time_s", row.time},
                    {"first_time_s", row.first_time},
                    {"steps", row.steps},
                    {"position_m", {at.x(), at.y(), at.z()}},
                    {"mass_share", row.mass_share},
                    {"ends_in_toe", row.ends_in_toe != 0},
                    {"met_fence", row.met_fence != 0},
                    {"is_too_fast", row.is_too_fast != 0}});
  }
  return list;
}

// Warning of them in one line: those that matter first, then the heaviest.
std::string deep_warning(const RunFile& file) {
  constexpr size_t most = 3;
  const std::vector<DeepRow> rows = by_weight(file.deep);
  std::string words = counted(static_cast<std::int64_t>(rows.size()), "block") + " of " +
                      percent(mass_share(rows)) + " of the mass came in by more than a tenth of " +
                      (rows.size() == 1 ? "its" : "their") + " thickness: ";
  for (size_t i = 0; i < std::min(most, rows.size()); ++i)
    words += (i == 0 ? "" : "; ") + deep_words(rows[i], file.lines, file.info.origin);
  return words + (rows.size() > most ? "; all stand in deep_blocks of the run" : "");
}

// Blocks that were crushed: which, when, where, by which load.
Json crushed_blocks_of(const RunFile& file) {
  Json list = Json::array();
  for (const CrushedBlock& row : file.crushed) {
    const Vec3 at = row.place + file.info.origin;
    list.push_back({{"block", row.block},
                    {"time_s", row.time},
                    {"load_n", row.load},
                    {"strength_n", row.strength},
                    {"position_m", {at.x(), at.y(), at.z()}},
                    {"volume_m3", row.volume},
                    {"mass_kg", row.mass}});
  }
  return list;
}

// Warning of them in one line.
std::string crushed_warning(const RunFile& file) {
  double volume = 0, mass = 0, all = 0;
  for (const CrushedBlock& row : file.crushed) volume += row.volume, mass += row.mass;
  for (const double m : file.blocks.mass) all += m;
  const CrushedBlock& first = file.crushed.front();
  const Vec3 at = first.place + file.info.origin;
  const bool is_one = file.crushed.size() == 1;
  return counted(static_cast<std::int64_t>(file.crushed.size()), "small block") + " of " +
         text(volume, 3) + " m3, " + percent(mass / all) + " of the mass, " +
         (is_one ? "was" : "were") +
         " crushed; the debris carries nothing and counts where it lies (" +
         (is_one ? "" : "first ") + "block " + std::to_string(first.block) + " at " +
         text(first.time, 4) + " s near " + text(at.x(), 7) + ", " + text(at.y(), 7) + ", " +
         text(at.z(), 5) + "; all stand in crushed_blocks of the run)";
}

// Pieces of blocks that broke, and the energy of their breaking.
Json fragments_of(const RunFile& file) {
  const FragmentSizes sizes = fragment_sizes(file);
  double fracture = 0;
  for (const Break& row : file.breaks) fracture += row.fracture;
  Json json = {{"n_pieces", sizes.n_pieces},
               {"n_unbroken", sizes.n_unbroken},
               {"unbroken_share", sizes.unbroken_share},
               {"largest_m3", sizes.largest},
               {"fracture_j", fracture},
               {"fractal_dimension", nullptr}};
  if (std::isfinite(sizes.dimension)) json["fractal_dimension"] = sizes.dimension;
  return json;
}

}  // namespace

Json plan_json(const ScenePlan& plan) {
  Json list = Json::array();
  for (const PlanItem& item : plan.items)
    list.push_back(
        {{"item", item.item}, {"on", item.on}, {"rule", item.rule}, {"reason", item.reason}});
  return list;
}

Json run_report(const Runner& runner, const ScenePlan& plan, double from_s, double cpu_s) {
  const RunFile& file = runner.file;
  const RunCounters& counters = runner.state.counters;
  const Vec3 moved = mean_displacement(file);
  Json json = {{"run_id", file.info.run_id},
               {"status", file.info.status},
               {"time_s", file.info.time},
               {"n_blocks", n_blocks(file)},
               {"steps", counters.steps},
               {"block_steps", counters.substeps},
               {"flight_skips", counters.flight_skips},
               {"passes", counters.passes},
               {"impacts", counters.impacts},
               {"unconverged", counters.unconverged},
               {"left_domain", counters.left_domain},
               {"n_breaks", file.breaks.size()},
               {"n_passages", n_earlier(runner) + file.passages.size()},
               {"n_crossings", file.crossings.size()},
               {"n_fence_hits", file.fence_hits.size()},
               {"fences", fences_on(runner)},
               {"n_frames", n_frames(file.frames)},
               {"largest_speed_m_s", largest_speed(runner)},
               {"mean_displacement_m", {moved.x(), moved.y(), moved.z()}},
               {"moved", moved_json(moved_of_run(file))},
               {"cpu_time_s", cpu_s},
               {"simulated_s_per_cpu_s", cpu_s > 0 ? (file.info.time - from_s) / cpu_s : 0}};
  if (!file.forests.empty()) json["trees"] = trees_on(file);
  json["health"] = Json::array();
  for (const HealthCheck& check : health_checks(runner))
    json["health"].push_back({{"check", check.name},
                              {"value", check.value},
                              {"limit", check.limit},
                              {"pass", check.pass},
                              {"where", check.where}});
  json["crushed_blocks"] = crushed_blocks_of(file);
  if (!file.breaks.empty()) json["fragments"] = fragments_of(file);
  json["deep_blocks"] = deep_blocks_of(file);
  json["plan"] = plan_json(plan);
  return json;
}

std::string run_summary(const Json& report, const RunFile& file) {
  const auto number = [&report](const char* key) { return text(report[key].get<double>(), 3); };
  const Json& moved = report["mean_displacement_m"];
  const double horizontal = std::hypot(moved[0].get<double>(), moved[1].get<double>());
  const auto count = [&report](const char* key, const char* noun) {
    return counted(report[key].get<std::int64_t>(), noun);
  };
  const double fell = -moved[2].get<double>();
  const std::string centre = "centre of mass moved " + text(horizontal, 3) + " m and " +
                             (fell < 0 ? "rose " : "fell ") + text(std::abs(fell), 3) + " m; ";
  return count("n_blocks", file.info.independent ? "rock" : "block") + ", " + number("time_s") +
         " s in " + count("steps", "step") + ": " + (file.info.independent ? "" : centre) +
         text(moved_of_run(file)) + "; largest speed " + number("largest_speed_m_s") + " m/s, " +
         count("n_passages", "passage") + ", " + count("n_crossings", "crossing") +
         fence_summary(report, file) + tree_summary(report, file) + trouble_summary(report) + "; " +
         text(report["simulated_s_per_cpu_s"].get<double>(), 3) + " s simulated per CPU second";
}

void warn_of_standing_mass(Tool& tool, const RunFile& file) {
  const std::string words = standing_mass_warning(moved_of_run(file));
  if (!words.empty()) tool.warn(words);
}

void record_health(Tool& tool, Runner& runner) {
  runner.file.deep = deep_rows(runner.scene, runner.state, runner.crossings.rows);
  runner.file.crushed = runner.state.crushed;
  const auto warn = [&](const std::string& words) {
    tool.warn(words);
    runner.file.info.warnings += (runner.file.info.warnings.empty() ? "" : "\n") + words;
  };
  if (!runner.file.crushed.empty()) warn(crushed_warning(runner.file));
  if (!runner.file.deep.empty()) warn(deep_warning(runner.file));
  for (const HealthCheck& check : health_checks(runner)) {
    const std::string hint = health_hint(check.name);
    tool.check(check.name, check.value, check.limit, check.pass,
               check.where + (check.where.empty() || hint.empty() ? "" : "; ") + hint);
    if (check.pass) continue;
    runner.file.info.status = "failed";
    runner.file.info.reason += (runner.file.info.reason.empty() ? "" : "; ") + check.name + " is " +
                               text(check.value, 6) + ", limit " + text(check.limit, 6) +
                               (check.where.empty() ? "" : " (" + check.where + ")");
  }
}

}  // namespace talus
