# Run at every build: writes OUTPUT when the commit has changed, so that nothing else is rebuilt.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=10 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT commit)
  set(commit unknown)
endif()
execute_process(COMMAND git -C ${SOURCE} show --no-patch --format=%cs HEAD
                OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT date)
  set(date unknown)
endif()
set(text "#include \"tools/frame/build_info.hpp\"\n\nnamespace talus {\nconst char* const build_version = \"${VERSION}\";\nconst char* const build_commit = \"${commit}\";\nconst char* const build_commit_date = \"${date}\";\n}  // namespace talus\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${text}" STREQUAL "${old}")
  file(WRITE ${OUTPUT} "${text}")
endif()
