// SPDX-License-Identifier: LGPL-3.0-or-later
// A particle walks through a grid of cells until a wall stops it.
//! [walk]
#include <cellwalk/cellwalk.h>

#include <cstdio>

int main() {
  using namespace cellwalk;
  //! [short]
  const auto environment = Environment<3>::build(hex_grid({.cells = {4, 2, 2}}));  // certified, or an Error
  const Snapshot<3>& snapshot = environment.snapshot();
  Particle<3> particle = Locator<3>(snapshot).particle_at({0.5, 0.5, 0.5}).value();
  Walk_counts counts;
  for (const Point<3>& target : {Point<3>{3.5, 1.5, 0.5}, Point<3>{5.5, 1.5, 0.5}}) {
    const Walk_result<3> result = move(snapshot, particle, target, counts);
    if (result.contact)
      std::printf("stopped at time %g by the wall x = %g\n", result.contact->time, result.contact->point[0]);
    else
      std::printf("arrived through %u cells\n", result.cells);
  }
  //! [short]
}
//! [walk]
