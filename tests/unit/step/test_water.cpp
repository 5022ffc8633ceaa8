// Water in joints: sliding and lifting against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/units.hpp"
#include "blocks/limit_equilibrium.hpp"
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

/// The same in forces: one of its planes has a friction of 1.
SlidingMass mass_of(const PlaneFailure& block, const Filling& filling) {
  const double head = filling.crack > 0 ? filling.crack : block.height / 2;
  const double uplift = filling.uplift ? weight * head * block.length / 2 * block.width : 0;
  const double thrust = weight * filling.crack * filling.crack / 2 * block.width;
  const Vec3 normal(std::sin(dip), 0, std::cos(dip));
  return {block.mass() * g, uplift * normal + thrust * Vec3::UnitX(), {{normal, 1, 0}}};
}

// Gravity with a pseudo-static acceleration along +x, of gravity.
void shake(double seismic, Scene& scene) { scene.gravity.x() = seismic * g; }

double speed_after(const Scene& scene, double time) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state.motion[0].velocity.norm();
}

const Filling fillings[] = {{0, false}, {0, true},    {2.5, true},
                            {5, true},  {2.5, false}, {5, false}};

// Dry, half and full; with and without a tension crack; with water in the crack alone; and shaken.
TEST(Water, ABlockSlidesAtTheFrictionOfHoekAndBray) {
  const PlaneFailure block;
  for (const double seismic : {0.0, 0.1})
    for (const Filling& filling : fillings) {
      const double critical = 1 / sliding_factor(mass_of(block, filling), seismic * Vec3::UnitX());
      ASSERT_GT(critical, 0) << filling.crack;
      if (critical > 5) continue;  // it turns over first
      const auto moves = [&](double friction) {
        Scene scene = plane_failure(block, filling, std::atan(friction) / degree);
        shake(seismic, scene);
        return speed_after(scene, 0.3) > 0.01;
      };
      EXPECT_TRUE(moves(0.99 * critical)) << filling.crack << filling.uplift << seismic;
      EXPECT_FALSE(moves(1.01 * critical)) << filling.crack << filling.uplift << seismic;
    }
}

// ... and with the rest of the force, it accelerates.
TEST(Water, ABlockAcceleratesByWhatIsLeft) {
  const PlaneFailure block;
  for (const Filling& filling : fillings) {
    const SlidingMass mass = mass_of(block, filling);
    const double friction = 0.5 / sliding_factor(mass);
    const Vec3 along(std::cos(dip), 0, -std::sin(dip));
    const double a = 0.5 * along.dot(mass.water - mass.weight * Vec3::UnitZ()) / block.mass();
    const double v = speed_after(plane_failure(block, filling, std::atan(friction) / degree), 0.1);
    EXPECT_NEAR(v / (a * 0.1), 1, 5e-3) << filling.crack << filling.uplift;
  }
}

/// A prism that lies in a valley of two planes, plunging: a wedge of equal planes.
struct WedgeBlock {
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

// Two planes with a head all over.
TEST(Water, AWedgeSlidesAtItsFriction) {
  const WedgeBlock wedge;
  const double volume = wedge.length * wedge.half_width * wedge.half_width * std::tan(wedge.side);
  for (const auto& [head, seismic] :
       {std::pair(0.0, 0.0), {0.5, 0.0}, {1.0, 0.0}, {0.0, 0.1}, {0.5, 0.1}}) {
    SlidingMass mass{2500 * g * volume, Vec3::Zero(), {}};
    for (const double sign : {-1, 1}) {
      const Vec3 normal = Vec3(std::tan(wedge.plunge), sign * std::tan(wedge.side), 1).normalized();
      mass.planes.push_back({normal, 1, 0});
      mass.water += weight * head * wedge.length * wedge.half_width / normal.z() * normal;
    }
    const double critical = 1 / sliding_factor(mass, seismic * Vec3::UnitX());
    ASSERT_GT(critical, 0);
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
      shake(seismic, scene);
      EXPECT_EQ(scene.loads.size(), head > 0 ? 2u : 0u);
      EXPECT_EQ(speed_after(scene, 0.3) > 0.01, share < 1) << head << " " << seismic << share;
    }
  }
}

/// A block of 2 x 2 x 1 m on level ground with a head below it that lifts `share` of its weight.
/// The remaining pressure is renewed at the ends of steps: the error goes with their length.
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

// F (1 - x / d) lifts a weight W by 2 d (1 - W / F) where that is at most d; an opened face has
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

// The energy put in by water is that of the block: 3/2 of its weight along its rise, less losses;
// without other losses the account closes while the block rises.
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
