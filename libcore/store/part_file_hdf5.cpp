// Writes and reads parts as HDF5: many runs reduced to their first and last frame, their tables,
// and their passages sorted by cell. Blocks, lines and objects that runs share are stored once.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "base/write_bytes.hpp"
#include "io/h5_hdf5.hpp"
#include "record/part_file.hpp"
#include "store/run_file_pieces_hdf5.hpp"
#include "store/run_file_tables_hdf5.hpp"

namespace talus {
namespace {

const char* const format_name = "talus-part";
constexpr std::int64_t format_version = 4;

// --- data shared by runs -----------------------------------------------------------------------

template <class T>
void hash(Sha256& sum, const std::vector<T>& values) {
  const std::uint64_t n = values.size();
  sum.add(&n, sizeof n);
  if (n > 0) sum.add(values.data(), n * sizeof(T));
}

std::string digest_of(const RunBlocks& b) {
  Sha256 sum;
  for (const auto* list : {&b.mass, &b.volume, &b.weight}) hash(sum, *list);
  for (const auto* list : {&b.inertia, &b.vertices}) hash(sum, *list);
  for (const Pose& pose : b.rest) {
    sum.add(pose.position.data(), 3 * sizeof(double));
    sum.add(pose.attitude.coeffs().data(), 4 * sizeof(double));
  }
  for (const auto* list : {&b.vertex_begin, &b.face_vertices, &b.face_begin, &b.block_face_begin,
                           &b.generation, &b.body})
    hash(sum, *list);
  return sum.hex();
}

std::string digest_of(const std::vector<RecordLine>& lines) {
  Sha256 sum;
  for (const RecordLine& line : lines) {
    sum.add(line.name.c_str(), line.name.size() + 1);
    hash(sum, line.points);
    sum.add(&line.standing, sizeof line.standing);
  }
  return sum.hex();
}

std::string digest_of(const std::vector<RecordObject>& objects) {
  Sha256 sum;
  for (const RecordObject& object : objects) {
    for (const std::string* word : {&object.name, &object.kind})
      sum.add(word->c_str(), word->size() + 1);
    sum.add(&object.radius, sizeof object.radius);
    for (const ObjectPart& part : object.parts) {
      hash(sum, part.points);
      sum.add(&part.is_area, sizeof part.is_area);
    }
    for (const std::vector<Vec2>& roof : object.roofs) hash(sum, roof);
  }
  return sum.hex();
}

// The index of a digest; `is_new` when it has not been seen before.
int index_of(std::vector<std::pair<std::string, int>>& known, const std::string& digest,
             bool& is_new) {
  const auto at = std::lower_bound(known.begin(), known.end(), std::pair{digest, 0});
  is_new = at == known.end() || at->first != digest;
  if (!is_new) return at->second;
  const int index = static_cast<int>(known.size());
  known.insert(at, {digest, index});
  return index;
}

template <class T>
void extend(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

// `begin` without its first entry, moved up by `by`.
void extend_begin(std::vector<int>& begin, const std::vector<int>& more, int by) {
  for (std::size_t i = 1; i < more.size(); ++i) begin.push_back(more[i] + by);
}

// Where nothing broke, each block is a body of its own, and says nothing of it.
void leave_out_if_whole(RunBlocks& blocks) {
  const auto is_zero = [](int generation) { return generation == 0; };
  bool is_whole = std::all_of(blocks.generation.begin(), blocks.generation.end(), is_zero);
  for (std::size_t b = 0; b < blocks.body.size(); ++b)
    is_whole = is_whole && blocks.body[b] == static_cast<int>(b);
  if (!is_whole) return;
  blocks.generation.clear();
  blocks.body.clear();
}

void extend_bodies(RunBlocks& all, const RunBlocks& more) {
  const std::size_t n = more.mass.size();
  if (more.body.empty())
    for (std::size_t b = 0; b < n; ++b) all.body.push_back(static_cast<int>(b));
  else
    extend(all.body, more.body);
  if (more.generation.empty())
    all.generation.resize(all.generation.size() + n, 0);
  else
    extend(all.generation, more.generation);
}

void extend_blocks(RunBlocks& all, const RunBlocks& more) {
  const int n_vertices = static_cast<int>(all.vertices.size());
  const int n_entries = static_cast<int>(all.face_vertices.size());
  const int n_faces = static_cast<int>(all.face_begin.size()) - 1;
  extend(all.mass, more.mass);
  extend(all.volume, more.volume);
  if (more.weight.empty())
    all.weight.resize(all.weight.size() + more.mass.size(), 1);
  else
    extend(all.weight, more.weight);
  extend_bodies(all, more);
  extend(all.inertia, more.inertia);
  extend(all.rest, more.rest);
  extend(all.vertices, more.vertices);
  for (const int v : more.face_vertices) all.face_vertices.push_back(v + n_vertices);
  extend_begin(all.vertex_begin, more.vertex_begin, n_vertices);
  extend_begin(all.face_begin, more.face_begin, n_entries);
  extend_begin(all.block_face_begin, more.block_face_begin, n_faces);
}

template <class T>
std::vector<T> piece(const std::vector<T>& list, std::size_t first, std::size_t end) {
  return {list.begin() + static_cast<std::ptrdiff_t>(first),
          list.begin() + static_cast<std::ptrdiff_t>(end)};
}

// Entries first..end of `begin`, moved down so that they start at 0.
std::vector<int> piece_of_begin(const std::vector<int>& begin, int first, int end) {
  std::vector<int> out = piece(begin, first, end + 1);
  const int by = out.front();
  for (int& entry : out) entry -= by;
  return out;
}

RunBlocks blocks_between(const RunBlocks& all, int first, int end) {
  RunBlocks out;
  out.mass = piece(all.mass, first, end);
  out.volume = piece(all.volume, first, end);
  out.weight = piece(all.weight, first, end);
  if (std::all_of(out.weight.begin(), out.weight.end(), [](double w) { return w == 1; }))
    out.weight.clear();
  if (!all.body.empty()) out.body = piece(all.body, first, end);
  if (!all.generation.empty()) out.generation = piece(all.generation, first, end);
  leave_out_if_whole(out);
  out.inertia = piece(all.inertia, first, end);
  out.rest = piece(all.rest, first, end);
  const int v0 = all.vertex_begin[first], v1 = all.vertex_begin[end];
  const int f0 = all.block_face_begin[first], f1 = all.block_face_begin[end];
  out.vertex_begin = piece_of_begin(all.vertex_begin, first, end);
  out.vertices = piece(all.vertices, v0, v1);
  out.block_face_begin = piece_of_begin(all.block_face_begin, first, end);
  out.face_begin = piece_of_begin(all.face_begin, f0, f1);
  out.face_vertices = piece(all.face_vertices, all.face_begin[f0], all.face_begin[f1]);
  for (int& v : out.face_vertices) v -= v0;
  return out;
}

// --- lists of all runs, one behind the other ---------------------------------------------------

template <class Field>
auto joined(const Part& part, const Field& field) {
  std::remove_cvref_t<decltype(field(part.runs.front()))> all;
  for (const RunFile& run : part.runs) extend(all, field(run));
  return all;
}

// Where each run's rows begin in a joined list.
template <class Size>
std::vector<int> begin_of(const Part& part, const Size& size) {
  std::vector<int> begin{0};
  for (const RunFile& run : part.runs) begin.push_back(begin.back() + static_cast<int>(size(run)));
  return begin;
}

template <class Field>
void put_begin(H5Writer& file, const std::string& group, const Part& part, const Field& field) {
  put_indices(file, group + "/run_begin",
              begin_of(part, [&](const RunFile& run) { return field(run).size(); }), "run_bound",
              "rows of run r: [r], [r + 1)");
}

// Hands each run its piece of a joined list.
template <class T, class Field>
void share_out(const H5Reader& file, const std::string& path, const std::string& group, Part& part,
               const std::vector<T>& all, const Field& field) {
  const std::vector<int> begin = file.array<std::int32_t>(group + "/run_begin", 1);
  check_begin(begin, part.runs.size(), all.size(), {path, 0, group + "/run_begin"});
  for (std::size_t r = 0; r < part.runs.size(); ++r)
    field(part.runs[r]) = piece(all, begin[r], begin[r + 1]);
}

// --- groups ------------------------------------------------------------------------------------

bool has_objects(const Part& part) {
  return std::any_of(part.objects.begin(), part.objects.end(),
                     [](const auto& objects) { return !objects.empty(); });
}

void write_runs(H5Writer& file, const Part& part) {
  const RunInfo& first = part.runs.front().info;
  file.attribute("", "format", std::string(format_name));
  file.attribute("", "format_version", format_version);
  file.attribute("", "description",
                 std::string("Runs of talus-dda with their first and last frame"));
  file.attribute("", "version", first.version);
  file.attribute("", "site", first.site);
  file.attribute("", "crs", first.crs_wkt);
  file.attribute("", "origin_m", std::span<const double>(first.origin.data(), 3));
  file.attribute("", "path_tolerance_m", part.path_tolerance);
  file.group("runs", "the runs, by their id");
  file.names("runs/name", part.name, "run", "file that the run stood in, with its folder");
  for (const InfoText& text : info_texts) {
    std::vector<std::string> values;
    for (const RunFile& run : part.runs) values.push_back(run.info.*text.field);
    file.texts(std::string("runs/") + text.name, values, "run", text.long_name);
  }
  for (const InfoNumber& number : info_numbers) {
    std::vector<double> values;
    for (const RunFile& run : part.runs) values.push_back(run.info.*number.field);
    file.array<double>(std::string("runs/") + number.name, values, {{"run", values.size()}},
                       number.units, number.long_name);
  }
  const auto put_flag = [&](const InfoFlag& flag) {
    std::vector<int> values;
    for (const RunFile& run : part.runs) values.push_back(run.info.*flag.field ? 1 : 0);
    put_indices(file, std::string("runs/") + flag.name, values, "run", flag.long_name);
  };
  for (const InfoFlag& flag : info_flags) put_flag(flag);
  put_flag(seed_draws);
  std::vector<std::int64_t> seeds;
  for (const RunFile& run : part.runs) seeds.push_back(run.info.seed);
  file.array<std::int64_t>("runs/seed", seeds, {{"run", seeds.size()}}, "1", "seed");
  put_indices(file, "runs/blocks", part.blocks_of_run, "run", "index of its set of blocks");
  put_indices(file, "runs/lines", part.lines_of_run, "run", "index of its set of lines");
  if (has_objects(part))
    put_indices(file, "runs/objects", part.objects_of_run, "run", "index of its set of objects");
}

void read_runs(const H5Reader& file, const std::string& path, Part& part) {
  if (const std::int64_t version = file.attribute_integer("", "format_version");
      version != format_version)
    throw InputError({path},
                     "has format version " + std::to_string(version) + ", expected " +
                         std::to_string(format_version),
                     "make it again with talus-reduce of this version");
  const std::vector<double> origin = file.attribute_numbers("", "origin_m");
  if (origin.size() != 3 || !std::isfinite(origin[0] + origin[1] + origin[2]))
    throw InputError({path, 0, "origin_m"}, "is not three finite numbers");
  RunFile common;
  common.info.version = file.attribute_text("", "version");
  common.info.site = file.attribute_text("", "site");
  common.info.crs_wkt = file.attribute_text("", "crs");
  common.info.origin = Vec3(origin[0], origin[1], origin[2]);
  part.path_tolerance = file.attribute_number("", "path_tolerance_m");
  part.name = file.texts("runs/name");
  part.runs.assign(part.name.size(), common);
  const auto same = [&](const std::string& name, std::size_t n) {
    if (n != part.runs.size())
      throw InputError({path, 0, "runs/" + name}, "does not have a row for each run");
  };
  for (const InfoText& text : info_texts) {
    const std::vector<std::string> values = file.texts(std::string("runs/") + text.name);
    same(text.name, values.size());
    for (std::size_t r = 0; r < values.size(); ++r) part.runs[r].info.*text.field = values[r];
  }
  for (const InfoNumber& number : info_numbers) {
    const std::vector<double> values = file.array<double>(std::string("runs/") + number.name, 1);
    same(number.name, values.size());
    for (std::size_t r = 0; r < values.size(); ++r) part.runs[r].info.*number.field = values[r];
  }
  const auto take_flag = [&](const InfoFlag& flag) {
    const std::vector<int> values = file.array<std::int32_t>(std::string("runs/") + flag.name, 1);
    same(flag.name, values.size());
    for (std::size_t r = 0; r < values.size(); ++r) part.runs[r].info.*flag.field = values[r] != 0;
  };
  for (const InfoFlag& flag : info_flags) take_flag(flag);
  take_flag(seed_draws);
  const std::vector<std::int64_t> seeds = file.array<std::int64_t>("runs/seed", 1);
  same("seed", seeds.size());
  for (std::size_t r = 0; r < seeds.size(); ++r) part.runs[r].info.seed = seeds[r];
  part.blocks_of_run = file.array<std::int32_t>("runs/blocks", 1);
  same("blocks", part.blocks_of_run.size());
  part.lines_of_run = file.array<std::int32_t>("runs/lines", 1);
  same("lines", part.lines_of_run.size());
  part.objects_of_run.assign(part.runs.size(), 0);
  if (file.has("runs/objects")) part.objects_of_run = file.array<std::int32_t>("runs/objects", 1);
  same("objects", part.objects_of_run.size());
}

void check_index(const std::vector<int>& index, std::size_t n, const Where& where) {
  for (const int i : index)
    if (i < 0 || static_cast<std::size_t>(i) >= n)
      throw InputError(where, "names a set that does not exist");
}

void write_sets(H5Writer& file, const Part& part) {
  RunBlocks all;
  std::vector<int> begin{0};
  for (const RunBlocks& blocks : part.blocks) {
    extend_blocks(all, blocks);
    begin.push_back(static_cast<int>(all.mass.size()));
  }
  const auto is_whole = [](const RunBlocks& blocks) { return blocks.body.empty(); };
  if (std::all_of(part.blocks.begin(), part.blocks.end(), is_whole)) {
    all.body.clear();
    all.generation.clear();
  }
  write_blocks(file, all);
  put_indices(file, "blocks/set_begin", begin, "set_bound", "blocks of set s: [s], [s + 1)");
  std::vector<RecordLine> lines;
  begin = {0};
  for (const std::vector<RecordLine>& of_set : part.lines) {
    extend(lines, of_set);
    begin.push_back(static_cast<int>(lines.size()));
  }
  write_lines(file, lines);
  put_indices(file, "lines/set_begin", begin, "set_bound", "lines of set s: [s], [s + 1)");
  if (!has_objects(part)) return;
  std::vector<RecordObject> objects;
  begin = {0};
  for (const std::vector<RecordObject>& of_set : part.objects) {
    extend(objects, of_set);
    begin.push_back(static_cast<int>(objects.size()));
  }
  write_objects(file, objects);
  put_indices(file, "objects/set_begin", begin, "set_bound", "objects of set s: [s], [s + 1)");
}

void read_sets(const H5Reader& file, const std::string& path, Part& part) {
  const RunBlocks all = read_blocks(file, path);
  const std::vector<int> begin = file.array<std::int32_t>("blocks/set_begin", 1);
  check_begin(begin, begin.empty() ? 0 : begin.size() - 1, all.mass.size(),
              {path, 0, "blocks/set_begin"});
  for (std::size_t s = 0; s + 1 < begin.size(); ++s)
    part.blocks.push_back(blocks_between(all, begin[s], begin[s + 1]));
  check_index(part.blocks_of_run, part.blocks.size(), {path, 0, "runs/blocks"});
  const std::vector<RecordLine> lines = read_lines(file, path);
  const std::vector<int> line_begin = file.array<std::int32_t>("lines/set_begin", 1);
  check_begin(line_begin, line_begin.empty() ? 0 : line_begin.size() - 1, lines.size(),
              {path, 0, "lines/set_begin"});
  for (std::size_t s = 0; s + 1 < line_begin.size(); ++s)
    part.lines.push_back(piece(lines, line_begin[s], line_begin[s + 1]));
  check_index(part.lines_of_run, part.lines.size(), {path, 0, "runs/lines"});
  if (!file.has("objects")) {
    part.objects.resize(1);
    check_index(part.objects_of_run, part.objects.size(), {path, 0, "runs/objects"});
    return;
  }
  const std::vector<RecordObject> objects = read_objects(file, path);
  const std::vector<int> object_begin = file.array<std::int32_t>("objects/set_begin", 1);
  check_begin(object_begin, object_begin.empty() ? 0 : object_begin.size() - 1, objects.size(),
              {path, 0, "objects/set_begin"});
  for (std::size_t s = 0; s + 1 < object_begin.size(); ++s)
    part.objects.push_back(piece(objects, object_begin[s], object_begin[s + 1]));
  check_index(part.objects_of_run, part.objects.size(), {path, 0, "runs/objects"});
}

// Poses, velocities and phases in the first and the last frame.
void write_ends(H5Writer& file, const Part& part) {
  file.group("ends", "first and last frame of each run, all blocks of a frame together");
  const auto times = [](const RunFile& run) { return run.frames.time; };
  const std::vector<double> time = joined(part, times);
  file.array<double>("ends/time_s", time, {{"frame", time.size()}}, "s", "time of the frame");
  put_begin(file, "ends", part, times);
  const auto put = [&](const std::string& name, const Dimension& columns, const std::string& units,
                       const std::string& long_name, auto member) {
    const auto all = joined(part, [member](const RunFile& run) { return run.frames.*member; });
    using Value = typename std::remove_cvref_t<decltype(all)>::value_type;
    file.array<Value>("ends/" + name, all, {{"row", all.size() / columns.extent}, columns}, units,
                      long_name);
  };
  put("position_m", {"/axis", 3}, "m", "centroids, local", &RunFrames::position);
  put("attitude", {"/quaternion", 4}, "1", "quaternions w x y z, body to local axes",
      &RunFrames::attitude);
  put("velocity_m_s", {"/axis", 3}, "m/s", "velocities of the centroids", &RunFrames::velocity);
  put("spin_rad_s", {"/axis", 3}, "rad/s", "angular velocities, local axes", &RunFrames::spin);
  const auto phases = [](const RunFile& run) { return run.phase; };
  std::vector<std::uint8_t> phase;
  for (const Phase p : joined(part, phases)) phase.push_back(static_cast<std::uint8_t>(p));
  file.group("phase", "state of each block at the end of its run");
  file.array<std::uint8_t>("phase/phase", phase, {{"row", phase.size()}}, "1", phase_numbers);
  put_begin(file, "phase", part, phases);
}

void read_ends(const H5Reader& file, const std::string& path, Part& part) {
  share_out(
      file, path, "ends", part, file.array<double>("ends/time_s", 1),
      [](RunFile & run) -> auto& { return run.frames.time; });
  const auto position = file.array<double>("ends/position_m", 3);
  const auto attitude = file.array<float>("ends/attitude", 4);
  const auto velocity = file.array<float>("ends/velocity_m_s", 3);
  const auto spin = file.array<float>("ends/spin_rad_s", 3);
  std::size_t first = 0;
  std::vector<std::size_t> begin{0};
  for (std::size_t r = 0; r < part.runs.size(); ++r)
    begin.push_back(first += part.runs[r].frames.time.size() *
                             part.blocks[part.blocks_of_run[r]].mass.size());
  for (const std::size_t n :
       {position.size() / 3, attitude.size() / 4, velocity.size() / 3, spin.size() / 3})
    if (n != first) throw InputError({path, 0, "ends"}, "does not have a row for each block");
  for (std::size_t r = 0; r < part.runs.size(); ++r) {
    RunFrames& frames = part.runs[r].frames;
    frames.position = piece(position, 3 * begin[r], 3 * begin[r + 1]);
    frames.attitude = piece(attitude, 4 * begin[r], 4 * begin[r + 1]);
    frames.velocity = piece(velocity, 3 * begin[r], 3 * begin[r + 1]);
    frames.spin = piece(spin, 3 * begin[r], 3 * begin[r + 1]);
  }
  const std::vector<Phase> phases =
      phases_of(file.array<std::uint8_t>("phase/phase", 1), {path, 0, "phase"});
  share_out(
      file, path, "phase", part, phases, [](RunFile & run) -> auto& { return run.phase; });
  for (std::size_t r = 0; r < part.runs.size(); ++r)
    if (const std::size_t n = part.runs[r].phase.size();
        n != 0 && n != part.blocks[part.blocks_of_run[r]].mass.size())
      throw InputError({path, 0, "phase"}, "does not have a row for each block");
}

void write_reaches(H5Writer& file, const Part& part) {
  RunReach all;
  std::vector<double> centre;
  for (const RunFile& run : part.runs) {
    extend(all.block, run.reach->block);
    extend(all.max_speed, run.reach->max_speed);
    extend(all.max_energy, run.reach->max_energy);
    const ReachLine& line = run.reach->centre_of_mass;
    centre.insert(centre.end(), {line.height, line.path, line.chord});
  }
  file.group("reach", "how far each block came, run by run");
  write_block_reach(file, "reach", all);
  file.array<double>("runs/centre_of_mass_m", centre,
                     {{"run", part.runs.size()}, {"drop_path_chord", 3}}, "m",
                     "of the centre of mass: drop, length of its path and of its chord in plan");
  const auto streamlines = [](const RunFile& run) { return run.reach->streamline; };
  file.group("streamline", "top, the toe block's path on the ground, toe; none: nothing moved");
  put_points(file, "streamline/point_m", joined(part, streamlines), "point", "m", "local");
  put_begin(file, "streamline", part, streamlines);
}

void read_reaches(const H5Reader& file, const std::string& path, Part& part) {
  const RunReach all = read_block_reach(file, "reach");
  const std::vector<double> centre = file.array<double>("runs/centre_of_mass_m", 3);
  std::size_t n = 0;
  for (const int set : part.blocks_of_run) n += part.blocks[set].mass.size();
  check_reach(all, n, path);
  if (centre.size() != 3 * part.runs.size())
    throw InputError({path, 0, "runs/centre_of_mass_m"}, "does not have a row for each run");
  std::size_t first = 0;
  for (std::size_t r = 0; r < part.runs.size(); ++r) {
    const std::size_t end = first + part.blocks[part.blocks_of_run[r]].mass.size();
    part.runs[r].reach = RunReach{part.path_tolerance,
                                  piece(all.block, first, end),
                                  piece(all.max_speed, first, end),
                                  piece(all.max_energy, first, end),
                                  {},
                                  {centre[3 * r], centre[3 * r + 1], centre[3 * r + 2]}};
    first = end;
  }
  share_out(
      file, path, "streamline", part, as_points(file.array<double>("streamline/point_m", 3)),
      [](RunFile & run) -> auto& { return run.reach->streamline; });
  for (const RunFile& run : part.runs)
    if (run.reach->streamline.size() == 1)
      throw InputError({path, 0, "streamline"}, "has a line of a single point");
}

// A table of a run file with the rows of all runs.
template <class Row>
void write_rows(H5Writer& file, const Part& part, std::vector<Row> RunFile::*rows,
                bool also_if_empty = false) {
  const auto field = [rows](const RunFile& run) { return run.*rows; };
  const std::vector<Row> all = joined(part, field);
  if (all.empty() && !also_if_empty) return;
  write_table(file, all);
  put_begin(file, table_of<Row>().name, part, field);
}

template <class Row>
void read_rows(const H5Reader& file, const std::string& path, Part& part,
               std::vector<Row> RunFile::*rows) {
  const char* group = table_of<Row>().name;
  if (!file.has(group)) return;
  share_out(
      file, path, group, part,
      read_table<Row>(file), [rows](RunFile & run) -> auto& { return run.*rows; });
}

void write_forests(H5Writer& file, const Part& part) {
  const auto forests = [](const RunFile& run) { return run.forests; };
  std::vector<std::string> names;
  std::vector<int> n_stems;
  for (const ForestInfo& forest : joined(part, forests)) {
    names.push_back(forest.name);
    n_stems.push_back(forest.n_stems);
  }
  if (names.empty()) return;
  file.group("forests", "the forests that stood");
  file.names("forests/name", names, "forest", "name of the forest");
  put_indices(file, "forests/n_stems", n_stems, "forest", "stems that stood at the start");
  put_begin(file, "forests", part, forests);
}

void read_forests(const H5Reader& file, const std::string& path, Part& part) {
  if (!file.has("forests")) return;
  const std::vector<std::string> names = file.texts("forests/name");
  const std::vector<int> n_stems = file.array<std::int32_t>("forests/n_stems", 1);
  if (n_stems.size() != names.size())
    throw InputError({path, 0, "forests/n_stems"}, "does not have a row for each forest");
  std::vector<ForestInfo> forests;
  for (std::size_t k = 0; k < names.size(); ++k) forests.push_back({names[k], n_stems[k]});
  share_out(
      file, path, "forests", part, forests, [](RunFile & run) -> auto& { return run.forests; });
}

void write_tables(H5Writer& file, const Part& part) {
  write_rows(file, part, &RunFile::crossings, true);
  write_rows(file, part, &RunFile::object_hits, has_objects(part));
  write_rows(file, part, &RunFile::roof_hits);
  write_rows(file, part, &RunFile::panels);
  write_rows(file, part, &RunFile::fence_hits);
  write_forests(file, part);
  write_rows(file, part, &RunFile::tree_hits);
  write_rows(file, part, &RunFile::health, true);
  write_rows(file, part, &RunFile::breaks);
  write_rows(file, part, &RunFile::crushed);
  write_rows(file, part, &RunFile::deep);
}

void read_tables(const H5Reader& file, const std::string& path, Part& part) {
  read_rows(file, path, part, &RunFile::crossings);
  read_rows(file, path, part, &RunFile::object_hits);
  read_rows(file, path, part, &RunFile::roof_hits);
  read_rows(file, path, part, &RunFile::panels);
  read_rows(file, path, part, &RunFile::fence_hits);
  read_forests(file, path, part);
  read_rows(file, path, part, &RunFile::tree_hits);
  read_rows(file, path, part, &RunFile::health);
  read_rows(file, path, part, &RunFile::breaks);
  read_rows(file, path, part, &RunFile::crushed);
  read_rows(file, path, part, &RunFile::deep);
  for (int r = 0; r < n_runs(part); ++r) {
    RunFile run = run_of(part, r);
    check_crossings(run, path);
    check_object_hits(run, path);
    check_roof_hits(run, path);
    check_fences(run, path);
    check_tree_hits(run, path);
    check_breaks(run, path);
    check_crushed(run, path);
    check_deep(run, path);
    part.runs[r].crossings = std::move(run.crossings);  // now told apart by `beside`
  }
}

void write_cells(H5Writer& file, const Part& part, const std::vector<PartRow>& rows) {
  std::vector<std::int32_t> cell;
  std::vector<std::int64_t> begin;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!cell.empty() && rows[i].passage.cell == cell.back()) continue;
    cell.push_back(rows[i].passage.cell);
    begin.push_back(static_cast<std::int64_t>(i));
  }
  begin.push_back(static_cast<std::int64_t>(rows.size()));
  file.group("cells", "the cells that any block passed");
  write_grid(file, "cells", part.grid, part.runs.front().info.origin, part.passages_by_centroid);
  file.array<std::int32_t>("cells/cell", cell, {{"cell", cell.size()}}, "1",
                           "row * n_cols + column, row 0 in the north, ascending");
  file.array<std::int64_t>("cells/begin", begin, {{"cell_bound", begin.size()}}, "1",
                           "rows of cell i: [i], [i + 1)");
  write_part_rows(file, rows);
}

}  // namespace

RunFile run_of(const Part& part, int run) {
  RunFile out = part.runs[run];
  out.blocks = part.blocks[part.blocks_of_run[run]];
  out.lines = part.lines[part.lines_of_run[run]];
  out.objects = part.objects[part.objects_of_run[run]];
  out.grid = part.grid;
  out.passages_by_centroid = part.passages_by_centroid;
  return out;
}

void add_run(PartBuilder& builder, const std::string& name, RunFile run) {
  TALUS_ASSERT(run.reach && n_frames(run.frames) <= 2 && run.blocks.parent.empty());
  Part& part = builder.part;
  if (part.runs.empty()) {
    part.path_tolerance = run.reach->tolerance;
    part.grid = run.grid;
    part.passages_by_centroid = run.passages_by_centroid;
  }
  RunBlocks& blocks = run.blocks;
  if (std::all_of(blocks.weight.begin(), blocks.weight.end(), [](double w) { return w == 1; }))
    blocks.weight.clear();
  leave_out_if_whole(blocks);
  bool is_new = false;
  part.blocks_of_run.push_back(index_of(builder.known_blocks, digest_of(blocks), is_new));
  if (is_new) part.blocks.push_back(blocks);
  part.lines_of_run.push_back(index_of(builder.known_lines, digest_of(run.lines), is_new));
  if (is_new) part.lines.push_back(run.lines);
  part.objects_of_run.push_back(index_of(builder.known_objects, digest_of(run.objects), is_new));
  if (is_new) part.objects.push_back(run.objects);
  part.name.push_back(name);
  run.blocks = {};
  run.lines.clear();
  run.objects.clear();
  std::vector<Passage>().swap(run.passages);
  run.checkpoint.clear();
  run.frames.strain.clear();
  part.runs.push_back(std::move(run));
}

void sort_rows(std::vector<PartRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const PartRow& a, const PartRow& b) {
    return std::tie(a.passage.cell, a.run, a.passage.block) <
           std::tie(b.passage.cell, b.run, b.passage.block);
  });
}

void write_part_file(const std::string& path, const Part& part, const std::vector<PartRow>& rows) {
  TALUS_ASSERT(!part.runs.empty());
  H5Writer file;
  write_runs(file, part);
  write_sets(file, part);
  write_ends(file, part);
  write_reaches(file, part);
  write_tables(file, part);
  if (part.grid.n_rows > 0) write_cells(file, part, rows);
  file.save(path);
}

struct PartFile::Impl {
  explicit Impl(const std::string& name) : path(name), file(name) {}
  std::string path;
  H5Reader file;
};

PartFile::PartFile(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  const H5Reader& file = impl_->file;
  if (file.attribute_text("", "format") != format_name)
    throw InputError({path}, "is not a part written by talus-reduce");
  read_runs(file, path, part);
  read_sets(file, path, part);
  read_ends(file, path, part);
  read_reaches(file, path, part);
  read_tables(file, path, part);
  if (!file.has("cells")) {
    begin = {0};
    return;
  }
  part.grid = read_grid(file, "cells", path);
  part.passages_by_centroid = file.attribute_text("cells", "passes_by") == "centroid";
  cell = file.array<std::int32_t>("cells/cell", 1);
  begin = file.array<std::int64_t>("cells/begin", 1);
  const std::size_t n_rows = file.shape("rows/run")[0];
  const bool is_whole = begin.size() == cell.size() + 1 && begin.front() == 0 &&
                        begin.back() == static_cast<std::int64_t>(n_rows) &&
                        std::is_sorted(begin.begin(), begin.end()) &&
                        std::is_sorted(cell.begin(), cell.end());
  if (!is_whole ||
      (!cell.empty() && (cell.front() < 0 || cell.back() >= part.grid.n_rows * part.grid.n_cols)))
    throw InputError({path, 0, "cells"}, "does not divide the rows by cells of the grid");
}

PartFile::~PartFile() = default;
PartFile::PartFile(PartFile&&) noexcept = default;
PartFile& PartFile::operator=(PartFile&&) noexcept = default;

std::vector<PartRow> PartFile::rows(std::size_t first, std::size_t end) const {
  const auto from = static_cast<std::size_t>(begin[first]);
  std::vector<PartRow> out =
      read_part_rows(impl_->file, from, static_cast<std::size_t>(begin[end]) - from);
  for (std::size_t c = first, i = 0; c < end; ++c)
    for (const std::size_t last = static_cast<std::size_t>(begin[c + 1]) - from; i < last; ++i) {
      const int run = out[i].run;
      if (run < 0 || run >= n_runs(part) || out[i].passage.block < 0 ||
          out[i].passage.block >=
              static_cast<int>(part.blocks[part.blocks_of_run[run]].mass.size()))
        throw InputError({impl_->path, 0, "rows"},
                         "a row names a run or block that does not exist");
      out[i].passage.cell = cell[c];
    }
  return out;
}

bool is_part_file(const std::string& path) {
  return H5Reader(path).attribute_text("", "format") == format_name;
}

}  // namespace talus
