# Writes OUTPUT, a header with the version and the commit, when its content changes. Run at build time, because a
# commit does not configure anew: cmake -DSOURCE=... -DVERSION=... -DOUTPUT=... -P version.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR commit STREQUAL "")
  set(commit unknown)
endif()
file(WRITE ${OUTPUT}.new "#define HEXFIELD_VERSION \"${VERSION}\"\n#define HEXFIELD_GIT \"${commit}\"\n")
execute_process(COMMAND ${CMAKE_COMMAND} -E copy_if_different ${OUTPUT}.new ${OUTPUT})
