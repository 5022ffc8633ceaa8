// record/run_file.hpp as HDF5: writes and reads a run file whole, or its head.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "base/error.hpp"
#include "io/h5_hdf5.hpp"
#include "io/write_bytes.hpp"
#include "record/run_file.hpp"
#include "scene/stand.hpp"
#include "store/run_file_tables_hdf5.hpp"

namespace talus {
namespace {

const char* const format_name = "talus-run";
constexpr std::int64_t format_version = 1;

// --- arrays of small vectors -------------------------------------------------------------------

template <class Vector>
std::vector<double> flat(const std::vector<Vector>& values) {
  std::vector<double> list;
  list.reserve(values.size() * static_cast<std::size_t>(Vector::SizeAtCompileTime));
  for (const Vector& value : values)
    for (const double entry : value) list.push_back(entry);
  return list;
}

std::vector<Vec3> as_points(const std::vector<double>& list) {
  std::vector<Vec3> points(list.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Vec3(list[3 * i], list[3 * i + 1], list[3 * i + 2]);
  return points;
}

void put_points(H5Writer& file, const std::string& path, const std::vector<Vec3>& points,
                const std::string& units, const std::string& description) {
  file.array<double>(path, flat(points), {points.size(), 3}, units, description);
}

void put_indices(H5Writer& file, const std::string& path, const std::vector<int>& values,
                 const std::string& description) {
  file.array<std::int32_t>(path, values, {values.size()}, "1", description);
}

// --- groups ------------------------------------------------------------------------------------

void write_info(H5Writer& file, const RunFile& run) {
  const RunInfo& info = run.info;
  file.attribute("", "format", std::string(format_name));
  file.attribute("", "format_version", format_version);
  file.attribute("", "description", std::string("One run of talus-dda"));
  file.attribute("", "run_id", info.run_id);
  file.attribute("", "version", info.version);
  file.attribute("", "site", info.site);
  file.attribute("", "crs", info.crs_wkt);
  file.attribute("", "origin_m", std::span<const double>(info.origin.data(), 3));
  file.attribute("", "trn_sha256", info.trn_sha256);
  file.attribute("", "blocks_hash", info.blocks_hash);
  file.attribute("", "law", info.law);
  file.attribute("", "seed", info.seed);
  file.attribute("", "status", info.status);
  file.attribute("", "reason", info.reason);
  file.attribute("", "duration_s", info.duration);
  file.attribute("", "time_s", info.time);
  file.text("config", info.config, "effective settings as TOML, each with its origin");
  file.text("plan", info.plan, "what was computed and what was left out, JSON");
  if (!info.warnings.empty())
    file.text("warnings", info.warnings, "what inputs and settings were warned of, a line each");
}

RunInfo read_info(const H5Reader& file, const std::string& path) {
  if (file.attribute_text("", "format") != format_name)
    throw InputError({path}, "is not a run of talus-dda");
  if (const std::int64_t version = file.attribute_integer("", "format_version");
      version != format_version)
    throw InputError({path},
                     "has format version " + std::to_string(version) + ", expected " +
                         std::to_string(format_version),
                     "run talus-dda of this version again");
  RunInfo info;
  info.run_id = file.attribute_text("", "run_id");
  info.version = file.attribute_text("", "version");
  info.site = file.attribute_text("", "site");
  info.crs_wkt = file.attribute_text("", "crs");
  const std::vector<double> origin = file.attribute_numbers("", "origin_m");
  if (origin.size() != 3 || !std::isfinite(origin[0] + origin[1] + origin[2]))
    throw InputError({path, 0, "origin_m"}, "is not three finite numbers");
  info.origin = Vec3(origin[0], origin[1], origin[2]);
  info.trn_sha256 = file.attribute_text("", "trn_sha256");
  info.blocks_hash = file.attribute_text("", "blocks_hash");
  info.law = file.attribute_text("", "law");
  info.seed = file.attribute_integer("", "seed");
  info.status = file.attribute_text("", "status");
  info.reason = file.attribute_text("", "reason");
  if (file.has("warnings")) info.warnings = file.text("warnings");
  info.duration = file.attribute_number("", "duration_s");
  info.time = file.attribute_number("", "time_s");
  return info;
}

void write_blocks(H5Writer& file, const RunBlocks& blocks) {
  const std::size_t n = blocks.mass.size();
  file.group("blocks", "the blocks; body axes: origin at the centroid, principal axes of inertia");
  file.array<double>("blocks/mass_kg", blocks.mass, {n}, "kg", "mass");
  file.array<double>("blocks/volume_m3", blocks.volume, {n}, "m3", "volume");
  put_points(file, "blocks/inertia_kg_m2", blocks.inertia, "kg m2", "principal moments of inertia");
  std::vector<Vec3> position;
  std::vector<double> attitude;
  for (const Pose& pose : blocks.rest) {
    position.push_back(pose.position);
    for (const double q :
         {pose.attitude.w(), pose.attitude.x(), pose.attitude.y(), pose.attitude.z()})
      attitude.push_back(q);
  }
  put_points(file, "blocks/rest_position_m", position, "m", "centroid as cut, local");
  file.array<double>("blocks/rest_attitude", attitude, {n, 4}, "1",
                     "quaternion w x y z as cut, body to local axes");
  if (!blocks.weight.empty())
    file.array<double>("blocks/weight", blocks.weight, {n}, "1", "weight in statistics");
  put_points(file, "blocks/vertices_m", blocks.vertices, "m", "vertices, body axes");
  put_indices(file, "blocks/vertex_begin", blocks.vertex_begin,
              "vertices of block b: [b], [b + 1)");
  put_indices(file, "blocks/face_vertices", blocks.face_vertices,
              "indices into vertices_m, face by face, counter-clockwise from outside");
  put_indices(file, "blocks/face_begin", blocks.face_begin,
              "first entry of face f in face_vertices");
  put_indices(file, "blocks/block_face_begin", blocks.block_face_begin,
              "faces of block b: [b], [b + 1)");
}

// `begin` starts at 0, does not decrease and ends at `end`; it has n + 1 entries.
void check_begin(const std::vector<int>& begin, std::size_t n, std::size_t end,
                 const Where& where) {
  if (begin.size() != n + 1 || begin.front() != 0 ||
      static_cast<std::size_t>(begin.back()) != end || !std::is_sorted(begin.begin(), begin.end()))
    throw InputError(where, "does not divide the array that it points into");
}

void check_indices(const std::vector<int>& values, std::size_t n, const Where& where) {
  for (const int value : values)
    if (value < 0 || static_cast<std::size_t>(value) >= n)
      throw InputError(where, "holds " + std::to_string(value) + ", expected 0 to " +
                                  std::to_string(n) + " exclusive");
}

RunBlocks read_blocks(const H5Reader& file, const std::string& path) {
  RunBlocks blocks;
  blocks.mass = file.array<double>("blocks/mass_kg", 1);
  const std::size_t n = blocks.mass.size();
  const auto same = [&](const std::string& name, std::size_t rows) {
    if (rows != n)
      throw InputError({path, 0, name}, "has " + std::to_string(rows) + " rows for " +
                                            std::to_string(n) + " blocks");
  };
  blocks.volume = file.array<double>("blocks/volume_m3", 1);
  same("blocks/volume_m3", blocks.volume.size());
  if (file.has("blocks/weight")) {
    blocks.weight = file.array<double>("blocks/weight", 1);
    same("blocks/weight", blocks.weight.size());
  }
  blocks.inertia = as_points(file.array<double>("blocks/inertia_kg_m2", 3));
  same("blocks/inertia_kg_m2", blocks.inertia.size());
  const std::vector<Vec3> position = as_points(file.array<double>("blocks/rest_position_m", 3));
  same("blocks/rest_position_m", position.size());
  const std::vector<double> attitude = file.array<double>("blocks/rest_attitude", 4);
  same("blocks/rest_attitude", attitude.size() / 4);
  for (std::size_t b = 0; b < n; ++b) {
    const double* q = attitude.data() + 4 * b;
    blocks.rest.push_back({position[b], Quat(q[0], q[1], q[2], q[3])});
  }
  blocks.vertices = as_points(file.array<double>("blocks/vertices_m", 3));
  blocks.vertex_begin = file.array<std::int32_t>("blocks/vertex_begin", 1);
  blocks.face_vertices = file.array<std::int32_t>("blocks/face_vertices", 1);
  blocks.face_begin = file.array<std::int32_t>("blocks/face_begin", 1);
  blocks.block_face_begin = file.array<std::int32_t>("blocks/block_face_begin", 1);
  check_begin(blocks.vertex_begin, n, blocks.vertices.size(), {path, 0, "blocks/vertex_begin"});
  if (blocks.face_begin.empty()) throw InputError({path, 0, "blocks/face_begin"}, "is empty");
  check_begin(blocks.face_begin, blocks.face_begin.size() - 1, blocks.face_vertices.size(),
              {path, 0, "blocks/face_begin"});
  check_begin(blocks.block_face_begin, n, blocks.face_begin.size() - 1,
              {path, 0, "blocks/block_face_begin"});
  check_indices(blocks.face_vertices, blocks.vertices.size(), {path, 0, "blocks/face_vertices"});
  return blocks;
}

void write_frames(H5Writer& file, const RunFile& run) {
  const RunFrames& frames = run.frames;
  const std::size_t n = frames.time.size(), n_blocks = run.blocks.mass.size();
  file.group("frames", "states of all blocks at equal intervals, and at the end");
  file.array<double>("frames/time_s", frames.time, {n}, "s", "time of the frame");
  file.array<double>("frames/position_m", frames.position, {n, n_blocks, 3}, "m",
                     "centroids, local");
  file.array<float>("frames/attitude", frames.attitude, {n, n_blocks, 4}, "1",
                    "quaternions w x y z, body to local axes");
  file.array<float>("frames/velocity_m_s", frames.velocity, {n, n_blocks, 3}, "m/s",
                    "velocities of the centroids");
  file.array<float>("frames/spin_rad_s", frames.spin, {n, n_blocks, 3}, "rad/s",
                    "angular velocities, local axes");
  if (!frames.strain.empty())
    file.array<float>("frames/strain", frames.strain, {n, n_blocks, 6}, "1",
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

void write_passages(H5Writer& file, const RunFile& run) {
  write_passage_table(file, run.passages);
  const PassageGrid& grid = run.grid;
  const Vec2 corner = grid.corner + run.info.origin.head<2>();
  file.attribute("passages", "corner_map_m", std::span<const double>(corner.data(), 2));
  file.attribute("passages", "corner_local_m", std::span<const double>(grid.corner.data(), 2));
  file.attribute("passages", "cell_size_m", grid.cell_size);
  file.attribute("passages", "n_rows", static_cast<std::int64_t>(grid.n_rows));
  file.attribute("passages", "n_cols", static_cast<std::int64_t>(grid.n_cols));
  file.attribute("passages", "passes_by",
                 std::string(run.passages_by_centroid ? "centroid" : "footprint"));
}

PassageGrid read_grid(const H5Reader& file, const std::string& path) {
  PassageGrid grid;
  const Where where{path, 0, "passages"};
  const std::vector<double> corner = file.attribute_numbers("passages", "corner_local_m");
  if (corner.size() != 2) throw InputError(where, "corner_local_m is not two numbers");
  grid.corner = {corner[0], corner[1]};
  grid.cell_size = file.attribute_number("passages", "cell_size_m");
  const std::int64_t n_rows = file.attribute_integer("passages", "n_rows");
  const std::int64_t n_cols = file.attribute_integer("passages", "n_cols");
  constexpr std::int64_t most = 1LL << 30;
  if (!(grid.cell_size > 0) || !std::isfinite(corner[0] + corner[1] + grid.cell_size) ||
      n_rows < 1 || n_cols < 1 || n_rows > most || n_cols > most / n_rows)
    throw InputError(where, "the grid of cells makes no sense");
  grid.n_rows = static_cast<int>(n_rows);
  grid.n_cols = static_cast<int>(n_cols);
  return grid;
}

void read_passages(const H5Reader& file, const std::string& path, RunFile& run) {
  run.grid = read_grid(file, path);
  run.passages_by_centroid = file.attribute_text("passages", "passes_by") == "centroid";
  run.passages = read_passage_table(file);
  for (const Passage& row : run.passages)
    if (row.block < 0 || row.block >= n_blocks(run) || row.cell < 0 ||
        row.cell >= run.grid.n_rows * run.grid.n_cols)
      throw InputError({path, 0, "passages"}, "a row names block " + std::to_string(row.block) +
                                                  ", cell " + std::to_string(row.cell) +
                                                  ", which do not exist");
}

void write_crossings(H5Writer& file, const RunFile& run) {
  write_crossing_table(file, run.crossings);
  std::vector<std::string> names;
  std::vector<Vec3> points;
  std::vector<int> begin{0}, standing;
  for (const RecordLine& line : run.lines) {
    names.push_back(line.name);
    standing.push_back(line.standing ? 1 : 0);
    points.insert(points.end(), line.points.begin(), line.points.end());
    begin.push_back(static_cast<int>(points.size()));
  }
  file.group("lines", "the lines that crossings belong to");
  file.texts("lines/name", names, "name of the line");
  put_points(file, "lines/points_m", points, "m", "points of all lines, local, z = base");
  put_indices(file, "lines/begin", begin, "points of line l: [l], [l + 1)");
  put_indices(file, "lines/standing", standing, "1: a fence that stops blocks, 0: a line only");
}

void read_crossings(const H5Reader& file, const std::string& path, RunFile& run) {
  const std::vector<std::string> names = file.texts("lines/name");
  const std::vector<Vec3> points = as_points(file.array<double>("lines/points_m", 3));
  const std::vector<int> begin = file.array<std::int32_t>("lines/begin", 1);
  check_begin(begin, names.size(), points.size(), {path, 0, "lines/begin"});
  const std::vector<int> standing = file.array<std::int32_t>("lines/standing", 1);
  if (standing.size() != names.size())
    throw InputError({path, 0, "lines/standing"}, "does not have a row for each line");
  for (std::size_t l = 0; l < names.size(); ++l) {
    run.lines.push_back(
        record_line(names[l], {points.begin() + begin[l], points.begin() + begin[l + 1]}));
    run.lines.back().standing = standing[l] != 0;
  }
  run.crossings = read_crossing_table(file);
  for (Crossing& row : run.crossings) {
    const bool known = row.block >= 0 && row.block < n_blocks(run) && row.line >= 0 &&
                       row.line < static_cast<int>(run.lines.size());
    if (!known || row.segment < 0 ||
        row.segment + 1 >= static_cast<int>(run.lines[row.line].points.size()))
      throw InputError({path, 0, "crossings"}, "a row names a block or line that does not exist");
    row.beside = row.n_crossings == 0;
  }
}

// Only in runs with fences that stood.
void write_fences(H5Writer& file, const RunFile& run) {
  if (run.panels.empty()) return;
  write_panel_table(file, run.panels);
  write_hit_table(file, run.fence_hits);
}

void read_fences(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("fence_panels")) return;
  run.panels = read_panel_table(file);
  run.fence_hits = read_hit_table(file);
  const auto is_known = [&](int line, int panel) {
    return line >= 0 && line < static_cast<int>(run.lines.size()) && panel >= 0 &&
           panel + 1 < static_cast<int>(run.lines[line].points.size());
  };
  for (const PanelRow& row : run.panels)
    if (!is_known(row.line, row.panel) || row.broken_by >= n_blocks(run))
      throw InputError({path, 0, "fence_panels"}, "a row names a panel that does not exist");
  for (const FenceHit& row : run.fence_hits)
    if (!is_known(row.line, row.panel) || row.block < 0 || row.block >= n_blocks(run))
      throw InputError({path, 0, "fence_hits"}, "a row names a block or panel that does not exist");
}

// Only in runs with forests that stood.
void write_trees(H5Writer& file, const RunFile& run) {
  if (run.forests.empty()) return;
  std::vector<std::string> names;
  std::vector<int> n_stems;
  for (const ForestInfo& forest : run.forests) {
    names.push_back(forest.name);
    n_stems.push_back(forest.n_stems);
  }
  file.group("forests", "the forests that stood");
  file.texts("forests/name", names, "name of the forest");
  put_indices(file, "forests/n_stems", n_stems, "stems that stood at the start");
  write_tree_hit_table(file, run.tree_hits);
}

void read_trees(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("tree_hits")) return;
  const std::vector<std::string> names = file.texts("forests/name");
  const std::vector<int> n_stems = file.array<std::int32_t>("forests/n_stems", 1);
  if (n_stems.size() != names.size())
    throw InputError({path, 0, "forests/n_stems"}, "does not have a row for each forest");
  for (std::size_t k = 0; k < names.size(); ++k) run.forests.push_back({names[k], n_stems[k]});
  run.tree_hits = read_tree_hit_table(file);
  const int n_species = static_cast<int>(known_species().size());
  for (const TreeHitRow& row : run.tree_hits)
    if (row.forest < 0 || row.forest >= static_cast<int>(names.size()) || row.species < 0 ||
        row.species >= n_species || row.hit.block < 0 || row.hit.block >= n_blocks(run) ||
        row.broken_by >= n_blocks(run))
      throw InputError({path, 0, "tree_hits"},
                       "a row names a block, forest or species that does not exist");
}

void read_deep(const H5Reader& file, const std::string& path, RunFile& run) {
  if (!file.has("deep_blocks")) return;
  run.deep = read_deep_table(file);
  for (const DeepRow& row : run.deep)
    if (row.block < 0 || row.block >= n_blocks(run) || row.partner >= n_blocks(run) ||
        row.partner < DeepRow::fixed_body)
      throw InputError({path, 0, "deep_blocks"}, "a row names a block that does not exist");
}

void write_phases(H5Writer& file, const RunFile& run) {
  std::vector<std::uint8_t> phases;
  for (const Phase phase : run.phase) phases.push_back(static_cast<std::uint8_t>(phase));
  if (!phases.empty())
    file.array<std::uint8_t>("blocks/phase", phases, {phases.size()}, "1",
                             "at the end: 0 near the ground, 1 in flight, 2 asleep, 3 left the "
                             "terrain, 4 stopped for want of finite numbers");
}

std::vector<Phase> read_phases(const H5Reader& file, std::size_t n_blocks,
                               const std::string& path) {
  std::vector<Phase> phases;
  if (!file.has("blocks/phase")) return phases;
  for (const std::uint8_t phase : file.array<std::uint8_t>("blocks/phase", 1)) {
    if (phase > static_cast<std::uint8_t>(Phase::stopped))
      throw InputError({path, 0, "blocks/phase"}, "holds an unknown phase");
    phases.push_back(static_cast<Phase>(phase));
  }
  if (phases.size() != n_blocks)
    throw InputError({path, 0, "blocks/phase"}, "does not have a row for each block");
  return phases;
}

}  // namespace

RunFile read_run_file(const std::string& path, const RunParts& parts) {
  const H5Reader file(path);
  RunFile run;
  run.info = read_info(file, path);
  if (parts.words) {
    run.info.config = file.text("config");
    run.info.plan = file.text("plan");
  }
  run.blocks = read_blocks(file, path);
  run.phase = read_phases(file, run.blocks.mass.size(), path);
  if (parts.frames)
    run.frames = read_frames(file, run.blocks.mass.size(), path, parts.only_last_frame);
  if (parts.passages && file.has("passages")) read_passages(file, path, run);
  if (parts.crossings) {
    read_crossings(file, path, run);
    read_fences(file, path, run);
  }
  if (parts.trees) read_trees(file, path, run);
  if (parts.health) {
    run.health = read_health_table(file, parts.only_faults);
    read_deep(file, path, run);
  }
  if (parts.checkpoint && file.has("checkpoint"))
    run.checkpoint = file.array<std::uint8_t>("checkpoint", 1);
  return run;
}

RunFile read_run_head(const std::string& path) {
  const H5Reader file(path);
  RunFile run;
  run.info = read_info(file, path);
  if (file.has("passages")) run.grid = read_grid(file, path);
  return run;
}

void write_run_file(const std::string& path, const RunFile& run) {
  H5Writer file;
  write_info(file, run);
  write_blocks(file, run.blocks);
  write_phases(file, run);
  write_frames(file, run);
  if (run.grid.n_rows > 0) write_passages(file, run);
  write_crossings(file, run);
  write_fences(file, run);
  write_trees(file, run);
  write_health_table(file, run.health);
  if (!run.deep.empty()) write_deep_table(file, run.deep);
  if (!run.checkpoint.empty())
    file.array<std::uint8_t>("checkpoint", run.checkpoint, {run.checkpoint.size()}, "1",
                             "state of the solver and the recorder, for talus-dda --resume");
  write_bytes(path, file.image());
}

void replace_run_file(const std::string& path, const RunFile& run) {
  const std::string temporary = path + ".new";
  write_run_file(temporary, run);
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) throw InputError({path}, "cannot be put in place: " + error.message());
}

}  // namespace talus
