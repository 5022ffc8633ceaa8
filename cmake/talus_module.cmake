# talus_module(NAME [DEPENDS module...]): one folder with its subfolders, one target.
#
# Plain sources become talus_NAME, which needs Eigen and the modules it depends on. A source whose
# name ends in _boost, _cairo, _cgal, _crypto, _gdal, _hdf5, _json, _sqlite or _toml becomes part of
# talus_NAME_cgal and so on, which alone sees that library. A tool therefore links what it uses and nothing else.

option(TALUS_TOGETHER "Compile several sources of a target as one" ON)

add_library(talus_options INTERFACE)
target_compile_options(talus_options INTERFACE -Wall -Wextra -Wpedantic -Werror)
if(TALUS_TOGETHER)
  # A tool takes from a group what it calls, and needs no library that the rest of the group calls.
  target_compile_options(talus_options INTERFACE -ffunction-sections -fdata-sections)
  target_link_options(talus_options INTERFACE LINKER:--gc-sections)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # which takes a source of a group for a header
    target_compile_options(talus_options INTERFACE -Wno-subobject-linkage)
  endif()
else()  # in a group, a local name may be that of a function of another source
  target_compile_options(talus_options INTERFACE -Wshadow)
endif()
target_include_directories(talus_options INTERFACE ${PROJECT_SOURCE_DIR}/libcore ${PROJECT_SOURCE_DIR})

# What moves blocks is compiled with options of its own.
set(TALUS_ENGINE_OPTIONS "" CACHE STRING "Options of the engine's modules beside those of all sources")
set(talus_engine geometry motion terrain contact solver scene step paper record)

# The headers that nearly every source includes are compiled once for each set of options: g++ takes
# the optimisation level of a precompiled header for all that is compiled with it. A source names all
# that it uses nevertheless: the preset asan builds without this.
option(TALUS_PRECOMPILED "Compile the common headers of libcore, tools and tests once" ON)
set(talus_common_headers <Eigen/Geometry> <algorithm> <array> <cmath> <functional> <map> <optional>
    <span> <string> <vector>)
function(talus_precompiled target owner)
  if(NOT TALUS_PRECOMPILED)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${talus_common_headers} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# Sources of a target are compiled several at a time, in groups whose names cannot meet: each group
# reads the headers once. A name added since the last configuration may meet another: configure again.
find_package(Python3 COMPONENTS Interpreter)
function(talus_together target)
  if(NOT TALUS_TOGETHER OR NOT Python3_FOUND)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_avx2\\.cpp$")  # code for wide registers stays apart
  list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
  execute_process(
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/source_groups.py ${PROJECT_SOURCE_DIR}/libcore 12 ${sources}
    OUTPUT_VARIABLE groups OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  foreach(source group IN ZIP_LISTS sources groups)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

set(TALUS_LIBRARY_boost Boost::headers)
set(TALUS_LIBRARY_cairo PkgConfig::pango)
set(TALUS_LIBRARY_cgal CGAL::CGAL)
set(TALUS_LIBRARY_crypto OpenSSL::Crypto)
set(TALUS_LIBRARY_gdal GDAL::GDAL PROJ::proj)
set(TALUS_LIBRARY_hdf5 hdf5::hdf5 hdf5::hdf5_hl)
set(TALUS_LIBRARY_json nlohmann_json::nlohmann_json)
set(TALUS_LIBRARY_sqlite SQLiteCpp SQLite::SQLite3)
set(TALUS_LIBRARY_toml tomlplusplus::tomlplusplus)

function(talus_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  set(plain ${sources})
  list(FILTER plain EXCLUDE REGEX "_(boost|cairo|cgal|crypto|gdal|hdf5|json|sqlite|toml)\\.cpp$")
  list(TRANSFORM ARG_DEPENDS PREPEND talus_ OUTPUT_VARIABLE modules)
  set(own_options "")
  set(owner talus_base)
  if(TALUS_ENGINE_OPTIONS AND name IN_LIST talus_engine)
    set(own_options ${TALUS_ENGINE_OPTIONS})
    set(owner talus_geometry)  # the first of them
  endif()

  if(plain)
    add_library(talus_${name} STATIC ${plain})
    target_compile_options(talus_${name} PRIVATE ${own_options})
    talus_precompiled(talus_${name} ${owner})
    talus_together(talus_${name})
    set(scope PUBLIC)
  else()
    add_library(talus_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_link_libraries(talus_${name} ${scope} talus_options Eigen3::Eigen ${modules})

  foreach(library boost cairo cgal crypto gdal hdf5 json sqlite toml)
    set(own ${sources})
    list(FILTER own INCLUDE REGEX "_${library}\\.cpp$")
    if(own)
      add_library(talus_${name}_${library} STATIC ${own})
      target_compile_options(talus_${name}_${library} PRIVATE ${own_options})
      talus_precompiled(talus_${name}_${library} ${owner})
      talus_together(talus_${name}_${library})
      target_link_libraries(talus_${name}_${library} PUBLIC talus_${name}
                            PRIVATE ${TALUS_LIBRARY_${library}})
      foreach(module ${modules})  # io_hdf5 serves store_hdf5
        if(TARGET ${module}_${library})
          target_link_libraries(talus_${name}_${library} PUBLIC ${module}_${library})
        endif()
      endforeach()
    endif()
  endforeach()
endfunction()

# All parts of a module: the plain target and those with a library.
function(talus_module_parts module out)
  set(parts talus_${module})
  foreach(library boost cairo cgal crypto gdal hdf5 json sqlite toml)
    if(TARGET talus_${module}_${library})
      list(APPEND parts talus_${module}_${library})
    endif()
  endforeach()
  set(${out} ${parts} PARENT_SCOPE)
endfunction()
