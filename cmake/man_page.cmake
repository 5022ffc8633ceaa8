# man_page.cmake -DHELP2MAN= -DTOOL= -DPAGE= -DDOC=: the man page of a tool from its --help; the name
# line is the first paragraph of its page in docs/tools.
cmake_path(GET PAGE PARENT_PATH folder)
file(MAKE_DIRECTORY ${folder})
file(STRINGS ${DOC} lines)
list(FILTER lines EXCLUDE REGEX "^#")
list(GET lines 0 purpose)
string(REGEX REPLACE "\\.$" "" purpose "${purpose}")
execute_process(COMMAND ${HELP2MAN} --no-info --no-discard-stderr --section=1 --name=${purpose}
                        --manual=Talus --output=${PAGE} ${TOOL} COMMAND_ERROR_IS_FATAL ANY)
