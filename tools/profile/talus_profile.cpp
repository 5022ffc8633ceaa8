// tools/profile/talus_profile.cpp
// Crossings of a line that was drawn after the runs. Page: docs/tools/talus-profile.md
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "post/profile/line_sums.hpp"
#include "post/reduce.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/tool.hpp"
#include "tools/profile/output.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  std::string line, line_file, out, tables, json;
  double step_m = no_value, bin_m = no_value;
};

void declare(Tool& tool, Options& o) {
  tool.option("--line", o.line,
              "the line: \"x,y x,y ...\" in map coordinates of the terrain, blanks between points");
  tool.input("--line-file", o.line_file, "the line: a vector file that holds one");
  tool.output("-o,--out", o.out, "crossings, parts of the line, stations (GeoPackage)").required();
  tool.output_folder(
      "--tables", o.tables,
      "folder for tables and charts: crossings.csv, a row a block; bins.csv, a row a "
      "part of the line; stations.csv, ground and passing blocks along it; ground, "
      "count, energy, speed and height (SVG)");
  tool.json_output(o.json);
  tool.option("--step-m", o.step_m, "between stations [m]; nan: the cells of the terrain")
      .check(number_between(1e-3, 1e6, true));
  tool.option("--bin-m", o.bin_m, "parts that blocks are counted by [m]; nan: 10 to 25 of them")
      .check(number_between(1e-3, 1e6, true));
  tool.footer(
      "Example:\n  talus-profile run_*.h5 --trn bed.tif --line-file road.geojson -o profile.gpkg "
      "--tables profile");
}

Where where_of_line(const Options& o) {
  return o.line.empty() ? Where{o.line_file} : Where{"", 0, "--line"};
}

// The points of "x,y x,y ...".
std::vector<Vec3> points_of(const std::string& line) {
  std::vector<Vec3> points;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    const std::size_t comma = word.find(',');
    double x = 0, y = 0;
    if (comma == std::string::npos || !parse_double(word.substr(0, comma), x) ||
        !parse_double(word.substr(comma + 1), y))
      throw UsageError({"", 0, "--line"}, "point '" + word + "', expected two numbers as x,y",
                       "e.g. --line \"1757190,5917275 1757262,5917275\"");
    points.emplace_back(x, y, 0);
  }
  return points;
}

std::vector<Vec3> read_line(Tool& tool, const Options& o, const Trn& trn) {
  if (o.line.empty() == o.line_file.empty())
    throw UsageError({"", 0, "--line"}, o.line.empty() ? "no line is given" : "there are two lines",
                     "give either --line \"x,y x,y ...\" or --line-file FILE");
  if (!o.line.empty()) {
    const std::vector<Vec3> points = points_of(o.line);
    std::vector<Doubt> doubts;
    if (!points.empty())
      check_place({trn.crs_wkt, window_of(points), trn.crs_wkt}, where_of_line(o), doubts);
    tool.doubts(doubts);
    return points;
  }
  read_members(tool, "line-file", o.line_file);
  const VectorShapes found =
      read_layer(tool, "line-file", {o.line_file, VectorKind::lines}, trn.crs_wkt);
  if (found.shapes.size() != 1)
    throw InputError({o.line_file}, "holds " + counted(found.n_parts, "line") + ", expected one",
                     "choose one, e.g. --line-file \"FILE|subset=fid = 1\", or draw it as one");
  return found.shapes[0];
}

RecordLine line_on_ground(Tool& tool, const Options& o, const Trn& trn) {
  std::vector<Vec2> corners;
  for (const Vec3& point : read_line(tool, o, trn))
    corners.emplace_back((point - trn.origin).head<2>());
  // the corners alone: one that is far away is the fault, not the number of stations up to it
  constexpr double no_stations = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> ends = posts_on_ground(trn, corners, no_stations, where_of_line(o));
  const double step = std::isnan(o.step_m) ? trn.cell_size : o.step_m;
  const double n = record_line("line", ends).chainage.back() / step;
  constexpr double most_stations = 1e4;
  if (n > most_stations)
    throw InputError(where_of_line(o),
                     "stations every " + text(step) + " m are " + text(n, 3) + ", expected up to " +
                         text(most_stations),
                     "give a larger --step-m");
  return record_line("line", posts_on_ground(trn, corners, step, where_of_line(o)));
}

const RunParts wanted{.crossings = false,
                      .checkpoint = false,
                      .objects = false,
                      .only_faults = true,
                      .words = false,
                      .trees = false};

// Passages of the runs of parts.
void add_parts(LineSums& sums, const RunInputs& runs) {
  constexpr std::uint64_t most_rows = 1'000'000;
  for (const PartInput& part : runs.parts()) {
    std::vector<RunFile> of_part;
    for (std::size_t r = 0; r < part.member.size(); ++r) {
      of_part.push_back(run_of(part.file.part, static_cast<int>(r)));
      if (part.member[r] >= 0) of_part[r].run_weight = runs.members[part.member[r]].run_weight;
    }
    for_each_strip(part.file, 1, {}, most_rows, [&](const auto& by_run) {
      for (std::size_t r = 0; r < by_run.size(); ++r)
        if (part.member[r] >= 0) add_passages(sums, of_part[r], part.member[r], by_run[r]);
    });
  }
}

LineSums sums_of(RunInputs& runs, RecordLine line) {
  const Trn& trn = runs.trn();
  LineSums sums = start_line(std::move(line));
  runs.read(wanted, [&](RunFile& run, int index) {
    const RunMember& member = runs.members[index];
    if (!has_frames(run) && run.grid.n_rows == 0)
      throw InputError({where_of(member)}, "has neither frames nor passages",
                       "run talus-dda again with [output] passages = true or frames = true");
    add_run(sums, run, trn);
    if (member.part.empty()) add_passages(sums, run, index, run.passages);
  });
  add_parts(sums, runs);
  finish(sums);
  return sums;
}

LineProfile evaluated(LineSums sums, const RunInputs& runs, double bin_m, const Vec3& origin) {
  LineProfile profile;
  profile.sums = std::move(sums);
  profile.origin = origin;
  for (const RunMember& member : runs.members) profile.run_ids.push_back(member.info.run_id);
  const double length = profile.sums.line.chainage.back();
  const ShareBasis basis = share_basis(clusters_of(runs.members), runs.failed_share());
  profile.whole = across_summary(profile.sums, basis, 0, length);
  const std::vector<double> limits = bin_limits(length, bin_m);
  for (std::size_t i = 0; i + 1 < limits.size(); ++i)
    profile.bins.push_back(across_summary(profile.sums, basis, limits[i], limits[i + 1]));
  profile.stations = station_summaries(profile.sums, basis);
  return profile;
}

void warn_of(Tool& tool, const LineSums& sums) {
  if (sums.n_by_cells > 0)
    tool.warn(
        counted(sums.n_by_cells, "run") + " of " + std::to_string(n_runs(sums)) +
        (sums.n_by_cells == 1 ? " has" : " have") +
        " no frames: what crosses the line is told by the cells under it: upper bounds, far too "
        "high where blocks come to rest at the line");
  if (sums.n_by_cells > 0 && sums.by_centroid)
    tool.warn(
        "cells were passed by centroids alone (--passages-by centroid): blocks that touch the line "
        "with their side may be missed");
  if (sums.grid.n_rows == 0)
    tool.info("no run has passages: the profile along the line holds the ground alone");
}

void run_tool(Tool& tool, const Options& o, RunInputs& runs) {
  const Trn& trn = runs.trn();
  RecordLine line = line_on_ground(tool, o, trn);
  const LineProfile profile = evaluated(sums_of(runs, std::move(line)), runs, o.bin_m, trn.origin);
  warn_of(tool, profile.sums);
  const std::string remark = runs.remark();
  std::vector<std::pair<std::string, std::string>> tags = tags_of(runs.members, runs.left_out);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()},
                             {"RUN_SET", runs.run_set()},
                             {"METHOD", method_text(profile.sums)},
                             {"ERROR", error_text(profile.sums)}});
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  std::vector<VectorLayer> layers = profile_layers(profile);
  mark_layers(layers, remark);
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  if (!o.tables.empty()) {
    const auto write = [&](const std::string& name, const std::string& content) {
      tool.write_text((fs::path(o.tables) / name).string(), content);
    };
    write("crossings.csv", crossing_csv(profile));
    write("bins.csv", bin_csv(profile));
    write("stations.csv", station_csv(profile));
    for (const auto& [name, svg] : profile_charts(profile)) write(name + ".svg", svg);
  }
  Json result = {
      {"run_id", tool.run_id()}, {"tags", Json::object()}, {"n_runs", n_runs(profile.sums)}};
  for (const auto& [key, value] : tags) result["tags"][key] = value;
  result.update(profile_json(profile));
  add_faults(result, faults_of(runs.members, runs.left_out));
  tool.result(result, profile_summary(profile));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-profile", "What crosses a line that was drawn after the runs.");
  RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, runs); });
}
