// Reads vector files that a site file names, and reports which shapes were taken.
#include "setup/vector_inputs_gdal.hpp"

#include <algorithm>

#include "base/file_paths.hpp"
#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "io/data_files_gdal.hpp"

namespace talus {

void read_members(InputLog& log, const std::string& role, const std::string& path) {
  const std::string file = file_of(path);
  if (file.empty() || is_virtual(file)) return;
  const std::vector<std::string> known = sidecars_of(file);  // which are read anyway
  for (const std::string& member : data_files(file))
    if (member != file && std::count(known.begin(), known.end(), member) == 0)
      log.read_also(role, member);
}

void read_data(InputLog& log, const std::string& role, const std::string& path) {
  log.read_also(role, path);
  read_members(log, role, path);
}

std::string parts_of(const LayerReading& taken) {
  std::string words = counted(taken.n_parts, taken.noun);
  if (taken.area_m2 > 0) words += " of " + grouped_text(taken.area_m2, 4) + " m2 in all";
  if (taken.n_united > 0)
    words += "; " + std::to_string(taken.n_united) + " that overlap or touch were united to " +
             std::to_string(taken.n_made);
  return words + (taken.operation.empty() ? "" : "; ") + taken.operation;
}

LayerRead facts_on(const LayerReading& taken, const std::string& role) {
  LayerRead layer{role, taken.file, {{"layer", taken.layer}}};
  if (!taken.where.empty()) layer.facts.emplace_back("where", taken.where);
  layer.facts.emplace_back("n_" + taken.noun + "s", std::int64_t{taken.n_parts});
  if (!taken.elevation_from.empty()) {
    layer.facts.emplace_back("elevation_from", taken.elevation_from);
    layer.facts.emplace_back("elevation_unit_m", taken.unit_m);
  }
  if (taken.area_m2 > 0) {
    layer.facts.emplace_back("n_united", std::int64_t{taken.n_united});
    layer.facts.emplace_back("n_made_of_them", std::int64_t{taken.n_made});
    layer.facts.emplace_back("area_m2", taken.area_m2);
  }
  if (!taken.operation.empty()) layer.facts.emplace_back("operation", taken.operation);
  layer.facts.emplace_back("n_passed_over", std::int64_t{taken.n_passed_over});
  if (!taken.passed_over.empty()) layer.facts.emplace_back("passed_over", taken.passed_over);
  if (!taken.remarks.empty()) layer.facts.emplace_back("remarks", taken.remarks);
  std::vector<std::string> decisions;
  for (const Decision& decision : taken.decisions)
    decisions.push_back(decision.question + ": " + decision.answer +
                        (decision.why.empty() ? "" : " (" + decision.why + ")"));
  if (!decisions.empty()) layer.facts.emplace_back("decisions", decisions);
  return layer;
}

void note_shapes(InputLog& log, const VectorShapes& found) {
  log.content_read(found.role, digest_of(found));
  if (!found.operation.empty()) log.record(found.file + ": " + found.operation);
  for (const std::string& remark : found.remarks) log.info(found.file + ": " + remark);
  if (found.n_passed_over > 0)
    log.doubts({doubt_on({found.file, 0, "layer " + found.layer},
                         "also holds " + found.passed_over + ", passed over")});
}

VectorShapes read_layer(InputLog& log, const std::string& role, const VectorQuery& query,
                        const std::string& crs_wkt) {
  VectorShapes found = read_vectors(query, crs_wkt);
  found.role = role;
  log.info(found.file + ": layer " + found.layer +
           (found.where.empty() ? "" : " where " + found.where) + ", " + parts_of(found));
  note_shapes(log, found);
  log.doubts(found.doubts);
  log.layer_read(facts_on(found, role));
  return found;
}

}  // namespace talus
