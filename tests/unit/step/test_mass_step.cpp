// The mass step against the exact step and closed forms, and the hand-over between the two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/random.hpp"
#include "base/units.hpp"
#include "base/workers.hpp"
#include "contact/shapes.hpp"
#include "scene/fence.hpp"
#include "scene/stems.hpp"
#include "scene/worlds.hpp"
#include "solver/law_numbers.hpp"
#include "step/flight.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form.hpp"
#include "verify/study/ensemble.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double g = 10;

Settings with_masses(bool masses, double dt = 0.005) {
  Settings settings;
  settings.masses = masses;
  settings.dt = dt;
  return settings;
}

/// Cubes of 1 m that touch on all sides, on a plane.
struct Lattice {
  int along = 4, across = 4, high = 4;
  double thick = 1;  ///< [m]
  double dip_deg = 40, friction_deg = 25, restitution = 0.3;
  double above = 0;              ///< the plane [m]
  Vec3 velocity = Vec3::Zero();  ///< in the axes of the slope [m/s]
};

std::vector<Body> cubes_of(const Lattice& lattice, const SlopeFrame& frame, const Vec3& at) {
  std::vector<Body> bodies;
  for (int k = 0; k < lattice.high; ++k)
    for (int j = 0; j < lattice.across; ++j)
      for (int i = 0; i < lattice.along; ++i) {
        const Vec3 low = at + Vec3(i, j, k * lattice.thick + lattice.above);
        const Vec3& v = lattice.velocity;
        bodies.push_back(body_of(box_in(frame, Vec3::Zero(), low, low + Vec3(1, 1, lattice.thick)),
                                 v.x() * frame.dip + v.y() * frame.strike + v.z() * frame.normal));
      }
  return bodies;
}

Scene scene_of_lattice(const Lattice& lattice, const Settings& settings) {
  const SlopeFrame frame = slope_frame(lattice.dip_deg, 30);
  return scene_of(plane_trn(frame, 4, 400), ground_of(lattice.friction_deg, lattice.restitution),
                  cubes_of(lattice, frame, Vec3::Zero()), settings);
}

int n_in_mass(const State& state) {
  return static_cast<int>(std::count_if(state.mass.begin(), state.mass.end(),
                                        [](const MassShare& share) { return share.is_in_mass; }));
}

double mechanical(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  return e.translation + e.rotation + e.potential;
}

double booked(const EnergyLedger& l) {
  return l.friction + l.impact + l.contact + l.fence + l.rolling + l.drag + l.removed - l.base;
}

Vec3 momentum(const Scene& scene, const State& state) {
  Vec3 sum = Vec3::Zero();
  for (int b = 0; b < n_blocks(scene); ++b)
    sum += scene.blocks.mass[static_cast<std::size_t>(b)] *
           motion_at(scene, state, b, state.time).velocity;
  return sum;
}

/// Records of a run.
struct Course {
  State state;
  int steps_in_mass = 0;    ///< nominal ones
  double largest_gain = 0;  ///< of energy in a step, of the energy lost so far [-]
  double lost = 0;          ///< mechanical energy [J]
  double imbalance = 0;     ///< of the ledger, of the energy lost [-]
  double deepest = 0;       ///< overlap [m]
};

Course run(const Scene& scene, double time, State state) {
  Course course;
  Work work = make_work(scene);
  const double before = mechanical(scene, state);
  double last = before;
  while (state.time < time - 1e-9) {
    const int stride = static_cast<int>(state.stride);
    const StepReport report = step(scene, state, work);
    const double now = mechanical(scene, state);
    if (n_in_mass(state) > 0) course.steps_in_mass += stride;
    course.largest_gain = std::max(course.largest_gain, now - last);
    course.deepest = std::max(course.deepest, report.largest_penetration);
    last = now;
  }
  course.lost = before - last;
  course.largest_gain /= std::max(course.lost, 1.0);
  course.imbalance = (course.lost - booked(state.ledger)) / std::max(course.lost, 1.0);
  course.state = std::move(state);
  return course;
}
Course run(const Scene& scene, double time) { return run(scene, time, start(scene)); }

/// Mean displacement of the blocks along their largest mean displacement, and their spread about
/// it.
struct Place {
  double way = 0, spread = 0;
};
Place place_of(const Scene& scene, const State& state) {
  Vec3 mean = Vec3::Zero();
  const std::size_t n = state.motion.size();
  for (std::size_t b = 0; b < n; ++b)
    mean += (state.motion[b].pose.position - scene.blocks.rest[b].position) / n;
  const Vec3 along = mean.normalized();
  Place place{mean.norm(), 0};
  double centre = 0, sum = 0;
  for (const Motion& m : state.motion) centre += along.dot(m.pose.position) / n;
  for (const Motion& m : state.motion) sum += std::pow(along.dot(m.pose.position) - centre, 2);
  place.spread = std::sqrt(sum / n);
  return place;
}

std::string text_of(const std::string& name) {
  std::ifstream in(std::string(TALUS_SOURCE_DIR) + "/tests/data/" + name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// --- which step --------------------------------------------------------------------------------

TEST(MassStep, IsAskedForWhereManyBlocksMove) {
  const Lattice sliding;
  EXPECT_EQ(run(scene_of_lattice(sliding, with_masses(false)), 0.1).steps_in_mass, 0);
  const Course many = run(scene_of_lattice(sliding, with_masses(true)), 0.1);
  EXPECT_EQ(n_in_mass(many.state), 64);
  EXPECT_GE(many.steps_in_mass, 17);
  Lattice few = sliding;
  few.high = 2;  // 32
  EXPECT_EQ(run(scene_of_lattice(few, with_masses(true)), 0.1).steps_in_mass, 0);
  Lattice resting = sliding;
  resting.dip_deg = 10;  // each column of four is stable
  EXPECT_EQ(run(scene_of_lattice(resting, with_masses(true)), 0.2).steps_in_mass, 0);
}

// At the start nothing moves and no contact knows its load.
TEST(MassStep, BeginsWhereManyBlocksLeave) {
  const auto in_first_step = [](const Lattice& lattice) {
    const Scene scene = scene_of_lattice(lattice, with_masses(true));
    return n_in_mass(run(scene, 0.005).state);
  };
  EXPECT_EQ(in_first_step({}), 64);
  Lattice columns;
  columns.across = 1;
  columns.dip_deg = 0;
  for (const int high : {6, 10, 20, 30}) {  // that are stable
    columns.along = 180 / high;
    columns.high = high;
    EXPECT_EQ(in_first_step(columns), 0) << high;
  }
}

// --- closed forms ------------------------------------------------------------------------------

// A lattice that slides as one: g (sin - mu cos).
TEST(MassStep, SlidesAsOneBlockDoes) {
  for (const double dt : {0.005, 0.02}) {
    Lattice lattice;
    lattice.along = lattice.across = 6;
    lattice.high = 1;
    const Course course = run(scene_of_lattice(lattice, with_masses(true, dt)), 2);
    EXPECT_GE(course.steps_in_mass, 2 / dt - 5);
    const double a = g * (std::sin(40 * degree) - std::tan(25 * degree) * std::cos(40 * degree));
    const Place place = place_of(scene_of_lattice(lattice, with_masses(true, dt)), course.state);
    EXPECT_NEAR(place.way, a * 2 * 2 / 2, 1e-5 * a * 2) << dt;
    EXPECT_LT(std::abs(course.imbalance), 1e-3) << dt;
  }
}

// Tiles slide on a slab that the ground holds, with friction that weakens between blocks.
TEST(MassStep, FrictionBetweenBlocksWeakensWithSpeed) {
  Lattice tiles;
  tiles.along = tiles.across = 6;
  tiles.high = 1;
  tiles.thick = 0.2;
  tiles.above = 1;
  tiles.velocity = Vec3(5, 0, 0);
  const SlopeFrame flat = slope_frame(0, 0);
  std::vector<Body> bodies = cubes_of(tiles, flat, Vec3::Zero());
  bodies.push_back(body_of(box_in(flat, Vec3::Zero(), Vec3(-1, -1, 0), Vec3(12, 7, 1))));
  Scene scene = scene_of(plane_trn(flat, 4, 400), ground_of(60, 0.3), bodies, with_masses(true));
  scene.joint = weakening_ground();
  const Course course = run(scene, 2);
  EXPECT_GT(course.steps_in_mass, 100);
  EXPECT_LT(std::abs(course.imbalance), 1e-3);
  for (std::size_t b = 0; b < 36; ++b)
    EXPECT_NEAR(
        (course.state.motion[b].pose.position - scene.blocks.rest[b].position).dot(flat.dip),
        weakening_way(5), 5e-3 * weakening_way(5));
}

// On rough ground, and between blocks, friction is that at the stress of each cube or tile.
TEST(MassStep, RoughJointsSlideAtTheStressOfTheirBlocks) {
  const auto rough = [](double residual_deg) {
    GroundClass made = ground_of(residual_deg, 0.3);
    made.residual = residual_deg * degree;
    made.roughness = 8 * degree;
    made.wall_strength = 50e6;
    return made;
  };
  const auto tangent = [](double residual_deg, double stress) {
    return std::tan((residual_deg + 8 * std::log10(50e6 / stress)) * degree);
  };
  Lattice cubes;
  cubes.along = cubes.across = 6;
  cubes.high = 1;
  Scene slope = scene_of_lattice(cubes, with_masses(true));
  slope.ground.classes[0] = rough(4);
  const Course down = run(slope, 2);
  EXPECT_GE(down.steps_in_mass, 2 / 0.005 - 5);
  const double dip = cubes.dip_deg * degree;
  const double a = g * (std::sin(dip) - tangent(4, 2500 * g * std::cos(dip)) * std::cos(dip));
  EXPECT_NEAR(place_of(slope, down.state).way / (a * 2 * 2 / 2), 1, 5e-3);
  EXPECT_LT(std::abs(down.imbalance), 1e-3);

  Lattice tiles = cubes;
  tiles.thick = 0.2;
  tiles.above = 1;
  tiles.velocity = Vec3(5, 0, 0);
  const SlopeFrame flat = slope_frame(0, 0);
  std::vector<Body> bodies = cubes_of(tiles, flat, Vec3::Zero());
  bodies.push_back(body_of(box_in(flat, Vec3::Zero(), Vec3(-1, -1, 0), Vec3(12, 7, 1))));
  const double way = 5 * 5 / (2 * g * tangent(5, 2500 * g * tiles.thick));
  for (const bool masses : {false, true}) {
    Scene slab = scene_of(plane_trn(flat, 4, 400), ground_of(60, 0.3), bodies, with_masses(masses));
    slab.joint = rough(5);
    const Course along = run(slab, 2);
    EXPECT_EQ(along.steps_in_mass > 50, masses);
    EXPECT_LT(std::abs(along.imbalance), 1e-3);
    double sum = 0;
    for (std::size_t b = 0; b < 36; ++b)
      sum += (along.state.motion[b].pose.position - slab.blocks.rest[b].position).dot(flat.dip);
    EXPECT_NEAR(sum / 36 / way, 1, 5e-3) << masses;
  }
}

// Blocks that fall flat side by side rebound with the restitution, each alone.
TEST(MassStep, ReboundsWithTheRestitution) {
  Lattice lattice;
  lattice.along = lattice.across = 6;
  lattice.high = 1;
  lattice.dip_deg = 0;
  lattice.restitution = 0.5;
  lattice.above = 0.2;
  lattice.velocity = Vec3(0, 0, -2);
  const Scene scene = scene_of_lattice(lattice, with_masses(true));
  const double speed = std::sqrt(2 * 2 + 2 * g * 0.2);
  const double hit = (speed - 2) / g, later = hit + 0.06;
  const Course course = run(scene, std::ceil(later / 0.005) * 0.005);
  const double expected = 0.5 * speed - g * (course.state.time - hit);
  for (const Motion& m : course.state.motion) EXPECT_NEAR(m.velocity.z(), expected, 0.01 * speed);
  const double impact = 0.5 * 36 * 2500 * speed * speed * (1 - 0.25);
  EXPECT_NEAR(course.state.ledger.impact, impact, 0.02 * impact);
}

// The same where corners touch at the end of a step, some before it and some after by rounding: it
// does not split the hit.
TEST(MassStep, ReboundsWithTheRestitutionAtTheEndOfAStep) {
  const double hit = 0.1, speed = 2 + g * hit;
  Lattice lattice;
  lattice.along = lattice.across = 6;
  lattice.high = 1;
  lattice.dip_deg = 0;
  lattice.restitution = 0.5;
  lattice.above = (2 + speed) / 2 * hit;
  lattice.velocity = Vec3(0, 0, -2);
  const Scene scene = scene_of_lattice(lattice, with_masses(true));
  const Course course = run(scene, hit + 0.06);
  const double expected = 0.5 * speed - g * (course.state.time - hit);
  for (const Motion& m : course.state.motion) EXPECT_NEAR(m.velocity.z(), expected, 0.01 * speed);
}

// --- conserved quantities ----------------------------------------------------------------------

// Two lattices meet in the air.
TEST(MassStep, KeepsMomentum) {
  Lattice lattice;
  lattice.along = 3;
  lattice.high = 4;
  lattice.dip_deg = 0;
  lattice.above = 50;
  const SlopeFrame frame = slope_frame(0, 30);
  std::vector<Body> bodies = cubes_of(lattice, frame, Vec3::Zero());
  lattice.velocity = Vec3(-6, 1, 0.5);
  for (Body& body : cubes_of(lattice, frame, Vec3(3.2, 0.4, 0.3))) bodies.push_back(body);
  const Scene scene =
      scene_of(plane_trn(frame, 4, 400), ground_of(30, 0.4), bodies, with_masses(true));
  State state = start(scene);
  const Vec3 before = momentum(scene, state);
  const Course course = run(scene, 0.5, std::move(state));
  EXPECT_GE(course.steps_in_mass, 60);
  double mass = 0;
  for (const double m : scene.blocks.mass) mass += m;
  const Vec3 expected = before + 0.5 * mass * scene.gravity;
  EXPECT_LT((momentum(scene, course.state) - expected).norm(), 1e-9 * before.norm());
  EXPECT_LT(course.largest_gain, 1e-3);
  EXPECT_LT(std::abs(course.imbalance), 1e-6);
  EXPECT_GT(course.state.ledger.impact, 0.1 * course.lost);
}

// Whatever threads share pairs, rows and colours.
TEST(MassStep, HasTheSameBitsInAnyNumberOfThreads) {
  Lattice lattice;
  lattice.along = lattice.across = 12;
  lattice.high = 8;
  lattice.velocity = Vec3(3, 0, 0);
  const Scene scene = scene_of_lattice(lattice, with_masses(true));
  const auto end = [&](int n_threads) {
    Workers workers(n_threads);
    State state = start(scene);
    Work work = make_work(scene, n_threads > 1 ? &workers : nullptr);
    for (int k = 0; k < 12; ++k) step(scene, state, work);
    EXPECT_TRUE(state.mass[0].is_in_mass);
    return state.motion;
  };
  const std::vector<Motion> alone = end(1);
  for (const int n_threads : {2, 3, 8}) {
    const std::vector<Motion> shared = end(n_threads);
    for (std::size_t b = 0; b < alone.size(); ++b) {
      EXPECT_EQ(alone[b].pose.position, shared[b].pose.position);
      EXPECT_EQ(alone[b].angular_momentum, shared[b].angular_momentum);
    }
  }
}

TEST(MassStep, LosesEnergyAndBooksIt) {
  Lattice lattice;
  lattice.velocity = Vec3(8, 0, 0);
  lattice.dip_deg = 30;
  const Course course = run(scene_of_lattice(lattice, with_masses(true)), 2);
  EXPECT_GE(course.steps_in_mass, 150);
  EXPECT_LT(course.largest_gain, 1e-3);
  EXPECT_LT(std::abs(course.imbalance), 1e-6);
  EXPECT_LT(course.deepest, 0.05);
}

// While all that moves is a mass, steps are twice as long, and the blocks go as far. Beside more
// blocks that are in none they are not, nor where the nominal step is long.
TEST(MassStep, TakesLongStepsWhereTheyAreAccurate) {
  Lattice lattice;
  const auto n_steps = [](const Scene& scene, double time, State& state) {
    Work work = make_work(scene);
    int n = 0;
    for (; state.time < time - 1e-9; ++n) step(scene, state, work);
    EXPECT_NEAR(state.time, time, 1e-9);
    return n;
  };
  const Scene scene = scene_of_lattice(lattice, with_masses(true));
  State state = start(scene);
  EXPECT_LE(n_steps(scene, 1, state), 120);
  State held = start(scene);
  for (Work work = make_work(scene); held.time < 1 - 1e-9; held.stride = 1) step(scene, held, work);
  const double way = place_of(scene, held).way;
  EXPECT_NEAR(place_of(scene, state).way, way, 3e-3 * way);
  const Scene coarse = scene_of_lattice(lattice, with_masses(true, 0.01));
  State coarsely = start(coarse);
  EXPECT_EQ(n_steps(coarse, 0.5, coarsely), 50);
  std::vector<Body> bodies = cubes_of(lattice, slope_frame(lattice.dip_deg, 30), Vec3::Zero());
  for (int k = 0; k < 70; ++k)
    bodies.push_back(body_of(box(Vec3(4.0 * k, 100, 300), Vec3(4.0 * k + 1, 101, 301))));
  const Scene beside = scene_of(plane_trn(slope_frame(lattice.dip_deg, 30), 4, 400),
                                ground_of(lattice.friction_deg, 0.3), bodies, with_masses(true));
  State others = start(beside);
  EXPECT_EQ(n_steps(beside, 0.2, others), 40);
}

// --- against the exact step --------------------------------------------------------------------

// 39 blocks of all shapes on a valley's side of 2,240 triangles, from two starts, against the
// exact step at 1 ms.
TEST(MassStep, SlidesAsTheExactStepDoes) {
  const SlideData data = read_slide(text_of("terrain_F.asc"), text_of("blocks_39.obj"));
  constexpr int n_seeds = 2;
  Place exact, mass;
  double lost_by_exact = 0, lost_by_mass = 0;
  for (int seed = 0; seed < n_seeds; ++seed) {
    for (const bool masses : {false, true}) {
      const Scene scene = slide_scene(data, with_masses(masses, masses ? 0.005 : 0.001),
                                      static_cast<std::uint64_t>(seed));
      const Course course = run(scene, 3);
      EXPECT_EQ(course.steps_in_mass >= 200, masses);
      EXPECT_LT(std::abs(course.imbalance), 1e-6);
      EXPECT_LT(course.largest_gain, 1e-3);
      const Place place = place_of(scene, course.state);
      (masses ? mass : exact).way += place.way / n_seeds;
      (masses ? mass : exact).spread += place.spread / n_seeds;
      (masses ? lost_by_mass : lost_by_exact) += course.lost / n_seeds;
    }
  }
  EXPECT_NEAR(mass.way, exact.way, 3e-3 * exact.way);
  EXPECT_NEAR(mass.spread, exact.spread, 0.03 * exact.spread);
  EXPECT_NEAR(lost_by_mass, lost_by_exact, 0.01 * lost_by_exact);
}

// Yielding ground, and a base that moves: a layer of blocks goes as far as by the exact
// step.
struct GroundLaw {
  const char* name;
  double high = 1;
  void (*change)(GroundClass& ground, Scene& scene);
};
class MassOnGround : public testing::TestWithParam<GroundLaw> {};
INSTANTIATE_TEST_SUITE_P(
    MassStep, MassOnGround,
    testing::Values(
        GroundLaw{"Rolling", 2, [](GroundClass& of, Scene&) { of.rolling = 0.3; }},
        GroundLaw{"Drag", 1,
                  [](GroundClass& of, Scene&) { of.drag_per_time = of.drag_per_distance = 0.1; }},
        GroundLaw{"Scar", 1,
                  [](GroundClass& of, Scene&) { of.scar_friction = 0.9, of.scar_rate = 0.5; }},
        GroundLaw{"Weakening", 1,
                  [](GroundClass& of, Scene&) { of.weak_friction = 0.1, of.weakening_speed = 3; }},
        GroundLaw{"Base", 1,
                  [](GroundClass&, Scene& scene) {
                    scene.base.harmonic = {Vec3(3, 1, 2), 12, 0.2, 1.5};
                  }}),
    [](const testing::TestParamInfo<GroundLaw>& info) { return info.param.name; });

TEST_P(MassOnGround, GoesAsFarAsByTheExactStep) {
  double way[2], booked_of[2];
  for (const bool masses : {false, true}) {
    Lattice lattice;
    lattice.along = lattice.across = 6;
    lattice.high = static_cast<int>(GetParam().high);
    lattice.velocity = Vec3(4, 0.5, 0);
    lattice.dip_deg = 25;
    const SlopeFrame frame = slope_frame(lattice.dip_deg, 30);
    GroundClass ground = ground_of(lattice.friction_deg, 0.3);
    Scene unused;
    GetParam().change(ground, unused);
    Scene scene = scene_of(plane_trn(frame, 4, 400), ground, cubes_of(lattice, frame, Vec3::Zero()),
                           with_masses(masses));
    GetParam().change(ground, scene);
    const Course course = run(scene, 1.5);
    EXPECT_EQ(course.steps_in_mass > 100, masses);
    EXPECT_LT(std::abs(course.imbalance), 1e-6);
    way[masses] = place_of(scene, course.state).way;
    booked_of[masses] = course.state.ledger.friction;
  }
  EXPECT_NEAR(way[1], way[0], 3e-3 * way[0]);
  EXPECT_NEAR(booked_of[1], booked_of[0], 0.01 * booked_of[0]);
}

// --- hand-over ---------------------------------------------------------------------------------

// A lattice that slides to rest on a slope less steep than its friction: nothing is thrown, and
// nothing moves on once the exact step has it.
TEST(MassStep, HandsOverWhatHasComeToRest) {
  for (const double dip : {0.0, 20.0, 25.0}) {
    Lattice lattice;
    lattice.along = lattice.across = 5;
    lattice.high = 2;
    lattice.thick = 0.5;
    lattice.dip_deg = dip;
    lattice.friction_deg = 30;
    lattice.velocity = Vec3(2, 0.5, 0);
    const Scene scene = scene_of_lattice(lattice, with_masses(true));
    State state = start(scene);
    Work work = make_work(scene);
    int exact_from = -1;
    std::vector<Vec3> place;
    double fastest = 0, farthest = 0;
    for (int i = 0; i < 800; ++i) {
      const bool was_mass = n_in_mass(state) > 0;
      step(scene, state, work);
      if (was_mass && n_in_mass(state) == 0) {
        exact_from = i;
        place.clear();
        for (const Motion& m : state.motion) place.push_back(m.pose.position);
      }
      if (exact_from < 0) continue;
      for (std::size_t b = 0; b < place.size(); ++b) {
        fastest = std::max(fastest, state.motion[b].velocity.norm());
        farthest = std::max(farthest, (state.motion[b].pose.position - place[b]).norm());
      }
    }
    ASSERT_GT(exact_from, 0) << dip;
    EXPECT_LT(exact_from, 500) << dip;
    EXPECT_LT(farthest, 1e-3) << dip;
    EXPECT_LT(fastest, g * 0.005) << dip;
  }
}

// --- fences ------------------------------------------------------------------------------------

// A layer of blocks runs into a fence, soft or stiff: the energy of its panel and its deflection,
// against the exact step at 0.2 ms. (At 5 ms that one takes 6 % less of the soft fence, and 56 %
// less of the stiff one, which stops a block within a step.)
TEST(MassStep, PushesAFenceAsTheExactStepDoes) {
  struct Met {
    double work = 0, deflection = 0;
    int steps_in_mass = 0;
  };
  const auto meet = [](double capacity, bool masses, double dt) {
    Lattice lattice;
    lattice.along = lattice.across = 6;
    lattice.high = 1;
    lattice.velocity = Vec3(6, 0, 0);
    const SlopeFrame frame = slope_frame(0, 0);
    Scene scene = scene_of(plane_trn(frame, 4, 100), ground_of(10),
                           cubes_of(lattice, frame, Vec3(-7, -3, 0)), with_masses(masses, dt));
    StandingFence fence;
    fence.posts = {Vec3(0.5, -10, 0), Vec3(0.5, 10, 0)};
    fence.depth = {0.5};
    fence.height = 6;
    fence.capacity = capacity;
    fence.deflection = 3;
    add_fence(scene, fence);
    const Course course = run(scene, 0.6);
    const Met met{met_by(course.state.yielding, 0, 0).work,
                  -met_by(course.state.yielding, 0, 0).deflection, course.steps_in_mass};
    EXPECT_LT(std::abs(course.imbalance), 5e-3) << masses;
    EXPECT_NEAR(course.state.ledger.fence, met.work, 1);
    EXPECT_GE(course.state.fence.hits.size(), 6u);
    return met;
  };
  for (const double capacity : {2.1e6, 1e7}) {
    const Met exact = meet(capacity, false, 0.0002), mass = meet(capacity, true, 0.005);
    EXPECT_GT(mass.steps_in_mass, 50);
    EXPECT_GT(exact.work, 1e4);
    EXPECT_NEAR(mass.work, exact.work, 0.01 * exact.work);
    EXPECT_NEAR(mass.deflection, exact.deflection, 0.02 * exact.deflection);
  }
}

// The break of a panel may cut a step short anywhere, close to its begin or its end too. The
// impulses of such a substep stop what approaches: over its length they would be forces of any
// size.
TEST(MassStep, ABreakCloseToTheEndOfAStepThrowsNoBlock) {
  const auto meet = [](double capacity) {
    Lattice lattice;
    lattice.along = lattice.across = 6;
    lattice.high = 2;
    lattice.velocity = Vec3(6, 0, 0);
    const SlopeFrame frame = slope_frame(0, 0);
    Scene scene = scene_of(plane_trn(frame, 4, 100), ground_of(10),
                           cubes_of(lattice, frame, Vec3(-7, -3, 0)), with_masses(true));
    StandingFence fence;
    fence.posts = {Vec3(0.5, -10, 0), Vec3(0.5, 10, 0)};
    fence.depth = {0.5};
    fence.height = 6;
    fence.capacity = capacity;
    fence.deflection = 3;
    add_fence(scene, fence);
    return run(scene, 0.4);
  };
  const auto time_of_break = [](const Course& course) {
    return met_by(course.state.yielding, 0, 0).broken_at;
  };
  double low = 2e5, high = 1e6;
  const double step = 2 * 0.005, end = std::ceil(time_of_break(meet(low)) / step) * step;
  ASSERT_GT(time_of_break(meet(high)), end);
  while (high - low > 1e-7 * high) {
    const double middle = (low + high) / 2;
    (time_of_break(meet(middle)) < end ? low : high) = middle;
  }
  for (const double capacity : {low, high}) {
    const Course course = meet(capacity);
    EXPECT_NEAR(time_of_break(course), end, 1e-6);
    EXPECT_GT(course.steps_in_mass, 50);
    EXPECT_LT(course.largest_gain, 1e-3 * course.lost) << capacity;
    EXPECT_LT(std::abs(course.imbalance), 5e-3) << capacity;
  }
}

// A layer of blocks runs through a row of stems, which it breaks.
TEST(MassStep, BreaksStemsAsTheExactStepDoes) {
  double lost[2];
  std::size_t n_hit[2];
  for (const bool masses : {false, true}) {
    Lattice lattice;
    lattice.along = lattice.across = 6;
    lattice.high = 1;
    lattice.velocity = Vec3(8, 0, 0);
    const SlopeFrame frame = slope_frame(0, 0);
    Scene scene = scene_of(plane_trn(frame, 4, 100), ground_of(10),
                           cubes_of(lattice, frame, Vec3(-7, -3, 0)), with_masses(masses));
    std::vector<Stem> stems;
    for (int i = 0; i < 5; ++i) {
      Stem stem;
      stem.foot = Vec3(0, -2 + i, 0);
      stem.height = 8;
      stem.radius = 0.15;
      stem.capacity = 5e4;
      stem.deflection = 0.4;
      stems.push_back(stem);
    }
    GroundClass bark;
    bark.friction = 0.2;
    add_forest(scene, stems, {bark});
    const Course course = run(scene, 0.6);
    EXPECT_EQ(course.steps_in_mass > 20, masses);
    EXPECT_LT(std::abs(course.imbalance), 1e-6);
    lost[masses] = course.state.ledger.fence;
    n_hit[masses] = course.state.stem_hits.size();
  }
  EXPECT_GT(lost[0], 1e5);
  EXPECT_NEAR(lost[1], lost[0], 0.05 * lost[0]);
  EXPECT_GE(n_hit[1], 5u);
  EXPECT_GE(n_hit[0], 5u);
}

// --- a mass arrives at blocks at rest ------------------------------------------------------------

// A wall of bricks at rest; a mass arrives at one end of it, and all of it is in the mass. The
// other end moves by no more than by the exact step, to 1 mm. (That one lets it sag by 1.5 to 4
// mm.)
TEST(MassStep, LeavesInPlaceWhatItDoesNotReach) {
  constexpr int n_long = 30, n_high = 5;
  const SlopeFrame frame = slope_frame(0, 0);
  std::vector<Body> bodies;
  for (int k = 0; k < n_high; ++k)
    for (int i = 0; i < n_long; ++i) {
      const Vec3 low(-0.5, 2 * i + k % 2, k);
      bodies.push_back(body_of(box_in(frame, Vec3::Zero(), low, low + Vec3(1, 2, 1))));
    }
  Lattice arriving;
  arriving.along = arriving.across = 4, arriving.high = 3;
  arriving.velocity = Vec3(6, 0, 0);
  for (Body& body : cubes_of(arriving, frame, Vec3(-7, -0.4, 0))) bodies.push_back(std::move(body));
  std::vector<double> moved[2];
  for (const bool masses : {false, true}) {
    const Scene scene =
        scene_of(plane_trn(frame, 4, 200), ground_of(25, 0.3), bodies, with_masses(masses));
    const Course course = run(scene, 1.5);
    EXPECT_EQ(course.steps_in_mass > 100, masses);
    for (int b = 0; b < n_long * n_high; ++b)
      moved[masses].push_back(
          (course.state.motion[b].pose.position - scene.blocks.rest[b].position).norm());
  }
  for (int b = 0; b < n_long * n_high; ++b)
    if (b % n_long >= 20) {
      EXPECT_LT(moved[1][b], moved[0][b] + 1e-3) << b;
    }
  EXPECT_GT(*std::max_element(moved[1].begin(), moved[1].end()), 1);
}

// --- one large among many small ------------------------------------------------------------------

// A block 10,000 times as heavy as each of the 400 below it slides with them, as one.
TEST(MassStep, ALayerOfSmallBlocksCarriesALargeOne) {
  const SlopeFrame frame = slope_frame(30, 25);
  std::vector<Body> bodies;
  constexpr double small = 0.2, large = 4.309;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const Vec3 low(0.21 * i, 0.21 * j, 0);
      bodies.push_back(body_of(box_in(frame, Vec3::Zero(), low, low + Vec3::Constant(small))));
    }
  bodies.push_back(
      body_of(box_in(frame, Vec3::Zero(), Vec3(0, 0, small), Vec3(large, large, small + large))));
  Scene scene = scene_of(plane_trn(frame, 2, 40), ground_of(20), bodies, with_masses(true));
  scene.joint = ground_of(35);  // blocks that slide on the ground stick together
  EXPECT_NEAR(scene.blocks.mass[400] / scene.blocks.mass[0], 1e4, 10);
  const Course course = run(scene, 1);
  const double a = g * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
  const auto way = [&](int b) {
    return (course.state.motion[b].pose.position - scene.blocks.rest[b].position).norm();
  };
  for (int b = 0; b < 400; ++b) EXPECT_NEAR(way(b), 0.5 * a, 0.03 * 0.5 * a) << b;
  EXPECT_GE(course.steps_in_mass, 190);
  EXPECT_NEAR(way(400), 0.5 * a, 3e-3 * 0.5 * a);
  EXPECT_LT(course.deepest, 0.05 * small);
  EXPECT_EQ(course.state.counters.unconverged, 0);
}

/// A box of 0.42 x 0.38 x 0.34 m, turned at random, with its centre at `at`.
Body rock_at(const Vec3& at, Random& random) {
  const Quat turn(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                  random.uniform(-1, 1));
  const Vec3 half(0.21, 0.19, 0.17);
  return body_of(moved(box_in(slope_frame(0, 0), Vec3::Zero(), -half, half),
                       turn.normalized().toRotationMatrix(), Vec3::Zero(), at));
}

double lowest_corner(const Scene& scene, const State& state) {
  double lowest = 1e9;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const Pose& pose = state.motion[b].pose;
    for (const Vec3& v : vertices_of(scene.blocks.shapes, b))
      lowest = std::min(lowest, (pose.position + pose.attitude * v).z());
  }
  return lowest;
}

// A block of 4 m falls on 196 rocks that have just been dropped: no energy comes from nowhere in
// the mass. (It first touches them at rest, in the exact step, where the hit gains 0.7 %.)
TEST(MassStep, ABlockFallsOnManySmallOnes) {
  Random random(1, "rocks");
  std::vector<Body> bodies;
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 14; ++j)
      bodies.push_back(rock_at(Vec3(0.5 * (i - 6.5), 0.5 * (j - 6.5), 0.35), random));
  bodies.push_back(
      body_of(box_in(slope_frame(0, 0), Vec3::Zero(), Vec3(-2, -2, 2.7), Vec3(2, 2, 6.7))));
  const Scene scene =
      scene_of(plane_trn(slope_frame(0, 0), 2, 40), ground_of(30, 0.2), bodies, with_masses(true));
  State state = start(scene);
  Work work = make_work(scene);
  double last = mechanical(scene, state), gain = 0;
  const double before = last;
  int in_mass = 0;
  while (state.time < 2.5) {
    step(scene, state, work);
    if (n_in_mass(state) > 0) gain = std::max(gain, mechanical(scene, state) - last);
    last = mechanical(scene, state);
    in_mass += n_in_mass(state) > 150;
  }
  EXPECT_GT(in_mass, 20);
  EXPECT_LT(gain, 1e-3 * (before - last));
  EXPECT_NEAR(booked(state.ledger), before - last, 5e-3 * (before - last));
}

// 200 rocks are poured into a pit: they stay in it, and no energy comes from nowhere.
TEST(MassStep, RocksArePouredIntoAPit) {
  Random random(2, "rocks");
  std::vector<Body> bodies;
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        bodies.push_back(
            rock_at(Vec3(0.6 * (i - 2) + 0.05 * (k % 2), 0.6 * (j - 2), 0.4 + 0.6 * k), random));
  const auto height = [](double x, double y) {
    return std::max(0.0, 3 * (std::hypot(x, y) - 2.2));
  };
  const Scene scene =
      scene_of(make_trn(height, 0.25, 12), ground_of(30, 0.3), bodies, with_masses(true));
  const Course course = run(scene, 4);
  for (const Motion& m : course.state.motion)
    EXPECT_LT(std::hypot(m.pose.position.x(), m.pose.position.y()), 3);
  EXPECT_GT(course.steps_in_mass, 100);
  EXPECT_LT(std::abs(course.imbalance), 1e-6);
  EXPECT_LT(course.largest_gain, 1e-3);
  EXPECT_GT(lowest_corner(scene, course.state), -0.02);
}

// --- several parts a body ------------------------------------------------------------------------

// Angles of two boxes each, of which some lie in each other's arms, move as far as by the exact
// step.
TEST(MassStep, MovesBodiesOfSeveralParts) {
  double way[2];
  for (const bool masses : {false, true}) {
    const SlopeFrame frame = slope_frame(30, 30);
    std::vector<Body> bodies;
    for (int i = 0; i < 36; ++i) {
      const Vec3 at(1.55 * (i % 6), 1.05 * (i / 6), 0);
      const auto box = [&](const Vec3& low, const Vec3& high) {
        return box_in(frame, Vec3::Zero(), at + low, at + high);
      };
      const Vec3 velocity = (2 + 2 * (i % 3)) * frame.dip + (i % 2 - 0.5) * frame.strike;
      Body body = body_of(box(Vec3(0, 0, 0), Vec3(1.5, 1, 0.5)), velocity);
      body.parts.push_back(box(Vec3(0, 0, 0.5), Vec3(0.5, 1, 1.5)));
      bodies.push_back(body);
      bodies.push_back(body_of(box(Vec3(0.5, 0.1, 0.5), Vec3(1.4, 0.9, 1.2)), velocity));
    }
    const Scene scene =
        scene_of(plane_trn(frame, 4, 100), ground_of(20, 0.3), bodies, with_masses(masses));
    const Course course = run(scene, 1.5);
    EXPECT_EQ(course.steps_in_mass > 50, masses);
    EXPECT_LT(std::abs(course.imbalance), 1e-6);
    way[masses] = place_of(scene, course.state).way;
  }
  EXPECT_NEAR(way[1], way[0], 3e-3 * way[0]);
}

// --- simplifications -----------------------------------------------------------------------------

// Columns of four cubes that touch, dropped: hit by hit they lose nearly all of their energy; in a
// mass e acts once, and they rebound as one.
TEST(MassStep, ReboundsOnceWhereHitsInTurnLoseAll) {
  double kept[2];
  for (const bool masses : {false, true}) {
    Lattice lattice;
    lattice.dip_deg = 0;
    lattice.restitution = 0.7;
    lattice.velocity = Vec3(0, 0, -10);
    lattice.above = 0.2;
    Scene scene = scene_of_lattice(lattice, with_masses(masses));
    scene.gravity *= 1e-4;
    scene.joint = scene.ground.classes[0];
    const State first = start(scene);
    const double before = energies(scene, first).translation;
    const Course course = run(scene, 0.6, first);
    const Energies e = energies(scene, course.state);
    kept[masses] = (e.translation + e.rotation) / before;
  }
  EXPECT_LT(kept[0], 0.1);
  EXPECT_NEAR(kept[1], 0.7 * 0.7, 0.05);
}

// Small rocks that rain on each other at 9 m/s: a hit acts within a step, so that the substep, not
// the rebound, bounds how deep it leaves them.
TEST(MassStep, RainLeavesNothingDeep) {
  Random random(7, "rain");
  const Vec3 half(0.16, 0.13, 0.11);
  std::vector<Body> bodies;
  for (int layer = 0; layer < 6; ++layer)
    for (int i = 0; i < 36; ++i) {
      const Mat3 turn = Quat(random.normal(), random.normal(), random.normal(), random.normal())
                            .normalized()
                            .toRotationMatrix();
      const Vec3 at(0.5 * (i % 6) + 0.2 * (layer % 2), 0.5 * (i / 6), 0.3 + 0.6 * layer);
      const double falls = layer == 0 ? 0 : 9;
      bodies.push_back(
          body_of(moved(box(-half, half), turn, Vec3::Zero(), at), Vec3(0, 0, -falls)));
    }
  const Scene scene =
      scene_of(plane_trn(slope_frame(0, 0), 1, 40), ground_of(30, 0.3), bodies, with_masses(true));
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < 0.6) step(scene, state, work);
  EXPECT_GT(n_in_mass(state), 100);
  for (const DeepBlock& deep : state.deep) EXPECT_EQ(deep.steps, 0) << deep.depth;
}

}  // namespace
