# talus_shipped_data(OUT FOLDER file...): a source OUT that holds files of FOLDER as text, declared in
# tools/shipped_data.hpp; made again when one of them changes.
function(talus_shipped_data out folder)
  set(entries "")
  foreach(name ${ARGN})
    set(path ${PROJECT_SOURCE_DIR}/${folder}/${name})
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

const std::string& shipped_data(const std::string& name) {
  static const std::map<std::string, std::string> files = {
@entries@  };
  const auto at = files.find(name);
  if (at == files.end()) throw InputError({name}, "is not a data file that is shipped");
  return at->second;
}

}  // namespace talus
]])
  # clang warns of texts above 65,536 bytes, which both compilers take
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  set(${out} ${source} PARENT_SCOPE)
endfunction()
