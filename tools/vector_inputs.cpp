#include "vector_inputs.hpp"

#include "base/grouped_text.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

std::string noun_of(VectorKind kind) {
  return kind == VectorKind::points ? "point" : kind == VectorKind::lines ? "line" : "polygon";
}

std::string digest_of(const VectorShapes& found) {
  Sha256 hash;
  for (const std::vector<Vec3>& shape : found.shapes) {
    const std::size_t n = shape.size();
    hash.add(&n, sizeof n);
    for (const Vec3& point : shape) hash.add(point.data(), sizeof point);
  }
  return hash.hex();
}

std::string sentence_on(const VectorShapes& found, const VectorQuery& query) {
  std::string words =
      query.path + ": layer " + found.layer + ", " + counted(found.n_parts, noun_of(query.kind));
  if (query.kind == VectorKind::areas)
    words += " of " + grouped_text(found.area_m2, 6) + " m2 in all";
  if (found.n_united > 0)
    words += "; " + std::to_string(found.n_united) + " that overlap or touch were united to " +
             std::to_string(found.n_made);
  if (!found.operation.empty()) words += "; " + found.operation;
  return words;
}

Json entry_on(const VectorShapes& found, const std::string& role, const VectorQuery& query) {
  Json entry = {{"input", role},
                {"file", query.path},
                {"layer", found.layer},
                {"n_" + noun_of(query.kind) + "s", found.n_parts}};
  if (query.kind == VectorKind::areas) {
    entry["n_united"] = found.n_united;
    entry["n_made_of_them"] = found.n_made;
    entry["area_m2"] = found.area_m2;
  }
  entry["n_passed_over"] = found.n_passed_over;
  if (!found.operation.empty()) entry["operation"] = found.operation;
  return entry;
}

}  // namespace

VectorShapes read_layer(Tool& tool, const std::string& role, const VectorQuery& query,
                        const std::string& crs_wkt) {
  VectorShapes found = read_vectors(query, crs_wkt);
  tool.content_read(role, digest_of(found));
  tool.info(sentence_on(found, query));
  if (!found.operation.empty()) tool.record(query.path + ": " + found.operation);
  for (const std::string& warning : found.warnings) tool.warn(warning);
  if (found.n_passed_over > 0)
    tool.warn(query.path + ": layer " + found.layer + " also holds " +
              counted(found.n_passed_over, "part") + " that are no " + noun_of(query.kind) +
              "s, passed over");
  tool.layer_read(entry_on(found, role, query));
  return found;
}

}  // namespace talus
