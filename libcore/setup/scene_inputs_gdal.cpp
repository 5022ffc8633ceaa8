// Reads the inputs of a run and checks them against one another.
#include "setup/scene_inputs_gdal.hpp"

#include <algorithm>
#include <cmath>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "blocks/least_size.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/dem_gdal.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/crs_gdal.hpp"
#include "io/judged_heights_gdal.hpp"
#include "io/trn_digest.hpp"
#include "scene/site_fence.hpp"
#include "setup/forest_inputs_gdal.hpp"
#include "setup/ground_class_inputs_gdal.hpp"
#include "setup/search_lines.hpp"
#include "setup/site_dams_gdal.hpp"
#include "setup/site_places_gdal.hpp"
#include "setup/start_depth.hpp"
#include "setup/start_overlaps.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "setup/water_inputs_gdal.hpp"

namespace talus {
namespace {

// Overlap of blocks and ground that rounding and stored files explain [m].
constexpr double depth_tolerance = 1e-3;

// --- blocks ------------------------------------------------------------------------------------

void check_crs(const BlockSet& blocks, const Trn& trn, const DdaFiles& files) {
  if (blocks.crs_wkt.empty() || trn.crs_wkt.empty()) return;
  if (same_crs(blocks.crs_wkt, trn.crs_wkt) && same_heights(blocks.crs_wkt, trn.crs_wkt)) return;
  throw InputError({files.blocks},
                   "the blocks are in " + crs_name(blocks.crs_wkt) + ", the terrain " + files.trn +
                       " is in " + crs_name(trn.crs_wkt),
                   "cut the blocks from this terrain with talus-blocks");
}

double distance_off(const Trn& trn, const Vec3& point) {
  const double east = trn.node0.x() + (trn.n_cols - 1) * trn.cell_size;
  const double south = trn.node0.y() - (trn.n_rows - 1) * trn.cell_size;
  const Vec2 nearest(std::clamp(point.x(), trn.node0.x(), east),
                     std::clamp(point.y(), south, trn.node0.y()));
  return (point.head<2>() - nearest).norm();
}

void check_place(const BlockSet& blocks, const Trn& trn, const DdaFiles& files) {
  for (std::size_t b = 0; b < blocks.centroid.size(); ++b) {
    const Vec3& at = blocks.centroid[b];
    if (!std::isnan(elevation_at(trn, at.x(), at.y()))) continue;
    const Vec3 place = at + blocks.origin;
    const double off = distance_off(trn, at);
    throw InputError({files.blocks, 0, "block " + std::to_string(b)},
                     off > 0 ? "lies " + text(off, 4) + " m outside the terrain " + files.trn +
                                   ", at " + text(place.x(), 9) + ", " + text(place.y(), 9)
                             : "lies where the ground of " + files.trn + " is not known, at " +
                                   text(place.x(), 9) + ", " + text(place.y(), 9),
                     "give the terrain that the blocks were cut from, or a larger window");
  }
}

// How many blocks start below the ground, and the deepest; empty when none does.
std::string depth_finding(const BlockSet& blocks, const Trn& trn) {
  const std::vector<double> depths = depths_below_ground(trn, blocks);
  const auto n = std::count_if(depths.begin(), depths.end(),
                               [](double depth) { return depth > depth_tolerance; });
  if (n == 0) return "";
  const auto deepest = std::max_element(depths.begin(), depths.end());
  return std::to_string(n) + " of " + std::to_string(depths.size()) +
         (n == 1 ? " blocks starts" : " blocks start") + " below the ground, block " +
         std::to_string(deepest - depths.begin()) + " by " + text(*deepest, 4) + " m, the most";
}

void check_number_of_blocks(const BlockSet& blocks, const DdaFiles& files) {
  const auto smallest = std::min_element(blocks.volume.begin(), blocks.volume.end());
  if (*smallest >= least_volume) return;
  throw InputError({files.blocks, 0, "block " + std::to_string(smallest - blocks.volume.begin())},
                   "has " + text(*smallest, 3) + " m3, expected " + text(least_volume) +
                       " (a cube of 1 mm) or more: contacts of smaller blocks are not resolved",
                   "check the units that the blocks were made in, or leave it out");
}

void check_depth(const BlockSet& blocks, const Trn& trn, const DdaFiles& files) {
  if (files.settle) return;
  const std::string finding = depth_finding(blocks, trn);
  if (!finding.empty())
    throw InputError({files.blocks}, finding,
                     "blocks cut out of a slope slide on the bed that talus-blocks --trn-out "
                     "writes; --settle lifts blocks onto the ground");
}

BlockSet read_checked_blocks(InputLog& log, const Trn& trn, const std::string& digest,
                             const DdaFiles& files, std::vector<std::string>& warnings) {
  BlockSet blocks = read_blocks(files.blocks);
  if (n_blocks(blocks) == 0)
    throw InputError({files.blocks}, "there is no block in it", "nothing would move");
  check_number_of_blocks(blocks, files);
  check_crs(blocks, trn, files);
  move_to_origin(blocks, trn.origin);
  check_place(blocks, trn, files);
  const std::vector<std::string>& known = blocks.ground_digests;
  if (!known.empty() && std::find(known.begin(), known.end(), digest) == known.end()) {
    log.warn(files.trn + " is not the terrain that " + files.blocks + " was made for");
    warnings.push_back("the terrain is not the one that the blocks were made for");
  }
  check_depth(blocks, trn, files);
  return blocks;
}

// --- fences ------------------------------------------------------------------------------------

void add_lines(InputLog& log, const Site& site, const FenceSettings& fence, DdaInputs& inputs,
               std::vector<FenceLine>& known) {
  const Where where = where_of_fence(site.file, fence);
  for (RecordLine& line : fence_lines(log, site, inputs.parts.trn, fence)) {
    known.push_back({&fence, line});
    line.standing = fence.active && site.solver.law == "talus";
    if (line.standing)
      inputs.parts.fences.push_back(standing_fence(
          fence, inputs.parts.trn, static_cast<int>(inputs.lines.size()), line.points, where));
    inputs.lines.push_back(std::move(line));
  }
}

// "panel 2 of fence upper", from the number of a panel among those of all fences.
std::string panel_name(const DdaInputs& inputs, int panel) {
  for (const StandingFence& fence : inputs.parts.fences) {
    const int n = static_cast<int>(fence.posts.size()) - 1;
    if (panel < n)
      return "panel " + std::to_string(panel) + " of fence " + inputs.lines[fence.line].name;
    panel -= n;
  }
  return "a fence";
}

std::string text_of(const StartOverlap& start, const DdaInputs& inputs) {
  const BlockOverlap& o = start.overlap;
  const int n = n_blocks(inputs.parts.blocks);
  const Vec3 at = o.point + inputs.origin;
  return "block " + std::to_string(o.block_a) + " and " +
         (o.block_b < n ? "block " + std::to_string(o.block_b)
                        : panel_name(inputs, o.block_b - n)) +
         " by " + text(o.depth, 3) + " m at " + text(at.x(), 9) + ", " + text(at.y(), 9) + ", " +
         text(at.z(), 6);
}

// Message on pairs of blocks that overlap; empty without any. Throws for those that
// are not to be moved apart.
std::string overlap_finding(const Site& site, const DdaInputs& inputs, const DdaFiles& files,
                            const std::vector<StartOverlap>& found) {
  if (found.empty()) return "";
  const auto too_deep =
      std::find_if(found.begin(), found.end(), [](const StartOverlap& o) { return !o.is_small; });
  const std::string finding =
      std::to_string(found.size()) +
      (found.size() == 1 ? " pair overlaps: " : " pairs overlap, the most ") +
      text_of(found.front(), inputs);
  if (too_deep != found.end())
    throw InputError(
        {files.blocks},
        too_deep == found.begin() ? finding : finding + "; " + text_of(*too_deep, inputs),
        too_deep->overlap.block_b >= n_blocks(inputs.parts.blocks)
            ? "move the fence of " + site.file + " off the blocks"
            : "blocks may overlap by " + text(too_deep->limit, 3) +
                  " m, a twentieth of their thickness, to be moved apart by --settle; "
                  "solver.blocks = \"alone\" moves each as if it were alone");
  if (!files.settle)
    throw InputError(
        {files.blocks}, finding,
        "--settle moves blocks apart that overlap as little as this, solver.blocks = \"alone\" "
        "moves each as if it were alone");
  return finding;
}

// Moving may bring blocks into a fence, and blocks that are too close may not come apart.
void check_settled(const Settled& settled, const DdaInputs& inputs, const DdaFiles& files,
                   bool among_blocks) {
  const std::vector<StartOverlap> left =
      start_overlaps(inputs.parts.blocks, inputs.parts.fences, among_blocks, overlap_tolerance);
  if (settled.done && left.empty()) return;
  throw InputError({files.blocks},
                   "the blocks were lifted onto the ground and moved apart " +
                       std::to_string(settled.rounds) + " times, and still " +
                       (left.empty() ? "they overlap" : text_of(left.front(), inputs) + " overlap"),
                   "they stand too closely packed: build the block set anew");
}

}  // namespace

namespace {

void settle_start(InputLog& log, const Site& site, DdaInputs& inputs, const DdaFiles& files,
                  bool among_blocks) {
  BlockSet& blocks = inputs.parts.blocks;
  const std::string deep = depth_finding(blocks, inputs.parts.trn);
  const std::string overlap =
      overlap_finding(site, inputs, files,
                      start_overlaps(blocks, inputs.parts.fences, among_blocks, overlap_tolerance));
  if (!files.settle) return;
  const Settled settled = settle(blocks, inputs.parts.trn, among_blocks, settled_tolerance);
  check_settled(settled, inputs, files, among_blocks);
  const std::string path = ", by " + text(settled.farthest, 3) + " m at most";
  const auto say = [&](const std::string& finding, const std::string& outcome) {
    if (finding.empty()) return;
    log.info(finding + outcome + path);
    inputs.warnings.push_back(finding + outcome + path);
  };
  say(deep, ": lifted onto it");
  say(overlap, ": moved apart");
}

}  // namespace

void check_start(InputLog& log, const Site& site, DdaInputs& inputs, const DdaFiles& files,
                 bool among_blocks) {
  settle_start(log, site, inputs, files, among_blocks);
  SceneParts& parts = inputs.parts;
  StandingForests forests = read_forests(log, site, parts.trn, parts.blocks);
  parts.stems = std::move(forests.stems);
  parts.stem_faces = std::move(forests.faces);
  parts.canopies = std::move(forests.canopies);
  inputs.forests = std::move(forests.forests);
  inputs.warnings.insert(inputs.warnings.end(), forests.warnings.begin(), forests.warnings.end());
}

DdaInputs read_dda_inputs(InputLog& log, const Site& site, const DdaFiles& files) {
  DdaInputs inputs;
  SceneParts& parts = inputs.parts;
  parts.trn = read_trn(files.trn);
  if (const std::string accepted = accepted_doubts(files.trn); !accepted.empty()) {
    inputs.warnings.push_back("heights of the terrain that were accepted: " + accepted);
    log.warn(inputs.warnings.back());
  }
  const Vec2 place = parts.trn.origin.head<2>() + parts.trn.node0;
  const CrsProblem problem = find_crs_problem(parts.trn.crs_wkt, place);
  if (!parts.trn.crs_wkt.empty() && !problem.finding.empty())
    throw InputError({files.trn}, problem.finding, "reproject it with talus-trn --t-srs");
  inputs.crs_wkt = parts.trn.crs_wkt;
  inputs.origin = parts.trn.origin;
  inputs.trn_sha256 = sha256_of_file(files.trn);
  inputs.trn_digest = trn_digest(parts.trn);
  log.content_read("trn", inputs.trn_digest);
  parts.base = base_motion(site, site.solver.duration_s);
  if (!site.base_motion.file.empty())
    log.read_also("base_motion", resolved(site, site.base_motion.file));
  parts.blocks = read_checked_blocks(log, parts.trn, inputs.trn_digest, files, inputs.warnings);
  parts.cell_class = ground_classes(log, site, parts.trn);
  parts.water = joint_water(log, site, parts.trn, parts.blocks.joint_set_names);
  if (parts.water) check_water_cover(log, site, parts.trn, *parts.water, parts.blocks);
  std::vector<FenceLine> lines;
  for (const FenceSettings& fence : site.fences) add_lines(log, site, fence, inputs, lines);
  check_fences_apart(log, site, parts.trn, lines);
  WatchedDams watched = watched_dams(log, site, parts.trn);
  inputs.other_dams = std::move(watched.other_ground);
  for (DamLines& dam : watched.dams) {
    inputs.lines.push_back(std::move(dam.crest));
    inputs.lines.push_back(std::move(dam.before));
  }
  inputs.objects = site_objects(log, site, parts.trn);
  for (const FenceSearchSettings& search : site.fence_searches)
    for (RecordLine& line : search_candidates(log, site, parts.trn, search, inputs.objects).lines)
      inputs.lines.push_back(std::move(line));
  return inputs;
}

}  // namespace talus
