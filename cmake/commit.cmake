# Writes a header with the commit of the sources, and touches it only where it has changed.
cmake_minimum_required(VERSION 3.25)
execute_process(
  COMMAND git -C ${SOURCE_DIR} describe --always --dirty
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "// The commit that is built.\n#pragma once\n#define LFD_COMMIT \"@commit@\"\n" @ONLY)
