// Run-out: reach of masses and events, energies, shown paths.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/random.hpp"
#include "post/runout/runout.hpp"
#include "post/runout/runout_runs.hpp"
#include "post/runout/runout_sensitivity.hpp"
#include "post/runout/runout_text.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

constexpr double deg = std::numbers::pi / 180;

// A cube of edge 2 that slides along (x, 0) down a plane of slope 0.5 with friction tan(phi) = 0.2
// on it, from x = 10 to the plane's end at x = 30, and then on the flat to where it stops.
RunFile sliding_block(double frame_interval) {
  RunFile run;
  add_box(run, {2, 2, 2}, {0, 0, 0});
  for (double x = 10; x <= 80 + 1e-9; x += frame_interval) {
    FrameBlock at = standing({x, 0, x < 30 ? 100 - 0.5 * x : 85});
    at.velocity = {x < 80 - 1e-9 ? 3.0 : 0, 0, 0};
    add_frame(run, x - 10, {at});
  }
  return run;
}

Trn bent_trn() {
  Trn trn = plane_trn(0.5, 2, 60, 3);
  trn.node0 = Vec2(0, 2);
  for (double& z : trn.elevation) z = std::max(z - 1, 84.0);  // a metre below the centroids
  return trn;
}

}  // namespace

TEST(ReachLine, OfAnLShapedWayTellsPathFromChord) {
  const std::vector<Vec3> path = {{0, 0, 30}, {30, 0, 10}, {30, 40, 0}};
  const ReachLine reach = reach_along(path);
  EXPECT_DOUBLE_EQ(reach.height, 30);
  EXPECT_DOUBLE_EQ(reach.path, 70);
  EXPECT_DOUBLE_EQ(reach.chord, 50);
  EXPECT_DOUBLE_EQ(reach.path_angle(), std::atan(30.0 / 70));
  EXPECT_DOUBLE_EQ(reach.chord_angle(), std::atan(30.0 / 50));
  EXPECT_TRUE(std::isnan(ReachLine{}.path_angle()));
}

// The straight slide: H, L and the angles are known to the last digit, whatever the frames.
TEST(EventReach, OfAStraightSlideIsExact) {
  for (const double interval : {0.5, 7.0}) {
    const EventReach event = event_reach(sliding_block(interval), bent_trn(), {});
    ASSERT_EQ(event.blocks.size(), 1U);
    EXPECT_NEAR(event.blocks[0].reach.height, 10, 1e-9);
    EXPECT_NEAR(event.blocks[0].reach.path, 70, 1e-9);
    EXPECT_NEAR(event.centre_of_mass.path_angle(), std::atan(10.0 / 70), 1e-12);
    EXPECT_NEAR(event.sum_angle, std::atan(10.0 / 70), 1e-12);
    EXPECT_DOUBLE_EQ(event.top.z(), 96);  // the cube's upper side
    EXPECT_DOUBLE_EQ(event.toe.x(), 81);
    EXPECT_DOUBLE_EQ(event.toe.z(), 84);  // on the ground
    EXPECT_NEAR(event.event.height, 12, 1e-9);
    EXPECT_EQ(event.toe_fate, Fate::deposited);
    EXPECT_EQ(event.blocks[0].fate, Fate::deposited);
    EXPECT_DOUBLE_EQ(event.blocks[0].max_speed, 3);
    EXPECT_DOUBLE_EQ(event.blocks[0].max_energy, 0.5 * 16000 * 9);
  }
}

// The first of 21 cubes stays, the k-th ends 10 k m away and k m lower, but the last runs to 400 m:
// 95 % of the twenty that moved are within 190 m.
TEST(MassReach, LeavesOutTheFewFarthestBlocks) {
  RunFile run;
  std::vector<FrameBlock> start, end;
  for (int block = 0; block < 21; ++block) {
    add_box(run, {2, 2, 2}, {0, 0, 100});
    start.push_back(standing({0, 0, 100}));
    const double way = block == 20 ? 400 : 10.0 * block;
    end.push_back(standing({way, 0, 100 - way / 10}));
  }
  add_frame(run, 0, start);
  add_frame(run, 1, end);
  const MassReach reach = mass_reach(run, displacements(run));
  // The top is a corner of a cube, a metre above and beside its centre, on either side.
  EXPECT_NEAR(reach.length, 190, 1.1);
  EXPECT_NEAR(reach.height, 1 + 19, 1e-9);
  EXPECT_EQ(reach.n_beyond, 1);
  EXPECT_NEAR(reach.beyond_share, 0.05, 1e-12);
  EXPECT_NEAR(reach.toe_share, 0.05, 1e-12);
  EXPECT_EQ(reach.n_outliers, 1);
  EXPECT_NEAR(reach.moved_volume, 20 * 8, 1e-9);
  EXPECT_NEAR(reach.angle(), std::atan(reach.height / reach.length), 1e-12);
}

// The top is that of the rock that moved: a mass that stays above it does not lengthen the run-out.
TEST(MassReach, BeginsAtTheTopOfWhatMoved) {
  RunFile run;
  add_box(run, {2, 2, 2}, {-300, 0, 300});
  add_box(run, {2, 2, 2}, {0, 0, 100});
  add_frame(run, 0, {standing({-300, 0, 300}), standing({0, 0, 100})});
  add_frame(run, 1, {standing({-300, 0, 300}), standing({50, 0, 80})});
  const MassReach reach = mass_reach(run, displacements(run));
  EXPECT_NEAR(reach.length, 50, 1.5);
  EXPECT_NEAR(reach.height, 21, 1e-9);
  EXPECT_EQ(reach.n_beyond, 0);
}

// Four of nine cubes in a square end beyond its sides, two of these outside a corner: the rest
// has not left the source. A cube of twice the mass in the middle counts twice.
TEST(MassReach, SaysHowMuchLeftTheSource) {
  RunFile run;
  std::vector<FrameBlock> start, end;
  for (int block = 0; block < 9; ++block) {
    const Vec3 at(10.0 * (block % 3), 10.0 * (block / 3), 100);
    add_box(run, {2, 2, block == 4 ? 4.0 : 2.0}, at);
    start.push_back(standing(at));
    end.push_back(standing(at + Vec3(block % 3 == 2 || block == 4 ? 12 : 5, 0, -5)));
  }
  add_frame(run, 0, start);
  add_frame(run, 1, end);
  EXPECT_NEAR(mass_reach(run, displacements(run)).left_share, 5.0 / 10, 1e-12);
}

TEST(MassReach, OfAMassThatStaysIsNone) {
  RunFile run;
  add_box(run, {2, 2, 2}, {0, 0, 100});
  add_frame(run, 0, {standing({0, 0, 100})});
  add_frame(run, 1, {standing({0.5, 0, 100})});
  EXPECT_TRUE(std::isnan(mass_reach(run, displacements(run)).length));
}

// The toe is where the deposit ends, not where the longest path ends.
TEST(EventReach, TakesTheFarthestBlockAsToe) {
  RunFile run;
  for (int block = 0; block < 2; ++block) add_box(run, {2, 2, 2}, {0, 0, 0});
  const std::vector<Vec3> round = {
      {10, 0, 95}, {20, 0, 95}, {20, 10, 95}, {10, 10, 95}, {10, 0, 95}};
  for (int k = 0; k < 5; ++k)
    add_frame(run, k, {standing(round[k]), standing({10 + 8.0 * k, 0, 90})});
  const EventReach event = event_reach(run, bent_trn(), {});
  EXPECT_GT(event.blocks[0].reach.path, event.blocks[1].reach.path);
  EXPECT_EQ(event.toe_block, 1);
}

// L must not stop at the last block at rest while another has gone on beyond it.
TEST(EventReach, GoesToTheFarthestBlockThoughItStillMoves) {
  RunFile run;
  for (int block = 0; block < 2; ++block) add_box(run, {2, 2, 2}, {0, 0, 0});
  add_frame(run, 0, {standing({10, 0, 95}), standing({12, 0, 95})});
  FrameBlock moving = standing({72, 0, 85});
  moving.velocity = {5, 0, 0};
  add_frame(run, 9, {standing({40, 0, 85}), moving});
  const EventReach event = event_reach(run, bent_trn(), {});
  EXPECT_EQ(event.toe_block, 1);
  EXPECT_EQ(event.toe_fate, Fate::moving);
  EXPECT_NEAR(event.event.chord, 73 - 9, 1e-9);  // the top is an edge of the first block
}

// A block that stayed low in the source is not the end of the run-out.
TEST(EventReach, DoesNotEndAtABlockThatStayed) {
  RunFile run;
  for (int block = 0; block < 2; ++block) add_box(run, {2, 2, 2}, {0, 0, 0});
  add_frame(run, 0, {standing({10, 0, 95}), standing({50, 0, 85})});
  add_frame(run, 9, {standing({40, 0, 85}), standing({50.5, 0, 85})});
  const EventReach event = event_reach(run, bent_trn(), {});
  EXPECT_EQ(event.toe_block, 0);
  EXPECT_DOUBLE_EQ(event.moved.share, 0.5);
}

// The length of a source is not a run-out.
TEST(EventReach, OfAMassThatStaysHasNoReach) {
  RunFile run;
  for (int block = 0; block < 2; ++block) add_box(run, {2, 2, 2}, {0, 0, 0});
  add_frame(run, 0, {standing({10, 0, 95}), standing({50, 0, 85})});
  add_frame(run, 9, {standing({10.9, 0, 94.8}), standing({50, 0, 85})});
  const EventReach event = event_reach(run, bent_trn(), {});
  EXPECT_FALSE(event.moved.any());
  EXPECT_EQ(event.toe_block, -1);
  EXPECT_TRUE(event.streamline.empty());
  for (const double value : {event.event.height, event.event.path, event.event.path_angle(),
                             event.centre_of_mass.path, event.sum_angle})
    EXPECT_TRUE(std::isnan(value));
}

// A path that flattens and then drops again: the angle at its end hides that a flatter energy line
// would have been needed before.
TEST(AngleProfile, SaysWhereItIsNotMonotone) {
  const std::vector<Vec3> falling = {{0, 0, 100}, {50, 0, 60}, {150, 0, 40}};
  EXPECT_TRUE(angle_profile(falling, 5, 0).monotone);
  const std::vector<Vec3> stepped = {{0, 0, 100}, {50, 0, 60}, {150, 0, 50}, {200, 0, 0}};
  const AngleProfile profile = angle_profile(stepped, 5, 24.9);
  EXPECT_FALSE(profile.monotone);
  EXPECT_DOUBLE_EQ(profile.smallest, std::atan(50.0 / 150));
  EXPECT_DOUBLE_EQ(profile.smallest_at, 150);
  EXPECT_DOUBLE_EQ(profile.angle.back(), std::atan(100.0 / 200));
  // the line from the start to the end runs at 100 - 150 / 2 = 25 over the ground at 50
  EXPECT_DOUBLE_EQ(profile.missing_head, 25);
  EXPECT_TRUE(angle_profile(stepped, 5, 25.1).monotone);
}

// The angle that an energy line needs is said where it matters, by a degree or more.
TEST(EnergyLineText, SaysWhichAngleToTakeWhereItMatters) {
  const std::vector<Vec3> stepped = {{0, 0, 100}, {50, 0, 60}, {150, 0, 50}, {200, 0, 0}};
  const std::string words = energy_line_text(angle_profile(stepped, 5, 0.5));
  EXPECT_NE(words.find("flattens at 150 m"), std::string::npos) << words;
  EXPECT_NE(words.find("reaches the toe with 18.4 deg"), std::string::npos) << words;
  const std::vector<Vec3> hardly = {{0, 0, 100}, {150, 0, 50}, {200, 0, 32}};
  EXPECT_FALSE(angle_profile(hardly, 5, 0.1).monotone);
  EXPECT_EQ(energy_line_text(angle_profile(hardly, 5, 0.1)), "");
  EXPECT_EQ(energy_line_text({}), "");
}

// lechtal_kotdam's expected path (data/SOURCES.md) is not monotone, the other three sites' are.
TEST(AngleProfile, OfTheSharedSitesPaths) {
  const std::string folder = std::string(TALUS_SHARED_DIR) + "/data/scenarios/";
  const std::map<std::string, bool> is_monotone = {{"gschnitz_gar", true},
                                                   {"lechtal_kotcliff", true},
                                                   {"lechtal_kotdam", false},
                                                   {"salisbury_crags", true}};
  for (const auto& [site, expected] : is_monotone) {
    std::ifstream file(folder + site + ".json");
    if (!file) GTEST_SKIP() << folder << " is absent";
    std::vector<Vec3> points;
    const nlohmann::json scenario = nlohmann::json::parse(file);
    for (const auto& p : scenario["path"]["points"]) points.emplace_back(p[0], p[1], p[2]);
    const AngleProfile profile = angle_profile(points, 0.1 * horizontal_length(points), 0.5);
    EXPECT_EQ(profile.monotone, expected) << site << ": " << profile.missing_head << " m";
  }
}

TEST(Simplified, LeavesNoPointFartherThanTheTolerance) {
  Random random(5);
  std::vector<Vec3> points;
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < 400; ++i) {
    at += Vec3(random.uniform(0, 1), random.normal() * 0.3, -random.uniform(0, 1));
    points.push_back(at);
  }
  for (const double tolerance : {0.1, 0.5, 2.0}) {
    const auto kept = simplified(std::span<const Vec3>(points), tolerance);
    EXPECT_EQ(kept.front(), 0);
    EXPECT_EQ(kept.back(), 399);
    for (std::size_t k = 1; k < kept.size(); ++k)
      for (int i = kept[k - 1]; i <= kept[k]; ++i) {
        const Vec3 a = points[kept[k - 1]], u = (points[kept[k]] - a);
        const double s = std::clamp((points[i] - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
        EXPECT_LE((points[i] - a - s * u).norm(), tolerance + 1e-12);
      }
  }
  EXPECT_LT(simplified(std::span<const Vec3>(points), 2.0).size(), 100U);
}

// Two blocks of masses 1 : 8; the centre of mass goes with the heavy one.
TEST(CentreOfMass, WeighsByMass) {
  RunFile run;
  add_box(run, {1, 1, 1}, {0, 0, 0});
  add_box(run, {2, 2, 2}, {0, 0, 0});
  add_frame(run, 0, {standing({0, 0, 0}), standing({0, 0, 0})});
  add_frame(run, 1, {standing({0, 0, 0}), standing({9, 0, -9})});
  const TimedPath path = centre_of_mass_path(run);
  EXPECT_TRUE(path.point[1].isApprox(Vec3(8, 0, -8)));
  const EventReach event = event_reach(run, bent_trn(), {});
  EXPECT_EQ(event.toe_block, 1);
  EXPECT_NEAR(event.sum_angle, 45 * deg, 1e-12);
}

TEST(Curves, HoldEnergiesAndTheFront) {
  RunFile run;
  add_box(run, {2, 2, 2}, {0, 0, 0});
  FrameBlock at = standing({3, 4, -2});
  at.velocity = {0, 3, 4};
  at.spin = {0, 0, 2};
  add_frame(run, 0, {standing({0, 0, 0})});
  add_frame(run, 1, {at});
  const auto rows = curves(run);
  EXPECT_DOUBLE_EQ(rows[1].front, 5);
  EXPECT_DOUBLE_EQ(rows[1].mean_speed, 5);
  EXPECT_DOUBLE_EQ(rows[1].translation, 0.5 * 16000 * 25);
  EXPECT_NEAR(rows[1].rotation, 0.5 * (16000.0 / 12 * 8) * 4, 1e-6);
}

TEST(EnergyShares, SumToOne) {
  RunFile run;
  HealthRow start, end;
  start.potential = 1000;
  end.potential = 200;
  end.friction = 500;
  end.impact = 200;
  end.contact = 40;
  end.fence = 20;
  end.translation = 30;
  end.rotation = 10;
  run.health = {start, end};
  const EnergyShares s = energy_shares(run);
  EXPECT_DOUBLE_EQ(s.put_in, 800);
  EXPECT_DOUBLE_EQ(s.friction, 0.625);
  EXPECT_DOUBLE_EQ(s.fence, 0.025);
  EXPECT_NEAR(s.unaccounted, 0, 1e-15);
}

TEST(EventReach, OfARunWithoutFramesHasNoAngle) {
  RunFile run;
  add_box(run, {1, 1, 1}, {0, 0, 0});
  const EventReach event = event_reach(run, bent_trn(), {});
  EXPECT_TRUE(std::isnan(event.event.path_angle()));
  EXPECT_EQ(event.toe_block, -1);
}

TEST(RunoutCases, AreEvaluatedByThemselves) {
  std::vector<RunoutRun> runs(3);
  for (int k = 0; k < 3; ++k) {
    runs[k].member.info.case_name = k == 1 ? "high" : "low";
    runs[k].mass = {1};
    runs[k].displacement = {k == 1 ? 0.0 : 30.0};
    runs[k].event.mass.length = 10 * k;
  }
  const std::vector<RunoutCase> cases = cases_of(runs);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "high");
  EXPECT_EQ(cases[0].moved.share, 0);
  EXPECT_EQ(cases[1].runs, (std::vector<int>{0, 2}));
  EXPECT_EQ(cases[1].moved.share, 1);
  const Spread spread =
      spread_over(runs, cases[1].runs, [](const RunoutRun& r) { return r.event.mass.length; });
  EXPECT_EQ(spread.n, 2u);
  EXPECT_EQ(spread.largest, 20);
  runs.erase(runs.begin() + 1);
  EXPECT_TRUE(cases_of(runs).empty());
}

// L = 300 - 5 friction + cor: 25 and 1 times the variances of the two (uniform, width 4 and 0.4).
// Ground and key say the same of friction; a quantity that never changes says nothing.
TEST(Sensitivity, OfRunsSaysWhatEachQuantityExplains) {
  std::vector<RunoutRun> runs(400);
  talus::Random random(3);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double friction = random.uniform(26, 30), cor = random.uniform(0.1, 0.5);
    RunoutRun& run = runs[i];
    run.drawn = {{"sample", static_cast<double>(i + 1)},
                 {"rock_mass", static_cast<double>(i % 4)},
                 {"ground.slope.friction_deg", friction},
                 {"ground.slope.cor", cor},
                 {"solver.duration_s", 20},
                 {"friction_deg.slope", friction}};
    run.event.moved.largest = 50;
    run.event.event.path = 300 - 5 * friction + cor;
    run.lines = {{"road", cor, 1e3 * friction}};
  }
  const std::vector<SensitivityRow> rows = sensitivity_of(runs);
  std::map<std::string, SensitivityRow> of;
  for (const SensitivityRow& row : rows) of[row.result + " " + row.quantity] = row;
  ASSERT_EQ(of.count("L_path_m ground.slope.friction_deg"), 1U);
  EXPECT_NEAR(of["L_path_m ground.slope.friction_deg"].rank_correlation, -1, 0.01);
  EXPECT_NEAR(of["L_path_m ground.slope.friction_deg"].first_order, 1, 0.03);
  EXPECT_NEAR(of["L_path_m ground.slope.cor"].first_order, 0, 0.15);
  EXPECT_NEAR(of["crossed.road ground.slope.cor"].rank_correlation, 1, 1e-12);
  EXPECT_NEAR(of["energy_kj.road ground.slope.friction_deg"].rank_correlation, 1, 1e-12);
  EXPECT_TRUE(std::isnan(of["L_path_m rock_mass"].rank_correlation));
  EXPECT_NEAR(of["L_path_m rock_mass"].first_order, 0, 0.15);
  EXPECT_EQ(of.count("L_path_m friction_deg.slope"), 0U);
  EXPECT_EQ(of.count("L_path_m solver.duration_s"), 0U);
  EXPECT_EQ(of.count("L_path_m sample"), 0U);
  runs.resize(199);
  for (const SensitivityRow& row : sensitivity_of(runs)) {
    EXPECT_TRUE(std::isnan(row.first_order));
    EXPECT_EQ(row.n, 199);
  }
}

// Of four runs one did not move, one lost a stone, two are events of weight 1 and 0.5.
TEST(RunoutRuns, AreEventsWhereATenthOfTheMassMoved) {
  std::vector<RunoutRun> runs(4);
  const std::vector<double> share = {0, 0.02, 0.1, 0.9}, length = {std::nan(""), 70, 100, 130};
  const std::vector<double> weight = {1.5, 1, 1, 0.5};
  for (int k = 0; k < 4; ++k) {
    runs[k].member.run_weight = weight[k];
    runs[k].member.info.status = "done";
    runs[k].event.moved.share = share[k];
    runs[k].event.moved.largest = share[k] > 0 ? 50 : 0;
    runs[k].event.mass.length = length[k];
  }
  const std::vector<int> events = events_among(runs, all_of(runs));
  EXPECT_EQ(events, (std::vector<int>{2, 3}));
  EXPECT_DOUBLE_EQ(event_probability(runs, all_of(runs)), 1.5 / 4);
  const auto of_mass = [](const RunoutRun& r) { return r.event.mass.length; };
  const Spread given_an_event = spread_over(runs, events, of_mass);
  EXPECT_DOUBLE_EQ(given_an_event.mean, (100 + 0.5 * 130) / 1.5);
  EXPECT_EQ(given_an_event.smallest, 100);
  EXPECT_EQ(spread_over(runs, of_mass).smallest, 70);
  EXPECT_EQ(standing_runs(runs),
            "1 of 4 runs did not move (no block by more than 1 m), and 1 of 4 runs moved less than "
            "10 % of the mass");
}

// A rock thrown five times at a plane: the path is straight in plan and lower than the tolerance in
// height, but each bounce is there, with its height and the energy taken by the impact.
TEST(ShownPath, KeepsEachBounceWithItsHeight) {
  RunFile run;
  add_box(run, {0.2, 0.2, 0.2}, {0, 0, 0});
  constexpr double g = 9.81, up = 2, flight = 2 * up / g;
  int frames = 0;
  for (double t = 0; t < 5 * flight; t += 0.02, ++frames) {
    const double since = std::fmod(t, flight);
    FrameBlock at = standing({40 + 3 * t, 0, 85 + up * since - 0.5 * g * since * since});
    at.velocity = {3, 0, up - g * since};
    at.spin = {0, 4, 0};
    add_frame(run, t, {at});
  }
  const TimedPath path = shown_path(run, 0, bent_trn(), 0.5);
  EXPECT_EQ(std::count(path.is_impact.begin(), path.is_impact.end(), true), 4);
  EXPECT_LT(path.point.size(), 18U);
  double highest = 0;
  for (std::size_t i = 0; i < path.point.size(); ++i) {
    EXPECT_NEAR(path.height[i], path.point[i].z() - 84, 1e-9);
    EXPECT_EQ(path.spin[i], 4);
    EXPECT_GE(path.energy[i], 0.5 * run.blocks.mass[0] * path.speed[i] * path.speed[i]);
    highest = std::max(highest, path.height[i]);
  }
  EXPECT_NEAR(highest, 1 + up * up / (2 * g), 1e-3);
  EXPECT_LE(simplified(block_path(run, 0), 0.5).point.size(), 3U);  // lengths stay as they were
}

// Sliding to a stop in one frame of a second is not an impact; a wall is.
TEST(ShownPath, HasNoImpactInASlide) {
  EXPECT_EQ(block_path(sliding_block(1), 0).is_impact, std::vector<bool>(71, false));
  RunFile run = sliding_block(0.1);
  const auto path = block_path(run, 0);
  EXPECT_EQ(std::count(path.is_impact.begin(), path.is_impact.end(), true), 1);
  EXPECT_TRUE(path.is_impact.back());
}
