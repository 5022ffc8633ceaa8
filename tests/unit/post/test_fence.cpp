// Verdicts on blocks at fences, arrivals, storage, design checks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"
#include "post/fence/fence.hpp"
#include "post/fence/fence_design.hpp"
#include "post/fence/fence_result.hpp"
#include "post/fence/fence_summary.hpp"
#include "post/statistics.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

// A flat terrain at z = 100, a fence along x = 20 from y = 10 to y = 40, 4 m high; blocks come from
// the west (from the left of the line drawn from south to north).
Trn flat() { return plane_trn(0, 2, 40, 30); }

FenceSettings fence_settings() {
  FenceSettings settings;
  settings.name = "test";
  settings.height_m = 4;
  settings.capacity_kj = 500;
  return settings;
}

Fence fence_along(const std::vector<Vec2>& corners, const Trn& trn, double spacing = 10) {
  return make_fence(record_line("test", posts_on_ground(trn, corners, spacing, {"site.toml"})),
                    fence_settings());
}

Fence straight_fence() { return fence_along({{20, 10}, {20, 40}}, flat()); }

// Adds a cube of edge `edge` that crosses the line at `chainage` with the centroid at `height`.
void add_crossing(RunFile& run, double chainage, double height, double edge, double energy,
                  double time = 1) {
  const int block = n_blocks(run);
  add_box(run, {edge, edge, edge}, {0, 0, 0});
  Crossing c;
  c.block = block;
  c.direction = -1;  // eastwards: to the right of a line that runs north
  c.beside = chainage < 0 || chainage > 30;
  c.n_crossings = c.beside ? 0 : 1;
  c.time = time;
  c.chainage = chainage;
  c.position = {20, 10 + chainage, 100 + height};
  c.velocity = {10, 0, 0};
  c.translational_energy = energy;
  c.centroid_height = height;
  c.top_height = height + edge / 2;
  c.bottom_height = height - edge / 2;
  run.crossings.push_back(c);
}

// A touch of a panel by a block that comes at 10 m/s, 1 m high.
void add_touch(RunFile& run, int block, int panel, double chainage, double time, double energy) {
  FenceHit hit;
  hit.block = block;
  hit.panel = panel;
  hit.chainage = chainage;
  hit.time = time;
  hit.velocity = {10, 0, 0};
  hit.translational_energy = energy;
  hit.top_height = 1;
  run.fence_hits.push_back(hit);
}

Verdict verdict_of_single(double chainage, double height, double edge, double energy) {
  RunFile run;
  add_crossing(run, chainage, height, edge, energy);
  const Fence fence = straight_fence();
  const auto list = arrivals(run, 0, fence, 0);
  return verdicts_of(run, 0, 0, list, fence, 0.5, false, 0.1).at(0).verdict;
}

}  // namespace

TEST(PostsOnGround, StandAtEqualDistances) {
  const Fence fence = fence_along({{20, 10}, {20, 40}, {25, 40}}, plane_trn(0.5, 2, 40, 30), 8);
  ASSERT_EQ(fence.post.size(), 6U);  // 30 m in 4 fields, 5 m in 1
  EXPECT_DOUBLE_EQ(fence.chainage[1], 7.5);
  EXPECT_DOUBLE_EQ(fence.chainage[5], 35);
  EXPECT_DOUBLE_EQ(fence.post[5].z(), 100 - 12.5);
  EXPECT_DOUBLE_EQ(base_at(fence, 32.5), 100 - 11.25);
}

TEST(PostsOnGround, RefuseWhatIsNoFence) {
  const Trn trn = flat();
  using Corners = std::vector<Vec2>;
  for (const Corners& corners :
       {Corners{{20, 10}}, Corners{{20, 10}, {20, 10}}, Corners{{20, 10}, {20, 500}}})
    EXPECT_THROW(static_cast<void>(posts_on_ground(trn, corners, 10, {"site.toml"})), InputError);
}

// One block of each kind at a fence of 4 m and 500 kJ, free border 0.5 m.
TEST(ExpectedVerdict, IsTheRightOneForEachKind) {
  EXPECT_EQ(verdict_of_single(15, 1, 1, 400e3), Verdict::stopped);
  EXPECT_EQ(verdict_of_single(15, 1, 1, 501e3), Verdict::pierced);
  EXPECT_EQ(verdict_of_single(15, 3.1, 1, 400e3), Verdict::free_border);  // top 3.6 m
  EXPECT_EQ(verdict_of_single(15, 4.2, 1, 400e3), Verdict::free_border);  // the rope is hit
  EXPECT_EQ(verdict_of_single(15, 4.6, 1, 400e3), Verdict::overtopped);
  EXPECT_EQ(verdict_of_single(15, 4.6, 1, 900e3), Verdict::overtopped);
  EXPECT_EQ(verdict_of_single(15, -1, 1, 400e3), Verdict::underpassed);
  // eastwards at a line that runs north: its first (southern) end is on the right
  EXPECT_EQ(verdict_of_single(-3, 1, 1, 400e3), Verdict::bypassed_right);
  EXPECT_EQ(verdict_of_single(33, 1, 1, 400e3), Verdict::bypassed_left);
}

TEST(Verdicts, AreExactlyOneABlock) {
  Random random(1);
  RunFile run;
  for (int i = 0; i < 200; ++i) {
    if (random.below(4) == 0)
      add_box(run, {1, 1, 1}, {0, 0, 0});  // never comes
    else
      add_crossing(run, random.uniform(-10, 40), random.uniform(-2, 7), random.uniform(0.5, 3),
                   random.uniform(0, 1e6));
  }
  const Fence fence = straight_fence();
  const auto list = arrivals(run, 0, fence, 0);
  std::map<Verdict, int> count;
  for (const BlockVerdict& v : verdicts_of(run, 0, 0, list, fence, 0.5, false, 0.1)) {
    ++count[v.verdict];
    EXPECT_EQ(v.verdict == Verdict::not_reached, v.arrival < 0);
  }
  int sum = 0;
  for (const auto& [verdict, n] : count) sum += n;
  EXPECT_EQ(sum, 200);
  EXPECT_EQ(count.size(), verdicts.size());
}

// A dip between two posts: a block that rolls through it below the straight base passes underneath.
TEST(ExpectedVerdict, SeesTheDipBetweenTwoPosts) {
  Trn trn = flat();
  for (int c = 0; c < trn.n_cols; ++c)
    trn.elevation[node_index(trn, trn.n_rows - 1 - 7, c)] = 95;  // y = 14
  const Fence fence = fence_along({{20, 10}, {20, 20}}, trn);
  RunFile run;
  add_crossing(run, 4, -4, 2, 1e3);  // on the bottom of the dip
  EXPECT_EQ(expected_verdict(arrivals(run, 0, fence, 0)[0], fence, 0.5), Verdict::underpassed);
}

// With an active fence, blocks that did not cross but lie at it were stopped.
TEST(ObservedVerdict, TellsStoppedFromNotReached) {
  RunFile run;
  add_box(run, {2, 2, 2}, {0, 0, 0});
  add_box(run, {2, 2, 2}, {0, 0, 0});
  add_frame(run, 0, {standing({5, 20, 101}), standing({5, 30, 101})});
  add_frame(run, 1, {standing({18.95, 20, 101}), standing({12, 30, 101})});
  const Fence fence = straight_fence();
  add_crossing(run, 5, 1, 1, 1e3);  // came through
  add_crossing(run, 5, 6, 1, 1e3);  // over the top
  run.frames = {};
  add_frame(run, 1,
            {standing({18.95, 20, 101}), standing({12, 30, 101}), standing({40, 15, 101}),
             standing({40, 15, 101})});
  const auto list = verdicts_of(run, 0, 0, arrivals(run, 0, fence, 0), fence, 0.5, true, 0.1);
  EXPECT_EQ(list[0].verdict, Verdict::stopped);
  EXPECT_EQ(list[1].verdict, Verdict::not_reached);
  EXPECT_EQ(list[2].verdict, Verdict::pierced);
  EXPECT_EQ(list[3].verdict, Verdict::overtopped);
}

TEST(Arrivals, MeasureTheAngleToTheFieldsNormal) {
  RunFile run;
  add_crossing(run, 5, 1, 1, 1e3);
  run.crossings[0].velocity = {1, std::sqrt(3.0), -7};
  const FenceArrival a = arrivals(run, 0, straight_fence(), 0)[0];
  EXPECT_NEAR(a.angle, 60 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(a.field, 0);
  EXPECT_EQ(a.post, 0);  // 5 m from both: the first
}

// Reference: the percentile of the plain sorted list and the Wilks ranks.
TEST(Summarise, GivesPercentilesWithBoundsOfIndependentRuns) {
  Random random(2);
  std::vector<FenceArrival> list;
  std::vector<double> energies;
  for (int run = 0; run < 120; ++run) {
    FenceArrival a;
    a.run = run;
    a.translation = std::floor(random.uniform(0, 1e6));
    a.rotation = 1000;
    energies.push_back(a.energy());
    list.push_back(a);
  }
  std::sort(energies.begin(), energies.end());
  const FencePartSummary s = summarise(list, clusters_of_runs(std::vector<double>(150, 1), 1));
  EXPECT_EQ(s.n, 120);
  EXPECT_DOUBLE_EQ(s.per_run, 0.8);
  EXPECT_EQ(s.energy.largest, energies.back());
  EXPECT_EQ(s.energy.percentile[2].value, energies[113]);  // rank ceil(0.95 * 120) = 114
  EXPECT_EQ(s.energy.percentile[2].upper, energies[upper_bound_rank(120, 0.95) - 1]);
  EXPECT_TRUE(std::isnan(s.energy.percentile[3].value));  // 120 < 299
  EXPECT_TRUE(std::isnan(s.energy.percentile[3].upper));
  EXPECT_EQ(s.most_in_a_run, 1);
  EXPECT_EQ(s.runs_hit_twice, 0);
}

// Hits at 0, 0.4, 0.9, 1.3, 5 s: the busiest second holds those at 0.4, 0.9 and 1.3 s.
TEST(Summarise, AddsUpTheHitsOfOneSecond) {
  RunFile run;
  const std::vector<double> times = {0.9, 0, 5, 0.4, 1.3},
                            energies = {40e3, 10e3, 70e3, 20e3, 30e3};
  for (int i = 0; i < 5; ++i) add_crossing(run, 5, 1, 1, energies[i], times[i]);
  const FencePartSummary s =
      summarise(arrivals(run, 0, straight_fence(), 0), clusters_of_runs({5}, 5));
  EXPECT_DOUBLE_EQ(s.window_energy, 90e3);
  EXPECT_EQ(s.window_hits, 3);
  EXPECT_EQ(s.most_in_a_run, 5);
  EXPECT_EQ(s.runs_hit_twice, 1);
}

// Before the first touch the fence has taken nothing; the crossing has the energy left by a panel
// that yields.
TEST(Arrivals, OfAStandingFenceAreFirstTouches) {
  RunFile run;
  add_crossing(run, 12, 1, 1, 20e3, 3.5);  // touched, then crossed in the bulge
  add_crossing(run, 25, 1, 1, 70e3);       // through a gap
  add_box(run, {1, 1, 1}, {0, 0, 0});      // touched, did not cross
  add_touch(run, 0, 1, 12, 3, 50e3);
  add_touch(run, 0, 0, 8, 2, 100e3);
  add_touch(run, 2, 2, 21, 4, 80e3);
  const Fence fence = straight_fence();
  const auto list = arrivals(run, 0, fence, 0);
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].energy(), 100e3);
  EXPECT_EQ(list[0].time, 2);
  EXPECT_EQ(list[0].field, 0);
  EXPECT_EQ(list[0].post, 1);
  EXPECT_EQ(list[0].direction, -1);
  EXPECT_NEAR(list[0].speed, 10, 1e-12);
  EXPECT_TRUE(list[0].by_touch);
  EXPECT_EQ(list[1].energy(), 70e3);
  EXPECT_FALSE(list[1].by_touch);
  EXPECT_EQ(list[2].energy(), 80e3);
  EXPECT_EQ(line_crossings(run, 0, fence, 0).size(), 2U);
}

TEST(TouchedVerdict, FollowsTheRecordOfHits) {
  constexpr double never = FenceTouch::never;
  const Fence fence = straight_fence();
  FenceArrival through;
  through.time = 4;
  through.bottom = 0;
  through.top = 1;
  const auto verdict = [&](double touched, double gap_since, bool held,
                           const FenceArrival* crossing) {
    return touched_verdict({touched, gap_since, held}, crossing, fence, 0.5);
  };
  EXPECT_EQ(verdict(never, never, false, nullptr), Verdict::not_reached);
  EXPECT_EQ(verdict(3, never, false, nullptr), Verdict::stopped);
  EXPECT_EQ(verdict(3, never, true, &through), Verdict::stopped);
  EXPECT_EQ(verdict(3, 3.9, false, &through), Verdict::pierced);
  EXPECT_EQ(verdict(3, 4.1, false, &through), Verdict::pierced);  // it broke under the block
  EXPECT_EQ(verdict(never, never, false, &through), Verdict::pierced);
  EXPECT_EQ(verdict(3, never, false, &through), Verdict::pierced);  // between two panels
  through.top = fence.height - 0.1;
  EXPECT_EQ(verdict(3, never, false, &through), Verdict::free_border);
  EXPECT_EQ(verdict(3, never, true, &through), Verdict::stopped);
  through.top = fence.height + 3;
  through.bottom = fence.height + 1;
  EXPECT_EQ(verdict(3, never, false, &through), Verdict::overtopped);
}

// A block that slides along the fence and round its end has passed it; one that comes round a wing
// turned uphill has not.
TEST(TouchedVerdict, TellsWhoPassesTheEndFromWhoComesRoundIt) {
  const Fence fence = straight_fence();
  FenceArrival beside;
  beside.time = 4;
  beside.beside = true;
  beside.chainage = 33;
  beside.direction = -1;
  const auto verdict = [&](double touched) {
    return touched_verdict({touched, FenceTouch::never, false}, &beside, fence, 0.5);
  };
  EXPECT_EQ(verdict(3), Verdict::bypassed_left);
  EXPECT_EQ(verdict(FenceTouch::never), Verdict::bypassed_left);
  EXPECT_EQ(verdict(5), Verdict::stopped);
}

// Panels 0 to 2 of 10 m; 0 holds, pushed 3 m to the right, 1 broke at 5 s, 2 holds unmoved.
TEST(Touches, KnowWhoHangsInAPanelThatGaveWay) {
  RunFile run;
  const auto add = [&run](double chainage, double end_x, double end_y) {
    add_crossing(run, chainage, 1, 1, 1e3, 4);
    run.blocks.rest.back().position = {end_x, end_y, 100};
  };
  add(5, 22.5, 15);   // in the bulge
  add(5, 60, 15);     // far below it
  add(15, 21, 25);    // lies where the panel broke
  add(11, 21, 20.5);  // before the broken panel, but it hangs in panel 0
  add(25, 20.5, 35);  // behind the panel that did not move
  add_touch(run, 0, 0, 5, 3, 1e3);
  add_touch(run, 1, 0, 5, 3, 1e3);
  add_touch(run, 3, 0, 9, 3, 1e3);
  run.panels = {{0, 0, 1e5, 0, -3, FenceTouch::never, -1},
                {0, 1, 1e5, 1e5, -4, 5, 1},
                {0, 2, 1e5, 0, 0, FenceTouch::never, -1},
                {1, 0, 1e5, 0, 0, 2, 0}};
  const Fence fence = straight_fence();
  const auto touch = touches(run, 0, fence, line_crossings(run, 0, fence, 0));
  EXPECT_EQ(touch[0].time, 3);
  EXPECT_EQ(touch[2].time, FenceTouch::never);
  EXPECT_EQ(touch[0].gap_since, FenceTouch::never);
  EXPECT_EQ(touch[2].gap_since, 5);
  const std::vector<bool> held = {true, false, false, true, false};
  for (int block = 0; block < 5; ++block) EXPECT_EQ(touch[block].held, held[block]) << block;
}

// Rocks that fell one by one: a panel that one broke is whole for the next, and holds only the rock
// that pushed it.
TEST(Touches, OfRocksThatFellOneByOneKnowTheirOwnPanels) {
  RunFile run;
  run.info.independent = true;
  for (int rock = 0; rock < 3; ++rock) {
    add_crossing(run, 5, 1, 1, 1e3, 4);
    run.blocks.rest.back().position = {22.5, 15, 100};  // 2.5 m beyond the line
    add_touch(run, rock, 0, 5, 3, 1e3);
  }
  run.panels = {{0, 0, 1e5, 0, 0, FenceTouch::never, -1},
                {0, 0, 1e5, 1e5, -4, 3.5, 0, 0},
                {0, 0, 1e5, 0, -3, FenceTouch::never, -1, 1}};
  const Fence fence = straight_fence();
  const auto touch = touches(run, 0, fence, line_crossings(run, 0, fence, 0));
  const double gap_since[] = {3.5, FenceTouch::never, FenceTouch::never};
  const bool held[] = {false, true, false};
  for (int rock = 0; rock < 3; ++rock) {
    EXPECT_EQ(touch[rock].gap_since, gap_since[rock]) << rock;
    EXPECT_EQ(touch[rock].held, held[rock]) << rock;
  }
}

// On a slope of 0.5 that falls to the east, filled to 4 m: a triangle of 4 m by 8 m behind a fence
// of 10 m a field.
TEST(Storage, OfAPlaneIsTheWedge) {
  const Trn trn = plane_trn(0.5, 1, 80, 60);
  const Fence fence = fence_along({{40, 10}, {40, 40}}, trn);
  EXPECT_NEAR(storage(fence, 1, 1, trn, 100), 0.5 * 4 * 8 * 10, 1e-9);
  EXPECT_EQ(uphill_side(fence, trn), 1);
  EXPECT_EQ(uphill_side(fence, plane_trn(-0.5, 1, 80, 60)), -1);
}

TEST(DesignCode, OfUniMultipliesSpeedPercentileAndDesignMass) {
  const DesignCode code = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/uni_11211-4.csv"));
  const auto classes =
      barrier_classes(read_csv(TALUS_SOURCE_DIR "/share/codes/barrier_classes.csv"));
  FencePartSummary part;
  part.n = 100;
  part.n_eff = 100;
  part.speed.percentile[2].value = 20;
  part.top.percentile[2].value = 2;
  const DesignInput input{1, 0.8, 2700, 2, false, 4, 30};
  const Fence fence = straight_fence();
  const DesignResult r = check_design(code, classes, input, part, fence);
  const double mass = 2700 * 1.10, speed = 20 * 1.10 * 1.10;
  EXPECT_NEAR(r.design_energy, 0.5 * mass * speed * speed * 1.05, 1e-6);
  EXPECT_NEAR(r.required_capacity, 1.2 * r.design_energy, 1e-6);
  EXPECT_EQ(r.smallest_class, "4");  // 1,096 kJ: MEL 1,500
  EXPECT_NEAR(r.required_height, 2 * 1.21 + 0.5, 1e-12);
  EXPECT_EQ(r.governs, "energy");
  EXPECT_EQ(r.verdict, DesignVerdict::does_not_meet);
  EXPECT_EQ(text(r),
            "does not meet the code, energy governs: needs 1,100 kJ (ETAG class 4) and a height of "
            "2.92 m");
}

namespace {

FencePartSummary hundred_arrivals() {
  FencePartSummary part;
  part.n = 100;
  part.n_eff = 100;
  part.speed.percentile[2].value = 20;
  part.energy.percentile[3].value = 300e3;
  part.energy.largest = 310e3;
  part.top.percentile[2].value = 2;
  return part;
}

DesignCode uni() { return design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/uni_11211-4.csv")); }

const DesignStep& step(const DesignResult& result, const std::string& symbol) {
  const auto at = std::find_if(result.steps.begin(), result.steps.end(),
                               [&](const DesignStep& s) { return s.symbol == symbol; });
  if (at == result.steps.end()) throw std::runtime_error("no step " + symbol);
  return *at;
}

}  // namespace

// A reader of the derivation can compute the need from its lines.
TEST(DesignSteps, OfUniMultiplyToWhatIsNeeded) {
  DesignInput input{1.5, 0.8, 2700, 2, false, NAN, NAN};
  input.block_source = "95th percentile of the 100 blocks that arrive";
  const DesignResult r = check_design(uni(), {}, input, hundred_arrivals(), straight_fence());
  const auto value = [&](const char* symbol) { return step(r, symbol).value; };
  EXPECT_DOUBLE_EQ(value("V"), 1.5);
  EXPECT_EQ(step(r, "V").source, "95th percentile of the 100 blocks that arrive");
  EXPECT_NEAR(value("m_d"), value("V") * value("rho") * value("g_V") * value("g_rho") / 1e3, 1e-9);
  EXPECT_NEAR(value("v_d"), value("v_p") * value("g_t") * value("g_s"), 1e-12);
  EXPECT_NEAR(value("E_d"), 0.5 * value("m_d") * value("v_d") * value("v_d") * value("g_R"), 1e-9);
  EXPECT_NEAR(value("E_req"), value("E_d") * value("g_E"), 1e-9);
  EXPECT_NEAR(value("E_req"), r.required_capacity / 1e3, 1e-9);
  EXPECT_NEAR(value("h_req"), value("h_p") * value("g_t") * value("g_s") + value("f_min"), 1e-12);
  EXPECT_DOUBLE_EQ(value("E"), 500);
  EXPECT_EQ(step(r, "v_p").source, "of 100 arrivals");
  EXPECT_NE(step(r, "g_R").source.find("gamma_risk: 1.00 to 1.10"), std::string::npos);
  EXPECT_NE(step(r, "g_R").source.find("not checked against the print"), std::string::npos);
  EXPECT_EQ(step(r, "g_t").source.find("not checked"), std::string::npos);
}

TEST(DesignSteps, OfOnrMultiplyToWhatIsNeeded) {
  FencePartSummary part = hundred_arrivals();
  const DesignCode onr = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/onr_24810.csv"));
  const DesignResult r =
      check_design(onr, {}, {1, 0.8, 2700, 3, false, NAN, NAN}, part, straight_fence());
  EXPECT_DOUBLE_EQ(step(r, "E_k").value, 310);  // 100 arrivals give no 99th percentile
  EXPECT_EQ(step(r, "E_k").source, "of 100 arrivals; the 99th percentile needs 299");
  EXPECT_NEAR(step(r, "E_d").value, step(r, "E_k").value * step(r, "g_E").value, 1e-9);
  EXPECT_NEAR(step(r, "E_d").value, r.required_capacity / 1e3, 1e-9);
}

// Beyond the largest class no net will do, and the largest class of the table is named.
TEST(CheckDesign, NamesNoClassAboveTheLargest) {
  const auto classes =
      barrier_classes(read_csv(TALUS_SOURCE_DIR "/share/codes/barrier_classes.csv"));
  const DesignInput input{60, 0.8, 2700, 2, false, NAN, NAN};
  const DesignResult r = check_design(uni(), classes, input, hundred_arrivals(), straight_fence());
  EXPECT_EQ(r.smallest_class, "none");
  EXPECT_NE(text(r).find("(no ETAG class: above the largest, 4,500 kJ; a net is not an option)"),
            std::string::npos)
      << text(r);
}

// Impacts on an active fence may condemn it, but never pass it.
TEST(CheckDesign, PassesNothingByFirstTouches) {
  DesignInput input{1, 0.8, 2700, 2, false, NAN, NAN};
  Fence fence = straight_fence();
  fence.capacity = 2e6;
  EXPECT_EQ(check_design(uni(), {}, input, hundred_arrivals(), fence).verdict,
            DesignVerdict::meets);
  input.first_touches = true;
  const DesignResult r = check_design(uni(), {}, input, hundred_arrivals(), fence);
  EXPECT_EQ(r.verdict, DesignVerdict::first_touches);
  EXPECT_FALSE(passes(r).has_value());
  EXPECT_EQ(text(r).find("not judged: first touches"), 0U);
  fence.capacity = 5e5;
  EXPECT_EQ(check_design(uni(), {}, input, hundred_arrivals(), fence).verdict,
            DesignVerdict::does_not_meet);
}

// Sixty cubes of 1 m3 cross the line; seven of 1,000 m3 stay where they are and ask for nothing.
TEST(FenceResult, TakesTheDesignBlockFromTheBlocksThatArrive) {
  const Trn trn = flat();
  FenceCase fence{fence_settings(), {}, straight_fence()};
  fence.line = record_line("test", fence.fence.post);
  RunFile run;
  for (int block = 0; block < 60; ++block) add_crossing(run, 15, 1, 1, 50e3, block);
  for (int block = 0; block < 7; ++block) add_box(run, {10, 10, 10}, {0, 0, 0});
  run.lines = {fence.line};
  FenceRuns runs;
  runs.with.members = {member_of("run_1.h5", run)};
  runs.with.clusters = clusters_of(runs.with.members);
  runs.with.runs = {run_at_fences(run, 0, {fence}, {0}, uni(), {0.5, 0.05}, trn)};
  FenceResultSettings settings;
  settings.design.block_volume = settings.design.deflection = settings.design.distance_to_object =
      NAN;
  FenceResult r = fence_result(fence, 0, runs, uni(), {}, settings, trn);
  EXPECT_EQ(r.basis, DesignBasis::open_line);
  EXPECT_NEAR(step(r.design, "V").value, 1, 1e-12);
  EXPECT_EQ(step(r.design, "V").source, "95th percentile of the 60 blocks that arrive");
  settings.design.block_volume = 1000;
  r = fence_result(fence, 0, runs, uni(), {}, settings, trn);
  EXPECT_EQ(step(r.design, "V").value, 1000);
}

TEST(CheckDesign, OfAFenceThatNothingCameToSaysSo) {
  const DesignResult r = check_design(uni(), {}, {}, {}, straight_fence());
  EXPECT_EQ(r.verdict, DesignVerdict::nothing_came);
  EXPECT_EQ(text(r), "not judged: nothing came to it");
  EXPECT_FALSE(passes(r).has_value());
}

// Without a capacity the energy stays open, whatever else holds; a height that fails, fails.
TEST(CheckDesign, LeavesTheEnergyOfAFenceWithoutCapacityOpen) {
  const DesignCode code = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/uni_11211-4.csv"));
  FencePartSummary part;
  part.n = 100;
  part.n_eff = 100;
  part.speed.percentile[2].value = 20;
  part.top.percentile[2].value = 2;
  DesignInput input{1, 0.8, 2700, 2, false, NAN, NAN};
  Fence fence = straight_fence();
  fence.capacity = NAN;
  DesignResult r = check_design(code, {}, input, part, fence);
  EXPECT_EQ(r.verdict, DesignVerdict::energy_unknown);
  EXPECT_EQ(r.governs, "");
  input.free_border = 3;
  r = check_design(code, {}, input, part, fence);
  EXPECT_NEAR(r.required_height, 2 * 1.21 + 3, 1e-12);
  EXPECT_EQ(r.free_border, 3);
  EXPECT_EQ(r.verdict, DesignVerdict::does_not_meet);
  fence.capacity = 2e6;
  input.free_border = NAN;
  EXPECT_EQ(check_design(code, {}, input, part, fence).verdict, DesignVerdict::meets);
}

TEST(DesignCode, OfOnrTakesFactorsOfItsConsequenceClassAndTheDeflectionRule) {
  const DesignCode code = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/onr_24810.csv"));
  FencePartSummary part;
  part.n = 400;
  part.n_eff = 400;
  part.energy.percentile[3].value = 300e3;
  part.top.percentile[2].value = 2;
  const DesignInput input{1, 0.8, 2700, 3, false, 4, 4.9};
  const DesignResult r = check_design(code, {}, input, part, straight_fence());
  EXPECT_NEAR(r.required_capacity, 1.15 * 300e3, 1e-6);
  EXPECT_NEAR(r.required_height, 1.3 * 2, 1e-12);
  EXPECT_DOUBLE_EQ(r.required_distance, 5);  // d + 1 > 1.2 d
  EXPECT_EQ(r.governs, "distance");
  EXPECT_EQ(r.verdict, DesignVerdict::does_not_meet);
}

TEST(CheckDesign, WithTooFewArrivalsTakesTheLargestAndPassesNothing) {
  const DesignCode code = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/onr_24810.csv"));
  FencePartSummary part;
  part.n = 20;
  part.n_eff = 20;
  part.energy.largest = 10e3;
  part.top.largest = 1;
  const DesignResult r =
      check_design(code, {}, {1, 0.8, 2700, 1, false, NAN, NAN}, part, straight_fence());
  EXPECT_EQ(r.verdict, DesignVerdict::too_few);
  EXPECT_EQ(r.n_needed, 299);
  EXPECT_NEAR(r.design_energy, 10e3, 1e-9);
}

TEST(BuildRemarks, SayWhereRowsAreLongerOrHaveFewerFieldsThanTheCodeAsksFor) {
  const DesignCode onr = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/onr_24810.csv"));
  const DesignCode uni = design_code(read_csv(TALUS_SOURCE_DIR "/share/codes/uni_11211-4.csv"));
  EXPECT_TRUE(build_remarks(onr, straight_fence()).empty());  // 30 m in 3 fields
  const Fence one_long_field = fence_along({{20, 1}, {20, 57}}, flat(), 60);
  EXPECT_EQ(build_remarks(onr, one_long_field).size(), 1U);
  const Trn wide = plane_trn(0, 2, 40, 60);
  EXPECT_EQ(build_remarks(onr, fence_along({{20, 1}, {20, 80}}, wide, 40)).size(), 2U);
  EXPECT_TRUE(build_remarks(uni, one_long_field).empty());
}

// Only percentiles that are computed can be asked for.
TEST(DesignCode, RefusesOtherPercentiles) {
  std::string text;
  for (const char* key :
       {"energy_percentile", "gamma_energy_cc1", "gamma_energy_cc2", "gamma_energy_cc3",
        "gamma_height_cc1", "gamma_height_cc2", "gamma_height_cc3", "f_min_m",
        "f_min_share_of_block", "deflection_factor"})
    text += std::string(key) + ",0.99,1,m,\n";
  const auto code_with = [&text](const std::string& percentile) {
    return design_code(parse_csv("key,value,unit,mark,source\nformula,onr,,v,\n" + text +
                                     "height_percentile," + percentile + ",1,m,\n",
                                 "x.csv"));
  };
  EXPECT_NO_THROW(static_cast<void>(code_with("0.95")));
  for (const char* wrong : {"95", "0.97", "0", "1", "-0.5"})
    EXPECT_THROW(static_cast<void>(code_with(wrong)), InputError);
}

TEST(DesignCode, RefusesAFileWithoutAFactor) {
  EXPECT_THROW(static_cast<void>(design_code(
                   parse_csv("key,value,unit,mark,source\nformula,uni,,v,\n", "x.csv"))),
               InputError);
}

// A run that counts three times is as good as the same run three times.
TEST(FenceShares, WeighRunsAsIfTheyStoodThereSoManyTimes) {
  FenceRun near, far;
  near.volume = far.volume = {2};
  near.weight = far.weight = {1};
  near.event.path = 50;
  far.event.path = 90;
  near.at_fence.resize(1);
  far.at_fence.resize(1);
  near.at_fence[0].verdicts = {{0, 0, Verdict::not_reached, -1}};
  far.at_fence[0].verdicts = {{0, 0, Verdict::pierced, -1}};
  FenceArrival crossing;
  crossing.passed_for_good = true;
  crossing.volume = 2;
  far.at_fence[0].crossings = {crossing};
  const FenceRunGroup repeated{std::vector<RunMember>(4), {near, far, far, far}, {}};
  far.run_weight = 3;
  far.weight = {3};
  far.at_fence[0].crossings[0].weight = 3;
  const FenceRunGroup weighed{
      std::vector<RunMember>(2), {near, far}, clusters_of_runs({1, 3}, 1, {}, {1, 3})};
  const GroundBehind a = ground_behind(weighed, 0), b = ground_behind(repeated, 0);
  EXPECT_DOUBLE_EQ(a.share, 0.75);
  EXPECT_DOUBLE_EQ(a.share, b.share);
  EXPECT_DOUBLE_EQ(a.volume, b.volume);
  EXPECT_DOUBLE_EQ(a.path, 80);
  EXPECT_DOUBLE_EQ(a.path, b.path);
  EXPECT_DOUBLE_EQ(verdict_share(weighed, 0, Verdict::pierced, share_basis(weighed.clusters)).share,
                   0.75);
}
