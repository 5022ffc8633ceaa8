// Names of objects as names of files.
#include "tools/frame/object_files.hpp"

#include <map>

#include "base/error.hpp"
#include "base/file_paths.hpp"

namespace talus {

void check_object_files(const Site& site) {
  constexpr std::size_t longest = 100;
  std::map<std::string, std::string> object_of;  // file, name
  for (const ObjectSettings& object : site.objects) {
    const Where where{site.file, object.line_number, "object." + object.name};
    const std::string word = file_word(object.name);
    if (word.size() > longest)
      throw InputError(where,
                       "the name has " + std::to_string(word.size()) + " bytes, expected at most " +
                           std::to_string(longest) + " for a file",
                       "give it a shorter name, or leave --rasters out");
    const auto [known, is_new] = object_of.emplace(word, object.name);
    if (!is_new)
      throw InputError(
          where, "has the same raster as object " + known->second + ", source_" + word + ".tif",
          "give it a name that differs in letters or digits");
  }
}

}  // namespace talus
