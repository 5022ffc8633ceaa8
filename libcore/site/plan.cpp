// Decides which parts of a run are computed and which are omitted, with the reasons.
#include "site/plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr const char* full_asked_for = "the full plan was asked for";

double height_of(const BlockSet& blocks, std::size_t b) {
  double low = 1e300, high = -1e300;
  for (int v = blocks.block_vertex_begin[b]; v < blocks.block_vertex_begin[b + 1]; ++v) {
    low = std::min(low, blocks.vertices[v].z());
    high = std::max(high, blocks.vertices[v].z());
  }
  return high - low;
}

const MaterialSettings* material_of(const Site& site, const BlockSet& blocks, std::size_t b) {
  const std::string& name = blocks.material_names[blocks.material[b]];
  for (const MaterialSettings& material : site.materials)
    if (material.name == name) return &material;
  return nullptr;
}

PlanItem strains(const PlanFacts& facts, bool full) {
  PlanItem item{"strains", true,
                "12 degrees of freedom a block where stress is asked for or a "
                "block's own weight strains it by more than " +
                    text(strain_that_matters),
                ""};
  item.reason = "largest strain by own weight " + text(facts.largest_weight_strain, 2);
  if (facts.strain == "off") {
    item.on = false;
    item.reason = "[solver] strain is off";
  } else if (full || facts.strain == "on") {
    item.reason = full ? full_asked_for : "[solver] strain is on";
  } else {
    item.on = facts.largest_weight_strain > strain_that_matters;
  }
  if (item.on && facts.law == "talus" && facts.n_blocks > 1 && !facts.independent)
    item.reason += "; blocks that touch each other are computed rigid";
  return item;
}

}  // namespace

PlanFacts plan_facts(const Site& site, const BlockSet& blocks, const Trn& trn,
                     const std::vector<std::uint8_t>& flags) {
  PlanFacts facts;
  facts.n_blocks = n_blocks(blocks);
  for (const GroundSettings& ground : site.grounds) {
    facts.largest_friction_deg = std::max(facts.largest_friction_deg, ground.friction_deg);
    facts.largest_cohesion =
        std::max({facts.largest_cohesion, ground.cohesion_pa, ground.tension_pa});
  }
  for (std::size_t b = 0; b < blocks.volume.size(); ++b)
    if (const MaterialSettings* material = material_of(site, blocks, b)) {
      facts.largest_weight_strain = std::max(facts.largest_weight_strain,
                                             material->density_kg_m3 * site.solver.gravity_m_s2 *
                                                 height_of(blocks, b) / material->young_modulus_pa);
      if (facts.n_blocks < 2) continue;
      facts.largest_friction_deg = std::max(facts.largest_friction_deg, material->friction_deg);
      facts.largest_cohesion =
          std::max({facts.largest_cohesion, material->cohesion_pa, material->tension_pa});
    }
  facts.n_cells = static_cast<std::int64_t>(trn.n_rows - 1) * (trn.n_cols - 1);
  const FeatureCounts counts = feature_counts(trn);
  facts.n_features = counts.vertices + counts.edges;
  for (const std::uint8_t byte : flags) facts.n_convex_features += std::popcount(byte);
  for (const JointSettings& joints : site.joints) {
    if (facts.n_blocks < 2) break;
    if (!std::isnan(joints.friction_deg))
      facts.largest_friction_deg = std::max(facts.largest_friction_deg, joints.friction_deg);
    facts.largest_cohesion =
        std::max({facts.largest_cohesion, joints.cohesion_pa, joints.tension_pa});
  }
  facts.n_fences = static_cast<int>(site.fences.size());
  for (const DamSettings& dam : site.dams) facts.n_dams += dam.active;
  facts.n_fence_searches = static_cast<int>(site.fence_searches.size());
  for (const FenceSettings& fence : site.fences)
    facts.n_standing += fence.active && site.solver.law == "talus";
  facts.breaks = site.fragmentation.enabled && site.solver.law == "talus";
  for (const ForestSettings& forest : site.forests)
    if (forest.active && site.solver.law == "talus")
      ++(forest.drag_kg_s > 0 ? facts.n_canopies : facts.n_forests);
  facts.has_base_motion = !site.base_motion.file.empty() || site.base_motion.amplitude_m_s2 > 0;
  facts.strain = site.solver.strain;
  facts.passages = site.output.passages;
  facts.law = site.solver.law;
  facts.independent = moves_alone(site);
  return facts;
}

namespace {

// An item that the full plan keeps although nothing in the scene asks for it.
PlanItem kept_by_full(bool full, PlanItem item) {
  if (item.on || !full) return item;
  item.on = true;
  item.reason = full_asked_for;
  return item;
}

PlanItem block_contacts(const PlanFacts& facts, bool full) {
  const bool several = facts.n_blocks > 1 || facts.breaks;
  const PlanItem item{
      "contacts between blocks", several && !facts.independent,
      "two blocks or more that do not move alone",
      counted(facts.n_blocks, "block") + (facts.breaks ? " that may break ([fragmentation])" : "")};
  if (facts.independent && facts.n_blocks > 1)
    return {item.item, false, item.rule, item.reason + ", each moves as if it were alone"};
  return kept_by_full(full && !facts.independent, item);
}

}  // namespace

ScenePlan make_plan(const PlanFacts& facts, bool full) {
  ScenePlan plan;
  const auto add = [&plan](PlanItem item) {
    plan.items.push_back(std::move(item));
    return plan.items.back().on;
  };
  plan.strains = add(strains(facts, full));
  plan.block_contacts = add(block_contacts(facts, full));
  add({"shear terms", facts.largest_friction_deg > 0,
       "shear springs and sliding where something has friction",
       "largest friction angle " + text(facts.largest_friction_deg, 4) + " degrees"});
  add({"bonded areas", facts.largest_cohesion > 0,
       "areas of faces in contact where something has cohesion or tension",
       "largest strength " + text(facts.largest_cohesion, 4) + " Pa"});
  add({"terrain edges and nodes", facts.n_convex_features > 0,
       "contact modes 2 and 3 at convex edges and nodes of the terrain",
       std::to_string(facts.n_convex_features) + " of " + std::to_string(facts.n_features) +
           " stand out"});
  add({"terrain beyond the blocks' reach", true,
       "kept whole: a step looks only at the cells below a block, whatever the terrain's size",
       counted(facts.n_cells, "cell")});
  plan.base_motion = add({"base motion", facts.has_base_motion, "where the site file has one",
                          facts.has_base_motion ? "[base_motion]" : "no [base_motion]"});
  plan.flight = add({"flight without search", !full && !facts.has_base_motion,
                     "no contact is searched while the ground below cannot be hit",
                     full                    ? "the full plan searches in every step"
                     : facts.has_base_motion ? "the base motion bends the paths"
                                             : "bounds of the ground below the path"});
  plan.sleep = add({"sleep", !full, "blocks at rest are left out until touched",
                    full ? "the full plan keeps them in every step" : "found step by step"});
  plan.passages = add(
      kept_by_full(full, {"passages", facts.passages, "one row a block and cell, for maps",
                          facts.passages ? "[output] passages" : "[output] passages is false"}));
  const std::string dams =
      facts.n_dams == 0 ? "" : " and two lines of " + counted(facts.n_dams, "dam");
  const std::string searches =
      facts.n_fence_searches == 0
          ? ""
          : " and candidates of [fence_search.*]: " + std::to_string(facts.n_fence_searches);
  plan.crossings = add({"crossings", facts.n_fences + facts.n_dams + facts.n_fence_searches > 0,
                        "one row a block and line of [fence.*]",
                        counted(facts.n_fences, "fence") + dams + searches});
  add({"standing fences", facts.n_standing > 0,
       "panels as fixed bodies where a fence is active, law talus",
       counted(facts.n_standing, "fence")});
  if (facts.n_forests > 0)
    add({"forest", true, "stems by place, looked at where a block is near",
         counted(facts.n_forests, "forest")});
  if (facts.n_canopies > 0)
    add({"drag of forests", true, "in each substep by place; no flight goes over such a forest",
         counted(facts.n_canopies, "forest")});
  const bool is_asked_for = facts.strain == "on";
  plan.strains_in_frames = add(kept_by_full(
      full && plan.strains,
      {"strains in frames", is_asked_for && plan.strains, "stored where asked for and computed",
       is_asked_for ? "[solver] strain is on" : "not asked for"}));
  return plan;
}

std::string as_text(const ScenePlan& plan) {
  std::string lines;
  for (const PlanItem& item : plan.items)
    lines += std::string(item.on ? "on   " : "off  ") + item.item + ": " + item.reason + " (" +
             item.rule + ")\n";
  if (!lines.empty()) lines.pop_back();
  return lines;
}

}  // namespace talus
