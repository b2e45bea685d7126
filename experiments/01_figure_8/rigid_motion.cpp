// SPDX-License-Identifier: LGPL-3.0-or-later
// Rigid cubes in flight, a second motion for figure 8: no deformation, fewer contacts, slow turns.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/target_recorder.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "motions.h"
#include "peers/hexahedra_trace.h"
#include "rigid_fit.h"

namespace cellwalk::figure_8 {
namespace {

/// Cells a step, where nothing else is asked for.
constexpr double usual_speed = 0.02;
/// A vertex is asked to move by at most so many times the speed, as the published traces have it: bodies that
/// hang on a wall do not snap back.
constexpr double longest_move = 5;
/// A body turns by at most so much a step, in radians (a vertex of the paper's bodies then by a quarter of
/// its speed).
constexpr double fastest_turn = 0.02;
/// Places tried for a body: bodies of three cells find one in about a thousand.
constexpr int most_tries = 1'000'000;

/// A cube in flight.
class Flyer {
 public:
  Flyer(Random& random, double side, double speed) : rotation_(random_rotation(random)), speed_(speed) {
    for (std::size_t v = 0; v < trace_vertices; ++v)
      for (std::size_t k = 0; k < 3; ++k)
        rest_[v][static_cast<Eigen::Index>(k)] = (v >> k & 1 ? 0.5 : -0.5) * side;
    change_course(random);
  }

  void change_course(Random& random) {
    velocity_ = speed_ * in_unit_ball(random).normalized();
    spin_ = rotation(1, 0.5 * fastest_turn * in_unit_ball(random));
  }
  std::array<Point<3>, trace_vertices> placed(const Vector3& centre) const {
    std::array<Point<3>, trace_vertices> x;
    for (std::size_t v = 0; v < trace_vertices; ++v) x[v] = point(centre + rotation_ * rest_[v]);
    return x;
  }
  /// Where the vertices are to go from where they are.
  std::array<Point<3>, trace_vertices> targets(const std::array<Point<3>, trace_vertices>& positions) {
    Vector3 centre = Vector3::Zero();
    for (const Point<3>& x : positions) centre += vector(x);
    centre /= static_cast<double>(trace_vertices);
    Matrix3 moments = Matrix3::Zero();
    for (std::size_t v = 0; v < trace_vertices; ++v)
      moments += (vector(positions[v]) - centre) * rest_[v].transpose();
    rotation_ = spin_ * nearest_rotation(moments, rotation_);
    std::array<Point<3>, trace_vertices> goals = placed(centre + velocity_);
    for (std::size_t v = 0; v < trace_vertices; ++v) {
      const Vector3 from = vector(positions[v]), way = vector(goals[v]) - from;
      const double length = way.norm();
      if (length > longest_move * speed_) goals[v] = point(from + longest_move * speed_ / length * way);
    }
    return goals;
  }

 private:
  static Vector3 vector(const Point<3>& x) { return {x[0], x[1], x[2]}; }
  static Point<3> point(const Vector3& x) { return {x[0], x[1], x[2]}; }

  std::array<Vector3, trace_vertices> rest_;
  Matrix3 rotation_, spin_;
  Vector3 velocity_;
  double speed_;
};

/// A body at a place where it is free. Its start is appended.
Flyer place(const Snapshot<3>& snapshot, const Locator<3>& locator, const Trace_options& options,
            double speed, Random& random, std::vector<Point<3>>& starts) {
  for (int i = 0; i < most_tries; ++i) {
    Flyer flyer(random, options.body_side, speed);
    Vector3 centre;
    for (std::size_t k = 0; k < 3; ++k)
      centre[static_cast<Eigen::Index>(k)] = random.real(0, static_cast<double>(options.cells[k]));
    const auto positions = flyer.placed(centre);
    // Most places are refused, and cheaply so where a vertex is not in free space.
    if (std::ranges::any_of(positions, [&](const Point<3>& x) { return !locator.particle_at(x); })) continue;
    try {
      const Body<3> body(snapshot, locator, {{positions.begin(), positions.end()}, hexahedron().edges, {}});
      starts.insert(starts.end(), positions.begin(), positions.end());
      return flyer;
    } catch (const Error& error) {
      if (error.code() != Error_code::outside) throw;
    }
  }
  throw Error(
      Error_code::usage,
      fmt::format("no place found for a body of side {} among {} solid cells of a hundred: make it smaller",
                  options.body_side, 100 * options.solid_share));
}

}  // namespace

Made_trace record_rigid(const Snapshot<3>& snapshot, Body_trace start, const Trace_options& options) {
  const double speed = options.speed.value_or(usual_speed);
  const Locator<3> locator(snapshot);
  Random random(scramble(options.seed));
  std::vector<Flyer> flyers;
  for (std::uint32_t b = 0; b < options.bodies; ++b)
    flyers.push_back(place(snapshot, locator, options, speed, random, start.before));
  Target_recorder recorder(snapshot, locator, std::move(start));
  std::vector<Point<3>> targets;
  for (std::uint32_t step = 0; step < options.steps; ++step) {
    targets.clear();
    for (std::uint32_t b = 0; b < options.bodies; ++b) {
      std::array<Point<3>, trace_vertices> positions;
      std::ranges::copy(recorder.bodies()[b].positions(), positions.begin());
      const auto goals = flyers[b].targets(positions);
      targets.insert(targets.end(), goals.begin(), goals.end());
    }
    recorder.step(targets);
    constexpr std::size_t of_body = trace_vertices * (1 + trace_edges);
    const auto answers = std::span(recorder.trace().answers).last(options.bodies * of_body);
    for (std::uint32_t b = 0; b < options.bodies; ++b)
      if (std::ranges::any_of(answers.subspan(b * of_body, of_body),
                              [](unsigned a) { return (a & body_trace_blocked) != 0; }))
        flyers[b].change_course(random);
  }
  return {recorder.trace(), speed};
}

}  // namespace cellwalk::figure_8
