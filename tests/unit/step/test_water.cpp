#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/units.hpp"
#include "scene/joint_water.hpp"
#include "step/step.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double weight = 1e4;  // of water [N/m3]

// Slope along +x through the local zero.
constexpr double dip_deg = 35;
const double dip = dip_deg * degree;

/// A block on a plane of 35 degrees with an upright rear face, its tension crack: `length` along
/// the plane, as high at the rear as `height`, 1 m wide. As Hoek and Bray have it.
struct PlaneFailure {
  double length = 10, height = 5, width = 4;

  [[nodiscard]] Polyhedron shape() const {
    const double rear = -length / 2 * std::cos(dip), toe = -rear, low = toe * std::tan(dip);
    std::vector<Vec3> at;
    for (const double y : {-width / 2, width / 2}) {
      at.emplace_back(rear, y, low);
      at.emplace_back(toe, y, -low);
      at.emplace_back(rear, y, low + height);
    }
    Polyhedron body =
        polyhedron(at, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}});
    body.face_tag.back() = face_source_side;
    return body;
  }
  [[nodiscard]] double mass() const { return 2500 * width * height * length * std::cos(dip) / 2; }
};

/// How high the crack is filled; and whether there is water under the block.
struct Filling {
  double crack = 0;
  bool uplift = true;
};

// Water in the crack to z_w above its foot; under the block from that head at the foot to none at
// the toe.
Scene plane_failure(const PlaneFailure& block, const Filling& filling, double friction_deg) {
  Scene scene = scene_of(plane_trn(slope_frame(dip_deg, 0), 1, 40), ground_of(friction_deg),
                         {body_of(block.shape())}, {});
  JointWater water;
  water.unit_weight = weight;
  water.of_side = filling.crack > 0 ? JointFill::crack : JointFill::drained;
  water.crack_fill = filling.crack;
  const double reach = block.length * std::cos(dip), rear = -reach / 2;
  const double head = filling.crack > 0 ? filling.crack : block.height / 2;
  const auto surface = [&](double x, double) {
    return -x * std::tan(dip) + head * (1 - (x - rear) / reach);
  };
  if (filling.uplift) water.surface = make_trn(surface, 1, 40).elevation;
  add_joint_water(water, scene);
  scene.drained_at = 1e6;  // kept
  return scene;
}

struct Forces {
  double weight, uplift, thrust;
};
Forces forces_on(const PlaneFailure& block, const Filling& filling) {
  const double head = filling.crack > 0 ? filling.crack : block.height / 2;
  return {block.mass() * g, filling.uplift ? weight * head * block.length / 2 * block.width : 0,
          weight * filling.crack * filling.crack / 2 * block.width};
}

// tan(phi) at which it is about to slide: Hoek and Bray.
double critical_friction(const Forces& f) {
  return (f.weight * std::sin(dip) + f.thrust * std::cos(dip)) /
         (f.weight * std::cos(dip) - f.uplift - f.thrust * std::sin(dip));
}

double speed_after(const Scene& scene, double time) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state.motion[0].velocity.norm();
}

const Filling fillings[] = {{0, false}, {0, true},    {2.5, true},
                            {5, true},  {2.5, false}, {5, false}};

// Dry, half and full; with and without a tension crack; and with water in the crack alone.
TEST(Water, ABlockSlidesAtTheFrictionOfHoekAndBray) {
  const PlaneFailure block;
  for (const Filling& filling : fillings) {
    const double critical = critical_friction(forces_on(block, filling));
    ASSERT_GT(critical, 0) << filling.crack;
    const auto moves = [&](double friction) {
      return speed_after(plane_failure(block, filling, std::atan(friction) / degree), 0.3) > 0.01;
    };
    EXPECT_TRUE(moves(0.99 * critical)) << filling.crack << filling.uplift;
    EXPECT_FALSE(moves(1.01 * critical)) << filling.crack << filling.uplift;
  }
}

// ... and with what is left over, it accelerates.
TEST(Water, ABlockAcceleratesByWhatIsLeft) {
  const PlaneFailure block;
  for (const Filling& filling : fillings) {
    const Forces f = forces_on(block, filling);
    const double friction = 0.5 * critical_friction(f);
    const double a = (f.weight * std::sin(dip) + f.thrust * std::cos(dip) -
                      friction * (f.weight * std::cos(dip) - f.uplift - f.thrust * std::sin(dip))) /
                     block.mass();
    const double v = speed_after(plane_failure(block, filling, std::atan(friction) / degree), 0.1);
    EXPECT_NEAR(v / (a * 0.1), 1, 5e-3) << filling.crack << filling.uplift;
  }
}

/// A prism that lies in a valley of two planes, plunging: a wedge of equal planes.
struct Wedge {
  double plunge = 30 * degree, side = 45 * degree;  // of a section across, in a vertical plane
  double length = 8, half_width = 2;

  [[nodiscard]] double floor(double x, double y) const {
    return -x * std::tan(plunge) + std::abs(y) * std::tan(side);
  }
  [[nodiscard]] Polyhedron shape() const {
    std::vector<Vec3> at;
    for (const double x : {-length / 2, length / 2})
      for (const double y : {0.0, half_width, -half_width}) at.emplace_back(x, y, floor(x, y));
    return polyhedron(at, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}});
  }
};

// Equal planes with a head h all over: W cos i is carried by two normal forces at the angle that
// the planes have to the plane of their line and the vertical, each less the uplift; friction acts
// along the line (Hoek and Bray).
TEST(Water, AWedgeSlidesAtItsFriction) {
  const Wedge wedge;
  const Vec3 normal = Vec3(std::tan(wedge.plunge), -std::tan(wedge.side), 1).normalized();
  const Vec3 line(std::cos(wedge.plunge), 0, -std::sin(wedge.plunge));
  const Vec3 up(std::sin(wedge.plunge), 0, std::cos(wedge.plunge));
  const double volume = wedge.length * wedge.half_width * wedge.half_width * std::tan(wedge.side);
  const double area = wedge.length * wedge.half_width / normal.z(), w = 2500 * g * volume;
  EXPECT_NEAR(normal.dot(line), 0, 1e-12);
  for (const double head : {0.0, 0.5, 1.0}) {
    const double uplift = weight * head * area;
    const double pressed = w * std::cos(wedge.plunge) / (2 * normal.dot(up)) - uplift;
    ASSERT_GT(pressed, 0);
    const double critical = w * std::sin(wedge.plunge) / (2 * pressed);
    for (const double share : {0.99, 1.01}) {
      const Trn valley = make_trn([&](double x, double y) { return wedge.floor(x, y); }, 1, 30);
      Scene scene = scene_of(valley, ground_of(std::atan(share * critical) / degree),
                             {body_of(wedge.shape())}, {});
      JointWater water;
      water.unit_weight = weight;
      water.surface = valley.elevation;
      for (double& z : water.surface) z += head;
      add_joint_water(water, scene);
      scene.drained_at = 1e6;
      EXPECT_EQ(scene.loads.size(), head > 0 ? 2u : 0u);
      EXPECT_EQ(speed_after(scene, 0.3) > 0.01, share < 1) << head << " " << share;
    }
  }
}

/// A block of 2 x 2 x 1 m on level ground with a head below it that lifts `share` of its weight.
/// What is left of a pressure is renewed at the ends of steps: the error goes with their length.
Scene lifted(double share, double drained_at, double dt = 1e-3) {
  Settings settings;
  settings.dt = dt;
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 20), ground_of(30),
                         {body_of(box(Vec3(-1, -1, 0), Vec3(1, 1, 1)))}, settings);
  JointWater water;
  water.unit_weight = weight;
  water.surface.assign(scene.ground.trn.elevation.size(), share * 2500 * g / weight);
  add_joint_water(water, scene);
  scene.drained_at = drained_at;
  return scene;
}

TEST(Water, ABlockFloatsWhereThePressureIsItsWeight) {
  EXPECT_LT(speed_after(lifted(0.99, 1e6), 0.2), 1e-6);
  EXPECT_NEAR(speed_after(lifted(1.1, 1e6), 0.05), 0.05 * 0.1 * g, 0.05 * 0.1 * g * 0.02);
}

double highest_of(const Scene& scene, double time, double& last) {
  State state = start(scene);
  Work work = make_work(scene);
  double highest = 0;
  while (state.time < time - 1e-9) {
    step(scene, state, work);
    last = motion_at(scene, state, 0, state.time).pose.position.z() - 0.5;
    highest = std::max(highest, last);
  }
  return highest;
}

// F (1 - x / d) lifts a weight W by 2 d (1 - W / F) where that is at most d; what opened has
// drained, so that the block is back on the ground and stays there.
TEST(Water, PressureFallsAsAFaceOpens) {
  double last = 1;
  for (const double drained_at : {0.05, 0.02}) {
    const double rises = 2 * drained_at * (1 - 1 / 1.5);
    const double highest = highest_of(lifted(1.5, drained_at), 2, last);
    EXPECT_NEAR(highest / rises, 1, 0.03) << drained_at;
    EXPECT_NEAR(last, 0, 1e-4) << drained_at;
    const double coarse = highest_of(lifted(1.5, drained_at, 4e-3), 2, last);
    EXPECT_LT(highest - rises, 0.5 * (coarse - rises)) << drained_at;
  }
  EXPECT_LT(highest_of(lifted(1.5, 0), 2, last), 1e-3);  // at once
  EXPECT_NEAR(last, 0, 1e-4);
  // kept: until the faces are the diameter of the circle of their area apart
  const double extent = 2 * std::sqrt(4 / std::numbers::pi);
  const double rises = 2 * extent * (1 - 1 / 1.5);
  EXPECT_NEAR(highest_of(lifted(1.5, 1e6), 3, last) / rises, 1, 0.02);
}

// What water puts in is what the block gets: 3/2 of its weight along its rise, less what is lost of
// it on the way; without other losses the account closes while the block rises.
TEST(Water, IsAnEntryOfTheEnergyAccount) {
  const double drained_at = 0.5;
  const Scene scene = lifted(1.5, drained_at);
  State state = start(scene);
  Work work = make_work(scene);
  const auto mechanical = [&] {
    const Energies e = energies(scene, state);
    return e.translation + e.rotation + e.potential;
  };
  const double before = mechanical();
  const double force = 1.5 * scene.blocks.mass[0] * g;
  while (state.time < 0.3 - 1e-9) step(scene, state, work);
  const double rise = state.motion[0].pose.position.z() - 0.5;
  ASSERT_GT(rise, 0.1);
  const double extent = 2 * std::sqrt(4 / std::numbers::pi);
  // integral of F (1 - x / d) (1 - x / e)
  const double exact = force * (rise - rise * rise / 2 * (1 / drained_at + 1 / extent) +
                                rise * rise * rise / (3 * drained_at * extent));
  EXPECT_NEAR(state.ledger.water / exact, 1, 0.01);
  EXPECT_NEAR((mechanical() - before) / state.ledger.water, 1, 1e-3);
  EXPECT_EQ(state.ledger.base, 0);
}

// A sleeping block is woken by a joint that drains, and the joint of a mass that left is dry.
TEST(Water, DoesNotDriveForEver) {
  const PlaneFailure block;
  Scene scene = plane_failure(block, {5, true}, 30);
  scene.drained_at = 0.01;
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < 3 - 1e-9) step(scene, state, work);
  ASSERT_GT((state.motion[0].pose.position - scene.blocks.rest[0].position).norm(), 12);
  for (const double left : state.pressure) EXPECT_EQ(left, 0);
}

}  // namespace
