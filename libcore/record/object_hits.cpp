// Touches of endangered objects by blocks.
#include "record/object_hits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.hpp"
#include "geometry/plan2d.hpp"
#include "record/footprint_cells.hpp"
#include "scene/scene.hpp"

namespace talus {
namespace {

constexpr double touch_gap = 1e-3;  // [m]
constexpr int halvings = 20;        // of the time in which a block comes off a roof

bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double s1 = cross(b - a, c - a), s2 = cross(b - a, d - a);
  const double s3 = cross(d - c, a - c), s4 = cross(d - c, b - c);
  return s1 * s2 < 0 && s3 * s4 < 0;
}

// Calls visit(a, b) for each side; a point is a side of no length.
template <class Visit>
void for_each_side(const ObjectPart& part, Visit&& visit) {
  const std::size_t n = part.points.size();
  if (n == 1) visit(part.points[0], part.points[0]);
  for (std::size_t i = 0; i + 1 < n; ++i) visit(part.points[i], part.points[i + 1]);
  if (part.is_area && n > 2) visit(part.points[n - 1], part.points[0]);
}

double distance_to(const ObjectPart& part, const Vec2& p) {
  if (part.is_area && is_inside(part.points, p)) return 0;
  double least = infinity;
  for_each_side(part, [&](const Vec2& a, const Vec2& b) {
    least = std::min(least, distance_to_segment(p, a, b));
  });
  return least;
}

double distance_to(const ObjectPart& part, const std::vector<Vec2>& convex) {
  if (part.is_area && is_inside(part.points, convex[0])) return 0;
  if (is_inside(convex, part.points[0])) return 0;
  double least = infinity;
  for_each_side(part, [&](const Vec2& a, const Vec2& b) {
    for (std::size_t i = 0, j = convex.size() - 1; i < convex.size(); j = i++) {
      if (meet(convex[j], convex[i], a, b)) least = 0;
      least = std::min({least, distance_to_segment(convex[i], a, b),
                        distance_to_segment(a, convex[j], convex[i]),
                        distance_to_segment(b, convex[j], convex[i])});
    }
  });
  return least;
}

// Without its roofs.
template <class Shape>
double gap_of(const RecordObject& object, const Shape& shape) {
  double least = infinity;
  for (const ObjectPart& part : object.parts) least = std::min(least, distance_to(part, shape));
  return std::max(0.0, least - object.radius);
}

// The part of a convex polygon to the right of the line from `a` to `b`, or to its left.
std::vector<Vec2> cut(const std::vector<Vec2>& convex, const Vec2& a, const Vec2& b, bool right) {
  std::vector<Vec2> kept;
  const auto side = [&](const Vec2& p) { return (right ? -1 : 1) * cross(b - a, p - a); };
  for (std::size_t i = 0, j = convex.size() - 1; i < convex.size(); j = i++) {
    const double before = side(convex[j]), now = side(convex[i]);
    if ((before < 0 && now > 0) || (before > 0 && now < 0))
      kept.push_back(convex[j] + before / (before - now) * (convex[i] - convex[j]));
    if (now >= 0) kept.push_back(convex[i]);
  }
  return kept;
}

// What a convex polygon has outside of the roofs, in convex pieces; none smaller than rounding.
std::vector<std::vector<Vec2>> outside_of(const std::vector<std::vector<Vec2>>& roofs,
                                          const std::vector<Vec2>& convex) {
  constexpr double least_area = 1e-9;  // [m2]
  std::vector<std::vector<Vec2>> open{convex};
  for (const std::vector<Vec2>& roof : roofs) {
    std::vector<std::vector<Vec2>> left;
    for (std::vector<Vec2>& piece : open)
      for (std::size_t i = 0, j = roof.size() - 1; i < roof.size(); j = i++) {
        std::vector<Vec2> beyond = cut(piece, roof[j], roof[i], true);
        if (beyond.size() > 2 && std::abs(ring_area(beyond)) > least_area)
          left.push_back(std::move(beyond));
        piece = cut(piece, roof[j], roof[i], false);
        if (piece.size() < 3) break;
      }
    open = std::move(left);
  }
  return open;
}

// The polygon with the extents along eight axes: its corners lie between neighbouring directions.
void make_footprint(const Scene& scene, int block, const Motion& motion,
                    std::vector<Vec2>& polygon) {
  constexpr int n = 2 * n_footprint_axes;
  constexpr double step = std::numbers::pi / n_footprint_axes;
  const Extents extents = footprint_extents(scene.blocks.shapes, block, motion.pose.attitude);
  const auto reach = [&extents](int k) {
    k %= n;
    return k < n_footprint_axes ? extents.high[k] : -extents.low[k - n_footprint_axes];
  };
  const Vec2 at = motion.pose.position.head<2>();
  for (int k = 0; k < n; ++k) {
    const double a = k * step, b = a + step, h = reach(k), next = reach(k + 1);
    polygon[static_cast<std::size_t>(k)] =
        at + Vec2(h * std::sin(b) - next * std::sin(a), next * std::cos(a) - h * std::cos(b)) /
                 std::sin(step);
  }
}

// No point of the block is faster in plan in this segment [m/s].
double speed_bound(const Scene& scene, const Segment& segment) {
  const auto b = static_cast<std::size_t>(segment.block);
  const double h = segment.t_end - segment.t_start;
  const Vec2 path = (segment.end.pose.position - segment.start.pose.position).head<2>();
  const double centroid = path.norm() / h + 0.5 * h * segment.acceleration.head<2>().norm();
  const auto apart = [&](double sign) {
    return (segment.start.pose.attitude.coeffs() - sign * segment.end.pose.attitude.coeffs())
        .norm();
  };
  // omega = L / I in flight, which keeps |L|; else an even turn, 4 asin(d / 2) <= 2.1 d
  const double turn =
      segment.flight ? segment.start.angular_momentum.norm() / scene.blocks.inertia[b].minCoeff()
                     : 2.1 * std::min(apart(1), apart(-1)) / h;
  return centroid + scene.blocks.shapes.radius[b] * turn;
}

ObjectHit hit_at(const Scene& scene, int block, int object, const Motion& motion, double time) {
  ObjectHit hit;
  hit.block = block;
  hit.object = object;
  hit.time = time;
  hit.position = motion.pose.position;
  hit.speed = motion.velocity.norm();
  const auto b = static_cast<std::size_t>(block);
  hit.translational_energy = translational_energy(scene.blocks.mass[b], motion.velocity);
  hit.total_energy = hit.translational_energy + rotational_energy(motion, scene.blocks.inertia[b]);
  const Vec3 up = motion.pose.attitude.toRotationMatrix().row(2);
  double top = -infinity, bottom = infinity;
  for (const Vec3& vertex : vertices_of(scene.blocks.shapes, block)) {
    top = std::max(top, up.dot(vertex));
    bottom = std::min(bottom, up.dot(vertex));
  }
  const double height =
      hit.position.z() - elevation_at(scene.ground.trn, hit.position.x(), hit.position.y());
  hit.top_height = height + top;
  hit.bottom_height = height + bottom;
  hit.largest_speed = hit.speed;
  hit.largest_translational_energy = hit.translational_energy;
  hit.largest_total_energy = hit.total_energy;
  hit.largest_top_height = hit.top_height;
  return hit;
}

void raise(ObjectHit& known, const ObjectHit& other) {
  const auto up = [](double& value, double by) {
    value = std::isnan(value) ? by : std::fmax(value, by);
  };
  up(known.largest_speed, other.largest_speed);
  up(known.largest_translational_energy, other.largest_translational_energy);
  up(known.largest_total_energy, other.largest_total_energy);
  up(known.largest_top_height, other.largest_top_height);
}

void add_object_hit(ObjectRecorder& recorder, const ObjectHit& hit) {
  const std::size_t n_objects = recorder.objects.size();
  std::int32_t& index = recorder.row_of[static_cast<std::size_t>(hit.block) * n_objects +
                                        static_cast<std::size_t>(hit.object)];
  if (index >= 0) return raise(recorder.rows[static_cast<std::size_t>(index)], hit);
  index = static_cast<std::int32_t>(recorder.rows.size());
  recorder.rows.push_back(hit);
}

// Goes through a segment from gap to gap; over the object by a quarter of the block at most.
void follow(ObjectRecorder& recorder, const Scene& scene, SegmentMotion& motion, int object,
            double fastest) {
  const Segment& segment = motion.segment();
  const RecordObject& shape = recorder.objects[static_cast<std::size_t>(object)];
  const double stride =
      std::max(0.01, 0.25 * scene.blocks.shapes.radius[static_cast<std::size_t>(segment.block)]);
  const auto footprint_at = [&](double time) -> const std::vector<Vec2>& {
    make_footprint(scene, segment.block, motion.at(time), recorder.footprint);
    return recorder.footprint;
  };
  double t = segment.t_start, covered_at = infinity;
  while (true) {
    const double gap = gap_of(shape, footprint_at(t));
    const bool comes = gap <= touch_gap;
    if (comes && gap_to(shape, recorder.footprint) > touch_gap) {
      covered_at = t;
    } else if (comes) {
      double first = t;
      for (int i = 0; covered_at < t && i < halvings; ++i) {
        const double middle = 0.5 * (covered_at + first);
        (gap_to(shape, footprint_at(middle)) > touch_gap ? covered_at : first) = middle;
      }
      covered_at = infinity;
      if (first < t)
        add_object_hit(recorder, hit_at(scene, segment.block, object, motion.at(first), first));
      add_object_hit(recorder, hit_at(scene, segment.block, object, motion.at(t), t));
    }
    if (t >= segment.t_end) return;
    const double distance = gap <= touch_gap ? stride : gap - 0.5 * touch_gap;
    t = std::min(segment.t_end, t + distance / fastest);
  }
}

}  // namespace

double gap_to(const RecordObject& object, const std::vector<Vec2>& convex) {
  if (object.roofs.empty()) return gap_of(object, convex);
  double least = infinity;
  for (const std::vector<Vec2>& piece : outside_of(object.roofs, convex))
    least = std::min(least, gap_of(object, piece));
  return least;
}

double gap_to(const RecordObject& object, const Vec2& point) {
  for (const std::vector<Vec2>& roof : object.roofs)
    if (is_inside(roof, point)) return infinity;
  return gap_of(object, point);
}

ObjectRecorder start_objects(const Scene& scene, std::vector<RecordObject> objects) {
  const auto n = static_cast<std::size_t>(n_blocks(scene));
  ObjectRecorder recorder;
  recorder.objects = std::move(objects);
  recorder.row_of.assign(n * recorder.objects.size(), -1);
  recorder.clearance.assign(n, 0);
  recorder.rows.reserve(n * recorder.objects.size());
  recorder.footprint.resize(2 * n_footprint_axes);
  return recorder;
}

void record_objects(ObjectRecorder& recorder, const Scene& scene, SegmentMotion& motion) {
  if (recorder.objects.empty()) return;
  const Segment& segment = motion.segment();
  const double duration = segment.t_end - segment.t_start;
  if (!(duration > 0)) return;
  const auto b = static_cast<std::size_t>(segment.block);
  const double fastest = speed_bound(scene, segment);
  double& clearance = recorder.clearance[b];
  clearance -= fastest * duration;
  if (clearance > 0 || fastest == 0) return;
  const Vec2 start = segment.start.pose.position.head<2>();
  const Vec2 end = segment.end.pose.position.head<2>();
  const double radius = scene.blocks.shapes.radius[b];
  clearance = infinity;
  for (std::size_t o = 0; o < recorder.objects.size(); ++o) {
    const double before = gap_of(recorder.objects[o], start) - radius;
    if (before - fastest * duration <= touch_gap)
      follow(recorder, scene, motion, static_cast<int>(o), fastest);
    clearance = std::min(clearance, gap_of(recorder.objects[o], end) - radius - touch_gap);
  }
}

void restore(ObjectRecorder& recorder, const std::vector<ObjectHit>& rows) {
  for (const ObjectHit& row : rows) add_object_hit(recorder, row);
}

std::vector<ObjectHit> sorted(const ObjectRecorder& recorder) {
  std::vector<ObjectHit> rows = recorder.rows;
  std::sort(rows.begin(), rows.end(), [](const ObjectHit& a, const ObjectHit& b) {
    return a.object != b.object ? a.object < b.object : a.block < b.block;
  });
  return rows;
}

ObjectHit joined(const ObjectHit& a, const ObjectHit& b) {
  ObjectHit out = b.time < a.time ? b : a;
  raise(out, b.time < a.time ? a : b);
  return out;
}

}  // namespace talus
