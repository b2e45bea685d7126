# SPDX-License-Identifier: LGPL-3.0-or-later
# The page of `cellwalk view`, made of viewer/ by Node with the packages that viewer/package-lock.json names.
#
#   CELLWALK_WITH_VIEWER  AUTO (default): in where Node and its packages are to be had; ON: an error where not; OFF: left out
#
# Sets CELLWALK_VIEWER_PAGE, a C++ source, where the page can be made; CELLWALK_NODE and CELLWALK_VIEWER_MODULES for tests.
set(CELLWALK_WITH_VIEWER AUTO CACHE STRING "Make the page of cellwalk view with Node: AUTO, ON or OFF")
set_property(CACHE CELLWALK_WITH_VIEWER PROPERTY STRINGS AUTO ON OFF)

# Installs the packages beside the build, once for each lock file; what is wrong goes to `problem`.
function(cellwalk_viewer_modules problem)
  find_program(CELLWALK_NODE NAMES node nodejs)
  find_program(CELLWALK_NPM NAMES npm)
  if(NOT CELLWALK_NODE OR NOT CELLWALK_NPM)
    set(${problem} "Node.js and npm are not installed" PARENT_SCOPE)
    return()
  endif()
  execute_process(COMMAND ${CELLWALK_NODE} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(version VERSION_LESS v18)
    set(${problem} "Node.js is ${version}, and 18 or later is needed" PARENT_SCOPE)
    return()
  endif()
  set(folder ${PROJECT_BINARY_DIR}/viewer)
  file(SHA256 ${PROJECT_SOURCE_DIR}/viewer/package-lock.json lock)
  set(omitted "")
  if(NOT CELLWALK_BUILD_TESTS)
    set(omitted --omit=dev)
  endif()
  set(stamp ${folder}/installed-${lock}${omitted})
  if(NOT EXISTS ${stamp})
    message(STATUS "Viewer: installing the packages of viewer/package-lock.json")
    file(COPY ${PROJECT_SOURCE_DIR}/viewer/package.json ${PROJECT_SOURCE_DIR}/viewer/package-lock.json DESTINATION ${folder})
    execute_process(COMMAND ${CELLWALK_NPM} ci ${omitted} --ignore-scripts --no-audit --no-fund --prefer-offline
        --fetch-retries=1 --fetch-timeout=60000
      WORKING_DIRECTORY ${folder} RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
    if(NOT result EQUAL 0)
      file(WRITE ${folder}/npm.log "${said}")
      set(${problem} "npm ci failed, see ${folder}/npm.log" PARENT_SCOPE)
      return()
    endif()
    file(TOUCH ${stamp})
  endif()
  set(${problem} "" PARENT_SCOPE)
endfunction()

if(CELLWALK_WITH_VIEWER)
  cellwalk_viewer_modules(viewer_problem)
  if(viewer_problem AND CELLWALK_WITH_VIEWER STREQUAL "ON")
    message(FATAL_ERROR "CELLWALK_WITH_VIEWER is ON, but ${viewer_problem}. Debian: apt-get install nodejs npm")
  elseif(viewer_problem)
    message(STATUS "Viewer: left out: ${viewer_problem}")
  else()
    set(CELLWALK_VIEWER_MODULES ${PROJECT_BINARY_DIR}/viewer/node_modules)
    set(CELLWALK_VIEWER_PAGE ${PROJECT_BINARY_DIR}/viewer/viewer_page.cpp)
    file(GLOB viewer_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/viewer/src/* ${PROJECT_SOURCE_DIR}/viewer/build.mjs)
    add_custom_command(OUTPUT ${CELLWALK_VIEWER_PAGE}
      COMMAND ${CMAKE_COMMAND} -E env VIEWER_MODULES=${CELLWALK_VIEWER_MODULES}
        ${CELLWALK_NODE} ${PROJECT_SOURCE_DIR}/viewer/build.mjs ${CELLWALK_VIEWER_PAGE}
      DEPENDS ${viewer_sources} ${PROJECT_SOURCE_DIR}/viewer/package-lock.json
      COMMENT "Making the page of cellwalk view" VERBATIM)
    # The program is made in another folder, which sees targets of this one, but no rules.
    add_custom_target(cellwalk_viewer_page DEPENDS ${CELLWALK_VIEWER_PAGE})
    message(STATUS "Viewer: in")
  endif()
endif()
