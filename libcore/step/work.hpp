// libcore/step/work.hpp: public
// Data that a step recomputes and may be thrown away; the comment above a group names its function.
// Buffers grow to the largest step and are kept: the step loop does not allocate.
#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "contact/search.hpp"
#include "scene/state.hpp"
#include "solver/angular_row.hpp"
#include "solver/contact_row.hpp"
#include "solver/impact_solve.hpp"
#include "step/deep_work.hpp"
#include "step/island/data.hpp"
#include "step/mass/data.hpp"
#include "step/segment.hpp"

namespace talus {

/// Scratch of yielding ground over a substep of one block (step/soil.hpp).
struct SoilWork {
  std::vector<AngularRow> turns;  ///< one, or none
  std::vector<RowArm> arms;       ///< of the rows; empty: no turn
  bool varies = false;            ///< friction of a row does
  Slide slide;                    ///< of the block, for a hit
};

struct Work {  // clang-format off
  Workers* workers = nullptr;                ///< share the loops of a step; nullptr: there are none
  // find_contacts: candidates of the block at hand
  std::vector<Vec3> world_vertices;          ///< at the predicted pose [m]
  std::vector<Contact> contacts;             ///< of the block at hand             (n_candidates)
  std::vector<NearFeatures> near_ground;     ///< features that a block may touch there (n_blocks)
  // make_rows, solve_contacts
  std::vector<ContactRow> rows;              ///< of the block at hand
  SoilWork soil;                             ///< beside them
  std::vector<BondFace> bond_faces;          ///< its bonds with the ground that do not hold
  std::vector<ContactMemory> unbonded;       ///< its memory, less the bonds that its substep breaks
  // apply_impact
  ImpactScratch impact;
  // advance_block: the motion of this step, block by block, in order of time
  std::vector<Segment> segments;
  // form_islands, advance_island
  PairSearch search;
  UntouchedScratch untouched;                ///< move_untouched
  IslandScratch island;                      ///< at hand
  MassScratch mass;                          ///< ... where it is a mass
  // note_overlap, note_deep_blocks
  DeepWork deep;
};  // clang-format on

}  // namespace talus
