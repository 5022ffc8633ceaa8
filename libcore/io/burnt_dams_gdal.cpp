// Dams in the ground of a terrain file: its tag DAMS.
#include "io/burnt_dams_gdal.hpp"

#include <algorithm>

#include "base/json.hpp"
#include "io/judged_heights_gdal.hpp"

namespace talus {
namespace {

Json runs_of(const std::vector<int>& nodes) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i == 0 || nodes[i] != nodes[i - 1] + 1) runs.push_back(nodes[i]);
    if (i + 1 == nodes.size() || nodes[i + 1] != nodes[i] + 1) runs.push_back(nodes[i]);
  }
  return runs;
}

// Throws JsonError.
std::vector<int> nodes_of(const std::vector<int>& runs, const Trn& trn) {
  const int n = trn.n_rows * trn.n_cols;
  std::vector<int> nodes;
  for (std::size_t i = 0; i + 1 < runs.size(); i += 2) {
    if (runs[i] < 0 || runs[i + 1] >= n) throw JsonError("a node is outside of the terrain");
    for (int node = runs[i]; node <= runs[i + 1]; ++node) nodes.push_back(node);
  }
  if (!std::is_sorted(nodes.begin(), nodes.end())) throw JsonError("nodes are not in order");
  return nodes;
}

}  // namespace

std::string dams_text(const Trn& trn) {
  if (trn.dams.empty()) return {};
  Json list = Json::array();
  for (const BurntDam& dam : trn.dams) {
    std::vector<double> crest = dam.crest;
    for (double& z : crest) z += trn.origin.z();
    list.push_back({{"name", dam.name},
                    {"uphill", dam.uphill > 0 ? "left" : "right"},
                    {"crest_m", crest},
                    {"shape", dam.shape},
                    {"nodes", runs_of(dam.nodes)}});
  }
  return list.dump();
}

std::vector<BurntDam> burnt_dams(const std::string& path, const Trn& trn) {
  std::vector<BurntDam> dams;
  const std::string tag = tag_of_judged(path, dams_tag);
  if (tag.empty()) return dams;
  try {
    const Json list = Json::parse(tag);
    for (const Json& dam : list) {
      dams.push_back({dam["name"].get<std::string>(), dam["uphill"] == "left" ? 1 : -1,
                      dam["crest_m"].get<std::vector<double>>(),
                      nodes_of(dam["nodes"].get<std::vector<int>>(), trn),
                      dam["shape"].get<std::string>()});
      for (double& z : dams.back().crest) z -= trn.origin.z();
    }
  } catch (const JsonError& error) {
    throw InputError({path},
                     std::string("its tag ") + dams_tag + " cannot be read: " + error.what(),
                     "make the terrain again");
  }
  return dams;
}

}  // namespace talus
