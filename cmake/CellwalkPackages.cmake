# SPDX-License-Identifier: LGPL-3.0-or-later
# Debian packages by CPack, one for each component of the install rules:
#   cellwalk                 tools    the program
#   libcellwalk-dev          dev      headers and libraries of the core, which need no reader's libraries
#   cellwalk-readers         readers  modules that the program, the Python module and programs of users load to read by VTK
#   cellwalk-mpi             mpi      the module by which the program shares its work among the processes of mpirun
#   cellwalk-meshers         meshers  programs that the program, the Python module and programs of users run to mesh by TetGen and Mesh_3
#   libcellwalk-io-dev       io       those of io
#   libcellwalk-meshing-dev  meshing  those of meshing and loading, which need the GPL part
#   python3-cellwalk         python   the Python module
# Configure with CMAKE_INSTALL_PREFIX=/usr; scripts/package.sh does.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cellwalk)
set(CPACK_PACKAGE_VENDOR Cellwalk)
# Who builds packages for others puts an address of their own here. The default reaches nobody, on purpose (RFC 2606).
set(CELLWALK_PACKAGE_CONTACT "Cellwalk maintainers <maintainers@cellwalk.invalid>" CACHE STRING
    "Maintainer of the Debian packages: NAME <ADDRESS>")
if(NOT CELLWALK_PACKAGE_CONTACT MATCHES "^[^<>\n]*[^<> \n] <[^<>@ \n]+@[^<>@ \n]+>$")
  message(FATAL_ERROR "CELLWALK_PACKAGE_CONTACT is '${CELLWALK_PACKAGE_CONTACT}': Debian wants NAME <ADDRESS>, as in "
                      "-DCELLWALK_PACKAGE_CONTACT='Ada Lovelace <ada@example.org>'")
endif()
set(CPACK_PACKAGE_CONTACT "${CELLWALK_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libcellwalk-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libcgal-dev, libboost-dev, libtbb-dev, libfmt-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libcellwalk-io-dev, libcellwalk-meshing-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "${PROJECT_DESCRIPTION}: headers and static libraries of the core")

# What reads by VTK is loaded at run time, so that nobody needs its development packages, which bring Java and Qt.
set(readers)
if(TARGET VTK::IOXML)
  list(APPEND CPACK_COMPONENTS_ALL readers)
  set(readers "cellwalk-readers (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_READERS_PACKAGE_NAME cellwalk-readers)
  set(CPACK_DEBIAN_READERS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_COMPONENT_READERS_DESCRIPTION "Readers of meshes by VTK, for Cellwalk")
endif()

# Meshers run in programs of their own, so that nobody needs their development packages either.
set(meshers)
if(TARGET cellwalk::meshing)
  list(APPEND CPACK_COMPONENTS_ALL meshers)
  set(meshers "cellwalk-meshers (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_MESHERS_PACKAGE_NAME cellwalk-meshers)
  set(CPACK_DEBIAN_MESHERS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_COMPONENT_MESHERS_DESCRIPTION "Meshers of surfaces by TetGen (AGPL) and Mesh_3 (GPL), for Cellwalk")
endif()

if(TARGET cellwalk_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_NAME cellwalk-mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS openmpi-bin)
  set(CPACK_COMPONENT_MPI_DESCRIPTION "Runs of Cellwalk shared among the processes of mpirun (Open MPI)")
endif()

list(APPEND CPACK_COMPONENTS_ALL io)
set(io_depends "libcellwalk-dev (= ${PROJECT_VERSION})" zlib1g-dev ${readers})
list(JOIN io_depends ", " CPACK_DEBIAN_IO_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_IO_PACKAGE_NAME libcellwalk-io-dev)
set(CPACK_DEBIAN_IO_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_IO_DESCRIPTION "Readers and writers of Cellwalk, for libcellwalk-dev")

list(APPEND CPACK_COMPONENTS_ALL meshing)
set(CPACK_DEBIAN_MESHING_PACKAGE_NAME libcellwalk-meshing-dev)
set(CPACK_DEBIAN_MESHING_PACKAGE_SECTION libdevel)
set(meshing_depends "libcellwalk-io-dev (= ${PROJECT_VERSION})" ${meshers})
list(JOIN meshing_depends ", " CPACK_DEBIAN_MESHING_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_MESHING_DESCRIPTION "Environments of surfaces, polygons and files, for libcellwalk-dev (GPL)")

set(licences dev io meshing)
if(readers)
  list(APPEND licences readers)
endif()
if(meshers)
  list(APPEND licences meshers)
endif()
if(TARGET cellwalk_mpi)
  list(APPEND licences mpi)
endif()
if(TARGET cellwalk_cli)
  list(APPEND CPACK_COMPONENTS_ALL tools)
  list(APPEND licences tools)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME cellwalk)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
  set(tools_depends ${readers} ${meshers})
  list(JOIN tools_depends ", " CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS cellwalk-mpi)
  set(CPACK_COMPONENT_TOOLS_DESCRIPTION "${PROJECT_DESCRIPTION}: the program")
endif()
if(TARGET cellwalk_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND licences python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-cellwalk)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(python_depends "python3 (>= 3.${Python3_VERSION_MINOR}~)" "python3 (<< 3.${next_minor})" python3-numpy ${readers} ${meshers})
  list(JOIN python_depends ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${PROJECT_DESCRIPTION}: the Python module")
endif()

# Everything but the core is under the GPL where it is built with parts that are.
foreach(component ${licences})
  string(TOUPPER ${component} upper)
  set(licence LICENSE)
  if(NOT component MATCHES "^(dev|io|readers|mpi)$" AND TARGET cellwalk::meshing)
    set(licence COPYING.GPL)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/${licence} RENAME copyright COMPONENT ${component}
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()
include(CPack)
