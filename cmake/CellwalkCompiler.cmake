# SPDX-License-Identifier: LGPL-3.0-or-later
# Compiler settings every target of the project shares, and the checks that exactness rests on.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# The error bounds of the certificates hold for IEEE arithmetic only.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" MATCHES "-ffast-math|-Ofast|-funsafe-math-optimizations")
  message(FATAL_ERROR "cellwalk decides exactly and needs IEEE arithmetic: remove -ffast-math, -Ofast "
                      "or -funsafe-math-optimizations from CMAKE_CXX_FLAGS")
endif()

add_library(cellwalk_options INTERFACE)
add_library(cellwalk::options ALIAS cellwalk_options)
set_target_properties(cellwalk_options PROPERTIES EXPORT_NAME options)
target_compile_features(cellwalk_options INTERFACE cxx_std_20)
# No contraction into fused multiply-adds: results are the same for every compiler.
target_compile_options(cellwalk_options INTERFACE -ffp-contract=off)

add_library(cellwalk_warnings INTERFACE)
target_compile_options(cellwalk_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  -Wcast-align -Wcast-qual -Wold-style-cast
  -Wconversion -Wno-sign-conversion # indices of points and facets are signed, sizes are not
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion> -Wformat=2
  -Wextra-semi -Wmissing-declarations -Wredundant-decls -Wundef -Wunused-macros
  -Wnon-virtual-dtor -Woverloaded-virtual -Wsuggest-override)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(cellwalk_warnings INTERFACE -Wduplicated-branches -Wduplicated-cond -Wlogical-op)
else()
  target_compile_options(cellwalk_warnings INTERFACE -Wno-overlength-strings) # the page of the viewer is one
endif()

# Off under sanitizers, whose instructions gcc takes for uses of what is not initialised.
option(CELLWALK_WERROR "Warnings are errors; without the option, the variable of this name in the environment" "$ENV{CELLWALK_WERROR}")
if(CELLWALK_WERROR)
  target_compile_options(cellwalk_warnings INTERFACE -Werror)
endif()

# Sources compile in batches (CMAKE_UNITY_BUILD, on in all presets but dev) in half the time: what a header costs is parsed and optimised
# once a batch. So names in anonymous namespaces must differ within a target. In a batch gcc takes sources for headers, in which types
# of anonymous namespaces would be a mistake, and sees Boost's vectors read what they do not read.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(cellwalk_warnings INTERFACE -Wno-subobject-linkage -Wno-stringop-overread)
endif()

# cellwalk_compile(TARGET [HOT | COLD] [BATCHES N])
#   HOT      what runs in each move: in a batch gcc would inline less than in a single source, at the price of 2 to 7 % of all instructions
#   COLD     what runs a few times in a run: -O1, which takes a third less time to compile
#   BATCHES  in how many batches the sources compile (1)
function(cellwalk_compile target)
  cmake_parse_arguments(COMPILE "HOT;COLD" "BATCHES" "" ${ARGN})
  if(COMPILE_HOT AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE --param=large-unit-insns=1000000)
  endif()
  if(COMPILE_COLD)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(NOT COMPILE_BATCHES)
    set(COMPILE_BATCHES 1)
  endif()
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  math(EXPR size "(${count} + ${COMPILE_BATCHES} - 1) / ${COMPILE_BATCHES}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${size})
endfunction()
