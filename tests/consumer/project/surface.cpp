// SPDX-License-Identifier: LGPL-3.0-or-later
// All components in one program: the surface of argv[1] is read, filled with tetrahedra and certified.
#include <cellwalk/environment/environment.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <cstdio>

int main(int, char** argv) {
  using namespace cellwalk;
  try {
    Build_report report;
    const auto environment = Environment<3>::build(tetrahedralize(io::read_surface(argv[1])), {}, &report);
    std::printf("free volume %g\n", report.certificate.free_volume);
  } catch (const Error& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
