# SPDX-License-Identifier: LGPL-3.0-or-later
# Every third-party package is found here, once, with its licence and what it turns on.
if(POLICY CMP0167)  # Boost is found by its own configuration, by CGAL's too
  cmake_policy(SET CMP0167 NEW)
  set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)
endif()
find_package(Threads REQUIRED)
find_package(CGAL 5.5 REQUIRED)             # LGPL part: Linear_cell_complex, kernels
find_package(Boost 1.74 REQUIRED)           # BSL: R-tree, exact integers
find_package(Eigen3 3.4 REQUIRED NO_MODULE) # MPL2: linear algebra of simulation, which is not installed
find_package(TBB REQUIRED)                  # Apache 2: parallel compilation of snapshots
find_package(fmt 9 REQUIRED)                # MIT: text output
find_package(ZLIB REQUIRED)                 # zlib: input compressed with gzip
find_path(CELLWALK_XXHASH_DIR xxhash.h REQUIRED DOC "Folder of xxhash.h 0.8 or newer (package libxxhash-dev)")
add_library(cellwalk_xxhash INTERFACE IMPORTED)  # BSD: checksums of compiled environments
target_include_directories(cellwalk_xxhash SYSTEM INTERFACE ${CELLWALK_XXHASH_DIR})
find_package(nlohmann_json 3.11 REQUIRED)   # MIT: scenes, reports
if(CELLWALK_BUILD_CLI)
  find_package(CLI11 2.1 REQUIRED)          # BSD: command line
endif()

# Optional parts: sought where wanted, used where found; `cellwalk --version` tells.
if(CELLWALK_WITH_MESHING)
  find_package(TetGen)                      # AGPL: closed surfaces to tetrahedra, boundary kept
endif()
if(CELLWALK_BUILD_TESTS)
  find_package(Gmsh)                        # GPL: writes files for tests of readers; nothing else uses it
endif()
if(CELLWALK_WITH_VTK)
  find_package(VTK 9.1 QUIET COMPONENTS CommonCore CommonDataModel IOLegacy IOXML)  # BSD: .vtk, .vtu
  message(STATUS "VTK: ${VTK_FOUND} ${VTK_VERSION}")
endif()

set(CELLWALK_HAS_MPI OFF)
if(CELLWALK_WITH_MPI)
  find_package(MPI QUIET COMPONENTS CXX)
  if(MPI_CXX_FOUND)
    find_package(Boost 1.74 QUIET OPTIONAL_COMPONENTS mpi)  # BSL: Boost.MPI, on Open MPI (BSD)
  endif()
  # Which processes mpirun starts, only Open MPI tells by the variables that are looked at.
  if(TARGET Boost::mpi AND MPI_CXX_LIBRARIES MATCHES "openmpi")
    set(CELLWALK_HAS_MPI ON)
  endif()
  message(STATUS "MPI: ${CELLWALK_HAS_MPI} ${MPI_CXX_VERSION}")
endif()

# The system's Python is the one whose packages the system's pybind11 and NumPy belong to.
if(CELLWALK_WITH_PYTHON)
  if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Interpreter that the Python module is built for")
  endif()
  find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  if(Python3_FOUND)
    set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})  # as pybind11 calls it
    find_package(pybind11 2.10 QUIET)         # BSD: the Python module
  endif()
  if(NOT pybind11_FOUND AND NOT CELLWALK_WITH_PYTHON STREQUAL "AUTO")
    message(FATAL_ERROR "CELLWALK_WITH_PYTHON needs pybind11, NumPy and the headers of Python 3.9 or newer "
                        "(packages pybind11-dev python3-numpy python3-dev); AUTO does without them")
  endif()
  message(STATUS "Python module: ${pybind11_FOUND} ${Python3_VERSION}")
endif()
