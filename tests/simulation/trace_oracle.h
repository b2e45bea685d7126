// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers of a trace by definition: brute force over the unit squares that are walls near each move, in
// exact arithmetic. Shares nothing with the library but the record Body_trace.
#ifndef CELLWALK_TESTS_SIMULATION_TRACE_ORACLE_H
#define CELLWALK_TESTS_SIMULATION_TRACE_ORACLE_H

#include <cellwalk/internal/records/body_trace.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::test {

/// The walls of a grid: its outer boundary, and the sides of its solid cells.
class Trace_walls {
 public:
  explicit Trace_walls(const Traced_grid& grid);

  /// Whether the closed segment meets a wall.
  bool meet_segment(const Point<3>& a, const Point<3>& b) const;
  /// Whether the closed triangle abq does; if so, when the edge from a + s (b - a) to q first does (0: at the
  /// start).
  std::optional<double> meet_triangle(const Point<3>& a, const Point<3>& b, const Point<3>& q) const;

 private:
  using Square = std::array<Point<3>, 4>;
  bool is_solid(const std::array<std::int64_t, 3>& cell) const;
  void for_each_near(const std::vector<Point<3>>& points,
                     const std::function<void(const Square&)>& visit) const;

  std::array<std::int64_t, 3> size_;
  std::vector<std::uint32_t> solid_;
};

/// A move of a trace, and what walls answer.
struct Recorded_move {
  std::size_t step, body;
  std::uint32_t vertex;
  Point<3> from, target;
  std::vector<Point<3>> neighbours;       ///< where they are then, ascending
  std::span<const std::uint8_t> answers;  ///< to the vertex, then to its edges

  bool is_blocked() const { return answers[0] != 0; }
  bool is_blocked_at_end(std::size_t i) const { return (answers[1 + i] & body_trace_blocked) != 0; }
  bool is_swept(std::size_t i) const { return (answers[1 + i] & body_trace_swept) != 0; }
  bool stays() const;
};

/// Visits all moves in order. Vertices that nothing blocks move to their targets.
void for_each_recorded_move(const Body_trace& trace, const std::function<void(const Recorded_move&)>& visit);

/// What the answers to a move are where touches block, bit by bit, as the format defines them.
std::vector<std::uint8_t> answers_where_touches_block(const Trace_walls& walls, const Point<3>& from,
                                                      const Point<3>& target,
                                                      const std::vector<Point<3>>& neighbours);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_TRACE_ORACLE_H
