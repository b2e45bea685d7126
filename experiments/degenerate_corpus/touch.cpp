// SPDX-License-Identifier: LGPL-3.0-or-later
#include "touch.h"

#include <cellwalk/internal/edge/sweep_along.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "edge/rational_touch.h"

namespace cellwalk::corpus {
namespace {

Rational volume(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  Vec x, y, z;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = b[i] - a[i];
    y[i] = c[i] - a[i];
    z[i] = d[i] - a[i];
  }
  return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
         x[2] * (y[0] * z[1] - y[1] * z[0]);
}

/// The time at which a triangle, whose corner goes from a to b, passes a point. None if it does not, or if it
/// moves in its plane.
std::optional<Rational> time_of_passing(const Vec& a, const Vec& b, const Vec& q, const Vec& r,
                                        const Vec& x) {
  const Rational all = volume(a, b, q, r);
  if (all == 0) return {};
  const std::array<Rational, 4> shares{Rational(volume(x, b, q, r) / all), Rational(volume(a, x, q, r) / all),
                                       Rational(volume(a, b, x, r) / all),
                                       Rational(volume(a, b, q, x) / all)};
  if (std::ranges::any_of(shares, [](const Rational& s) { return s < 0; })) return {};
  const Rational moving = shares[0] + shares[1];
  if (moving == 0) return {};
  return Rational(shares[1] / moving);
}

/// The first time at which a segment or triangle meets an obstacle, a segment or triangle that it does not
/// meet at the start, while one corner of it goes from a to b. The points in which they meet, with their
/// times, form a convex set; the first one is a corner of it: one in what a side at the moving corner
/// sweeps, a corner of the obstacle, or one at the end.
std::optional<Rational> first_meeting(const Point<3>& a, const Point<3>& b, std::span<const Point<3>> still,
                                      std::span<const Point<3>> obstacle) {
  std::optional<Rational> first;
  const auto note = [&](const std::optional<Rational>& time) {
    if (time && (!first || *time < *first)) first = time;
  };
  for (const Point<3>& s : still) note(test::touch_of_edge(a, b, s, obstacle).later);
  if (still.size() == 1) return first;
  std::vector<Vec> end{exact<3>(b), exact<3>(still[0]), exact<3>(still[1])}, corners;
  for (const Point<3>& x : obstacle) corners.push_back(exact<3>(x));
  for (const Vec& x : corners) note(time_of_passing(exact<3>(a), end[0], end[1], end[2], x));
  if (!first && meet(end, corners)) first = 1;
  return first;
}

/// The first touch of a wall, by the rational arithmetic of the tests.
template <int D>
std::optional<Rational> touch_of(const World<D>& world, const Wall<D>& wall, std::span<const Point<D>> points,
                                 const Move<D>& move) {
  std::vector<Point<3>> obstacle;
  for (const std::uint32_t v : wall.corners) obstacle.push_back(embedded<D>(world.soup.points[v]));
  const Point<3> from = embedded<D>(points[move.vertex]), to = embedded<D>(move.to);
  const auto of_point = test::touch_of_point(from, to, obstacle).later;
  if (points.size() == 1) return of_point;
  if (points.size() == 3)
    return first_meeting(
        from, to,
        std::array{embedded<D>(points[(move.vertex + 1) % 3]), embedded<D>(points[(move.vertex + 2) % 3])},
        obstacle);
  const auto of_edge = test::touch_of_edge(from, to, embedded<D>(points[1 - move.vertex]), obstacle).later;
  return !of_edge || (of_point && *of_point < *of_edge) ? of_point : of_edge;
}

template <int D>
std::string lowest_feature(const World<D>& world, std::span<const Vec> object) {
  const auto is_met = [&](const std::vector<Vec>& feature) { return meet(object, feature); };
  if (std::ranges::any_of(world.vertex_points, is_met)) return "vertex";
  return std::ranges::any_of(world.edge_points, is_met) ? "edge" : "facet";
}

template <int D>
std::vector<std::uint32_t> walls_met(const World<D>& world, std::span<const Vec> object) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < world.walls.size(); ++i)
    if (meet(object, world.wall_points[i])) result.push_back(i);
  return result;
}

/// Walls that the object meets at both of two times and between them, in whose plane it moves.
template <int D>
bool slides(const World<D>& world, const Case<D>& c, std::uint32_t move, const Rational& until) {
  const std::vector<Vec> early = pose(c, move, Rational(until / 3)),
                         late = pose(c, move, Rational(until / 2));
  return until > 0 && std::ranges::any_of(world.wall_points, [&](const std::vector<Vec>& wall) {
           return meet(early, wall) && meet(late, wall);
         });
}

}  // namespace

template <int D>
bool meets_walls(const World<D>& world, std::span<const Point<D>> points) {
  std::vector<Vec> object;
  for (const Point<D>& p : points) object.push_back(exact<D>(p));
  return !walls_met<D>(world, object).empty();
}

template <int D>
std::optional<Rational> first_touch(const World<D>& world, std::span<const Point<D>> points,
                                    const Move<D>& move) {
  if (points.size() > 3) throw std::invalid_argument("a point, an edge or a triangle");
  std::optional<Rational> first;
  for (const Wall<D>& wall : world.walls) {
    const auto later = touch_of<D>(world, wall, points, move);
    if (later && (!first || *later < *first)) first = later;
  }
  return first;
}

template <int D>
std::optional<Rational> first_touch_of_walls(const World<D>& world, std::span<const Point<D>> points,
                                             const Move<D>& move) {
  const std::array obstacle{embedded<D>(points[0]), embedded<D>(points[1])};
  std::optional<Rational> first;
  for (const Wall<D>& wall : world.walls) {
    if (std::ranges::find(wall.corners, move.vertex) == wall.corners.end()) continue;
    std::vector<Point<3>> still;
    for (const std::uint32_t v : wall.corners)
      if (v != move.vertex) still.push_back(embedded<D>(world.soup.points[v]));
    const auto time =
        first_meeting(embedded<D>(world.soup.points[move.vertex]), embedded<D>(move.to), still, obstacle);
    if (time && (!first || *time < *first)) first = time;
  }
  return first;
}

template <int D>
Meeting meeting(const World<D>& world, const Case<D>& c, std::uint32_t move, const Rational& time) {
  const std::vector<Vec> object = pose(c, move, time);
  Meeting m{move, time, {}, {}, {}};
  if (c.moves_wall) {
    World<D> then = world;
    const Move<D>& moved = c.moves[move];
    place_vertex(then, moved.vertex,
                 between(exact<D>(world.soup.points[moved.vertex]), exact<D>(moved.to), time));
    m.walls = walls_met<D>(then, object);
    m.feature = lowest_feature<D>(then, object);
  } else {
    m.walls = walls_met<D>(world, object);
    m.feature = lowest_feature<D>(world, object);
  }
  std::set<std::string> kinds;
  for (const std::uint32_t w : m.walls)
    kinds.insert(wall_kind_names[static_cast<std::size_t>(world.walls[w].kind)]);
  m.wall_kinds.assign(kinds.begin(), kinds.end());
  return m;
}

template <int D>
void find_touch(const World<D>& world, Case<D>& c) {
  c.at_start = meets_walls<D>(world, c.points);
  std::vector<Point<D>> points = c.points;
  for (std::uint32_t m = 0; m < c.moves.size(); ++m) {
    std::optional<Rational> first = c.moves_wall ? first_touch_of_walls<D>(world, points, c.moves[m])
                                                 : first_touch<D>(world, points, c.moves[m]);
    for (const Meeting& crossing : c.crossings)
      if (crossing.move == m && (!first || crossing.time < *first)) first = crossing.time;
    if (first) {
      c.touch = meeting(world, c, m, *first);
      return;
    }
    if (!c.moves_wall) points[c.moves[m].vertex] = c.moves[m].to;
  }
}

template <int D>
std::string degeneracy(const World<D>& world, const Case<D>& c) {
  const bool moves =
      std::ranges::any_of(c.moves, [&](const Move<D>& m) { return m.to != start_of(c, world, m); });
  if (!moves) return c.at_start ? "zero_length_on_wall" : "zero_length";
  const auto last = [&](std::uint32_t m) {
    return !c.crossings.empty() && c.crossings[0].move == m ? c.crossings[0].time : Rational(1);
  };
  // With a crossing at the start nothing has moved.
  if (c.at_start && slides(world, c, 0, last(0))) return "slides_on_wall";
  if (c.at_start) {
    const Meeting start = meeting(world, c, 0, Rational(0));
    return (c.crossing == Crossing::no ? "leaves_" : "starts_on_") + start.feature;
  }
  if (!c.touch) return "clear";
  if (c.touch->time == 1 && c.touch->move + 1 == c.moves.size() && c.crossing == Crossing::no)
    return "ends_on_" + c.touch->feature;
  const bool blocked_there = c.crossing != Crossing::no && c.crossings[0].move == c.touch->move &&
                             c.crossings[0].time == c.touch->time;
  return (blocked_there ? "hits_" : "touches_") + c.touch->feature;
}

#define CELLWALK_INSTANTIATE(D)                                                                        \
  template bool meets_walls<D>(const World<D>&, std::span<const Point<D>>);                            \
  template std::optional<Rational> first_touch<D>(const World<D>&, std::span<const Point<D>>,          \
                                                  const Move<D>&);                                     \
  template std::optional<Rational> first_touch_of_walls<D>(const World<D>&, std::span<const Point<D>>, \
                                                           const Move<D>&);                            \
  template Meeting meeting<D>(const World<D>&, const Case<D>&, std::uint32_t, const Rational&);        \
  template void find_touch<D>(const World<D>&, Case<D>&);                                              \
  template std::string degeneracy<D>(const World<D>&, const Case<D>&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::corpus
