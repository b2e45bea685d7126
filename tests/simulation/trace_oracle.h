// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers of a trace by definition: brute force over the unit squares that are walls near each move, in
// exact arithmetic. Shares nothing with the library but the record Trace.
#ifndef CELLWALK_TESTS_SIMULATION_TRACE_ORACLE_H
#define CELLWALK_TESTS_SIMULATION_TRACE_ORACLE_H

#include <cellwalk/internal/records/trace.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cellwalk::test {

/// The walls of a trace: the outer boundary of its grid, and the sides of its solid cells.
class Trace_walls {
 public:
  explicit Trace_walls(const Trace& trace);

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

/// Bit by bit, as the format defines it; q are the neighbours of the vertex that moves.
std::uint8_t answer(const Trace_walls& walls, const Point<3>& from, const Point<3>& target,
                    const std::array<Point<3>, trace_edges>& q);

/// Where vertices are when they are moved to their targets by the recorded answers. Calls visit(index, from,
/// target, q) for each move in order.
void for_each_move(const Trace& trace,
                   const std::function<void(std::size_t, const Point<3>&, const Point<3>&,
                                            const std::array<Point<3>, trace_edges>&)>& visit);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_TRACE_ORACLE_H
