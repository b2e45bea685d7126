// SPDX-License-Identifier: LGPL-3.0-or-later
// How components of SOFA would call Cellwalk: contacts for its constraint solver, the last word on positions,
// a vertex that a device drives, and a wall that deforms. It compiles without SOFA: what would be SOFA's is
// in the namespace stand_in. docs/sofa.md is about this file.
#include <cellwalk/cellwalk.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

using namespace cellwalk;

namespace {

//! [stand_ins]
namespace stand_in {

using VecCoord = std::vector<Point<3>>;   // Vec3Types::VecCoord
using VecDeriv = std::vector<Vector<3>>;  // Vec3Types::VecDeriv

/// sofa::core::collision::DetectionOutput: the fields that are filled here, and the weights that one of
/// SOFA's contact mappers computes from the element and the point.
struct DetectionOutput {
  std::array<std::uint32_t, 2> vertices;  // of the element of the body
  std::array<double, 2> weights;          // of these at the point
  Point<3> point;                         // where the element meets the wall
  Vector<3> normal;                       // from the body outwards, into the wall
  double deltaT;                          // the share of the motion that is free
};

/// A solver of SOFA: masses with springs in free motion.
VecCoord free_motion(const Body<3>& body, const std::vector<double>& lengths, VecDeriv& v, double dt) {
  VecCoord free(body.positions().begin(), body.positions().end());
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    const auto [a, b] = body.edges()[e];
    const Vector<3> between = free[b] - free[a];
    const Vector<3> pull = (200 * dt * (1 - lengths[e] / length(between))) * between;
    v[a] = v[a] + pull;
    v[b] = v[b] - pull;
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    v[i] = 0.99 * v[i] + dt * Vector<3>{0, 0, -10};
    free[i] = free[i] + dt * v[i];
  }
  return free;
}

/// A constraint solver of SOFA: pushes elements back to where they met a wall. It iterates, and stops before
/// it is exact.
void solve_constraints(const std::vector<DetectionOutput>& contacts, VecCoord& x) {
  for (int iteration = 0; iteration < 10; ++iteration)
    for (const DetectionOutput& contact : contacts) {
      double violation = 0, weight = 0;
      for (int i = 0; i < 2; ++i) {
        violation += contact.weights[i] * dot(x[contact.vertices[i]] - contact.point, contact.normal);
        weight += contact.weights[i] * contact.weights[i];
      }
      for (int i = 0; i < 2 && violation > 0; ++i)
        x[contact.vertices[i]] =
            x[contact.vertices[i]] - (contact.weights[i] * violation / weight) * contact.normal;
    }
}

}  // namespace stand_in
//! [stand_ins]

using namespace stand_in;

//! [detection]
/// In SOFA: what Pipeline::doCollisionDetection() asks for one state. Changes nothing: a copy of the body
/// tries the free motion, in which each vertex that meets a wall stays.
std::vector<DetectionOutput> detect(const Body<3>& body, const VecCoord& free_position, Body_counts& counts) {
  Body_options options;
  options.rule = Step_rule::reject;
  Step_report<3> report;
  Body<3> trial = body;
  trial.step(free_position, options, report, counts);

  std::vector<DetectionOutput> contacts;
  for (const Contact<3>& met : report.contacts) {
    DetectionOutput contact{{met.vertex, met.vertex}, {1, 0}, met.point, -1 * met.normal, met.time};
    if (met.body == Body_feature::edge) {
      // Vertices move in order: where both ends were when this one met the wall.
      const auto [u, v] = body.edges()[met.feature];
      const std::uint32_t other = u == met.vertex ? v : u;
      const Point<3>& start = body.positions()[met.vertex];
      const Point<3> p = start + met.time * (free_position[met.vertex] - start);
      const Point<3>& q = other < met.vertex ? trial.positions()[other] : body.positions()[other];
      const double share = std::clamp(dot(met.point - p, q - p) / dot(q - p, q - p), 0.0, 1.0);
      contact.vertices[1] = other;
      contact.weights = {1 - share, share};
    }
    contacts.push_back(contact);
  }
  return contacts;
}
//! [detection]

//! [constraint]
/// In SOFA: a ProjectiveConstraintSet<Vec3Types>. Whatever the solvers before it did, the state ends where
/// its whole motion of this step is free.
struct Wall_constraint {
  Body<3>& body;
  Body_options options{};
  Step_report<3> report{};
  VecCoord before{};

  void projectPosition(VecCoord& x, Body_counts& counts) {
    before.assign(body.positions().begin(), body.positions().end());
    report.clear();
    body.step(x, options, report, counts);
    x.assign(body.positions().begin(), body.positions().end());
  }

  void projectVelocity(VecDeriv& v, double dt) const {
    for (const Contact<3>& contact : report.contacts)
      v[contact.vertex] = (1 / dt) * (body.positions()[contact.vertex] - before[contact.vertex]);
  }
};
//! [constraint]

//! [device]
/// In SOFA: a controller that moves one vertex with a haptic device. The contact tells the device what it
/// meets: a time, a point and a normal. Without a contact the vertex is where the device is.
std::optional<Contact<3>> drive(Body<3>& body, std::uint32_t vertex, const Point<3>& target,
                                Body_counts& counts) {
  return body.move_vertex(vertex, target, {}, counts);
}
//! [device]

//! [wall]
/// In SOFA: after the solver of a vessel that deforms. Its points go where that wants them, or as far as the
/// body leaves room; then they are written back into its state.
Move_report<3> follow_wall(Environment<3>& environment, Body<3>& body,
                           const std::vector<Vertex_move<3>>& wanted) {
  Reshaping<3> reshaping(environment, {.bodies = {&body}, .particles = {}}, {.at_contact = At_contact::push});
  return reshaping.move(wanted);
}
//! [wall]

}  // namespace

int main() {
  // A trough with a block in its middle, in tetrahedra, so that its walls can move; a rod above it.
  auto environment =
      Environment<3>::build(hex_grid({.cells = {6, 3, 3}, .solid_cells = {9}}), {.simplicial = true});
  const Snapshot<3>& snapshot = environment.snapshot();
  Body_parts<3> rod;
  for (std::uint32_t i = 0; i <= 20; ++i) {
    rod.points.push_back({0.75 + 0.25 * i, 1.25 + 0.01 * i, 2});
    if (i > 0) rod.segments.push_back({i - 1, i});
  }
  Body<3> body(snapshot, Locator<3>(snapshot), make_body(rod).body);
  const std::vector<double> lengths(body.edges().size(), length(rod.points[1] - rod.points[0]));

  //! [step]
  Wall_constraint constraint{body};
  Body_counts counts;
  VecDeriv velocity(body.vertex_count());
  const double dt = 0.005;
  std::size_t detected = 0, left = 0;
  for (int step = 0; step < 400; ++step) {
    VecCoord x = free_motion(body, lengths, velocity, dt);  // solvers
    const auto contacts = detect(body, x, counts);          // collision pipeline
    solve_constraints(contacts, x);                         // constraint solver
    for (std::size_t i = 0; i < x.size(); ++i) velocity[i] = (1 / dt) * (x[i] - body.positions()[i]);
    constraint.projectPosition(x, counts);  // projective constraints
    constraint.projectVelocity(velocity, dt);
    detected += contacts.size();
    left += constraint.report.contacts.size();
  }
  //! [step]
  std::printf("%zu contacts for the constraint solver, %zu left for the last word\n", detected, left);

  const auto met = drive(body, 0, {0.75, 1.25, -1}, counts);
  std::printf("device: %s at z = %g\n", met ? "stopped" : "free", met ? met->point[2] : -1);

  std::vector<Vertex_move<3>> floor;
  for (std::uint32_t i = 0; i < snapshot.points().size(); ++i)
    if (const Point<3>& p = snapshot.point(i); p[2] == 0) floor.push_back({i, {p[0], p[1], 0.25}});
  const Move_report<3> moved = follow_wall(environment, body, floor);
  body.validate();  // throws if a wall were across a vertex or an edge, by exact predicates
  environment.certify();
  std::printf("floor: %zu of %zu points arrived, %zu contacts\n", floor.size() - moved.short_of_target.size(),
              floor.size(), moved.hits.size());
}
