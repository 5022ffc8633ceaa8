# What is installed beside the tools, and the Debian package (cpack in the build folder).
# Man pages are made from --help by help2man where that is there.
get_property(tools GLOBAL PROPERTY TALUS_TOOLS)

install(DIRECTORY pipelines/ DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/pipelines
        FILES_MATCHING PATTERN "*.mk" PATTERN "new_site.sh" PATTERN "clean.sh" PATTERN "run_outcomes.sh")
foreach(site designed maungawhau)
  install(DIRECTORY sample_sites/${site} DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/sample_sites
          PATTERN out EXCLUDE)
endforeach()
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
foreach(tool ${tools})
  install(FILES share/bash-completion/talus RENAME ${tool}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endforeach()

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
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "make, gdal-bin")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "qgis, bash-completion")
include(CPack)
