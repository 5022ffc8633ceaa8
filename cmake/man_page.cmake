# man_page.cmake -DHELP2MAN= -DTOOL= -DPAGE= -DDOC=: the man page of a tool from its --help; the name
# line is the first paragraph of its page in docs/tools.
cmake_policy(VERSION 3.25)
cmake_path(GET PAGE PARENT_PATH folder)
file(MAKE_DIRECTORY ${folder})
file(READ ${DOC} text LIMIT 1000)
string(REGEX MATCH "^#[^\n]*\n\n([^\n]*)" found "${text}")
string(REGEX REPLACE "[.`]" "" purpose "${CMAKE_MATCH_1}")
execute_process(COMMAND ${HELP2MAN} --no-info --no-discard-stderr --section=1 "--name=${purpose}"
                        --manual=Talus --output=${PAGE} ${TOOL} COMMAND_ERROR_IS_FATAL ANY)
