# Writes the header that names the commit, where it has changed: cmake -DROOT=... -DHEADER=... -P write_commit.cmake
execute_process(COMMAND git -C ${ROOT} describe --always --dirty=+ --exclude=* OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(text "// Made by the build.\n#define JAROL_COMMIT \"${commit}\"\n")
set(old "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${HEADER} ${text})
endif()
