# SPDX-License-Identifier: LGPL-3.0-or-later
# Install rules and the package that find_package(cellwalk COMPONENTS ...) reads.
#   core     LGPL  kernel to reshape                    target cellwalk::core; walks on any map of CGAL: target cellwalk::lcc, headers only
#   io       LGPL  readers and writers, pictures        targets cellwalk::io, cellwalk::drawing; its module for VTK is the component readers
#   meshing  GPL   meshing of surfaces and polygons     target cellwalk::meshing
#   loading  LGPL  environments from files (GPL where it is built with meshing)  target cellwalk::loading
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cellwalk)

# cellwalk::core stands for all layers of the core.
get_property(core_layers GLOBAL PROPERTY CELLWALK_LAYERS_core)
list(TRANSFORM core_layers PREPEND cellwalk::)
add_library(cellwalk_core INTERFACE)
add_library(cellwalk::core ALIAS cellwalk_core)
target_link_libraries(cellwalk_core INTERFACE ${core_layers})
set_target_properties(cellwalk_core PROPERTIES EXPORT_NAME core)
install(TARGETS cellwalk_options cellwalk_core EXPORT cellwalk_core COMPONENT dev)

set(CELLWALK_COMPONENTS core)
foreach(component io meshing loading)
  get_property(layers GLOBAL PROPERTY CELLWALK_LAYERS_${component})
  if(layers)
    list(APPEND CELLWALK_COMPONENTS ${component})
  endif()
endforeach()
foreach(component ${CELLWALK_COMPONENTS})
  cellwalk_package_of(package ${component})
  install(EXPORT cellwalk_${component} NAMESPACE cellwalk:: DESTINATION ${package_dir}
          FILE cellwalk-${component}.cmake COMPONENT ${package})
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/cellwalkConfig.cmake.in
  ${PROJECT_BINARY_DIR}/cellwalkConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cellwalkConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cellwalkConfig.cmake ${PROJECT_BINARY_DIR}/cellwalkConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT dev)

# Of the internal headers those that public ones include; tests/architecture knows if one is missing, or one too many.
set(installed_internals
  environment/cell_clusters.h
  environment/edit_log.h
  environment/flat_array.h
  environment/gluing.h
  environment/held_snapshot.h
  environment/planes.h
  environment/tissue_boxes.h
  kernel/box.h
  kernel/check_finite.h
  kernel/counts.h
  kernel/determinant.h
  kernel/next_double.h
  kernel/predicates.h
  kernel/uncertified.h
  lcc/cells.h
  lcc/choices.h
  lcc/exit.h
  lcc/obstacle.h
  lcc/place.h
  lcc/run.h
  lcc/signs.h
  lcc/star.h
  lcc/types.h
  walk/certified_exit.h
  walk/in_boundary.h walk/predictive_exit.h
  walk/link_search.h
  walk/sides_taken.h
  walk/signs.h
  walk/star.h)
foreach(header IN LISTS installed_internals)
  get_filename_component(layer ${header} DIRECTORY)
  cellwalk_package_of(package ${layer})
  install(FILES ${PROJECT_SOURCE_DIR}/src/shared/cellwalk/internal/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cellwalk/internal/${layer} COMPONENT ${package})
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/cellwalk DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev
        FILES_MATCHING PATTERN *.h PATTERN cli EXCLUDE PATTERN io EXCLUDE PATTERN meshing EXCLUDE PATTERN loading EXCLUDE)
# <cellwalk/cellwalk.h> includes it, whatever is installed.
install(FILES ${PROJECT_SOURCE_DIR}/include/cellwalk/loading/import.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cellwalk/loading COMPONENT dev)
foreach(component IN LISTS CELLWALK_COMPONENTS)
  if(NOT component STREQUAL core)
    cellwalk_package_of(package ${component})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/cellwalk/${component} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cellwalk
            COMPONENT ${package} FILES_MATCHING PATTERN *.h PATTERN import.h EXCLUDE)
  endif()
endforeach()

include(CellwalkPkgConfig)
include(CellwalkPackages)
