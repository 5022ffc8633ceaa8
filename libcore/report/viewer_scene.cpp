// A run as JSON for the 3-D viewer (tools/report/viewer.js).
#include "report/viewer_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "post/runout/runout_fields.hpp"
#include "report/encode.hpp"

namespace talus {
namespace {

// Nodes first..last of the terrain in both directions, every `step`-th.
struct Part {
  int row_first = 0, row_last = 0, col_first = 0, col_last = 0, step = 1;
  [[nodiscard]] int n_rows() const { return (row_last - row_first) / step + 1; }
  [[nodiscard]] int n_cols() const { return (col_last - col_first) / step + 1; }
};

// The terrain around all blocks in all frames, and half as much again on each side.
Part part_around(const RunFile& run, const Trn& trn, int max_nodes) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const std::vector<double>& position = run.frames.position;
  for (std::size_t i = 0; i + 2 < position.size(); i += 3) {
    low = low.cwiseMin(Vec2(position[i], position[i + 1]));
    high = high.cwiseMax(Vec2(position[i], position[i + 1]));
  }
  const double margin = std::max(0.5 * (high - low).maxCoeff(), 10 * trn.cell_size);
  const auto node = [&trn](double length, int last) {
    return std::clamp(static_cast<int>(std::lround(length / trn.cell_size)), 0, last);
  };
  Part part;
  part.col_first = node(low.x() - margin - trn.node0.x(), trn.n_cols - 1);
  part.col_last = node(high.x() + margin - trn.node0.x(), trn.n_cols - 1);
  part.row_first = node(trn.node0.y() - high.y() - margin, trn.n_rows - 1);
  part.row_last = node(trn.node0.y() - low.y() + margin, trn.n_rows - 1);
  while (static_cast<double>(part.n_rows()) * part.n_cols() > max_nodes) ++part.step;
  return part;
}

// Numbers of one kind as 16 bits each: low + step * word.
struct Packing {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  static constexpr int last = 65534;            // of the words that are numbers
  static constexpr std::uint16_t none = 65535;  // unknown

  void hold(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double step() const { return high > low ? (high - low) / last : 1; }
  [[nodiscard]] std::uint16_t word(double value) const {
    return std::isnan(value) ? none
                             : static_cast<std::uint16_t>(std::lround((value - low) / step()));
  }
  [[nodiscard]] std::string json() const {
    return "[" + text(high >= low ? low : 0, 9) + "," + text(step(), 9) + "]";
  }
};

// Counts and numbers of things, as short as they allow.
std::string counts_json(const std::vector<std::uint32_t>& counts) {
  const bool is_short = std::all_of(counts.begin(), counts.end(), [](auto i) { return i < 65536; });
  if (!is_short) return "{\"bytes\":4,\"all\":\"" + base64(counts) + "\"}";
  const std::vector<std::uint16_t> words(counts.begin(), counts.end());
  return "{\"bytes\":2,\"all\":\"" + base64(words) + "\"}";
}

std::string terrain_json(const Trn& trn, const Part& part, double z_origin) {
  std::vector<double> z;
  Packing packing;
  for (int r = 0; r < part.n_rows(); ++r)
    for (int c = 0; c < part.n_cols(); ++c) {
      z.push_back(
          node_point(trn, part.row_first + r * part.step, part.col_first + c * part.step).z() -
          z_origin);
      packing.hold(z.back());
    }
  std::vector<std::uint16_t> words;
  for (const double value : z) words.push_back(packing.word(value));
  const Vec3 corner = node_point(trn, part.row_first, part.col_first);
  return "{\"n_rows\":" + std::to_string(part.n_rows()) +
         ",\"n_cols\":" + std::to_string(part.n_cols()) +
         ",\"cell_size_m\":" + text(trn.cell_size * part.step) + ",\"x0_m\":" + text(corner.x()) +
         ",\"y0_m\":" + text(corner.y()) + ",\"z_origin_m\":" + text(z_origin) +
         ",\"z_m\":" + packing.json() + ",\"z\":\"" + base64(words) + "\"}";
}

// Corners of block b count from its own first vertex.
std::string blocks_json(const RunBlocks& blocks, int n) {
  Packing packing;
  for (const Vec3& vertex : blocks.vertices)
    for (const double value : vertex) packing.hold(value);
  std::vector<std::uint16_t> vertices;
  std::vector<std::uint32_t> n_vertices, n_faces, face_sizes, corners;
  std::string mass;
  for (int b = 0; b < n; ++b) {
    mass += (b > 0 ? "," : "") + text(blocks.mass[b], 7);
    n_vertices.push_back(blocks.vertex_begin[b + 1] - blocks.vertex_begin[b]);
    n_faces.push_back(blocks.block_face_begin[b + 1] - blocks.block_face_begin[b]);
    for (int v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
      for (const double value : blocks.vertices[v]) vertices.push_back(packing.word(value));
    for (int f = blocks.block_face_begin[b]; f < blocks.block_face_begin[b + 1]; ++f) {
      face_sizes.push_back(blocks.face_begin[f + 1] - blocks.face_begin[f]);
      for (int k = blocks.face_begin[f]; k < blocks.face_begin[f + 1]; ++k)
        corners.push_back(blocks.face_vertices[k] - blocks.vertex_begin[b]);
    }
  }
  return "{\"n\":" + std::to_string(n) + ",\"mass_kg\":[" + mass +
         "],\"n_vertices\":" + counts_json(n_vertices) + ",\"n_faces\":" + counts_json(n_faces) +
         ",\"face_sizes\":" + counts_json(face_sizes) + ",\"corners\":" + counts_json(corners) +
         ",\"vertex_m\":" + packing.json() + ",\"vertices\":\"" + base64(vertices) + "\"}";
}

// The frames of a run, eight words a block: x y z, speed, quaternion x y z w.
struct PackedFrames {
  std::array<Packing, 5> packing;  // x, y, z, speed, quaternion
  std::vector<std::uint16_t> words;
};

PackedFrames packed_frames(const RunFile& run, double z_origin) {
  const int n = n_blocks(run), count = n_frames(run.frames);
  const auto numbers = [&run, z_origin](int k, int b) {
    const FrameBlock block = frame_block(run, k, b);
    const Quat& q = block.attitude;
    return std::array<double, 8>{block.position.x(),
                                 block.position.y(),
                                 block.position.z() - z_origin,
                                 block.velocity.norm(),
                                 q.x(),
                                 q.y(),
                                 q.z(),
                                 q.w()};
  };
  PackedFrames packed;
  packed.packing[4] = {-1, 1};
  for (int k = 0; k < count; ++k)
    for (int b = 0; b < n; ++b)
      for (int i = 0; i < 4; ++i) packed.packing[i].hold(numbers(k, b)[i]);
  for (int k = 0; k < count; ++k)
    for (int b = 0; b < n; ++b) {
      const std::array<double, 8> all = numbers(k, b);
      for (int i = 0; i < 8; ++i)
        packed.words.push_back(packed.packing[std::min(i, 4)].word(all[i]));
    }
  return packed;
}

// A block whose words never change is in the first frame alone.
std::string frames_json(const RunFile& run, double z_origin, std::size_t max_bytes) {
  const auto n = static_cast<std::size_t>(n_blocks(run));
  const auto count = static_cast<std::size_t>(n_frames(run.frames));
  const PackedFrames packed = packed_frames(run, z_origin);
  const auto pose = [&packed, n](std::size_t k, std::size_t b) {
    return packed.words.begin() + static_cast<std::ptrdiff_t>(8 * (k * n + b));
  };
  std::vector<std::uint32_t> moved;
  for (std::size_t b = 0; b < n; ++b) {
    std::size_t k = 1;
    while (k < count && std::equal(pose(0, b), pose(0, b) + 8, pose(k, b))) ++k;
    if (k < count) moved.push_back(static_cast<std::uint32_t>(b));
  }
  const std::size_t stride =
      std::max<std::size_t>(1, (16 * (moved.size() * (count - 1) + n) + max_bytes - 1) / max_bytes);
  std::vector<std::uint16_t> words(pose(0, 0), pose(0, 0) + static_cast<std::ptrdiff_t>(8 * n));
  std::string time = text(run.frames.time[0], 9);
  for (std::size_t k = 1; k < count; ++k) {
    if (k % stride != 0 && k != count - 1) continue;
    time += "," + text(run.frames.time[k], 9);
    for (const std::uint32_t b : moved) words.insert(words.end(), pose(k, b), pose(k, b) + 8);
  }
  std::string packing;
  for (const Packing& part : packed.packing) packing += (packing.empty() ? "" : ",") + part.json();
  return "{\"time_s\":[" + time + "],\"moved\":" + counts_json(moved) + ",\"packing\":[" + packing +
         "],\"pose\":\"" + base64(words) + "\"}";
}

std::string fences_json(const RunFile& run, const std::vector<double>& height, double z_origin) {
  std::string out;
  for (std::size_t i = 0; i < run.lines.size(); ++i) {
    if (i >= height.size() || height[i] <= 0) continue;
    std::string points;
    for (const Vec3& p : run.lines[i].points)
      points += (points.empty() ? "[" : ",[") + text(p.x(), 9) + "," + text(p.y(), 9) + "," +
                text(p.z() - z_origin, 9) + "]";
    out += (out.empty() ? "{" : ",{") + std::string("\"name\":") + json_string(run.lines[i].name) +
           ",\"height_m\":" + text(height[i]) + ",\"points_m\":[" + points + "]}";
  }
  return "[" + out + "]";
}

// A point each half cell along a line, on the ground; where it is unknown, none.
std::string draped_json(const std::vector<Vec2>& line, const Trn& trn, double z_origin) {
  std::string points;
  const auto add = [&](const Vec2& p) {
    const double z = contains(trn, p.x(), p.y()) ? elevation_at(trn, p.x(), p.y()) : std::nan("");
    if (!std::isnan(z))
      points += (points.empty() ? "[" : ",[") + text(p.x(), 6) + "," + text(p.y(), 6) + "," +
                text(z - z_origin, 6) + "]";
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 along = line[i + 1] - line[i];
    const int n = std::max(1, static_cast<int>(std::ceil(along.norm() / (0.5 * trn.cell_size))));
    for (int k = 0; k < n; ++k) add(line[i] + along * k / n);
  }
  add(line.back());
  return "[" + points + "]";
}

// Lines and outlines; a point is a circle.
std::string objects_json(const RunFile& run, const Trn& trn, double z_origin) {
  std::string out;
  for (const RecordObject& object : run.objects) {
    std::string lines;
    for (const ObjectPart& part : object.parts) {
      if (part.points.empty()) continue;
      std::vector<Vec2> line = part.points;
      const bool is_point = line.size() == 1;
      if (is_point) {
        line.clear();
        for (int k = 0; k < 16; ++k)
          line.push_back(part.points[0] +
                         std::max(object.radius, 1.0) *
                             Vec2(std::cos(22.5 * k * degree), std::sin(22.5 * k * degree)));
      }
      if (part.is_area || is_point) line.push_back(Vec2(line.front()));
      lines += (lines.empty() ? "" : ",") + draped_json(line, trn, z_origin);
    }
    out += (out.empty() ? "{" : ",{") + std::string("\"name\":") + json_string(object.name) +
           ",\"lines_m\":[" + lines + "]}";
  }
  return "[" + out + "]";
}

// Trajectories of the blocks that came farthest, with every field of their points.
std::string paths_json(const RunFile& run, const Trn& trn, const Texts* texts, double z_origin,
                       std::size_t max_points) {
  constexpr double tolerance = 0.05;          // [m]
  std::vector<std::pair<double, int>> order;  // by length, the longest first
  std::vector<TimedPath> paths;
  for (int b = 0; b < n_blocks(run); ++b) {
    paths.push_back(shown_path(run, b, trn, tolerance));
    order.emplace_back(-paths.back().distance.back(), b);
  }
  std::sort(order.begin(), order.end());
  const auto& fields = path_point_fields();
  std::vector<std::vector<double>> columns(fields.size() + 1);  // the last: elevation
  std::vector<std::uint32_t> blocks, n_points;
  for (const auto& [length, b] : order) {
    const TimedPath& path = paths[b];
    if (columns[0].size() + path.point.size() > max_points) break;
    blocks.push_back(b);
    n_points.push_back(static_cast<std::uint32_t>(path.point.size()));
    for (std::size_t i = 0; i < path.point.size(); ++i) {
      for (std::size_t c = 0; c < fields.size(); ++c)
        columns[c].push_back(std::get<double>(fields[c].get({path, i})));
      columns.back().push_back(path.point[i].z() - z_origin);
    }
  }
  std::string out;
  const auto add = [&](const std::vector<double>& values, const char* name, const char* unit,
                       const std::string& title) {
    Packing packing;
    for (const double value : values) packing.hold(value);
    std::vector<std::uint16_t> words;
    for (const double value : values) words.push_back(packing.word(value));
    out += (out.empty() ? "{" : ",{") + std::string("\"name\":") + json_string(name) +
           ",\"unit\":" + json_string(unit) +
           ",\"title\":" + json_string(texts == nullptr ? title : texts->said(title)) +
           ",\"packing\":" + packing.json() + ",\"values\":\"" + base64(words) + "\"}";
  };
  for (std::size_t c = 0; c < fields.size(); ++c)
    add(columns[c], fields[c].name, fields[c].unit, fields[c].title);
  add(columns.back(), "z_m", "m", "Elevation of the centroid");
  return "{\"blocks\":" + counts_json(blocks) + ",\"n_points\":" + counts_json(n_points) +
         ",\"columns\":[" + out + "]}";
}

// Every k-th trail, so that all runs are drawn alike.
std::string trails_json(const std::vector<std::vector<Vec3>>& trails, double z_origin,
                        std::size_t max_points) {
  std::size_t n_points = 0;
  for (const std::vector<Vec3>& trail : trails) n_points += trail.size();
  const std::size_t stride = std::max<std::size_t>(1, (n_points + max_points - 1) / max_points);
  std::vector<float> position;
  std::vector<std::uint32_t> begin = {0};
  for (std::size_t i = 0; i < trails.size(); i += stride) {
    for (const Vec3& p : trails[i])
      for (const double value : {p.x(), p.y(), p.z() - z_origin})
        position.push_back(static_cast<float>(value));
    begin.push_back(static_cast<std::uint32_t>(position.size() / 3));
  }
  return "{\"n\":" + std::to_string(begin.size() - 1) +
         ",\"n_all\":" + std::to_string(trails.size()) + ",\"begin\":\"" + base64(begin) +
         "\",\"position_m\":\"" + base64(position) + "\"}";
}

}  // namespace

std::string viewer_scene(const RunFile& run, const Trn& trn, const ViewerPlaces& places,
                         const ViewerLimits& limits) {
  if (n_frames(run.frames) == 0 || n_blocks(run) == 0)
    throw InputError({run.info.run_id}, "holds no frames", "run talus-dda again");
  double z_origin = std::numeric_limits<double>::infinity();
  for (const double z : trn.elevation)
    if (!std::isnan(z)) z_origin = std::min(z_origin, z);
  return "{\"terrain\":" + terrain_json(trn, part_around(run, trn, limits.max_nodes), z_origin) +
         ",\n\"blocks\":" + blocks_json(run.blocks, n_blocks(run)) +
         ",\n\"frames\":" + frames_json(run, z_origin, limits.max_pose_bytes) +
         ",\n\"fences\":" + fences_json(run, places.fence_height, z_origin) +
         ",\n\"objects\":" + objects_json(run, trn, z_origin) +
         ",\n\"paths\":" + paths_json(run, trn, places.texts, z_origin, limits.max_path_points) +
         ",\n\"trails\":" + trails_json(places.trails, z_origin, limits.max_trail_points) +
         ",\n\"sheet\":{\"west_m\":" + text(places.map_corner.x()) +
         ",\"north_m\":" + text(places.map_corner.y()) +
         "},\n\"contour_m\":" + text(places.contour_interval) + "}";
}

}  // namespace talus
