# Run at every build: writes OUTPUT when the commit has changed, so that nothing else is rebuilt.
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=10 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT commit)
  set(commit unknown)
else()
  # pages are no part of the tools: studies write them while others still build
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no -- . ":(exclude)docs"
                  OUTPUT_VARIABLE changed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(changed)
    string(APPEND commit -dirty)
  endif()
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
