#include "report/viewer_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
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

std::string terrain_json(const Trn& trn, const Part& part, double z_origin) {
  std::vector<float> z;
  for (int r = 0; r < part.n_rows(); ++r)
    for (int c = 0; c < part.n_cols(); ++c)
      z.push_back(static_cast<float>(
          node_point(trn, part.row_first + r * part.step, part.col_first + c * part.step).z() -
          z_origin));
  const Vec3 corner = node_point(trn, part.row_first, part.col_first);
  return "{\"n_rows\":" + std::to_string(part.n_rows()) +
         ",\"n_cols\":" + std::to_string(part.n_cols()) +
         ",\"cell_size_m\":" + text(trn.cell_size * part.step) + ",\"x0_m\":" + text(corner.x()) +
         ",\"y0_m\":" + text(corner.y()) + ",\"z_origin_m\":" + text(z_origin) + ",\"z_m\":\"" +
         base64(z) + "\"}";
}

// Faces as fans of triangles in body axes; beside each corner the block it belongs to.
std::string blocks_json(const RunBlocks& blocks, int n) {
  std::vector<float> position;
  std::vector<std::uint32_t> owner;
  std::string mass;
  for (int b = 0; b < n; ++b) {
    mass += (b > 0 ? "," : "") + text(blocks.mass[b], 7);
    for (int f = blocks.block_face_begin[b]; f < blocks.block_face_begin[b + 1]; ++f)
      for (int k = blocks.face_begin[f] + 1; k + 1 < blocks.face_begin[f + 1]; ++k)
        for (const int corner : {blocks.face_begin[f], k, k + 1}) {
          const Vec3& vertex = blocks.vertices[blocks.face_vertices[corner]];
          for (int axis = 0; axis < 3; ++axis) position.push_back(static_cast<float>(vertex[axis]));
          owner.push_back(static_cast<std::uint32_t>(b));
        }
  }
  return "{\"n\":" + std::to_string(n) + ",\"mass_kg\":[" + mass + "],\"position_m\":\"" +
         base64(position) + "\",\"block\":\"" + base64(owner) + "\"}";
}

std::string frames_json(const RunFile& run, double z_origin, std::size_t max_bytes) {
  const int n = n_blocks(run), count = n_frames(run.frames);
  const std::size_t bytes = static_cast<std::size_t>(n) * count * 32;
  const int stride = static_cast<int>((bytes + max_bytes - 1) / max_bytes);
  std::vector<float> pose;
  std::string time;
  for (int k = 0; k < count; ++k) {
    if (stride > 1 && k % stride != 0 && k != count - 1) continue;
    time += (time.empty() ? "" : ",") + text(run.frames.time[k], 9);
    for (int b = 0; b < n; ++b) {
      const FrameBlock block = frame_block(run, k, b);
      const Quat& q = block.attitude;
      for (const double value :
           {block.position.x(), block.position.y(), block.position.z() - z_origin,
            block.velocity.norm(), q.x(), q.y(), q.z(), q.w()})
        pose.push_back(static_cast<float>(value));
    }
  }
  return "{\"time_s\":[" + time + "],\"pose\":\"" + base64(pose) + "\"}";
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
         ",\n\"trails\":" + trails_json(places.trails, z_origin, limits.max_trail_points) +
         ",\n\"contour_m\":" + text(places.contour_interval) + "}";
}

}  // namespace talus
