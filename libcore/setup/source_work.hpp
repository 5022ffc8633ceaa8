// libcore/setup/source_work.hpp: public
// Data that a run of talus-blocks works on.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "blocks/assemble.hpp"
#include "blocks/failure_plane.hpp"
#include "blocks/failure_wedge.hpp"
#include "blocks/source.hpp"
#include "site/joint_plan.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Filled step by step; lengths in metres, relative to the origin of `ground`.
struct BlocksWork {
  Site site;
  Trn ground;                    ///< before the slide
  std::string accepted_doubts;   ///< places of the ground that the user accepted, in words
  Area area;                     ///< polygon of [source]; empty without one
  std::vector<PlannedSet> sets;  ///< of [joints.*]; from here to `expected`: only where is_cut()
  FailurePlanes planes;          ///< of the sets: of a daylighting surface only
  std::vector<FailureWedge> wedges;  ///< of pairs of sets, where they were looked for
  int wedge = -1;                    ///< of `wedges`, that the mass lies on; -1: none
  double hollow_volume = 0;          ///< of the mass before source.daylight, 0 without [m3]
  PlaneAtFoot at_foot;               ///< of a plane given by hand only
  double slbl_curvature = 0;         ///< C of a base level on these cells [m]
  SourceMass mass;
  std::vector<Joint> joints;  ///< drawn, all that cross the mass
  AssembleOptions limits;     ///< of slivers and edges; whether blocks stay as they are cut
  AssembleReport cut;         ///< its result for the pieces
  double expected = 0;        ///< number of blocks that the joints should cut
  BlockSet blocks;

  /// A site of bodies from elsewhere may have [source] for max_blocks alone.
  [[nodiscard]] bool has_source() const {
    const bool is_given =
        std::find(site.sections.begin(), site.sections.end(), "source") != site.sections.end();
    const bool has_area = !site.source.polygon.empty() || !site.source.polygon_file.empty();
    if (!site.rockfalls.empty()) return false;
    return is_given && (has_area || site.blocks.empty() || !site.joints.empty());
  }
  /// Where there are joints, or no bodies from elsewhere.
  [[nodiscard]] bool is_cut() const {
    return has_source() && (site.blocks.empty() || !site.joints.empty());
  }
};

}  // namespace talus
