// Bodies of several parts on ridges: none sinks in.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "step/step.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double top = ridge_height;  // [m]

double cot_of(double angle_deg) { return 1 / std::tan(angle_deg * std::numbers::pi / 180); }

// A pillar with a square top that ends in a point.
Body pillar(double half_angle_deg, const Vec2& at) {
  const double cot = cot_of(half_angle_deg), w = std::min(1.0, 0.9 * top / cot);
  std::vector<Vec3> vertices;
  for (const double z : {0.0, top - w * cot})
    for (const Vec2& corner : {Vec2(-w, -w), Vec2(w, -w), Vec2(w, w), Vec2(-w, w)})
      vertices.emplace_back(at.x() + corner.x(), at.y() + corner.y(), z);
  vertices.emplace_back(at.x(), at.y(), top);
  return body_of(polyhedron(vertices, {{3, 2, 1, 0},
                                       {0, 1, 5, 4},
                                       {1, 2, 6, 5},
                                       {2, 3, 7, 6},
                                       {3, 0, 4, 7},
                                       {4, 5, 8},
                                       {5, 6, 8},
                                       {6, 7, 8},
                                       {7, 4, 8}}));
}

// Two slabs that fall to both sides of their seam at half of the ridge's slope, 0.6 m thick.
Body roof(double half_angle_deg) {
  const auto half = [&](double side) {
    Mat3 slope = Mat3::Identity();
    slope(2, 0) = -side * cot_of(half_angle_deg) / 2;
    Polyhedron part =
        box(Vec3(std::min(0.0, 2 * side), -2, 0), Vec3(std::max(0.0, 2 * side), 2, 0.6));
    for (Vec3& vertex : part.vertices) vertex = slope * vertex + top * Vec3::UnitZ();
    return part;
  };
  Body body;
  body.parts = {half(1), half(-1)};
  return body;
}

// A plate with a keel below its middle, so that other parts cover some of its underside.
Body plate_with_keel() {
  Body body;
  body.parts = {box(Vec3(-3, -2, top), Vec3(3, 2, top + 0.6)),
                box(Vec3(-0.5, -1, top - 0.1), Vec3(0.5, 1.5, top))};
  return body;
}

// How far a body goes down in a second on ridges of blocks, and on ridges of the ground [m].
struct Sunk {
  double on_blocks = 0, on_ground = 0;
};

// Of block 0.
double sunk(const Scene& scene) {
  State state = start(scene);
  Work work = make_work(scene);
  const double before = state.motion[0].pose.position.z();
  double deepest = 0;
  for (int i = 0; i < 200; ++i) {
    step(scene, state, work);
    deepest = std::max(deepest, before - state.motion[0].pose.position.z());
  }
  return deepest;
}

// On one ridge at x = 0, or on two at `apart` to both sides of it.
Sunk on_ridges(const Body& body, double half_angle_deg, double apart = 0) {
  const double cot = cot_of(half_angle_deg);
  const auto ridges = [&](double x, double) { return top - cot * std::abs(std::abs(x) - apart); };
  std::vector<Body> bodies = {body, ridge_wall(half_angle_deg, apart)};
  if (apart > 0) bodies.push_back(ridge_wall(half_angle_deg, -apart));
  return {sunk(scene_of(plane_trn(slope_frame(0, 0), 5, 50), ground_of(60), bodies, {})),
          sunk(scene_of(make_trn(ridges, 0.5, 20), ground_of(60), {body}, {}))};
}

constexpr double size = 6;  // of the bodies [m]

// However sharp the ridge, and wherever the seam lies above it: along it, beside it, across it.
TEST(PartsOnRidges, APlateOfTwoPartsDoesNotSinkIn) {
  for (int half_angle_deg = 10; half_angle_deg <= 80; half_angle_deg += 10)
    for (const double azimuth_deg : {0.0, 30.0, 90.0})
      for (const double off : {0.0, 1e-6, 1e-4, 3e-3, 0.1, 1.0}) {
        const Sunk by = on_ridges(split_plate(azimuth_deg, off), half_angle_deg);
        EXPECT_LT(by.on_blocks, 1e-4 * size) << half_angle_deg << " " << azimuth_deg << " " << off;
        EXPECT_LT(by.on_ground, 1e-4 * size) << half_angle_deg << " " << azimuth_deg << " " << off;
      }
}

TEST(PartsOnRidges, ARoofOfTwoPartsDoesNotSinkIn) {
  for (int half_angle_deg = 10; half_angle_deg <= 80; half_angle_deg += 10) {
    const Sunk by = on_ridges(roof(half_angle_deg), half_angle_deg);
    EXPECT_LT(by.on_blocks, 1e-4 * size) << half_angle_deg;
    EXPECT_LT(by.on_ground, 1e-4 * size) << half_angle_deg;
  }
}

// A face that another part covers somewhere is in contact where it is bare.
TEST(PartsOnRidges, APlateWithAKeelDoesNotSinkIn) {
  for (int half_angle_deg = 10; half_angle_deg <= 80; half_angle_deg += 10)
    for (const double apart : {1.5, 2.5}) {
      const Sunk by = on_ridges(plate_with_keel(), half_angle_deg, apart);
      EXPECT_LT(by.on_blocks, 1e-4 * size) << half_angle_deg << " " << apart;
      EXPECT_LT(by.on_ground, 1e-4 * size) << half_angle_deg << " " << apart;
    }
}

TEST(PartsOnRidges, APlateWithAKeelDoesNotSinkOnPoints) {
  for (int half_angle_deg = 10; half_angle_deg <= 80; half_angle_deg += 10)
    for (const double apart : {1.0, 1.5}) {
      std::vector<Body> bodies = {plate_with_keel()};
      for (const double x : {-2.0, 2.0})
        for (const double y : {-apart, apart}) bodies.push_back(pillar(half_angle_deg, {x, y}));
      const double by =
          sunk(scene_of(plane_trn(slope_frame(0, 0), 5, 50), ground_of(60), bodies, {}));
      EXPECT_LT(by, 1e-4 * size) << half_angle_deg << " " << apart;
    }
}

}  // namespace
