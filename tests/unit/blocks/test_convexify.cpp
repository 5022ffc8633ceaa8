// Convex blocks above a bed: room, volume, connected parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "blocks/convexify.hpp"
#include "blocks/cut.hpp"
#include "blocks/solid.hpp"

namespace {

using namespace talus;

// A bed with a ridge along y at x = `ridge`, falling by `west` and `east` to the sides.
struct Ridge {
  double x, west, east;
  [[nodiscard]] double height(double at) const {
    return at < x ? west * (at - x) : east * (x - at);
  }
};

Trn bed_of(const Ridge& ridge) {
  Trn bed;
  bed.n_rows = 5;
  bed.n_cols = 25;
  bed.cell_size = 0.5;
  bed.node0 = Vec2(-6, 1.5);
  for (int r = 0; r < bed.n_rows; ++r)
    for (int c = 0; c < bed.n_cols; ++c)
      bed.elevation.push_back(ridge.height(bed.node0.x() + c * bed.cell_size));
  return bed;
}

// Rock above the ridge, below z = `top`, between x = -5 and 5.
ConvexTask rock_above(const Ridge& ridge, double top) {
  ConvexTask task;
  task.room = box(Vec3(-5, 0, -20), Vec3(5, 1, top));
  for (const double side : {-1.0, 1.0}) {
    const double slope = side < 0 ? ridge.west : -ridge.east;
    const Vec3 down = Vec3(slope, 0, -1).normalized();
    const Plane above{down, down.x() * ridge.x};
    Polyhedron cell = clip_convex(task.room, {Vec3(-side, 0, 0), -side * ridge.x}, cut_wall, 1e-9);
    cell = clip_convex(cell, above, cut_failure, 1e-9);
    for (int f = 0; f < n_faces(cell); ++f)
      if (face_normal(cell, f).z() > 0.999)
        cell.face_tag[static_cast<std::size_t>(f)] = cut_terrain;
    task.volume += moments(cell).volume;
    task.cells.push_back(std::move(cell));
  }
  return task;
}

// Would the bodies share volume if `one` were a little thicker?
bool touch(const Polyhedron& one, const Polyhedron& other) {
  Polyhedron common = other;
  for (int f = 0; f < n_faces(one) && n_faces(common) > 0; ++f) {
    const Vec3 normal = face_normal(one, f);
    common = clip_convex(common, {normal, normal.dot(face_centroid(one, f)) + 1e-4}, 0, 1e-12);
  }
  return n_faces(common) > 0;
}

// A ridge of the bed may cut a part off from the plane in which the block was divided: such parts
// are not bodies.
TEST(ConvexParts, HangTogether) {
  std::mt19937_64 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int n_divided = 0, n_refused = 0;
  for (int k = 0; k < 40; ++k) {
    const Ridge ridge{0.5 * std::floor(uniform(-8, 8)), uniform(0.1, 1.5), uniform(0.1, 1.5)};
    const std::vector<Polyhedron> parts =
        made_convex_parts({rock_above(ridge, uniform(0.02, 0.5))}, bed_of(ridge), {});
    n_refused += parts.empty();
    if (parts.size() < 2) continue;
    ++n_divided;
    std::vector<const Polyhedron*> linked = {parts.data()};
    for (std::size_t i = 0; i < linked.size(); ++i)
      for (const Polyhedron& part : parts)
        if (std::find(linked.begin(), linked.end(), &part) == linked.end() &&
            touch(*linked[i], part))
          linked.push_back(&part);
    EXPECT_EQ(linked.size(), parts.size()) << "ridge " << ridge.x << " " << ridge.west;
  }
  EXPECT_GT(n_divided, 5);
  EXPECT_GT(n_refused, 0);
}

}  // namespace
