# SPDX-License-Identifier: LGPL-3.0-or-later
# Files for pkg-config: cellwalk (the core), cellwalk-io, cellwalk-meshing, cellwalk-loading. The libraries are static, so that each
# names all that it links; loading brings what it needs.
file(RELATIVE_PATH CELLWALK_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(CELLWALK_PC_LIBDIR ${CMAKE_INSTALL_LIBDIR})
set(CELLWALK_PC_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR})

# cellwalk_pkg_config(COMPONENT DESCRIPTION [REQUIRES ...] [LIBRARIES flags])
function(cellwalk_pkg_config component description)
  cmake_parse_arguments(PC "" "" "REQUIRES;LIBRARIES" ${ARGN})
  get_property(layers GLOBAL PROPERTY CELLWALK_LAYERS_${component})
  list(REVERSE layers)  # what links comes before what is linked
  list(TRANSFORM layers PREPEND -lcellwalk_)
  set(flags ${layers} ${PC_LIBRARIES})
  list(JOIN flags " " CELLWALK_PC_LIBS)
  list(JOIN PC_REQUIRES " " CELLWALK_PC_REQUIRES)
  set(CELLWALK_PC_DESCRIPTION ${description})
  set(CELLWALK_PC_NAME cellwalk-${component})
  if(component STREQUAL core)
    set(CELLWALK_PC_NAME cellwalk)
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/cellwalk.pc.in ${PROJECT_BINARY_DIR}/${CELLWALK_PC_NAME}.pc @ONLY)
  cellwalk_package_of(package ${component})
  install(FILES ${PROJECT_BINARY_DIR}/${CELLWALK_PC_NAME}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT ${package})
endfunction()

set(dl_flags ${CMAKE_DL_LIBS})
list(TRANSFORM dl_flags PREPEND -l)
# Modules and helpers are found by the folder of the prefix, wherever that has been moved.
set(run_path "-Wl,-rpath,\${libdir}/cellwalk")
cellwalk_pkg_config(core "${PROJECT_DESCRIPTION}" LIBRARIES -ltbb -lfmt -lmpfr -lgmp ${dl_flags} -pthread)
cellwalk_pkg_config(io "Readers and writers of Cellwalk" REQUIRES cellwalk LIBRARIES -lz ${run_path})
set(loading_requires)
if(TARGET cellwalk::meshing)
  cellwalk_pkg_config(meshing "Surfaces and polygons to environments, for Cellwalk" REQUIRES cellwalk LIBRARIES ${run_path})
  list(APPEND loading_requires cellwalk-meshing)
endif()
cellwalk_pkg_config(loading "Environments from files, for Cellwalk" REQUIRES ${loading_requires} cellwalk-io cellwalk)
