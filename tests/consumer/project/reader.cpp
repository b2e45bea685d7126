// SPDX-License-Identifier: LGPL-3.0-or-later
// Readers in modules, loaded by a program that knows nothing of them: says how many cells each of its
// arguments holds.
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <cstdio>

int main(int count, char** files) {
  using namespace cellwalk;
  try {
    for (int i = 1; i < count; ++i) {
      const io::Mesh_file file = io::read_mesh(files[i]);
      std::printf("%s: %zu cells\n", file.report.format.c_str(), file.report.cells);
    }
  } catch (const Error& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
