// SPDX-License-Identifier: LGPL-3.0-or-later
// Builds an environment of two tetrahedra and walks a particle from one into the other.
#include <cellwalk/environment/environment.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <cstdio>

int main() {
  using namespace cellwalk;
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  add_tetrahedron(soup, 0, 1, 2, 3);
  add_tetrahedron(soup, 1, 2, 3, 4);
  const auto environment = Environment<3>::build(soup);

  Particle<3> particle = Locator<3>(environment.snapshot()).particle_at({0.1, 0.1, 0.1});
  Walk_counts counts;
  const auto result = move(environment.snapshot(), particle, {0.6, 0.6, 0.6}, counts);
  if (result.status != Walk_status::arrived) return 1;
  std::printf("arrived in cell %u after %u cells\n", environment.snapshot().index(result.cell), result.cells);
  return 0;
}
