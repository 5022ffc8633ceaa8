# talus_shipped_data(OUT FOLDER file...): a source OUT that holds files of FOLDER as text, declared in
# tools/shipped_data.hpp; made again when one of them changes.
function(talus_shipped_data out folder)
  set(entries "")
  foreach(name ${ARGN})
    cmake_path(SET path NORMALIZE ${PROJECT_SOURCE_DIR}/${folder}/${name})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    file(READ ${path} content)
    string(APPEND entries "    {\"${name}\", R\"talus(${content})talus\"},\n")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${out}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include "tools/frame/shipped_data.hpp"

#include <map>

#include "base/error.hpp"

namespace talus {
namespace {

const std::map<std::string, std::string>& files() {
  static const std::map<std::string, std::string> map = {
@entries@  };
  return map;
}

}  // namespace

const std::string& shipped_data(const std::string& name) {
  const auto at = files().find(name);
  if (at == files().end()) throw InputError({name}, "is not a data file that is shipped");
  return at->second;
}

std::vector<std::string> shipped_names(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& [name, content] : files())
    if (name.starts_with(folder)) names.push_back(name);
  return names;
}

}  // namespace talus
]])
  # clang warns of texts above 65,536 bytes, which both compilers take
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  set(${out} ${source} PARENT_SCOPE)
endfunction()
