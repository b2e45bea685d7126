// SPDX-License-Identifier: LGPL-3.0-or-later
// Glues two tetrahedra and compiles their snapshot.
#include <cellwalk/environment/gluing.h>
#include <cellwalk/environment/snapshot.h>

#include <cstdio>

int main() {
  using namespace cellwalk;
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  add_tetrahedron(soup, 0, 1, 2, 3);
  add_tetrahedron(soup, 1, 2, 3, 4);
  const auto snapshot = Snapshot<3>::compile(soup, glue(soup));
  std::printf("compiled %zu cells\n", snapshot.cell_count());
  return 0;
}
