// The scene plan: items left out and kept.
#include <gtest/gtest.h>

#include <algorithm>

#include "site/plan.hpp"

namespace {

using talus::make_plan;
using talus::PlanFacts;
using talus::PlanItem;
using talus::ScenePlan;

const PlanItem& item(const ScenePlan& plan, const std::string& name) {
  return *std::find_if(plan.items.begin(), plan.items.end(),
                       [&name](const PlanItem& i) { return i.item == name; });
}

PlanFacts one_stiff_block() {
  PlanFacts facts;
  facts.n_blocks = 1;
  facts.largest_friction_deg = 30;
  facts.largest_weight_strain = 1e-6;
  return facts;
}

TEST(ScenePlan, LeavesOutWhatASceneDoesNotNeed) {
  const ScenePlan plan = make_plan(one_stiff_block(), false);
  EXPECT_FALSE(plan.strains);
  EXPECT_FALSE(plan.base_motion);
  EXPECT_FALSE(plan.crossings);
  EXPECT_TRUE(plan.flight);
  EXPECT_TRUE(plan.sleep);
  EXPECT_TRUE(item(plan, "shear terms").on);
  EXPECT_FALSE(item(plan, "bonded areas").on);
  EXPECT_FALSE(item(plan, "terrain edges and nodes").on);
}

TEST(ScenePlan, KeepsWhatASceneNeeds) {
  PlanFacts facts = one_stiff_block();
  facts.n_blocks = 2;
  facts.largest_cohesion = 1;
  facts.n_convex_features = 1;
  facts.n_fences = 1;
  facts.has_base_motion = true;
  const ScenePlan plan = make_plan(facts, false);
  EXPECT_TRUE(plan.block_contacts);
  facts.independent = true;
  EXPECT_FALSE(make_plan(facts, false).block_contacts);
  EXPECT_TRUE(plan.base_motion);
  EXPECT_FALSE(plan.flight);
  EXPECT_TRUE(plan.crossings);
  EXPECT_TRUE(item(plan, "bonded areas").on);
  EXPECT_TRUE(item(plan, "terrain edges and nodes").on);
}

TEST(ScenePlan, ComputesStrainsWhereTheyMatterOrAreAskedFor) {
  PlanFacts facts = one_stiff_block();
  facts.largest_weight_strain = 2 * talus::strain_that_matters;
  EXPECT_TRUE(make_plan(facts, false).strains);
  facts.strain = "off";
  EXPECT_FALSE(make_plan(facts, false).strains);
  facts = one_stiff_block();
  facts.strain = "on";
  EXPECT_TRUE(make_plan(facts, false).strains && make_plan(facts, false).strains_in_frames);
}

TEST(ScenePlan, FullKeepsEverythingThatCanBeLeftOut) {
  PlanFacts facts = one_stiff_block();
  facts.passages = false;
  const ScenePlan own = make_plan(facts, false), full = make_plan(facts, true);
  EXPECT_FALSE(own.strains || own.block_contacts || own.passages || own.strains_in_frames);
  EXPECT_TRUE(full.strains && full.block_contacts && full.passages && full.strains_in_frames);
  EXPECT_TRUE(own.flight && own.sleep);
  EXPECT_FALSE(full.flight || full.sleep);
  facts.strain = "off";  // said by the user, and kept
  facts.independent = true;
  const ScenePlan told = make_plan(facts, true);
  EXPECT_FALSE(told.strains || told.block_contacts || told.strains_in_frames);
}

TEST(ScenePlan, GivesEachDecisionARuleAndAReason) {
  for (const bool full : {false, true})
    for (const PlanItem& i : make_plan(one_stiff_block(), full).items) {
      EXPECT_FALSE(i.rule.empty()) << i.item;
      EXPECT_FALSE(i.reason.empty()) << i.item;
    }
}

}  // namespace
