// libcore/setup/dda_inputs.hpp: public
// Inputs of a run: terrain, blocks and the structures on the ground, relative to one origin.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "record/crossings.hpp"
#include "record/object_hits.hpp"
#include "record/run_file.hpp"
#include "setup/site_scene.hpp"
#include "site/site.hpp"

namespace talus {

struct DdaFiles {
  std::string trn, blocks;
  bool settle = false;  ///< lift blocks that are in the ground, move small overlaps apart
};

struct DdaInputs {
  SceneParts parts;
  std::vector<RecordLine> lines;         ///< of [fence.*], on the ground
  std::optional<InputError> other_dams;  ///< WatchedDams::other_ground
  std::vector<RecordObject> objects;     ///< of [object.*]
  std::vector<ForestInfo> forests;       ///< of active [forest.*], set by check_start()
  std::string crs_wkt;
  Vec3 origin = Vec3::Zero();  ///< of the TRN: everything is relative to it
  std::string trn_sha256, trn_digest;
  std::vector<std::string> warnings;  ///< for the run file: without paths, which may change
};

}  // namespace talus
