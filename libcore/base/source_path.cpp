// Takes apart the name of a source: file, archive member, layer, subset.
#include "base/source_path.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

bool is_file(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// Where the parts that QGIS adds begin; npos: there are none. A filter may hold any sign, so only
// known beginnings part a name, and nothing does behind "|subset=".
std::size_t next_part(const std::string& name, std::size_t from) {
  static constexpr std::array keys = {
      "layername=", "layerid=", "subset=", "geometrytype=", "uniqueGeometryType=", "option:"};
  for (std::size_t bar = name.find('|', from); bar != std::string::npos;
       bar = name.find('|', bar + 1))
    for (const char* key : keys)
      if (lower(name).compare(bar + 1, std::string(key).size(), lower(key)) == 0) return bar;
  return std::string::npos;
}

void take_part(const std::string& part, const std::string& name, SourcePath& path) {
  const std::size_t equals = part.find('=');
  const std::string key = lower(part.substr(0, equals)), value = part.substr(equals + 1);
  if (key == "layername")
    path.layer = value;
  else if (key == "layerid")
    path.layer_id = value;
  else if (key == "subset")
    path.subset = value;
  else if (key.rfind("option:", 0) == 0)
    throw InputError({name}, "asks for the option " + part + " of a driver, which is not passed on",
                     "take it out of the name");
  // A type of geometry is accepted and ignored: the caller knows which one it reads.
}

// The longest beginning of `path` that is a file with an archive's name.
std::string archive_of(const std::string& path) {
  for (std::size_t end = path.size(); end != std::string::npos && end > 0;
       end = path.rfind('/', end - 1)) {
    const std::string file = path.substr(0, end);
    if (!archive_prefix(file).empty() && is_file(file)) return file;
  }
  return "";
}

void find_file(SourcePath& path) {
  for (const char* prefix : {"/vsizip/", "/vsitar/", "/vsigzip/"}) {
    if (path.source.rfind(prefix, 0) != 0) continue;
    if (const std::string file = archive_of(path.source.substr(std::string(prefix).size()));
        !file.empty())
      path.file = file;
    return;
  }
  const std::string file = archive_of(path.source);
  if (file.empty() || (path.source != file && exists(path.source))) return;
  path.file = file;
  path.source = archive_prefix(file) + path.source;
}

}  // namespace

std::string without_layer(const std::string& name) {
  return name.substr(0, exists(name) ? std::string::npos : next_part(name, 0));
}

std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string("_-+=,./@:%").find(c) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_words(const std::string& name) {
  const SourcePath path = parse_source_path(name);
  return shell_word(path.source) + (path.layer.empty() ? "" : " " + shell_word(path.layer)) +
         (path.subset.empty() ? "" : " -where " + shell_word(path.subset));
}

std::string archive_prefix(const std::string& file) {
  const std::string name = lower(file);
  if (name.ends_with(".zip")) return "/vsizip/";
  if (name.ends_with(".tar") || name.ends_with(".tgz") || name.ends_with(".tar.gz"))
    return "/vsitar/";
  return name.ends_with(".gz") ? "/vsigzip/" : "";
}

bool is_table_name(const std::string& path) {
  const std::string name = lower(path);
  for (const char* end : {".csv", ".tsv", ".txt", ".xyz", ".pts"})
    if (name.ends_with(end)) return true;
  return false;
}

SourcePath parse_source_path(const std::string& name) {
  std::size_t bar = exists(name) ? std::string::npos : next_part(name, 0);
  SourcePath path;
  path.file = path.source = name.substr(0, bar);
  while (bar != std::string::npos) {
    const bool is_last = lower(name).compare(bar + 1, 7, "subset=") == 0;
    const std::size_t next = is_last ? std::string::npos : next_part(name, bar + 1);
    take_part(name.substr(bar + 1, next == std::string::npos ? next : next - bar - 1), name, path);
    bar = next;
  }
  find_file(path);
  const std::size_t at = name.find(path.file);
  path.inside = at == std::string::npos ? "" : name.substr(at + path.file.size());
  return path;
}

}  // namespace talus
