// Blocks, lines, grids and reach as HDF5: the parts that run files and part files share.
#include "store/run_file_pieces_hdf5.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "scene/stand.hpp"

namespace talus {
namespace {

template <class Vector>
std::vector<double> flat(const std::vector<Vector>& values) {
  std::vector<double> list;
  list.reserve(values.size() * static_cast<std::size_t>(Vector::SizeAtCompileTime));
  for (const Vector& value : values)
    for (const double entry : value) list.push_back(entry);
  return list;
}

void check_indices(const std::vector<int>& values, std::size_t n, const Where& where) {
  for (const int value : values)
    if (value < 0 || static_cast<std::size_t>(value) >= n)
      throw InputError(where, "holds " + std::to_string(value) + ", expected 0 to " +
                                  std::to_string(n) + " exclusive");
}

}  // namespace

std::vector<Vec3> as_points(const std::vector<double>& list) {
  std::vector<Vec3> points(list.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Vec3(list[3 * i], list[3 * i + 1], list[3 * i + 2]);
  return points;
}

void put_points(H5Writer& file, const std::string& path, const std::vector<Vec3>& points,
                const std::string& dimension, const std::string& units,
                const std::string& long_name) {
  file.array<double>(path, flat(points), {{dimension, points.size()}, {"/axis", 3}}, units,
                     long_name);
}

void put_indices(H5Writer& file, const std::string& path, const std::vector<int>& values,
                 const std::string& dimension, const std::string& long_name) {
  file.array<std::int32_t>(path, values, {{dimension, values.size()}}, "1", long_name);
}

void check_begin(const std::vector<int>& begin, std::size_t n, std::size_t end,
                 const Where& where) {
  if (begin.size() != n + 1 || begin.front() != 0 ||
      static_cast<std::size_t>(begin.back()) != end || !std::is_sorted(begin.begin(), begin.end()))
    throw InputError(where, "does not divide the array that it points into");
}

void write_blocks(H5Writer& file, const RunBlocks& blocks) {
  const std::size_t n = blocks.mass.size();
  file.group("blocks", "the blocks; body axes: origin at the centroid, principal axes of inertia");
  file.array<double>("blocks/mass_kg", blocks.mass, {{"/block", n}}, "kg", "mass");
  file.array<double>("blocks/volume_m3", blocks.volume, {{"/block", n}}, "m3", "volume");
  put_points(file, "blocks/inertia_kg_m2", blocks.inertia, "/block", "kg m2",
             "principal moments of inertia");
  std::vector<Vec3> position;
  std::vector<double> attitude;
  for (const Pose& pose : blocks.rest) {
    position.push_back(pose.position);
    for (const double q :
         {pose.attitude.w(), pose.attitude.x(), pose.attitude.y(), pose.attitude.z()})
      attitude.push_back(q);
  }
  put_points(file, "blocks/rest_position_m", position, "/block", "m", "centroid as cut, local");
  file.array<double>("blocks/rest_attitude", attitude, {{"/block", n}, {"/quaternion", 4}}, "1",
                     "quaternion w x y z as cut, body to local axes");
  if (!blocks.weight.empty())
    file.array<double>("blocks/weight", blocks.weight, {{"/block", n}}, "1",
                       "weight in statistics");
  if (!blocks.parent.empty())
    put_indices(file, "blocks/parent", blocks.parent, "/block",
                "block that a piece comes from; -1: released");
  if (!blocks.generation.empty())
    put_indices(file, "blocks/generation", blocks.generation, "/block",
                "breaks before it was there");
  if (!blocks.body.empty())
    put_indices(file, "blocks/body", blocks.body, "/block",
                "its number in the run, of which only what is there at the end is kept");
  put_points(file, "blocks/vertices_m", blocks.vertices, "vertex", "m", "vertices, body axes");
  put_indices(file, "blocks/vertex_begin", blocks.vertex_begin, "block_bound",
              "vertices of block b: [b], [b + 1)");
  put_indices(file, "blocks/face_vertices", blocks.face_vertices, "corner",
              "indices into vertices_m, face by face, counter-clockwise from outside");
  put_indices(file, "blocks/face_begin", blocks.face_begin, "face_bound",
              "first entry of face f in face_vertices");
  put_indices(file, "blocks/block_face_begin", blocks.block_face_begin, "block_bound",
              "faces of block b: [b], [b + 1)");
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
  const auto read_if_there = [&](const std::string& name, std::vector<int>& values) {
    if (!file.has(name)) return;
    values = file.array<std::int32_t>(name, 1);
    same(name, values.size());
  };
  read_if_there("blocks/parent", blocks.parent);
  read_if_there("blocks/generation", blocks.generation);
  read_if_there("blocks/body", blocks.body);
  if (!blocks.parent.empty() && blocks.generation.empty())
    throw InputError({path, 0, "blocks/generation"}, "is missing beside blocks/parent");
  for (std::size_t b = 0; b < blocks.parent.size(); ++b)
    if (blocks.parent[b] < -1 || blocks.parent[b] >= static_cast<int>(b))
      throw InputError({path, 0, "blocks/parent"}, "names a block behind its piece");
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

void write_grid(H5Writer& file, const std::string& group, const PassageGrid& grid,
                const Vec3& origin, bool by_centroid) {
  const Vec2 corner = grid.corner + origin.head<2>();
  file.attribute(group, "corner_map_m", std::span<const double>(corner.data(), 2));
  file.attribute(group, "corner_local_m", std::span<const double>(grid.corner.data(), 2));
  file.attribute(group, "cell_size_m", grid.cell_size);
  file.attribute(group, "n_rows", static_cast<std::int64_t>(grid.n_rows));
  file.attribute(group, "n_cols", static_cast<std::int64_t>(grid.n_cols));
  file.attribute(group, "passes_by", std::string(by_centroid ? "centroid" : "footprint"));
}

PassageGrid read_grid(const H5Reader& file, const std::string& group, const std::string& path) {
  PassageGrid grid;
  const Where where{path, 0, group};
  const std::vector<double> corner = file.attribute_numbers(group, "corner_local_m");
  if (corner.size() != 2) throw InputError(where, "corner_local_m is not two numbers");
  grid.corner = {corner[0], corner[1]};
  grid.cell_size = file.attribute_number(group, "cell_size_m");
  const std::int64_t n_rows = file.attribute_integer(group, "n_rows");
  const std::int64_t n_cols = file.attribute_integer(group, "n_cols");
  constexpr std::int64_t most = 1LL << 30;
  if (!(grid.cell_size > 0) || !std::isfinite(corner[0] + corner[1] + grid.cell_size) ||
      n_rows < 1 || n_cols < 1 || n_rows > most || n_cols > most / n_rows)
    throw InputError(where, "the grid of cells makes no sense");
  grid.n_rows = static_cast<int>(n_rows);
  grid.n_cols = static_cast<int>(n_cols);
  return grid;
}

namespace {

// Only where galleries stand over objects.
void write_roofs(H5Writer& file, const std::vector<RecordObject>& objects) {
  std::vector<int> roof_begin{0}, begin{0};
  std::vector<double> points;
  for (const RecordObject& object : objects) {
    for (const std::vector<Vec2>& roof : object.roofs) {
      for (const Vec2& p : roof) points.insert(points.end(), {p.x(), p.y()});
      begin.push_back(static_cast<int>(points.size() / 2));
    }
    roof_begin.push_back(static_cast<int>(begin.size() - 1));
  }
  if (points.empty()) return;
  file.group("object_roofs",
             "convex pieces of roofs over the objects, under which nothing hits them");
  put_indices(file, "object_roofs/roof_begin", roof_begin, "object_bound",
              "pieces over object o: [o], [o + 1)");
  put_indices(file, "object_roofs/begin", begin, "roof_bound", "points of piece p: [p], [p + 1)");
  file.array<double>("object_roofs/points_m", points,
                     {{"point", points.size() / 2}, {"plan_axis", 2}}, "m", "local x, y");
}

void read_roofs(const H5Reader& file, const std::string& path, std::vector<RecordObject>& objects) {
  if (!file.has("object_roofs")) return;
  const std::vector<int> roof_begin = file.array<std::int32_t>("object_roofs/roof_begin", 1);
  const std::vector<int> begin = file.array<std::int32_t>("object_roofs/begin", 1);
  const std::vector<double> points = file.array<double>("object_roofs/points_m", 2);
  const Where where{path, 0, "object_roofs/roof_begin"};
  check_begin(roof_begin, objects.size(), begin.empty() ? 0 : begin.size() - 1, where);
  check_begin(begin, begin.empty() ? 0 : begin.size() - 1, points.size() / 2,
              {path, 0, "object_roofs/begin"});
  for (std::size_t o = 0; o < objects.size(); ++o)
    for (int r = roof_begin[o]; r < roof_begin[o + 1]; ++r) {
      std::vector<Vec2> roof;
      for (int i = begin[r]; i < begin[r + 1]; ++i)
        roof.emplace_back(points[2 * i], points[2 * i + 1]);
      if (roof.size() < 3) throw InputError(where, "has a piece of less than three points");
      objects[o].roofs.push_back(std::move(roof));
    }
}

}  // namespace

void write_objects(H5Writer& file, const std::vector<RecordObject>& objects) {
  std::vector<std::string> names, kinds;
  std::vector<double> radius, points;
  std::vector<int> part_begin{0}, begin{0}, is_area;
  for (const RecordObject& object : objects) {
    names.push_back(object.name);
    kinds.push_back(object.kind);
    radius.push_back(object.radius);
    for (const ObjectPart& part : object.parts) {
      is_area.push_back(part.is_area ? 1 : 0);
      for (const Vec2& p : part.points) points.insert(points.end(), {p.x(), p.y()});
      begin.push_back(static_cast<int>(points.size() / 2));
    }
    part_begin.push_back(static_cast<int>(is_area.size()));
  }
  file.group("objects", "the objects that hits belong to");
  file.names("objects/name", names, "object", "name of the object");
  file.names("objects/kind", kinds, "object", "what it is");
  file.array<double>("objects/radius_m", radius, {{"object", radius.size()}}, "m",
                     "about its lines and points");
  put_indices(file, "objects/part_begin", part_begin, "object_bound",
              "parts of object o: [o], [o + 1)");
  put_indices(file, "objects/is_area", is_area, "part",
              "1: the part is an area, 0: a line or a point");
  put_indices(file, "objects/begin", begin, "part_bound", "points of part p: [p], [p + 1)");
  file.array<double>("objects/points_m", points, {{"point", points.size() / 2}, {"plan_axis", 2}},
                     "m", "local x, y");
  write_roofs(file, objects);
}

std::vector<RecordObject> read_objects(const H5Reader& file, const std::string& path) {
  const std::vector<std::string> names = file.texts("objects/name"),
                                 kinds = file.texts("objects/kind");
  const std::vector<double> radius = file.array<double>("objects/radius_m", 1);
  const std::vector<int> part_begin = file.array<std::int32_t>("objects/part_begin", 1);
  const std::vector<int> is_area = file.array<std::int32_t>("objects/is_area", 1);
  const std::vector<int> begin = file.array<std::int32_t>("objects/begin", 1);
  const std::vector<double> points = file.array<double>("objects/points_m", 2);
  if (kinds.size() != names.size() || radius.size() != names.size())
    throw InputError({path, 0, "objects"}, "does not have a row for each object");
  check_begin(part_begin, names.size(), is_area.size(), {path, 0, "objects/part_begin"});
  check_begin(begin, is_area.size(), points.size() / 2, {path, 0, "objects/begin"});
  std::vector<RecordObject> objects;
  for (std::size_t o = 0; o < names.size(); ++o) {
    RecordObject object{names[o], kinds[o], {}, radius[o]};
    for (int p = part_begin[o]; p < part_begin[o + 1]; ++p) {
      ObjectPart part;
      part.is_area = is_area[p] != 0;
      for (int i = begin[p]; i < begin[p + 1]; ++i)
        part.points.emplace_back(points[2 * i], points[2 * i + 1]);
      if (part.points.empty()) throw InputError({path, 0, "objects/begin"}, "has an empty part");
      object.parts.push_back(std::move(part));
    }
    objects.push_back(std::move(object));
  }
  read_roofs(file, path, objects);
  return objects;
}

void check_object_hits(const RunFile& run, const std::string& path) {
  for (const ObjectHit& row : run.object_hits)
    if (row.block < 0 || row.block >= n_blocks(run) || row.object < 0 ||
        row.object >= static_cast<int>(run.objects.size()))
      throw InputError({path, 0, "object_hits"},
                       "a row names a block or object that does not exist");
}

void check_roof_hits(const RunFile& run, const std::string& path) {
  for (const RoofHit& row : run.roof_hits)
    if (row.block < 0 || row.block >= n_blocks(run) || row.line < 0 ||
        row.line >= static_cast<int>(run.lines.size()))
      throw InputError({path, 0, "roof_hits"}, "a row names a block or line that does not exist");
}

void write_lines(H5Writer& file, const std::vector<RecordLine>& lines) {
  std::vector<std::string> names;
  std::vector<Vec3> points;
  std::vector<int> begin{0}, standing;
  for (const RecordLine& line : lines) {
    names.push_back(line.name);
    standing.push_back(line.standing ? 1 : 0);
    points.insert(points.end(), line.points.begin(), line.points.end());
    begin.push_back(static_cast<int>(points.size()));
  }
  file.group("lines", "the lines that crossings belong to");
  file.names("lines/name", names, "line", "name of the line");
  put_points(file, "lines/points_m", points, "point", "m", "points of all lines, local, z = base");
  put_indices(file, "lines/begin", begin, "line_bound", "points of line l: [l], [l + 1)");
  put_indices(file, "lines/standing", standing, "line",
              "1: a fence that stops blocks, 0: a line only");
}

std::vector<RecordLine> read_lines(const H5Reader& file, const std::string& path) {
  const std::vector<std::string> names = file.texts("lines/name");
  const std::vector<Vec3> points = as_points(file.array<double>("lines/points_m", 3));
  const std::vector<int> begin = file.array<std::int32_t>("lines/begin", 1);
  check_begin(begin, names.size(), points.size(), {path, 0, "lines/begin"});
  const std::vector<int> standing = file.array<std::int32_t>("lines/standing", 1);
  if (standing.size() != names.size())
    throw InputError({path, 0, "lines/standing"}, "does not have a row for each line");
  std::vector<RecordLine> lines;
  for (std::size_t l = 0; l < names.size(); ++l) {
    lines.push_back(
        record_line(names[l], {points.begin() + begin[l], points.begin() + begin[l + 1]}));
    lines.back().standing = standing[l] != 0;
  }
  return lines;
}

void check_crossings(RunFile& run, const std::string& path) {
  for (Crossing& row : run.crossings) {
    const bool known = row.block >= 0 && row.block < n_blocks(run) && row.line >= 0 &&
                       row.line < static_cast<int>(run.lines.size());
    if (!known || row.segment < 0 ||
        row.segment + 1 >= static_cast<int>(run.lines[row.line].points.size()))
      throw InputError({path, 0, "crossings"}, "a row names a block or line that does not exist");
    row.beside = row.n_crossings == 0;
  }
}

void check_fences(const RunFile& run, const std::string& path) {
  const auto is_known = [&](int line, int panel) {
    return line >= 0 && line < static_cast<int>(run.lines.size()) && panel >= 0 &&
           panel + 1 < static_cast<int>(run.lines[line].points.size());
  };
  for (const PanelRow& row : run.panels)
    if (!is_known(row.line, row.panel) || row.broken_by >= n_blocks(run) || row.rock < -1)
      throw InputError({path, 0, "fence_panels"}, "a row names a panel that does not exist");
  for (const FenceHit& row : run.fence_hits)
    if (!is_known(row.line, row.panel) || row.block < 0 || row.block >= n_blocks(run))
      throw InputError({path, 0, "fence_hits"}, "a row names a block or panel that does not exist");
}

void check_tree_hits(const RunFile& run, const std::string& path) {
  const int n_species = static_cast<int>(known_species().size());
  const auto n_forests = static_cast<int>(run.forests.size());
  for (const TreeHitRow& row : run.tree_hits)
    if (row.forest < 0 || row.forest >= n_forests || row.species < 0 || row.species >= n_species ||
        row.hit.block < 0 || row.hit.block >= n_blocks(run) || row.broken_by >= n_blocks(run))
      throw InputError({path, 0, "tree_hits"},
                       "a row names a block, forest or species that does not exist");
}

void check_deep(const RunFile& run, const std::string& path) {
  for (const DeepRow& row : run.deep)
    if (row.block < 0 || row.block >= n_blocks(run) || row.partner >= n_blocks(run) ||
        row.partner < DeepRow::fixed_body)
      throw InputError({path, 0, "deep_blocks"}, "a row names a block that does not exist");
}

void check_breaks(const RunFile& run, const std::string& path) {
  const std::vector<int>& parent = run.blocks.parent;
  const auto is_piece = [&](int piece, int of) {
    return piece >= 0 && piece < n_blocks(run) && parent[piece] == of;
  };
  // Where only the remaining pieces were kept, their parents are unknown.
  const auto is_known = [&](const Break& row) {
    if (parent.empty())
      return !run.blocks.body.empty() && row.block >= 0 && row.first_piece > row.block;
    return row.block >= 0 && row.block < n_blocks(run) && is_piece(row.first_piece, row.block) &&
           is_piece(row.first_piece + 1, row.block);
  };
  for (const Break& row : run.breaks)
    if (!is_known(row))
      throw InputError({path, 0, "breaks"}, "a row names a piece that does not exist");
}

void check_crushed(const RunFile& run, const std::string& path) {
  for (const CrushedBlock& row : run.crushed)
    if (row.block < 0 || row.block >= n_blocks(run))
      throw InputError({path, 0, "crushed_blocks"}, "a row names a block that does not exist");
}

std::vector<Phase> phases_of(const std::vector<std::uint8_t>& numbers, const Where& where) {
  std::vector<Phase> phases;
  for (const std::uint8_t number : numbers) {
    if (number > static_cast<std::uint8_t>(last_phase))
      throw InputError(where, "holds an unknown phase");
    phases.push_back(static_cast<Phase>(number));
  }
  return phases;
}

void write_block_reach(H5Writer& file, const std::string& group, const RunReach& reach) {
  const std::size_t n = reach.block.size();
  std::vector<double> lines;
  for (const ReachLine& line : reach.block)
    lines.insert(lines.end(), {line.height, line.path, line.chord});
  file.array<double>(group + "/drop_path_chord_m", lines, {{"block", n}, {"drop_path_chord", 3}},
                     "m",
                     "of each block's centroid: drop, length of its path and of its chord in plan");
  file.array<double>(group + "/max_speed_m_s", reach.max_speed, {{"block", n}}, "m/s",
                     "largest speed of the block");
  file.array<double>(group + "/max_energy_j", reach.max_energy, {{"block", n}}, "J",
                     "largest kinetic energy of the block, with spin");
}

RunReach read_block_reach(const H5Reader& file, const std::string& group) {
  RunReach reach;
  const std::vector<double> lines = file.array<double>(group + "/drop_path_chord_m", 3);
  for (std::size_t i = 0; i + 2 < lines.size(); i += 3)
    reach.block.push_back({lines[i], lines[i + 1], lines[i + 2]});
  reach.max_speed = file.array<double>(group + "/max_speed_m_s", 1);
  reach.max_energy = file.array<double>(group + "/max_energy_j", 1);
  return reach;
}

void check_reach(const RunReach& reach, std::size_t n_blocks, const std::string& path) {
  if (reach.block.size() != n_blocks || reach.max_speed.size() != n_blocks ||
      reach.max_energy.size() != n_blocks || reach.streamline.size() == 1)
    throw InputError({path, 0, "reach"}, "does not have a row for each block");
}

}  // namespace talus
