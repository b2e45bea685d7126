# SPDX-License-Identifier: LGPL-3.0-or-later
# Every third-party package is found here, once, with its licence and what it turns on.
find_package(Threads REQUIRED)
find_package(CGAL 5.5 REQUIRED)            # LGPL part: Linear_cell_complex, kernels
find_package(Boost 1.74 REQUIRED)          # BSL: R-tree, exact integers
find_package(Eigen3 3.4 REQUIRED NO_MODULE)# MPL2: linear algebra of simulation
find_package(TBB REQUIRED)                 # Apache 2: parallel compilation of snapshots
find_package(fmt 9 REQUIRED)               # MIT: text output
find_package(nlohmann_json 3.11 REQUIRED)  # MIT: scenes, reports
