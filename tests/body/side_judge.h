// SPDX-License-Identifier: LGPL-3.0-or-later
// Which sides of walls a body is on, by integers, from its moves alone. In the plane.
#ifndef CELLWALK_TESTS_BODY_SIDE_JUDGE_H
#define CELLWALK_TESTS_BODY_SIDE_JUDGE_H

#include <cellwalk/body/body.h>
#include <cellwalk/environment/snapshot.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace cellwalk::test {

/// Follows the moves of a body vertex by vertex, and remembers from which side of a wall a vertex came into
/// it, and from which side an edge came to an end of a wall. What leaves such a place must leave to the side
/// from which it came, as long as the wall stands. Coordinates are multiples of 1/64.
class Side_judge {
 public:
  /// Looks at the walls anew, after edits.
  void look(const Snapshot<2>& snapshot) {
    walls_ = walls_of(snapshot);
    std::erase_if(in_wall_, [&](const auto& entry) { return !walls_.contains(std::get<1>(entry.first)); });
    std::erase_if(at_end_, [&](const auto& entry) { return !walls_.contains(std::get<1>(entry.first)); });
  }

  /// Judges a move that was made. Returns what is wrong with it.
  std::string judge(const Body<2>& body, std::uint32_t vertex, const Point<2>& from) {
    const Place a = place(from), b = place(body.positions()[vertex]);
    std::string wrong;
    for (const Wall& wall : walls_) judge_vertex(vertex, wall, a, b, wrong);
    for (std::uint32_t e = 0; e < body.edges().size(); ++e) {
      const auto [u, v] = body.edges()[e];
      if (u != vertex && v != vertex) continue;
      const Place other = place(body.positions()[u == vertex ? v : u]);
      for (const Wall& wall : walls_)
        for (const Place& end : {wall.first, wall.second})
          judge_edge(e, u == vertex ? 1 : -1, wall, end, a, b, other, wrong);
    }
    return wrong;
  }

 private:
  using Place = std::array<std::int64_t, 2>;
  using Wall = std::pair<Place, Place>;

  static Place place(const Point<2>& x) { return {std::llround(64 * x[0]), std::llround(64 * x[1])}; }

  static std::set<Wall> walls_of(const Snapshot<2>& snapshot) {
    std::set<Wall> walls;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell cell = snapshot.cell(i);
      if (cell == Cell::none || snapshot.is_solid(cell)) continue;
      for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
        const Half_facet f = Snapshot<2>::half_facet(cell, k);
        if (!snapshot.is_impassable(f)) continue;
        const auto loop = snapshot.loop(f);
        Wall wall{place(snapshot.point(loop[0])), place(snapshot.point(loop[1]))};
        if (wall.second < wall.first) std::swap(wall.first, wall.second);
        walls.insert(wall);
      }
    }
    return walls;
  }

  static std::int64_t turn(const Place& a, const Place& b, const Place& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  static int sign(std::int64_t x) { return (x > 0) - (x < 0); }
  /// True if z is strictly between a and b.
  static bool is_between(const Place& a, const Place& b, const Place& z) {
    return turn(a, b, z) == 0 && (z[0] - a[0]) * (z[0] - b[0]) + (z[1] - a[1]) * (z[1] - b[1]) < 0;
  }
  static Place times(std::int64_t factor, const Place& x) { return {factor * x[0], factor * x[1]}; }
  /// The point between a and b that divides them as two numbers of different signs, times their difference.
  static Place divided(const Place& a, const Place& b, std::int64_t at_a, std::int64_t at_b) {
    const std::int64_t n = at_a - at_b;
    return {n * a[0] + at_a * (b[0] - a[0]), n * a[1] + at_a * (b[1] - a[1])};
  }

  void judge_vertex(std::uint32_t vertex, const Wall& wall, const Place& a, const Place& b,
                    std::string& wrong) {
    const auto& [p, q] = wall;
    const std::int64_t at_a = turn(p, q, a), at_b = turn(p, q, b);
    if (sign(at_a) * sign(at_b) < 0) {
      const std::int64_t n = at_a - at_b;
      if (is_between(times(n, p), times(n, q), divided(a, b, at_a, at_b)))
        wrong += " vertex " + std::to_string(vertex) + " crosses a wall";
    }
    follow(in_wall_, {vertex, wall, p}, is_between(p, q, a), is_between(p, q, b), sign(at_a), sign(at_b),
           " vertex " + std::to_string(vertex) + " leaves a wall for the other side", wrong);
  }

  /// \param direction 1 if the first end of the edge moves, else -1
  void judge_edge(std::uint32_t edge, int direction, const Wall& wall, const Place& end, const Place& a,
                  const Place& b, const Place& other, std::string& wrong) {
    const std::int64_t at_a = turn(a, other, end), at_b = turn(b, other, end);
    if (sign(at_a) * sign(at_b) < 0) {
      const std::int64_t n = at_a - at_b;
      if (is_between(divided(a, b, at_a, at_b), times(n, other), times(n, end)))
        wrong += " edge " + std::to_string(edge) + " passes an end of a wall";
    }
    follow(at_end_, {edge, wall, end}, is_between(a, other, end), is_between(b, other, end),
           direction * sign(at_a), direction * sign(at_b),
           " edge " + std::to_string(edge) + " leaves an end of a wall for the other side", wrong);
  }

  using Sides = std::map<std::tuple<std::uint32_t, Wall, Place>, int>;

  static void follow(Sides& sides, const Sides::key_type& key, bool was_there, bool is_there, int before,
                     int after, const std::string& complaint, std::string& wrong) {
    const auto known = sides.find(key);
    if (was_there && after != 0 && known != sides.end() && known->second != after) wrong += complaint;
    if (!was_there && is_there && before != 0)
      sides[key] = before;
    else if (!(was_there && is_there) && known != sides.end())
      sides.erase(known);
  }

  std::set<Wall> walls_;
  Sides in_wall_, at_end_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_SIDE_JUDGE_H
