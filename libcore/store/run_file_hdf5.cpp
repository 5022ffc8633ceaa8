// record/run_file.hpp as HDF5: writes and reads a run file whole, or its head.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "base/error.hpp"
#include "io/h5_hdf5.hpp"
#include "record/passage_rows.hpp"
#include "record/pieces.hpp"
#include "record/run_file.hpp"
#include "store/run_file_pieces_hdf5.hpp"
#include "store/run_file_tables_hdf5.hpp"

namespace talus {
namespace {

const char* const format_name = "talus-run";
constexpr std::int64_t format_version = 2;

// --- groups ------------------------------------------------------------------------------------

// Where local coordinates are on the map.
void write_place(H5Writer& file, const std::string& group, const RunInfo& info) {
  file.attribute(group, "crs", info.crs_wkt);
  file.attribute(group, "origin_m", std::span<const double>(info.origin.data(), 3));
}

void write_info(H5Writer& file, const RunFile& run) {
  const RunInfo& info = run.info;
  file.attribute("", "format", std::string(format_name));
  file.attribute("", "format_version", format_version);
  file.attribute("", "description", std::string("One run of talus-dda"));
  file.attribute("", "version", info.version);
  file.attribute("", "site", info.site);
  write_place(file, "", info);
  file.attribute("", "seed", info.seed);
  for (const InfoText& text : info_texts) {
    const std::string& value = info.*text.field;
    if (text.kind == InfoText::attribute)
      file.attribute("", text.name, value);
    else if (!text.is_optional || !value.empty())
      file.text(text.name, value, text.long_name);
  }
  for (const InfoNumber& number : info_numbers) file.attribute("", number.name, info.*number.field);
  for (const InfoFlag& flag : info_flags)
    file.attribute("", flag.name, std::int64_t{info.*flag.field});
  if (!info.seed_draws)
    file.array<std::int32_t>(seed_draws.name, std::array<std::int32_t, 1>{0}, {{"/one", 1}}, "1",
                             seed_draws.long_name);
}

RunInfo read_info(const H5Reader& file, const std::string& path, bool words) {
  if (file.attribute_text("", "format") != format_name)
    throw InputError({path}, "is not a run of talus-dda");
  if (const std::int64_t version = file.attribute_integer("", "format_version");
      version != format_version)
    throw InputError({path},
                     "has format version " + std::to_string(version) + ", expected " +
                         std::to_string(format_version),
                     "run talus-dda of this version again");
  RunInfo info;
  info.version = file.attribute_text("", "version");
  info.site = file.attribute_text("", "site");
  info.crs_wkt = file.attribute_text("", "crs");
  const std::vector<double> origin = file.attribute_numbers("", "origin_m");
  if (origin.size() != 3 || !std::isfinite(origin[0] + origin[1] + origin[2]))
    throw InputError({path, 0, "origin_m"}, "is not three finite numbers");
  info.origin = Vec3(origin[0], origin[1], origin[2]);
  info.seed = file.attribute_integer("", "seed");
  for (const InfoText& text : info_texts) {
    if (text.kind == InfoText::words && !words) continue;
    if (text.kind == InfoText::attribute)
      info.*text.field = file.attribute_text("", text.name);
    else if (!text.is_optional || file.has(text.name))
      info.*text.field = file.text(text.name);
  }
  for (const InfoNumber& number : info_numbers)
    info.*number.field = file.attribute_number("", number.name);
  for (const InfoFlag& flag : info_flags)
    info.*flag.field = file.attribute_integer("", flag.name) != 0;
  info.seed_draws = !file.has(seed_draws.name);
  return info;
}

void write_frames(H5Writer& file, const RunFile& run) {
  const RunFrames& frames = run.frames;
  const Dimension time{"time_s", frames.time.size()}, block{"/block", run.blocks.mass.size()};
  file.group("frames", "states of all blocks at equal intervals, and at the end");
  write_place(file, "frames", run.info);
  file.array<double>("frames/time_s", frames.time, {time}, "s", "time of the frame");
  file.array<double>("frames/position_m", frames.position, {time, block, {"/axis", 3}}, "m",
                     "centroids, local");
  file.array<float>("frames/attitude", frames.attitude, {time, block, {"/quaternion", 4}}, "1",
                    "quaternions w x y z, body to local axes");
  file.array<float>("frames/velocity_m_s", frames.velocity, {time, block, {"/axis", 3}}, "m/s",
                    "velocities of the centroids");
  file.array<float>("frames/spin_rad_s", frames.spin, {time, block, {"/axis", 3}}, "rad/s",
                    "angular velocities, local axes");
  if (!frames.strain.empty())
    file.array<float>("frames/strain", frames.strain, {time, block, {"strain_component", 6}}, "1",
                      "strains exx eyy ezz gyz gzx gxy, body axes");
}

RunFrames read_frames(const H5Reader& file, std::size_t n_blocks, const std::string& path,
                      bool only_last) {
  const std::size_t n = file.shape("frames/time_s")[0];
  const auto read = [&](const std::string& name, std::size_t columns, auto& values) {
    using Value = typename std::remove_reference_t<decltype(values)>::value_type;
    if (only_last && n > 0) {
      values = file.rows<Value>(name, columns, n - 1, 1);
      return;
    }
    values = file.array<Value>(name, columns);
    if (values.size() != n * columns)
      throw InputError({path, 0, name}, "does not have as many frames as frames/time_s");
  };
  RunFrames frames;
  read("frames/time_s", 1, frames.time);
  read("frames/position_m", 3 * n_blocks, frames.position);
  read("frames/attitude", 4 * n_blocks, frames.attitude);
  read("frames/velocity_m_s", 3 * n_blocks, frames.velocity);
  read("frames/spin_rad_s", 3 * n_blocks, frames.spin);
  if (file.has("frames/strain")) read("frames/strain", 6 * n_blocks, frames.strain);
  return frames;
}

// Only in runs that keep no more than their first and last frame.
void write_reach(H5Writer& file, const RunFile& run) {
  if (!run.reach) return;
  file.group("reach", "what the frames between the first and the last told");
  file.attribute("reach", "path_tolerance_m", run.reach->tolerance);
  const ReachLine& centre = run.reach->centre_of_mass;
  file.attribute("reach", "centre_of_mass_m",
                 std::array<double, 3>{centre.height, centre.path, centre.chord});
  write_block_reach(file, "reach", *run.reach);
  put_points(file, "reach/streamline_m", run.reach->streamline, "point", "m",
             "top, the toe block's path on the ground, toe, local; none: nothing moved");
}

void read_reach(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("reach")) return;
  RunReach reach = read_block_reach(file, "reach");
  reach.tolerance = file.attribute_number("reach", "path_tolerance_m");
  const std::vector<double> centre = file.attribute_numbers("reach", "centre_of_mass_m");
  if (centre.size() != 3)
    throw InputError({path, 0, "reach"}, "centre_of_mass_m is not three numbers");
  reach.centre_of_mass = {centre[0], centre[1], centre[2]};
  reach.streamline = as_points(file.array<double>("reach/streamline_m", 3));
  check_reach(reach, run.blocks.mass.size(), path);
  run.reach = std::move(reach);
}

void write_passages(H5Writer& file, const RunFile& run, const PassageRows* earlier) {
  const std::size_t n = earlier != nullptr ? earlier->size() : 0;
  write_table<Passage>(file, n + run.passages.size(), [&](std::size_t i) -> const Passage& {
    return i < n ? (*earlier)[i] : run.passages[i - n];
  });
  write_grid(file, "passages", run.grid, run.info.origin, run.passages_by_centroid);
}

void read_passages(const H5Reader& file, const std::string& path, RunFile& run) {
  run.grid = read_grid(file, "passages", path);
  run.passages_by_centroid = file.attribute_text("passages", "passes_by") == "centroid";
  run.passages = read_table<Passage>(file);
  for (const Passage& row : run.passages)
    if (row.block < 0 || row.block >= n_blocks(run) || row.cell < 0 ||
        row.cell >= run.grid.n_rows * run.grid.n_cols)
      throw InputError({path, 0, "passages"}, "a row names block " + std::to_string(row.block) +
                                                  ", cell " + std::to_string(row.cell) +
                                                  ", which do not exist");
}

void write_crossings(H5Writer& file, const RunFile& run) {
  write_table(file, run.crossings);
  write_lines(file, run.lines);
}

void read_crossings(const H5Reader& file, const std::string& path, RunFile& run) {
  run.lines = read_lines(file, path);
  run.crossings = read_table<Crossing>(file);
  check_crossings(run, path);
}

// Only in runs of sites with objects.
void write_object_hits(H5Writer& file, const RunFile& run) {
  if (run.objects.empty()) return;
  write_objects(file, run.objects);
  write_table(file, run.object_hits);
}

void read_object_hits(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("objects")) return;
  run.objects = read_objects(file, path);
  run.object_hits = read_table<ObjectHit>(file);
  check_object_hits(run, path);
}

void read_roof_hits(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("roof_hits")) return;
  run.roof_hits = read_table<RoofHit>(file);
  check_roof_hits(run, path);
}

// Only in runs with fences.
void write_fences(H5Writer& file, const RunFile& run) {
  if (run.panels.empty()) return;
  write_table(file, run.panels);
  write_table(file, run.fence_hits);
}

void read_fences(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("fence_panels")) return;
  run.panels = read_table<PanelRow>(file);
  run.fence_hits = read_table<FenceHit>(file);
  check_fences(run, path);
}

// Only in runs with forests.
void write_trees(H5Writer& file, const RunFile& run) {
  if (run.forests.empty()) return;
  std::vector<std::string> names;
  std::vector<int> n_stems;
  for (const ForestInfo& forest : run.forests) {
    names.push_back(forest.name);
    n_stems.push_back(forest.n_stems);
  }
  file.group("forests", "the forests that stood");
  file.names("forests/name", names, "forest", "name of the forest");
  put_indices(file, "forests/n_stems", n_stems, "forest", "stems that stood at the start");
  write_table(file, run.tree_hits);
}

void read_trees(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("tree_hits")) return;
  const std::vector<std::string> names = file.texts("forests/name");
  const std::vector<int> n_stems = file.array<std::int32_t>("forests/n_stems", 1);
  if (n_stems.size() != names.size())
    throw InputError({path, 0, "forests/n_stems"}, "does not have a row for each forest");
  for (std::size_t k = 0; k < names.size(); ++k) run.forests.push_back({names[k], n_stems[k]});
  run.tree_hits = read_table<TreeHitRow>(file);
  check_tree_hits(run, path);
}

void read_deep(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("deep_blocks")) return;
  run.deep = read_table<DeepRow>(file);
  check_deep(run, path);
}

void read_breaks(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("breaks")) return;
  run.breaks = read_table<Break>(file);
  check_breaks(run, path);
}

void read_crushed(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("crushed_blocks")) return;
  run.crushed = read_table<CrushedBlock>(file);
  check_crushed(run, path);
}

void write_phases(H5Writer& file, const RunFile& run) {
  std::vector<std::uint8_t> phases;
  for (const Phase phase : run.phase) phases.push_back(static_cast<std::uint8_t>(phase));
  if (!phases.empty())
    file.array<std::uint8_t>("blocks/phase", phases, {{"/block", phases.size()}}, "1",
                             phase_numbers);
}

std::vector<Phase> read_phases(const H5Reader& file, std::size_t n_blocks,
                               const std::string& path) {
  std::vector<Phase> phases;
  if (!file.has("blocks/phase")) return phases;
  phases = phases_of(file.array<std::uint8_t>("blocks/phase", 1), {path, 0, "blocks/phase"});
  if (phases.size() != n_blocks)
    throw InputError({path, 0, "blocks/phase"}, "does not have a row for each block");
  return phases;
}

}  // namespace

RunFile read_run_file(const std::string& path, const RunParts& parts) {
  const H5Reader file(path);
  RunFile run;
  run.info = read_info(file, path, parts.words);
  run.blocks = read_blocks(file, path);
  run.phase = read_phases(file, run.blocks.mass.size(), path);
  if (parts.frames)
    run.frames = read_frames(file, run.blocks.mass.size(), path, parts.only_last_frame);
  read_reach(file, path, run);
  if (parts.passages && file.has("passages")) read_passages(file, path, run);
  if (parts.crossings) {
    read_crossings(file, path, run);
    read_roof_hits(file, path, run);
    read_fences(file, path, run);
  }
  if (parts.objects) read_object_hits(file, path, run);
  if (parts.trees) read_trees(file, path, run);
  if (parts.health) {
    run.health = read_table<HealthRow>(file, parts.only_faults);
    read_crushed(file, path, run);
    read_deep(file, path, run);
  }
  read_breaks(file, path, run);
  if (!run.blocks.parent.empty() && run.phase.empty())
    throw InputError({path, 0, "blocks/phase"}, "is missing, and tells which pieces are there");
  if (parts.merge_pieces) merge_pieces(run);
  if (parts.checkpoint && file.has("checkpoint"))
    run.checkpoint = file.array<std::uint8_t>("checkpoint", 1);
  return run;
}

RunFile read_run_head(const std::string& path) {
  const H5Reader file(path);
  RunFile run;
  run.info = read_info(file, path, true);
  if (file.has("passages")) run.grid = read_grid(file, "passages", path);
  return run;
}

void write_run_file(const std::string& path, const RunFile& run) {
  write_run_file(path, run, nullptr);
}

void write_run_file(const std::string& path, const RunFile& run, const PassageRows* earlier) {
  H5Writer file;
  write_info(file, run);
  write_blocks(file, run.blocks);
  write_phases(file, run);
  write_frames(file, run);
  write_reach(file, run);
  if (run.grid.n_rows > 0) write_passages(file, run, earlier);
  write_crossings(file, run);
  write_object_hits(file, run);
  if (!run.roof_hits.empty()) write_table(file, run.roof_hits);
  write_fences(file, run);
  write_trees(file, run);
  write_table(file, run.health);
  if (!run.breaks.empty()) write_table(file, run.breaks);
  if (!run.crushed.empty()) write_table(file, run.crushed);
  if (!run.deep.empty()) write_table(file, run.deep);
  if (!run.checkpoint.empty())
    file.array<std::uint8_t>("checkpoint", run.checkpoint, {{"/byte", run.checkpoint.size()}}, "1",
                             "state of the solver and the recorder, for talus-dda --resume");
  file.save(path);
}

void replace_run_file(const std::string& path, const RunFile& run) {
  replace_run_file(path, run, nullptr);
}

void replace_run_file(const std::string& path, const RunFile& run, const PassageRows* earlier) {
  const std::string temporary = path + ".new";
  write_run_file(temporary, run, earlier);
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) throw InputError({path}, "cannot be put in place: " + error.message());
}

}  // namespace talus
