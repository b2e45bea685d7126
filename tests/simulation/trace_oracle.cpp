// SPDX-License-Identifier: LGPL-3.0-or-later
#include "simulation/trace_oracle.h"

#include <algorithm>
#include <cmath>

#include "edge/rational_touch.h"

namespace cellwalk::test {

Trace_walls::Trace_walls(const Traced_grid& grid)
    : size_{grid.cells[0], grid.cells[1], grid.cells[2]}, solid_(grid.solid) {}

bool Trace_walls::is_solid(const std::array<std::int64_t, 3>& cell) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (cell[k] < 0 || cell[k] >= size_[k]) return true;
  const std::int64_t index = cell[0] + size_[0] * (cell[1] + size_[1] * cell[2]);
  return std::binary_search(solid_.begin(), solid_.end(), static_cast<std::uint32_t>(index));
}

/// Squares whose box may meet that of the points: those of the planes in it, in the rows and columns of cells
/// that it meets.
void Trace_walls::for_each_near(const std::vector<Point<3>>& points,
                                const std::function<void(const Square&)>& visit) const {
  std::array<std::int64_t, 3> first, last;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = points[0][k], high = low;
    for (const Point<3>& p : points) low = std::min(low, p[k]), high = std::max(high, p[k]);
    first[k] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(low)) - 1);
    last[k] = std::min<std::int64_t>(size_[k], static_cast<std::int64_t>(std::floor(high)));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::int64_t i = first[axis]; i <= last[axis]; ++i)
      for (std::int64_t j = first[u]; j <= std::min(last[u], size_[u] - 1); ++j)
        for (std::int64_t k = first[v]; k <= std::min(last[v], size_[v] - 1); ++k) {
          std::array<std::int64_t, 3> below{}, above{};
          below[axis] = i - 1, above[axis] = i;
          below[u] = above[u] = j, below[v] = above[v] = k;
          if (!is_solid(below) && !is_solid(above)) continue;
          Square square;
          for (std::size_t c = 0; c < 4; ++c) {
            square[c][axis] = static_cast<double>(i);
            square[c][u] = static_cast<double>(j + (c == 1 || c == 2));
            square[c][v] = static_cast<double>(k + (c >= 2));
          }
          visit(square);
        }
  }
}

bool Trace_walls::meet_segment(const Point<3>& a, const Point<3>& b) const {
  bool meets = false;
  for_each_near({a, b}, [&](const Square& s) {
    const std::array<Point<3>, 3> half{s[0], s[1], s[2]}, other{s[0], s[2], s[3]};
    meets = meets || segment_meets(a, b, half) || segment_meets(a, b, other);
  });
  return meets;
}

std::optional<double> Trace_walls::meet_triangle(const Point<3>& a, const Point<3>& b,
                                                 const Point<3>& q) const {
  std::optional<Rational> first;
  for_each_near({a, b, q}, [&](const Square& s) {
    const std::array<Point<3>, 3> halves[]{{s[0], s[1], s[2]}, {s[0], s[2], s[3]}};
    for (const auto& half : halves) {
      const Rational_touch touch = touch_of_edge(a, b, q, half);
      if (touch.at_start) first = 0;
      if (touch.later && (!first || *touch.later < *first)) first = *touch.later;
    }
  });
  if (!first) return std::nullopt;
  return first->convert_to<double>();
}

bool Recorded_move::stays() const {
  return std::ranges::any_of(answers, [](unsigned a) { return (a & body_trace_blocked) != 0; });
}

void for_each_recorded_move(const Body_trace& trace, const std::function<void(const Recorded_move&)>& visit) {
  std::size_t at = 0;
  for (std::size_t s = 0; s < trace.steps; ++s)
    for (std::size_t b = 0, first = 0; b < trace.bodies.size(); first += trace.bodies[b++].vertices) {
      const Traced_body& body = trace.bodies[b];
      const auto before = trace.before_step(s).subspan(first, body.vertices);
      std::vector<Point<3>> positions(before.begin(), before.end());
      for (std::uint32_t v = 0; v < body.vertices; ++v) {
        Recorded_move move{s, b, v, positions[v], trace.targets_of_step(s)[first + v], {}, {}};
        for (std::uint32_t q = 0; q < body.vertices; ++q)
          if (std::ranges::binary_search(body.edges, std::array{std::min(v, q), std::max(v, q)}))
            move.neighbours.push_back(positions[q]);
        move.answers = std::span(trace.answers).subspan(at, 1 + move.neighbours.size());
        at += move.answers.size();
        visit(move);
        if (!move.stays()) positions[v] = move.target;
      }
    }
}

std::vector<std::uint8_t> answers_where_touches_block(const Trace_walls& walls, const Point<3>& from,
                                                      const Point<3>& target,
                                                      const std::vector<Point<3>>& neighbours) {
  const bool is_blocked = walls.meet_segment(from, target);
  std::vector<std::uint8_t> answers{is_blocked ? body_trace_blocked : std::uint8_t{0}};
  for (const Point<3>& q : neighbours) {
    const bool is_blocked_at_end = !is_blocked && walls.meet_segment(target, q);
    const bool is_swept = is_blocked || walls.meet_triangle(from, target, q);
    answers.push_back(static_cast<std::uint8_t>(is_blocked_at_end * body_trace_blocked |  //
                                                is_swept * body_trace_swept));
  }
  return answers;
}

}  // namespace cellwalk::test
