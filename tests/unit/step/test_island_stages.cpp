// Stages of an island's step: reports, bonds, page, clock.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "step/island/stages.hpp"
#include "step/island/step_island.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

std::string theory() {
  std::ifstream file(std::string(TALUS_SOURCE_DIR) + "/docs/theory/theory.md");
  std::ostringstream page;
  page << file.rdbuf();
  return page.str();
}

// The nine stages have the numbers and names of the page, and so have the reasons of a cut.
TEST(IslandStages, AreThoseOfThePage) {
  const std::string page = theory();
  std::size_t after = 0;
  for (std::size_t k = 0; k < island_stage_names.size(); ++k) {
    const std::string row = "\n| " + std::to_string(k + 1) + " | `" + island_stage_names[k] + "` |";
    const std::size_t at = page.find(row, after);
    ASSERT_NE(at, std::string::npos) << row;
    after = at;
  }
  EXPECT_EQ(static_cast<std::size_t>(IslandStage::accept) + 1, island_stage_names.size());
  for (const char* reason : substep_cut_names) {
    const std::size_t at = page.find(std::string("\n| `") + reason + "` |", after);
    ASSERT_NE(at, std::string::npos) << reason;
    after = at;
  }
  EXPECT_EQ(static_cast<std::size_t>(SubstepCut::yielding_used_up) + 1, substep_cut_names.size());
}

// A cube on a slab, their common face bonded; the slab is rough, the cube shears its bond.
Scene cube_on_slab(double cohesion, double cube_speed) {
  const SlopeFrame flat = slope_frame(0, 0);
  Body slab = body_of(box_in(flat, Vec3::Zero(), Vec3(-3, -3, 0), Vec3(3, 3, 0.5)));
  Body cube = body_of(box_in(flat, Vec3::Zero(), Vec3(-0.5, -0.5, 0.5), Vec3(0.5, 0.5, 1.5)),
                      Vec3(cube_speed, 0, 0));
  for (Body* body : {&slab, &cube}) body->parts[0].face_tag.assign(6, 0);
  Scene scene = scene_of(plane_trn(flat, 1, 30), ground_of(60), {slab, cube}, {});
  scene.joints.of_set = {ground_of(20)};
  scene.joints.of_set[0].cohesion = scene.joints.of_set[0].tension = cohesion;
  return scene;
}

// Cubes one on the other; the upper ones fall, so that something is hit.
Scene tower_of(int n) {
  std::vector<Body> cubes;
  for (int k = 0; k < n; ++k)
    cubes.push_back(body_of(box(Vec3(-0.5, -0.5, 1.001 * k), Vec3(0.5, 0.5, 1.001 * k + 1)),
                            Vec3(0, 0, -0.5 * k)));
  return scene_of(plane_trn(slope_frame(0, 0), 1, 10), ground_of(30, 0.5), cubes, {});
}

/// The first substep of an island of all blocks, stage by stage.
struct FirstSubstep {
  const Scene& scene;
  State state;
  Work work;
  IslandScratch& w = work.island;

  explicit FirstSubstep(const Scene& s) : scene(s), state(start(s)), work(make_work(s)) {
    form_islands(scene, state, work);
    gather_members(scene, blocks_of(work.search.groups, 0), w.members);
    take_pairs(scene, state, work.search, 0, w.members, w.manifolds);
    classify_size(scene, state, work.search, w.manifolds, w.members);
    choose_stiffness(scene, state, work.search, w.manifolds, 0, w.members);
  }
  SubstepVerdict attempt(double h) {
    Solution solution;
    predict(scene, state, w.members, 0, h, w.free, w.system.island);
    EXPECT_TRUE(make_contacts(scene, state, work.search, w.manifolds, w.members, w.free, w.tries,
                              work.near_ground, w.making, w.system));
    solve_with_hits(scene, state, work.search, w.members, work.near_ground, w.making, w.free,
                    w.system, w.hits, w.solver, nullptr, solution);
    EXPECT_TRUE(solution.converged);
    return check_substep(scene, state, work.search, w.members, w.free, w.system, w.hits,
                         solution.converged, w.tries, work.near_ground, w.making, w.end);
  }
};

// A bond that carries too much stays in the state until the substep without it is accepted.
TEST(CheckSubstep, ABondThatFailsIsBrokenByTheAcceptedSubstepAlone) {
  const Scene scene = cube_on_slab(1000, 1);
  FirstSubstep first(scene);
  ASSERT_EQ(first.state.bonds.size(), 1u);
  const double area = first.state.bonds[0].area, h = scene.settings.dt;
  const SubstepVerdict verdict = first.attempt(h);
  EXPECT_EQ(verdict.kind, SubstepVerdict::Kind::again);
  EXPECT_EQ(verdict.reason, SubstepCut::bond_broken);
  EXPECT_EQ(verdict.h, h);
  EXPECT_EQ(first.state.bonds[0].area, area);
  first.w.tries.broken.resize(1);
  first.w.tries.broken[0].bond = 0;
  EXPECT_EQ(first.attempt(h).kind, SubstepVerdict::Kind::accept);
  EXPECT_EQ(first.state.bonds[0].area, area);
  for (const KeptContact& contact : first.w.system.contacts) EXPECT_LT(contact.bond, 0);
  StepReport report;
  accept(scene, first.w.members, first.w.free, first.w.system, first.w.hits, true, first.w.tries,
         first.w.end, first.state, first.work.segments, first.work.deep, report);
  EXPECT_EQ(first.state.bonds[0].area, 0);
  EXPECT_EQ(first.state.local_time[1], h);
}

TEST(CheckSubstep, ABondThatHoldsIsKept) {
  const Scene scene = cube_on_slab(1e7, 0.01);
  FirstSubstep first(scene);
  EXPECT_EQ(first.attempt(scene.settings.dt).kind, SubstepVerdict::Kind::accept);
}

// The reason is counted in the report of the step.
TEST(StepIsland, ReportsWhySubstepsWereMadeAgain) {
  const auto cuts_of = [](double cohesion, double speed) {
    const Scene scene = cube_on_slab(cohesion, speed);
    State state = start(scene);
    Work work = make_work(scene);
    return step(scene, state, work).cuts[static_cast<std::size_t>(SubstepCut::bond_broken)];
  };
  EXPECT_EQ(cuts_of(1000, 1), 1);
  EXPECT_EQ(cuts_of(1e7, 0.01), 0);
}

TEST(StageClock, GivesEachStageItsOwnTime) {
  const Scene scene = tower_of(3);
  State state = start(scene);
  Work work = make_work(scene);
  StageClock clock;
  work.island.clock = &clock;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) step(scene, state, work);
  const double all =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const double seconds : clock.seconds) EXPECT_GT(seconds, 0);
  EXPECT_LE(std::accumulate(clock.seconds.begin(), clock.seconds.end(), 0.0), all);
}

}  // namespace
