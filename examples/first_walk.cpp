// SPDX-License-Identifier: LGPL-3.0-or-later
// A particle in a room of cells: it walks through them, and is stopped by the wall behind.
//! [walk]
#include <cellwalk/cellwalk.h>

#include <cstdio>

int main() {
  using namespace cellwalk;
  const auto environment =
      Environment<3>::build(hex_grid({.cells = {4, 2, 2}}));  // certified, or an Error says why not
  const Snapshot<3>& snapshot = environment.snapshot();

  std::optional<Particle<3>> particle = Locator<3>(snapshot).particle_at({0.5, 0.5, 0.5});
  if (!particle) return 1;  // outside, or in a solid cell
  Walk_counts counts;
  for (const Point<3>& target : {Point<3>{3.5, 1.5, 0.5}, Point<3>{5.5, 1.5, 0.5}}) {
    const Walk_result<3> result = move(snapshot, *particle, target, counts);
    if (result.contact)
      std::printf("stopped at time %g by the wall x = %g\n", result.contact->time, result.contact->point[0]);
    else
      std::printf("arrived through %u cells\n", result.cells);
  }
}
//! [walk]
