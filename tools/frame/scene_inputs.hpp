// tools/frame/scene_inputs.hpp
// What talus-dda reads, checked against one another before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "record/crossings.hpp"
#include "record/run_file.hpp"
#include "scene/site_scene.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct DdaFiles {
  std::string trn, blocks;
  bool settle = false;  ///< lift blocks that stand in the ground, move small overlaps apart
};

struct DdaInputs {
  SceneParts parts;
  std::vector<RecordLine> lines;      ///< of [fence.*], on the ground
  std::vector<RecordObject> objects;  ///< of [object.*]
  std::vector<ForestInfo> forests;    ///< of [forest.*] that stand, set by check_start()
  std::string crs_wkt;
  Vec3 origin = Vec3::Zero();  ///< of the TRN: everything is relative to it
  std::string trn_sha256, trn_digest;
  std::vector<std::string> warnings;  ///< for the run file: without paths, which may change
};

/// Throws InputError for blocks that overlap one another (`among_blocks`) or a fence by more than a
/// millimetre: how many, and of the deepest which two, how deep and where. With files.settle blocks
/// in the ground are lifted onto it, and those that overlap by up to a twentieth of their thickness
/// are moved apart. Then reads the forests: stems keep clear of the blocks (read_forests()).
void check_start(Tool& tool, const Site& site, DdaInputs& inputs, const DdaFiles& files,
                 bool among_blocks);

/// Reads TRN, blocks, ground classes, base motion and fences. Throws InputError for blocks of
/// another CRS, off the terrain or in the ground (unless files.settle), ground without a class, and
/// a base motion that ends early. Fences that are active stand, with law talus. Warns of a TRN that
/// the blocks were not made for.
[[nodiscard]] DdaInputs read_dda_inputs(Tool& tool, const Site& site, const DdaFiles& files);

}  // namespace talus
