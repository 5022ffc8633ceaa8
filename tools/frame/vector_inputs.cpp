#include "tools/frame/vector_inputs.hpp"

#include <algorithm>

#include "base/grouped_text.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "tools/frame/data_files.hpp"
#include "tools/frame/file_paths.hpp"
#include "tools/frame/options.hpp"

namespace talus {
namespace {

std::string digest_of(const VectorShapes& found) {
  Sha256 hash;
  for (const std::vector<Vec3>& shape : found.shapes) {
    const std::size_t n = shape.size();
    hash.add(&n, sizeof n);
    for (const Vec3& point : shape) hash.add(point.data(), sizeof point);
  }
  for (const std::vector<std::string>& values : found.attributes)
    for (const std::string& value : values) hash.add(value.c_str(), value.size() + 1);
  return hash.hex();
}

std::string sentence_on(const VectorShapes& found, const VectorQuery& query) {
  std::string words = sentence_on(found);
  if (query.kind == VectorKind::areas)
    words += " of " + grouped_text(found.area_m2, 4) + " m2 in all";
  if (found.n_united > 0)
    words += "; " + std::to_string(found.n_united) + " that overlap or touch were united to " +
             std::to_string(found.n_made);
  if (!found.operation.empty()) words += "; " + found.operation;
  return words;
}

Json entry_on(const VectorShapes& found, const std::string& role, const VectorQuery& query) {
  Json entry = entry_on(found, role);
  if (query.kind == VectorKind::areas) {
    entry["n_united"] = found.n_united;
    entry["n_made_of_them"] = found.n_made;
    entry["area_m2"] = found.area_m2;
  }
  if (!found.operation.empty()) entry["operation"] = found.operation;
  return entry;
}

}  // namespace

void add_layer_options(Tool& tool, const std::string& prefix, const std::string& of,
                       LayerChoice& choice) {
  tool.option(prefix + "layer", choice.layer,
              "layer of " + of + ", again for each further one; empty: the only one that fits")
      ->join();
  tool.option(prefix + "where", choice.where, "filter on " + of + ", e.g. \"ELEV > 900\"");
}

void read_members(Tool& tool, const std::string& role, const std::string& path) {
  const std::string file = file_of(path);
  if (file.empty() || is_virtual(file)) return;
  const std::vector<std::string> known = sidecars_of(file);  // that the tool reads anyway
  for (const std::string& member : data_files(file))
    if (member != file && std::count(known.begin(), known.end(), member) == 0)
      tool.read_also(role, member);
}

void read_data(Tool& tool, const std::string& role, const std::string& path) {
  tool.read_also(role, path);
  read_members(tool, role, path);
}

std::string sentence_on(const LayerReading& taken) {
  std::string words = taken.file + ": layer " + taken.layer;
  if (!taken.where.empty()) words += " where " + taken.where;
  return words + ", " + counted(taken.n_parts, taken.noun);
}

Json entry_on(const LayerReading& taken, const std::string& role) {
  Json entry = {{"input", role}, {"file", taken.file}, {"layer", taken.layer}};
  if (!taken.where.empty()) entry["where"] = taken.where;
  entry["n_" + taken.noun + "s"] = taken.n_parts;
  if (!taken.elevation_from.empty()) {
    entry["elevation_from"] = taken.elevation_from;
    entry["elevation_unit_m"] = taken.unit_m;
  }
  entry["n_passed_over"] = taken.n_passed_over;
  if (!taken.passed_over.empty()) entry["passed_over"] = taken.passed_over;
  if (!taken.remarks.empty()) entry["remarks"] = taken.remarks;
  return entry;
}

VectorShapes read_layer(Tool& tool, const std::string& role, const VectorQuery& query,
                        const std::string& crs_wkt) {
  VectorShapes found = read_vectors(query, crs_wkt);
  tool.content_read(role, digest_of(found));
  tool.info(sentence_on(found, query));
  if (!found.operation.empty()) tool.record(query.path + ": " + found.operation);
  for (const std::string& warning : found.warnings) tool.warn(warning);
  for (const std::string& remark : found.remarks) tool.info(query.path + ": " + remark);
  if (found.n_passed_over > 0)
    tool.warn(query.path + ": layer " + found.layer + " also holds " + found.passed_over +
              ", passed over");
  tool.layer_read(entry_on(found, role, query));
  return found;
}

}  // namespace talus
