// Hits of the roofs of galleries by blocks.
#include "record/roof_hits.hpp"

#include <algorithm>
#include <tuple>

#include "geometry/plan2d.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"

namespace talus {
namespace {

constexpr double least_change = 0.5;  // of the velocity along the normal [m/s]
constexpr double touch_share = 0.1;   // of the radius, that a vertex may lie above what it touches

// The place of the vertex that lies lowest above the ground; false where none touches it.
bool find_touch(const Scene& scene, int block, const Motion& motion, Vec2& place) {
  const Mat3 R = motion.pose.attitude.toRotationMatrix();
  double least = touch_share * scene.blocks.shapes.radius[static_cast<std::size_t>(block)];
  bool touches = false;
  for (const Vec3& vertex : vertices_of(scene.blocks.shapes, block)) {
    const Vec3 at = motion.pose.position + R * vertex;
    const double gap = at.z() - elevation_at(scene.ground.trn, at.x(), at.y());
    if (!(gap < least)) continue;
    least = gap;
    place = at.head<2>();
    touches = true;
  }
  return touches;
}

void add_hit(RoofRecorder& recorder, const RoofHit& hit) {
  std::int32_t& index =
      recorder.row_of[static_cast<std::size_t>(hit.block) * recorder.lines.size() +
                      static_cast<std::size_t>(hit.line)];
  if (index < 0) {
    index = static_cast<std::int32_t>(recorder.rows.size());
    recorder.rows.push_back(hit);
    return;
  }
  RoofHit& known = recorder.rows[static_cast<std::size_t>(index)];
  const std::int32_t n = known.n_hits + hit.n_hits;
  if (hit.normal_energy() > known.normal_energy()) known = hit;
  known.n_hits = n;
}

// What a block does in a segment, and its velocity just after.
void look(RoofRecorder& recorder, const Scene& scene, const Segment& segment, const Vec3& after) {
  const Vec3& start = segment.start.velocity;
  const Vec3& end = segment.end.velocity;
  const Vec3 fallen = (segment.t_end - segment.t_start) * scene.gravity;
  const bool at_end = (after - end).norm() > least_change;
  if (!at_end && (segment.flight || (end - start - fallen).norm() <= least_change)) return;
  Vec2 place;
  if (!find_touch(scene, segment.block, segment.end, place)) return;
  const Vec3& before = at_end ? end : start;
  const Vec3 change = at_end ? Vec3(after - end) : Vec3(end - start - fallen);
  for (std::size_t l = 0; l < recorder.lines.size(); ++l) {
    // beside the roof the terrain falls or rises over a cell
    if (corners_among(scene.ground.trn, recorder.lines[l].roof_nodes, place) < 3) continue;
    for (const RoofPiece& piece : recorder.lines[l].roof) {
      if (!is_inside(piece.ring, place)) continue;
      const double speed = -before.dot(piece.normal);
      if (change.dot(piece.normal) <= least_change || speed <= 0) break;
      const auto b = static_cast<std::size_t>(segment.block);
      add_hit(recorder, {segment.block, static_cast<std::int32_t>(l), 1,
                         at_end ? segment.t_end : segment.t_start, scene.blocks.mass[b],
                         scene.blocks.volume[b], segment.end.pose.position, before, speed});
      break;
    }
  }
}

}  // namespace

RoofRecorder start_roofs(const Scene& scene, const std::vector<RecordLine>& lines) {
  RoofRecorder recorder;
  const auto has_roof = [](const RecordLine& line) { return !line.roof.empty(); };
  if (std::none_of(lines.begin(), lines.end(), has_roof)) return recorder;
  const auto n = static_cast<std::size_t>(n_blocks(scene));
  recorder.lines = lines;
  recorder.row_of.assign(n * lines.size(), -1);
  recorder.last_of.assign(n, -1);
  return recorder;
}

void record_roofs(RoofRecorder& recorder, const Scene& scene, const Segment& segment) {
  if (recorder.lines.empty()) return;
  std::int32_t& index = recorder.last_of[static_cast<std::size_t>(segment.block)];
  if (index < 0) {
    index = static_cast<std::int32_t>(recorder.last.size());
    recorder.last.push_back(segment);
    return;
  }
  Segment& last = recorder.last[static_cast<std::size_t>(index)];
  look(recorder, scene, last, segment.start.velocity);
  last = segment;
}

void close_step(RoofRecorder& recorder, const Scene& scene, const State& state) {
  for (const Segment& segment : recorder.last) {
    const auto b = static_cast<std::size_t>(segment.block);
    look(recorder, scene, segment, state.motion[b].velocity);
    recorder.last_of[b] = -1;
  }
  recorder.last.clear();
}

void restore(RoofRecorder& recorder, const std::vector<RoofHit>& rows) {
  for (const RoofHit& row : rows) add_hit(recorder, row);
}

std::vector<RoofHit> sorted(const RoofRecorder& recorder) {
  std::vector<RoofHit> rows = recorder.rows;
  std::sort(rows.begin(), rows.end(), [](const RoofHit& a, const RoofHit& b) {
    return std::tie(a.line, a.block) < std::tie(b.line, b.block);
  });
  return rows;
}

}  // namespace talus
