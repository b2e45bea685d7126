# SPDX-License-Identifier: LGPL-3.0-or-later
# cellwalk_layer(NAME [COMPONENT core|io|meshing|loading|none] [HOT | COLD] [BATCHES N] SOURCES ... LINKS ... PRIVATE_LINKS ...)
#
# One static library per layer, linked downward only, installed and exported with its component, or not at all: none. The compiler
# refuses GPL headers of CGAL in every component but meshing, however deep they are included.
#
# Three folders of headers: include/ is what users include; src/shared/ what layers share, <cellwalk/internal/LAYER/...>, of which
# only what public headers need is installed; and in src/LAYER/ lies what is a layer's own.
# HOT, COLD and BATCHES: see cellwalk_compile().
function(cellwalk_layer name)
  cmake_parse_arguments(LAYER "HOT;COLD" "COMPONENT;BATCHES" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  if(NOT LAYER_COMPONENT)
    set(LAYER_COMPONENT core)
  endif()
  set(heat)
  if(LAYER_HOT)
    set(heat HOT)
  elseif(LAYER_COLD)
    set(heat COLD)
  endif()
  set(target cellwalk_${name})
  if(LAYER_SOURCES)
    add_library(${target} STATIC ${LAYER_SOURCES})
    target_include_directories(${target}
      PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src/shared>
             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
      PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target} PUBLIC cellwalk::options ${LAYER_LINKS}
      PRIVATE $<BUILD_INTERFACE:cellwalk_warnings> ${LAYER_PRIVATE_LINKS})
    if(NOT LAYER_COMPONENT STREQUAL meshing)
      target_compile_definitions(${target} PRIVATE CGAL_LICENSE_ERROR)
    endif()
    cellwalk_compile(${target} ${heat} BATCHES ${LAYER_BATCHES})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src/shared>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} INTERFACE cellwalk::options ${LAYER_LINKS})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(cellwalk::${name} ALIAS ${target})
  if(LAYER_COMPONENT STREQUAL none)
    return()
  endif()
  cellwalk_package_of(package ${LAYER_COMPONENT})
  install(TARGETS ${target} EXPORT cellwalk_${LAYER_COMPONENT} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT ${package})
  set_property(GLOBAL APPEND PROPERTY CELLWALK_LAYERS_${LAYER_COMPONENT} ${name})
endfunction()

# The package (a component of install rules and of CPack) that holds a component of the library: what needs the readers' libraries is
# apart, and so is what needs the GPL part.
function(cellwalk_package_of out component)
  if(component STREQUAL meshing OR component STREQUAL loading)
    set(${out} meshing PARENT_SCOPE)
  elseif(component STREQUAL io)
    set(${out} io PARENT_SCOPE)
  else()
    set(${out} dev PARENT_SCOPE)
  endif()
endfunction()
