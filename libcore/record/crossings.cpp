// Crossings of lines by blocks: time, place and motion.
#include "record/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geometry/plan2d.hpp"
#include "motion/rotation.hpp"
#include "record/motion.hpp"
#include "scene/scene.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

// Segment i of a line as start + w * direction; w runs over 0..1, and on beyond both ends of the
// line in its first and last segment.
struct LinePart {
  Vec2 start, end, direction;
  bool is_first = false, is_last = false;
};

int n_parts(const RecordLine& line) { return static_cast<int>(line.points.size()) - 1; }

LinePart part_of(const RecordLine& line, int i) {
  const Vec2 a = line.points[i].head<2>(), b = line.points[i + 1].head<2>();
  return {a, b, b - a, i == 0, i + 1 == n_parts(line)};
}

double share_of(const LinePart& part, const Vec2& point) {
  return (point - part.start).dot(part.direction) / part.direction.squaredNorm();
}

double distance_to(const LinePart& part, const Vec2& point) {
  double w = share_of(part, point);
  if (!part.is_first) w = std::max(w, 0.0);
  if (!part.is_last) w = std::min(w, 1.0);
  return (part.start + w * part.direction - point).norm();
}

double distance_to_lines(const std::vector<RecordLine>& lines, const Vec2& point) {
  double distance = std::numeric_limits<double>::infinity();
  for (const RecordLine& line : lines)
    for (int i = 0; i < n_parts(line); ++i)
      distance = std::min(distance, distance_to(part_of(line, i), point));
  return distance;
}

// Where the motion from `a` to `b` meets a part.
struct Meeting {
  bool found = false;
  double s = 0;       // share of the motion
  double w = 0;       // share of the part
  int direction = 0;  // +1 to the part's left
};

// The ends of each lie on different sides of the other. A point on a line counts as lying to its
// left, and a corner of the line has one side of the path for both of its parts, so that no
// crossing is missed or seen twice when a step ends on the line or goes through a corner.
Meeting meet(const LinePart& part, const Vec2& a, const Vec2& b) {
  const double side_a = cross(part.direction, a - part.start);
  const double side_b = cross(part.direction, b - part.start);
  if ((side_a >= 0) == (side_b >= 0)) return {};
  const Vec2 path = b - a;
  const double start = part.is_first ? -cross(path, part.direction) : cross(path, part.start - a);
  const double end = part.is_last ? cross(path, part.direction) : cross(path, part.end - a);
  if ((start >= 0) == (end >= 0)) return {};
  const double s = side_a / (side_a - side_b);
  return {true, s, share_of(part, a + s * path), side_b >= 0 ? 1 : -1};
}

// Time at which the centroid reaches share s of its path in plan. The path is a line, but where the
// acceleration has a horizontal part along it the share is not that of the time.
double time_at(const Segment& segment, double s) {
  const double h = segment.t_end - segment.t_start;
  const Vec2 path = (segment.end.pose.position - segment.start.pose.position).head<2>();
  const double bend = 0.5 * h * h * segment.acceleration.head<2>().dot(path) / path.squaredNorm();
  double tau = s;  // s = tau - bend tau (1 - tau), by Newton
  for (int i = 0; i < 6; ++i)
    tau -= (tau - bend * tau * (1 - tau) - s) / std::max(0.1, 1 - bend * (1 - 2 * tau));
  return segment.t_start + h * std::clamp(tau, 0.0, 1.0);
}

Crossing crossing_at(const Scene& scene, const RecordLine& line, int i, const Segment& segment,
                     const Meeting& meeting) {
  const int block = segment.block;
  const Vec3& inertia = scene.blocks.inertia[block];
  Crossing row;
  row.block = block;
  row.segment = i;
  row.direction = meeting.direction;
  row.time = time_at(segment, meeting.s);
  row.chainage = line.chainage[i] + meeting.w * (line.chainage[i + 1] - line.chainage[i]);
  row.beside = (i == 0 && meeting.w < 0) || (i + 1 == n_parts(line) && meeting.w > 1);
  const Motion motion = motion_at(segment, inertia, row.time);
  row.position = motion.pose.position;
  row.velocity = motion.velocity;
  row.spin = angular_velocity(motion.pose.attitude, motion.angular_momentum, inertia);
  row.translational_energy = translational_energy(scene.blocks.mass[block], motion.velocity);
  row.rotational_energy = rotational_energy(motion, inertia);
  const double w = std::clamp(meeting.w, 0.0, 1.0);
  const double base = line.points[i].z() + w * (line.points[i + 1].z() - line.points[i].z());
  row.centroid_height = row.position.z() - base;
  const Vec3 up = motion.pose.attitude.toRotationMatrix().row(2);
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (const Vec3& vertex : vertices_of(scene.blocks.shapes, block)) {
    top = std::max(top, up.dot(vertex));
    bottom = std::min(bottom, up.dot(vertex));
  }
  row.top_height = row.centroid_height + top;
  row.bottom_height = row.centroid_height + bottom;
  return row;
}

void add_crossing(CrossingRecorder& recorder, int line, Crossing row) {
  const std::size_t n_lines = recorder.lines.size();
  std::int32_t& index =
      recorder
          .row_of[static_cast<std::size_t>(row.block) * n_lines + static_cast<std::size_t>(line)];
  row.line = line;
  row.n_crossings = row.beside ? 0 : 1;
  if (index < 0) {
    index = static_cast<std::int32_t>(recorder.rows.size());
    recorder.rows.push_back(row);
    return;
  }
  Crossing& known = recorder.rows[index];
  if (row.beside) return;
  if (known.beside)
    known = row;
  else
    ++known.n_crossings;
}

}  // namespace

std::vector<Vec3> posts_on_ground(const Trn& trn, const std::vector<Vec2>& corners, double spacing,
                                  const Where& where) {
  if (corners.size() < 2)
    throw InputError(where, "the line has " + std::to_string(corners.size()) + " point" +
                                (corners.size() == 1 ? "" : "s") + ", expected two or more");
  double length = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    length += (corners[i + 1] - corners[i]).norm();
  constexpr double most_posts = 1e4;  // each is asked for in each step of each block
  if (static_cast<double>(corners.size()) > most_posts)
    throw InputError(where,
                     "the line has " + std::to_string(corners.size()) + " points, expected up to " +
                         text(most_posts),
                     "simplify it");
  if (!(length / spacing <= most_posts))
    throw InputError(where,
                     "posts every " + text(spacing) + " m are " + text(length / spacing, 3) +
                         " posts, expected up to " + text(most_posts),
                     "give a larger post_spacing_m");
  std::vector<Vec3> posts;
  const auto add = [&](const Vec2& at) {
    const double z = elevation_at(trn, at.x(), at.y());
    if (std::isnan(z)) {
      const Vec2 place = at + trn.origin.head<2>();
      Doubt doubt = doubt_on(
          where,
          "leaves the known terrain at (" + text(place.x(), 10) + ", " + text(place.y(), 10) +
              "); " + extent_text(trn),
          "shorten the line or make the terrain larger; if it lies far away, check the order (x "
          "east, y north) and the coordinate system of its points");
      doubt.at = {{place.x(), place.y(), Doubt::none}};
      throw InputError(std::move(doubt));
    }
    posts.emplace_back(at.x(), at.y(), z);
  };
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[i + 1];
    if (!((b - a).norm() > 0))
      throw InputError(where,
                       "point " + std::to_string(i + 2) + " repeats the one before, (" +
                           place_text(b, trn.origin) + ")",
                       "leave out one of the two");
    const int n = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing - 1e-9)));
    for (int k = 0; k < n; ++k) add(a + (b - a) * (static_cast<double>(k) / n));
  }
  add(corners.back());
  return posts;
}

RecordLine record_line(std::string name, std::vector<Vec3> points) {
  RecordLine line{std::move(name), std::move(points), {}};
  const Where where{"", 0, "line " + line.name};
  if (line.points.size() < 2)
    throw InputError(where,
                     "has " + std::to_string(line.points.size()) + " point, expected two or more");
  line.chainage.push_back(0);
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const double length = (line.points[i] - line.points[i - 1]).head<2>().norm();
    if (!(length > 0))
      throw InputError(where,
                       "points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                           " lie at the same place",
                       "remove one of them");
    line.chainage.push_back(line.chainage.back() + length);
  }
  return line;
}

std::vector<LineMeeting> line_meetings(const RecordLine& line, const Vec2& a, const Vec2& b) {
  std::vector<LineMeeting> out;
  // meet() decides; segments farther apart than rounding need no call
  const Vec2 slack = Vec2::Constant(1e-6);
  const Vec2 low = a.cwiseMin(b) - slack, high = a.cwiseMax(b) + slack;
  for (int i = 0; i < n_parts(line); ++i) {
    const LinePart part = part_of(line, i);
    if ((part.start.cwiseMin(part.end).array() > high.array()).any() ||
        (part.start.cwiseMax(part.end).array() < low.array()).any())
      continue;
    const Meeting at = meet(part, a, b);
    if (!at.found || (part.is_first && at.w < 0) || (part.is_last && at.w > 1)) continue;
    out.push_back({i, at.direction, at.s,
                   line.chainage[i] + at.w * (line.chainage[i + 1] - line.chainage[i])});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const LineMeeting& p, const LineMeeting& q) { return p.share < q.share; });
  return out;
}

CrossingRecorder start_crossings(const Scene& scene, std::vector<RecordLine> lines) {
  const auto n = static_cast<std::size_t>(n_blocks(scene));
  CrossingRecorder recorder{std::move(lines), {}, {}, {}};
  recorder.row_of.assign(n * recorder.lines.size(), -1);
  recorder.clearance.assign(n, 0);
  recorder.rows.reserve(n * recorder.lines.size());
  return recorder;
}

void record_crossings(CrossingRecorder& recorder, const Scene& scene, const Segment& segment) {
  if (recorder.lines.empty()) return;
  const Vec2 a = segment.start.pose.position.head<2>(), b = segment.end.pose.position.head<2>();
  const double moved = (b - a).norm();
  double& clearance = recorder.clearance[segment.block];
  clearance -= moved;
  if (clearance > 0 || moved == 0) return;
  clearance = distance_to_lines(recorder.lines, b);
  std::vector<std::pair<int, Meeting>> met;  // part of the line, and where; mostly none or one
  for (std::size_t l = 0; l < recorder.lines.size(); ++l) {
    const RecordLine& line = recorder.lines[l];
    met.clear();
    for (int i = 0; i < n_parts(line); ++i)
      if (const Meeting meeting = meet(part_of(line, i), a, b); meeting.found)
        met.emplace_back(i, meeting);
    std::stable_sort(met.begin(), met.end(),
                     [](const auto& p, const auto& q) { return p.second.s < q.second.s; });
    for (const auto& [i, meeting] : met)
      add_crossing(recorder, static_cast<int>(l), crossing_at(scene, line, i, segment, meeting));
  }
}

std::vector<Crossing> sorted(const CrossingRecorder& recorder) {
  std::vector<Crossing> rows = recorder.rows;
  std::sort(rows.begin(), rows.end(), [](const Crossing& a, const Crossing& b) {
    return a.line != b.line ? a.line < b.line : a.block < b.block;
  });
  return rows;
}

}  // namespace talus
