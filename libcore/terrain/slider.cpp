// A point that slides down the ground under Coulomb friction: estimates the duration of a run.
#include "terrain/slider.hpp"

#include <algorithm>

#include "base/percentile.hpp"

namespace talus {
namespace {

constexpr double gravity = 9.80665;  // [m/s2]

double friction_at(const Trn& ground, const SlidingFriction& friction, const Vec2& place) {
  if (friction.cell_class.empty()) return friction.tangent[0];
  const Cell cell = locate(ground, place.x(), place.y()).cell;
  const auto index = static_cast<std::size_t>(first_triangle(ground, cell)) / 2;
  return friction.tangent[friction.cell_class[index]];
}

// The velocity turned into the plane of the ground, with its speed.
Vec3 turned_into(const Vec3& normal, const Vec3& velocity) {
  const Vec3 along = velocity - normal.dot(velocity) * normal;
  const double length = along.norm();
  return length > 0 ? Vec3(along * (velocity.norm() / length)) : Vec3(Vec3::Zero());
}

}  // namespace

SliderPath slide_from(const Trn& ground, const SlidingFriction& friction, const Vec2& start,
                      bool with_points) {
  SliderPath slide;
  slide.end = start;
  if (with_points) slide.points.push_back(start);
  Vec3 velocity = Vec3::Zero();
  while (slide.time < longest_slide_s) {
    const TrianglePlane plane =
        triangle_plane(ground, triangle_at(ground, slide.end.x(), slide.end.y()));
    if (!contains(ground, slide.end.x(), slide.end.y()) || !plane.normal.allFinite()) {
      slide.left = true;
      return slide;
    }
    velocity = turned_into(plane.normal, velocity);
    const Vec3 pull = gravity * (plane.normal.z() * plane.normal - Vec3::UnitZ());
    const double brake =
        gravity * plane.normal.z() * friction_at(ground, friction, slide.end) * slider_step_s;
    const Vec3 driven = velocity + slider_step_s * pull;
    if (driven.norm() <= brake) return slide;
    const Vec3 next = driven * (1 - brake / driven.norm());
    const Vec2 step = (velocity + next).head<2>() / 2 * slider_step_s;
    velocity = next;
    slide.end += step;
    slide.path += step.norm();
    slide.time += slider_step_s;
    if (with_points) slide.points.push_back(slide.end);
  }
  slide.left = true;
  return slide;
}

double duration_for(std::vector<double> times) {
  std::vector<WeightedValue> values;
  for (const double time : times) values.push_back({time, 1});
  sort_values(values);
  const double p95 = values.empty() ? 0 : weighted_percentile(values, 0.95);
  return std::max(10.0, 1.7 * p95);
}

}  // namespace talus
