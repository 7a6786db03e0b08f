# Writes TARGET, the source of fsi::version() and fsi::commit(), where it changed: with every build, since
# the commit may be another one. cmake -D SOURCE=... -D TEMPLATE=... -D TARGET=... -D VERSION=... -P
set(COMMIT unknown)
find_program(GIT git)
if(GIT)
  # The sources may lie in the repository of something else, or belong to another user.
  set(git ${GIT} -c safe.directory=* -C ${SOURCE})
  execute_process(COMMAND ${git} rev-parse --show-prefix OUTPUT_VARIABLE prefix RESULT_VARIABLE outside
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(outside EQUAL 0 AND prefix STREQUAL "")
    execute_process(COMMAND ${git} describe --always --abbrev=12 --exclude=* --dirty=-modified
                    OUTPUT_VARIABLE found RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(failed EQUAL 0)
      set(COMMIT ${found})
    endif()
  endif()
elseif(EXISTS ${SOURCE}/.git/HEAD)
  # Without git, as in a container: what HEAD names, whatever was changed since.
  file(READ ${SOURCE}/.git/HEAD found)
  string(STRIP "${found}" found)
  string(REPLACE "ref: " "" branch "${found}")
  if(EXISTS "${SOURCE}/.git/${branch}")
    file(READ "${SOURCE}/.git/${branch}" found)
  endif()
  if(found MATCHES "^([0-9a-f]+)")
    string(SUBSTRING ${CMAKE_MATCH_1} 0 12 COMMIT)
  endif()
endif()
configure_file(${TEMPLATE} ${TARGET} @ONLY)
