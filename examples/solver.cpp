// SPDX-License-Identifier: LGPL-3.0-or-later
// A solver of one's own: a cloth by position-based dynamics falls onto a block. The solver knows nothing of
// walls; Body::step has the last word on where its masses go. docs/tutorials/solver.md is about this program.
#include <cellwalk/cellwalk.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

using namespace cellwalk;

namespace {

//! [solver]
/// Masses that keep their distances along links: one step of position-based dynamics.
struct Cloth_solver {
  double time_step = 1.0 / 240;
  int sweeps = 20;
  Vector<3> gravity{0, 0, -9.81};
  std::vector<std::array<std::uint32_t, 2>> links;
  std::vector<double> lengths;
  std::vector<Vector<3>> velocities;

  /// Where the masses would go, were there no walls.
  std::vector<Point<3>> targets(const std::vector<Point<3>>& positions) {
    std::vector<Point<3>> next(positions.size());
    for (std::size_t i = 0; i < next.size(); ++i) {
      velocities[i] = velocities[i] + time_step * gravity;
      next[i] = positions[i] + time_step * velocities[i];
    }
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (std::size_t k = 0; k < links.size(); ++k) {
        const auto [u, v] = links[k];
        const Vector<3> between = next[v] - next[u];
        const Vector<3> share = (0.5 * (1 - lengths[k] / length(between))) * between;
        next[u] = next[u] + share;
        next[v] = next[v] - share;
      }
    return next;
  }

  /// The velocities with which the masses really went.
  void follow(const std::vector<Point<3>>& before, const std::vector<Point<3>>& after) {
    for (std::size_t i = 0; i < after.size(); ++i) velocities[i] = (1 / time_step) * (after[i] - before[i]);
  }
};
//! [solver]

//! [cloth]
/// A square of side x side masses, with a quad between each four.
Body_parts<3> cloth(const Point<3>& corner, double spacing, std::uint32_t side) {
  Body_parts<3> parts;
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i)
      parts.points.push_back({corner[0] + spacing * i, corner[1] + spacing * j, corner[2]});
  for (std::uint32_t j = 0; j + 1 < side; ++j)
    for (std::uint32_t i = 0; i + 1 < side; ++i) {
      const std::uint32_t v = i + side * j;
      parts.polygons.push_back({v, v + 1, v + 1 + side, v + side});
    }
  return parts;
}
//! [cloth]

std::vector<Point<3>> positions_of(const Body<3>& body) {
  return {body.positions().begin(), body.positions().end()};
}

}  // namespace

int main() {
  //! [room]
  // A room of 5 x 5 x 3 unit cells. The middle of its floor is a solid cell: a block with a top at z = 1.
  const auto environment = Environment<3>::build(hex_grid({.cells = {5, 5, 3}, .solid_cells = {12}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  //! [room]

  //! [body]
  const Body_soup<3> soup = make_body(cloth({1.3, 1.3, 1.5}, 0.3, 9)).body;
  Body<3> body(snapshot, Locator<3>(snapshot), soup);  // or an Error: what is in the way, and where

  Cloth_solver solver;
  solver.links.assign(body.edges().begin(), body.edges().end());
  for (const auto& [u, v] : solver.links) solver.lengths.push_back(length(soup.points[v] - soup.points[u]));
  solver.velocities.resize(body.vertex_count());
  //! [body]

  //! [loop]
  Body_options options;
  options.sweep.sweep = Sweep::faces;  // vertices, edges and faces: nothing is missed
  const double friction = 0.2;         // the share of the velocity along a wall that a contact takes
  Body_counts counts;
  Step_report<3> report;
  for (int step = 1; step <= 480; ++step) {
    const std::vector<Point<3>> before = positions_of(body);
    report.clear();
    body.step(solver.targets(before), options, report, counts);
    solver.follow(before, positions_of(body));
    for (const Contact<3>& contact : report.contacts) {
      Vector<3>& velocity = solver.velocities[contact.vertex];
      const Vector<3> along = velocity - dot(velocity, contact.normal) * contact.normal;
      velocity = velocity - friction * along;
    }
    if (step % 80 == 0) {
      double lowest = 3;
      for (const Point<3>& p : body.positions()) lowest = std::min(lowest, p[2]);
      std::printf("step %d: %zu contacts, lowest z %.2f\n", step, report.contacts.size(), lowest);
    }
  }
  //! [loop]

  //! [check]
  body.refresh(counts);
  body.validate();  // throws if a wall were across a vertex, an edge or a face, by exact predicates
  const double middle = body.positions()[40][2];
  std::printf("the middle of the cloth lies at z = %.6f\n", middle);
  std::printf("%llu moves, %.0f %% of them without a test\n", static_cast<unsigned long long>(counts.moves),
              100.0 * static_cast<double>(counts.in_region) / static_cast<double>(counts.moves));
  //! [check]
}
