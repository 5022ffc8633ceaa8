// Where values of a site file were given, and the paths of files that it names.
#include "site/site.hpp"

#include <filesystem>

namespace talus {

Where where_of(const Site& site, const std::string& key) {
  const auto found = site.sources.find(key);
  if (found == site.sources.end()) return {site.file};
  if (found->second.kind == ValueSource::from_cli) return {"", 0, "command line"};
  if (found->second.kind == ValueSource::from_soil) return {site.file};
  if (found->second.kind == ValueSource::from_layer) return {found->second.words};
  return {site.file, found->second.line};
}

std::string resolved(const Site& site, const std::string& path) {
  const bool is_whole = path.empty() || path[0] == '/' || site.folder.empty();
  if (is_whole) return path;
  const std::size_t end = path.find('|');  // a filter with any characters may follow
  const std::filesystem::path file = std::filesystem::path(site.folder) / path.substr(0, end);
  return file.lexically_normal().string() + (end == std::string::npos ? "" : path.substr(end));
}

bool names_layers_file(const Site& site, const std::string& name) {
  return !site.layers_file.empty() && name.substr(0, name.find('|')) == site.layers_file;
}

bool moves_alone(const Site& site) {
  const std::string& blocks = site.solver.blocks;
  return blocks == "alone" || (blocks == "auto" && !site.rockfalls.empty());
}

}  // namespace talus
