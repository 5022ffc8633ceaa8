// Scales bodies, sets them on the ground and finds their overlaps.
#include "blocks/placed_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "blocks/placement.hpp"
#include "blocks/solid.hpp"

namespace talus {
namespace {

// Faces that touch overlap by the rounding of their coordinates.
constexpr double rounding_share = 1e-6;

struct Box {
  Vec3 low = Vec3::Constant(infinity), high = -low;
};

Box box_of(const Body& body) {
  Box box;
  for (const Polyhedron& part : body.parts)
    for (const Vec3& v : part.vertices)
      box.low = box.low.cwiseMin(v), box.high = box.high.cwiseMax(v);
  return box;
}

bool are_apart(const Box& one, const Box& other) {
  return (one.low.array() >= other.high.array()).any() ||
         (other.low.array() >= one.high.array()).any();
}

bool is_inside(const Vec3& point, const Polyhedron& convex) {
  for (int f = 0; f < n_faces(convex); ++f)
    if (face_normal(convex, f).dot(point - convex.vertices[face(convex, f)[0]]) > 0) return false;
  return true;
}

bool has_corner_in(const Body& body, const Body& other) {
  for (const Polyhedron& part : body.parts)
    for (const Polyhedron& around : other.parts)
      if (is_inside(part.vertices[0], around)) return true;
  return false;
}

double shared_volume(const Body& one, const Body& other) {
  double shared = 0;
  for (const Polyhedron& part : one.parts)
    for (const Polyhedron& around : other.parts) shared += common_volume(part, around);
  return shared;
}

}  // namespace

double volume_of(const Body& body) {
  double sum = 0;
  for (const Polyhedron& part : body.parts) sum += moments(part).volume;
  return sum;
}

void centre(std::vector<Body>& bodies) {
  Moments sum;
  bool is_first = true;
  for (const Body& body : bodies)
    for (const Polyhedron& part : body.parts) {
      sum = is_first ? moments(part) : joined(sum, moments(part));
      is_first = false;
    }
  for (Body& body : bodies) move_by(body, -sum.centroid);
}

void scale_to_volume(std::vector<Body>& bodies, double volume) {
  double sum = 0;
  for (const Body& body : bodies) sum += volume_of(body);
  const double factor = std::cbrt(volume / sum);
  for (Body& body : bodies) {
    for (Polyhedron& part : body.parts)
      for (Vec3& v : part.vertices) v *= factor;
    for (Vec3& v : body.shell.vertices) v *= factor;
  }
}

double put_on_ground(std::vector<Body>& bodies, const Trn& ground, const Placing& placing) {
  const Vec3& place = placing.place;
  const double z0 = elevation_at(ground, place.x(), place.y());
  if (std::isnan(z0)) return z0;
  const bool by_height = !std::isnan(placing.height_above_ground) || std::isnan(place.z());
  const Vec3 at(place.x(), place.y(), by_height ? z0 : place.z());
  double gap = infinity;
  for (Body& body : bodies) {
    rotate(body, placing.turn);
    move_by(body, at);
    const double own = clearance(body, ground);
    if (std::isnan(own)) return own;
    gap = std::min(gap, own);
  }
  if (!by_height) return std::max(0.0, -gap);
  const double height = std::isnan(placing.height_above_ground) ? 0 : placing.height_above_ground;
  for (Body& body : bodies) move_by(body, {0, 0, height - gap});
  return 0;
}

bool is_below(const Body& body, const Trn& ground) {
  for (const Polyhedron& part : body.parts)
    for (const Vec3& v : part.vertices)
      if (!(v.z() < elevation_at(ground, v.x(), v.y()))) return false;
  return true;
}

BodyOverlaps find_overlaps(const std::vector<Body>& bodies, const std::vector<bool>& were_turned) {
  BodyOverlaps found;
  std::vector<Box> boxes;
  for (const Body& body : bodies) boxes.push_back(box_of(body));
  const int n = static_cast<int>(bodies.size());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (a == b || are_apart(boxes[a], boxes[b])) continue;
      if (!found.cavity && were_turned[a] && has_corner_in(bodies[a], bodies[b]))
        found.cavity = {a, b};
      if (a > b) continue;
      const double share = shared_volume(bodies[a], bodies[b]) /
                           std::min(volume_of(bodies[a]), volume_of(bodies[b]));
      if (share <= rounding_share) continue;
      ++found.n;
      if (share > found.largest_share) found.largest_share = share, found.worst = {a, b};
    }
  return found;
}

}  // namespace talus
