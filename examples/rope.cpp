// SPDX-License-Identifier: LGPL-3.0-or-later
// A rope in a mesh of a surface, its contacts, and a picture: docs/start.md.
//! [short]
#include <cellwalk/cellwalk.h>

#include <cstdio>

int main() {
  const auto torus = cellwalk::import_environment<3>("torus.off");
  cellwalk::Body rope(torus, cellwalk::rope({{0, -1, 0}, {0.9, -0.4, 0}, {0.9, 0.4, 0}, {0, 1, 0}}, 0.1));
  std::vector<cellwalk::Contact<3>> contacts;
  for (int step = 1; step <= 8; ++step) {
    std::vector targets(rope.positions().begin(), rope.positions().end());
    for (auto& x : targets) x[0] += 0.1;  // here a solver of your own says where to go
    contacts = rope.step(targets);        // the rope stops at walls and slides along them
    if (!contacts.empty())
      std::printf("step %d: vertex %u is free until %.2f\n", step, contacts[0].vertex, contacts[0].time);
  }
  cellwalk::draw(torus, {&rope}, contacts, "rope.png");
}
//! [short]
