// SPDX-License-Identifier: LGPL-3.0-or-later
// A body of one's own with an integrator of one's own: a tetrahedron of masses and springs falls into a
// corner of a room. The solver proposes targets, the body goes as far as walls allow, and the solver reads
// where it got.
#include <cellwalk/cellwalk.h>

#include <cstdio>
#include <vector>

using namespace cellwalk;

namespace {

//! [integrator]
/// Masses of one unit, springs along all edges; velocities follow from where the walls let the masses go.
struct Springs {
  double stiffness = 400, damping = 2, time_step = 1.0 / 256;
  Vector<3> gravity{-2, 0, -8};
  std::vector<double> rest_lengths;
  std::vector<Vector<3>> velocities;

  explicit Springs(const Body<3>& body) : velocities(body.vertex_count()) {
    for (const auto& [u, v] : body.edges())
      rest_lengths.push_back(length(body.positions()[v] - body.positions()[u]));
  }

  /// Where the masses would go, were there no walls.
  std::vector<Point<3>> targets(const Body<3>& body) {
    std::vector<Vector<3>> forces(body.vertex_count(), gravity);
    for (std::size_t e = 0; e < rest_lengths.size(); ++e) {
      const auto& [u, v] = body.edges()[e];
      const Vector<3> between = body.positions()[v] - body.positions()[u];
      const double now = length(between);
      const double closing = dot(velocities[v] - velocities[u], between) / now;
      const Vector<3> pull = ((stiffness * (now - rest_lengths[e]) + damping * closing) / now) * between;
      forces[u] = forces[u] + pull;
      forces[v] = forces[v] - pull;
    }
    std::vector<Point<3>> result(body.vertex_count());
    for (std::size_t v = 0; v < result.size(); ++v) {
      velocities[v] = velocities[v] + time_step * forces[v];
      result[v] = body.positions()[v] + time_step * velocities[v];
    }
    return result;
  }

  /// The velocities with which the masses really went.
  void follow(const std::vector<Point<3>>& before, const Body<3>& body) {
    for (std::size_t v = 0; v < before.size(); ++v)
      velocities[v] = (1 / time_step) * (body.positions()[v] - before[v]);
  }
};
//! [integrator]

}  // namespace

int main() {
  const auto environment = Environment<3>::build(hex_grid({.cells = {4, 4, 4}}));
  const Snapshot<3>& snapshot = environment.snapshot();

  //! [body]
  Body_parts<3> parts;
  parts.points = {{2, 2, 2}, {3, 2, 2.25}, {2.25, 3, 2}, {2.25, 2.25, 3}};
  parts.polygons = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};  // their sides become edges
  Body<3> body(snapshot, Locator<3>(snapshot),
               make_body(parts).body);  // or an Error: which vertex or edge, and why
  //! [body]

  //! [loop]
  Springs springs(body);
  Body_options options;
  options.sweep.sweep = Sweep::faces;  // vertices, edges and faces: nothing is missed
  Body_counts counts;
  Step_report<3> report;
  for (int step = 0; step < 1024; ++step) {
    const std::vector<Point<3>> before(body.positions().begin(), body.positions().end());
    body.step(springs.targets(body), options, report, counts);
    springs.follow(before, body);
  }
  //! [loop]

  body.refresh(counts);
  body.validate();  // throws if a vertex, an edge or a face were across a wall
  Vector<3> lowest{4, 4, 4};
  for (const Point<3>& p : body.positions())
    for (int i = 0; i < 3; ++i) lowest[i] = p[i] < lowest[i] ? p[i] : lowest[i];
  std::printf("%llu moves of vertices, %zu contacts\n", static_cast<unsigned long long>(counts.moves),
              report.contacts.size());
  std::printf("lowest x %.3f, lowest z %.3f\n", lowest[0], lowest[2]);
  const Contact<3>& first = report.contacts.front();
  std::printf("first: normal (%g %g %g) at z = %g\n", first.normal[0], first.normal[1], first.normal[2],
              first.point[2]);
}
