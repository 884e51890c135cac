# How everything is compiled: warnings are errors, sanitizers and clang-tidy on request.
set(LFD_SANITIZE "" CACHE STRING "Sanitizers for all targets, e.g. address,undefined")
option(LFD_FUZZ "Build the targets of tests/fuzz as fuzzers (clang)" OFF)
option(LFD_TIDY "Run clang-tidy beside every compile" OFF)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
if(LFD_TIDY)
  find_program(CLANG_TIDY_PROGRAM clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${CLANG_TIDY_PROGRAM})
endif()
if(LFD_SANITIZE)
  add_compile_options(-fsanitize=${LFD_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LFD_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized)  # GCC's manual: sanitizers make it warn of what is not so
  endif()
endif()
if(LFD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "LFD_FUZZ needs clang: -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address)
endif()

add_library(lfd_warnings INTERFACE)
target_compile_options(lfd_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
target_include_directories(lfd_warnings INTERFACE ${CMAKE_SOURCE_DIR})

# lfd_library(NAME SOURCES ... PUBLIC ... PRIVATE ...): a static library of one folder; links are listed by hand.
function(lfd_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} lfd_warnings)
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
endfunction()

# lfd_precompile(TARGET HEADERS...): headers that cost most of its files seconds each.
function(lfd_precompile target)
  # -fpch-preprocess: without it ccache keeps nothing that uses a precompiled header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  target_precompile_headers(${target} PRIVATE ${ARGN})
endfunction()

# The same in release builds only: so the other presets prove that files include what they need.
function(lfd_precompile_in_release target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    lfd_precompile(${target} ${ARGN})
  endif()
endfunction()

# lfd_program(NAME SOURCES ... LINKS ...): one executable in bin/, which is installed.
function(lfd_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} lfd_warnings)
  install(TARGETS ${name} DESTINATION usr/bin)
endfunction()
