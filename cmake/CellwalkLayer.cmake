# SPDX-License-Identifier: LGPL-3.0-or-later
# cellwalk_layer(NAME SOURCES ... LINKS ... PRIVATE_LINKS ...): one static library per layer, linked downward only.
function(cellwalk_layer name)
  cmake_parse_arguments(LAYER "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  set(target cellwalk_${name})
  if(LAYER_SOURCES)
    add_library(${target} STATIC ${LAYER_SOURCES})
    target_include_directories(${target} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
    target_link_libraries(${target} PUBLIC cellwalk::options ${LAYER_LINKS}
      PRIVATE $<BUILD_INTERFACE:cellwalk_warnings> ${LAYER_PRIVATE_LINKS})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
    target_link_libraries(${target} INTERFACE cellwalk::options ${LAYER_LINKS})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(cellwalk::${name} ALIAS ${target})
endfunction()
