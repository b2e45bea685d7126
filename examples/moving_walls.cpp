// SPDX-License-Identifier: LGPL-3.0-or-later
// A room that beats, with a thread across it: its walls push the thread to and fro, and stop where they
// cannot.
#include <cellwalk/cellwalk.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace cellwalk;

int main() {
  //! [room]
  // Walls move where all cells around them are tetrahedra.
  auto environment = Environment<3>::build(hex_grid({.cells = {4, 2, 2}}), {.simplicial = true});
  const Snapshot<3>& snapshot = environment.snapshot();
  Body_soup<3> thread;
  for (std::uint32_t i = 0; i < 13; ++i) {
    thread.points.push_back({0.45 + 0.25 * i, 0.9 + 0.01 * i, 0.125});
    if (i > 0) thread.edges.push_back({i - 1, i});
  }
  Body<3> body(snapshot, Locator<3>(snapshot), thread);
  //! [room]

  //! [beat]
  // The points of the floor go up, and down again, by a quarter.
  std::vector<std::uint32_t> floor;
  for (std::uint32_t i = 0; i < snapshot.points().size(); ++i)
    if (snapshot.point(i)[2] == 0) floor.push_back(i);
  for (int step = 1; step <= 8; ++step) {
    const double height = 0.25 * std::abs(std::sin(0.25 * 3.141592653589793 * step));
    std::vector<Vertex_move<3>> moves;
    for (const std::uint32_t i : floor)
      moves.push_back({i, {snapshot.point(i)[0], snapshot.point(i)[1], height}});
    // All that lies in the environment is listed; the walls push it out of their way.
    Reshaping<3> reshaping(environment, {.bodies = {&body}, .particles = {}},
                           {.at_contact = At_contact::push});
    const Move_report<3> report = reshaping.move(moves);
    reshaping.finish();
    double lowest = 1;
    for (const Point<3>& x : body.positions()) lowest = std::min(lowest, x[2]);
    std::printf("floor at %.3f: %zu contacts, %zu points short of their targets, thread from %.3f on\n",
                height, report.hits.size(), report.short_of_target.size(), lowest);
  }
  body.validate();  // no wall went through the thread, by exact predicates
  environment.certify();
  //! [beat]
  return 0;
}
