// SPDX-License-Identifier: LGPL-3.0-or-later
// A particle in two rooms: it walks to the other one through the cells between, and is stopped by the wall behind.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/generate/grid.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <cstdio>

int main() {
  using namespace cellwalk;
  Grid_options<3> grid;
  grid.cells = {4, 2, 2};
  const auto environment = Environment<3>::build(hex_grid(grid));  // certified, or an Error says why not
  const Snapshot<3>& snapshot = environment.snapshot();

  Particle<3> particle = Locator<3>(snapshot).particle_at({0.5, 0.5, 0.5});
  Walk_counts counts;
  for (const Point<3>& target : {Point<3>{3.5, 1.5, 0.5}, Point<3>{5.5, 1.5, 0.5}}) {
    const Walk_result<3> result = move(snapshot, particle, target, counts);
    if (result.contact)
      std::printf("stopped at time %g by the wall x = %g\n", result.contact->time, result.contact->point[0]);
    else
      std::printf("arrived through %u cells\n", result.cells);
  }
}
