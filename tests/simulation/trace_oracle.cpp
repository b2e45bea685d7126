// SPDX-License-Identifier: LGPL-3.0-or-later
#include "simulation/trace_oracle.h"

#include <algorithm>
#include <cmath>

#include "edge/rational_touch.h"

namespace cellwalk::test {

Trace_walls::Trace_walls(const Trace& trace) : size_{trace.nx, trace.ny, trace.nz}, solid_(trace.obstacles) {}

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
  std::optional<boost::multiprecision::cpp_rational> first;
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

std::uint8_t answer(const Trace_walls& walls, const Point<3>& from, const Point<3>& target,
                    const std::array<Point<3>, trace_edges>& q) {
  if (walls.meet_segment(from, target)) return 0x71;
  unsigned bits = 0;
  for (std::size_t k = 0; k < trace_edges; ++k) {
    if (walls.meet_segment(target, q[k])) bits |= 2u << k;
    if (walls.meet_triangle(from, target, q[k])) bits |= 16u << k;
  }
  return static_cast<std::uint8_t>(bits);
}

void for_each_move(const Trace& trace,
                   const std::function<void(std::size_t, const Point<3>&, const Point<3>&,
                                            const std::array<Point<3>, trace_edges>&)>& visit) {
  std::vector<Point<3>> positions = trace.start_positions;
  for (std::size_t i = 0; i < trace.targets.size(); ++i) {
    const std::size_t place = i % positions.size(), body = place / 8 * 8, vertex = place % 8;
    visit(i, positions[place], trace.targets[i],
          {positions[body + (vertex ^ 1)], positions[body + (vertex ^ 2)], positions[body + (vertex ^ 4)]});
    if ((trace.answers[i] & 0x0f) == 0) positions[place] = trace.targets[i];
  }
}

}  // namespace cellwalk::test
