# What is installed beside the tools, and the Debian package (cpack in the build folder).
# Man pages are made from --help by help2man where that is there.
get_property(tools GLOBAL PROPERTY TALUS_TOOLS)

install(DIRECTORY pipelines/ DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/pipelines
        FILES_MATCHING PATTERN "*.mk" PATTERN "*.sh" PATTERN "*.smk" PATTERN "demo.sh" EXCLUDE
        PATTERN "install_packages.sh" EXCLUDE PATTERN "release.sh" EXCLUDE)
foreach(site designed maungawhau)
  install(DIRECTORY sample_sites/${site} DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/sample_sites
          PATTERN out EXCLUDE PATTERN Makefile EXCLUDE)
endforeach()
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSES/GPL-3.0-or-later.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(PROGRAMS share/talus.sh RENAME talus DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(tool talus ${tools})
  install(FILES share/bash-completion/talus RENAME ${tool}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endforeach()

# The QGIS plug-in: a zip to install from within QGIS (target qgis-plugin), and with the package at the place
# where QGIS of Debian looks for plug-ins.
file(GLOB qgis_plugin_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/qgis/talus/*)
list(FILTER qgis_plugin_files EXCLUDE REGEX "__pycache__")
install(FILES ${qgis_plugin_files} DESTINATION ${CMAKE_INSTALL_DATADIR}/qgis/python/plugins/talus)
set(qgis_plugin_zip ${CMAKE_CURRENT_BINARY_DIR}/talus-qgis-${PROJECT_VERSION}.zip)
list(TRANSFORM qgis_plugin_files REPLACE "^${PROJECT_SOURCE_DIR}/qgis/" "" OUTPUT_VARIABLE qgis_plugin_names)
add_custom_command(OUTPUT ${qgis_plugin_zip} DEPENDS ${qgis_plugin_files} VERBATIM
  COMMAND ${CMAKE_COMMAND} -E tar cf ${qgis_plugin_zip} --format=zip --mtime=2000-01-01 -- ${qgis_plugin_names}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/qgis)
add_custom_target(qgis-plugin ALL DEPENDS ${qgis_plugin_zip})
install(FILES ${qgis_plugin_zip} DESTINATION ${CMAKE_INSTALL_DATADIR}/talus)

# The Python package, which is a Debian package of its own.
install(DIRECTORY python/talus DESTINATION lib/python3/dist-packages COMPONENT python
        FILES_MATCHING PATTERN "*.py")

find_program(HELP2MAN help2man)
if(HELP2MAN)
  foreach(tool ${tools})
    set(page ${CMAKE_CURRENT_BINARY_DIR}/man/${tool}.1)
    add_custom_command(OUTPUT ${page} DEPENDS ${tool} VERBATIM
      COMMAND ${CMAKE_COMMAND} -DHELP2MAN=${HELP2MAN} -DTOOL=$<TARGET_FILE:${tool}> -DPAGE=${page}
              -DDOC=${PROJECT_SOURCE_DIR}/docs/tools/${tool}.md -P ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake)
    list(APPEND pages ${page})
  endforeach()
  add_custom_target(man ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
else()
  message(STATUS "help2man was not found: no man pages")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME talus)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Talus developers <talus@invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "rockslide hazard from a contour map by discontinuous deformation analysis")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL Unspecified python)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME talus)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_DEPENDS fonts-dejavu-core)  # the letters of maps
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_RECOMMENDS "make, gdal-bin")
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SUGGESTS "qgis, bash-completion, python3-talus")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-talus)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3-netcdf4, python3-pandas, python3-xarray")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS talus)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "runs of Talus as tables of pandas and arrays of xarray")
include(CPack)
