// libcore/site/plan.hpp: public
// The scene plan: parts that a run has to compute and parts that it can omit, with the reason.
// in:    the site file, the blocks, the terrain
// out:   decisions; talus-dda --plan prints them, --plan=full keeps parts that a scene can do
//        without
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blocks/block_set.hpp"
#include "site/base_motion.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// One decision of the plan.
struct PlanItem {
  std::string item;    ///< its subject
  bool on = true;      ///< whether it is computed
  std::string rule;    ///< when it is computed
  std::string reason;  ///< the numbers of this scene that decided
};

/// Facts for the decisions.
struct PlanFacts {
  int n_blocks = 0;
  double largest_friction_deg = 0;     ///< over grounds, and materials where blocks can meet
  double largest_cohesion = 0;         ///< cohesion or tension [Pa]
  double largest_weight_strain = 0;    ///< rho g h / E over blocks, h = height of the block [-]
  std::int64_t n_cells = 0;            ///< of the terrain
  std::int64_t n_convex_features = 0;  ///< nodes and edges that are convex (trn_flags)
  std::int64_t n_features = 0;         ///< all nodes and edges
  int n_fences = 0;
  int n_fence_searches = 0, n_dams = 0;
  int n_standing = 0;   ///< fences that stop blocks
  int n_forests = 0;    ///< of stems that do
  int n_canopies = 0;   ///< forests that drag, law talus
  bool breaks = false;  ///< blocks may break: their pieces meet
  bool has_base_motion = false;
  std::string strain = "auto";  ///< [solver] strain: auto, on, off
  bool passages = true;
  std::string law = "talus";
  bool independent = false;  ///< each block is to move as if it were alone
};

/// A strain of a block under its own weight above which strains are computed: a block of 10 m is
/// then shortened by a millimetre, ten times the compression of contacts.
inline constexpr double strain_that_matters = 1e-4;

[[nodiscard]] PlanFacts plan_facts(const Site& site, const BlockSet& blocks, const Trn& trn,
                                   const std::vector<std::uint8_t>& flags);

/// The decisions in a fixed order; with `full` parts omitted to save time or space
/// stay on: strains, contacts of a lone block, searches in flight, sleepers, passages. Parts that
/// the scene does not have (friction, cohesion, fences, base motion) stay out.
struct ScenePlan {
  std::vector<PlanItem> items;
  bool strains = false;  ///< 12 degrees of freedom a block instead of 6
  bool block_contacts = false;
  bool flight = true;  ///< skip the search while nothing can be hit
  bool sleep = true;   ///< leave out blocks at rest
  bool base_motion = false;
  bool passages = true;
  bool crossings = false;
  bool strains_in_frames = false;
};
[[nodiscard]] ScenePlan make_plan(const PlanFacts& facts, bool full);

/// A line an item: "off  strains: reason (rule)".
[[nodiscard]] std::string as_text(const ScenePlan& plan);

}  // namespace talus
