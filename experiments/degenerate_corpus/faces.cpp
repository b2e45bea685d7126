// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangles of which one vertex moves, and that start off all walls. The oracles of walks and chains judge
// the vertex and its edges, the rational arithmetic of the tests what comes through the face.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "edge/rational_face.h"
#include "edge_judge.h"
#include "makers.h"
#include "touch.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::corpus {
namespace {

class Face_maker final : public Maker<3> {
 public:
  Face_maker(const World<3>& world, std::uint64_t seed)
      : world_(world), judge_(world.soup), source_world_{"", world.soup, true}, source_(source_world_, seed) {
    for (const Wall<3>& wall : world.walls) {
      std::array<Point<3>, 3>& corners = walls_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) corners[i] = world.soup.points[wall.corners[i]];
    }
  }

  std::optional<Case<3>> propose() override {
    Case<3> c = source_.random().chance(0.4) ? around_corner() : anywhere();
    if (test::on_one_line({c.points[0], c.points[1], c.points[2]})) return {};
    if (meets_walls<3>(world_, c.points)) return {};
    return c;
  }

  bool judge(Case<3>& c) override {
    const Move<3>& move = c.moves[0];
    const Point<3>&a = c.points[move.vertex], &q = c.points[(move.vertex + 1) % 3],
          &r = c.points[(move.vertex + 2) % 3];
    std::optional<Rational> first_of_edges, first_of_face;
    for (const Point<3>& other : {q, r}) {
      std::optional<Edge<3>> edge = judge_.place(a, other);
      if (!edge) return false;
      const std::optional<Judged> judged = judge_.move(*edge, {0, move.to});
      // Where an edge has a choice, its face may have none.
      if (!judged || judged->crossing == Crossing::either || judged->times.size() > 1) return false;
      if (!judged->times.empty()) keep(first_of_edges, judged->times[0]);
    }
    if (a == move.to) return true;
    const test::Triangle face{a, q, r};
    const bool is_flat = test::orientation_of(a, q, r, move.to) == 0;
    if (is_flat && meets_in_plane(face, move.to)) return false;
    if (!is_flat)
      for (const auto& wall : walls_)
        if (const auto time = test::first_piercing(face, 0, move.to, wall))
          keep(first_of_face, Rational(time->str()));
    // A wall that passes an edge passes the face.
    if (!is_flat && first_of_edges && (!first_of_face || *first_of_edges < *first_of_face))
      throw std::logic_error("an edge that its face contradicts");
    c.nature = nature(c, is_flat, q, r);
    const std::optional<Rational>& first = is_flat ? first_of_edges : first_of_face;
    if (!first) return true;
    c.crossing = Crossing::yes;
    c.crossings = {meeting(world_, c, 0, *first)};
    return true;
  }

 private:
  /// Where the face first touches a wall.
  const char* nature(const Case<3>& c, bool is_flat, const Point<3>& q, const Point<3>& r) const {
    if (is_flat) return "in its plane";
    const Move<3>& move = c.moves[0];
    const auto of_face = first_touch<3>(world_, c.points, move);
    if (!of_face) return "";
    for (const Point<3>& other : {q, r})
      if (first_touch<3>(world_, std::array{c.points[move.vertex], other}, {0, move.to}) == of_face)
        return "at an edge";
    return "within";
  }

  static void keep(std::optional<Rational>& first, const Rational& time) {
    if (!first || time < *first) first = time;
  }

  oracle::Motion_kind kind() {
    for (;;) {
      const oracle::Motion_kind k = source_.kind(source_.random().below(12) == 0);
      if (k != oracle::Motion_kind::in_wall_plane && k != oracle::Motion_kind::along_edge &&
          k != oracle::Motion_kind::nowhere)
        return k;
    }
  }

  Vector<3> way_from(const Point<3>& x, double size) { return size * (source_.target(kind(), x, x) - x); }

  double size() { return std::ldexp(1.0, -static_cast<int>(source_.random().below(3))); }

  Case<3> anywhere() {
    Case<3> c;
    c.points = {source_.start(kind())};
    const double size = this->size();
    for (int i = 0; i < 2; ++i) c.points.push_back(c.points[0] + way_from(c.points[0], size));
    const auto v = static_cast<std::uint32_t>(source_.random().below(3));
    c.moves = {{v, target(c.points[v], c.points[(v + 1) % 3], c.points[(v + 2) % 3])}};
    return c;
  }

  /// A face whose inside meets a corner of a wall on its way, or at its end: with half of the weight of the
  /// vertex that moves, and a quarter of the others each.
  Case<3> around_corner() {
    Random& random = source_.random();
    Point<3> corner{};
    Vector<3> q{}, r{}, way{};
    for (int tries = 0; tries < 30; ++tries) {
      corner = any_corner();
      const double size = this->size() / 2;
      q = way_from(corner, size);
      r = way_from(corner, size);
      way = way_from(corner, size);
      const double towards = side_of_walls(corner, cross(q, r));
      if (towards == 0) continue;
      if (towards * dot(way, cross(q, r)) < 0) way = -1.0 * way;
      break;
    }
    const Point<3> met = corner - 0.5 * (q + r);
    const auto v = static_cast<std::uint32_t>(random.below(3));
    Case<3> c;
    c.points.resize(3);
    c.points[v] = met - way;
    c.points[(v + 1) % 3] = corner + q;
    c.points[(v + 2) % 3] = corner + r;
    c.moves = {{v, met + (random.chance(0.3) ? 0.0 : random.chance(0.5) ? 0.25 : 1.0) * way}};
    return c;
  }

  /// The side of a plane through a corner of walls on which all of these lie; 0 if there is none.
  double side_of_walls(const Point<3>& corner, const Vector<3>& normal) const {
    double low = 0, high = 0;
    for (const auto& wall : walls_) {
      if (std::ranges::find(wall, corner) == wall.end()) continue;
      for (const Point<3>& x : wall)
        if (x != corner) {
          const double height = dot(normal, x - corner);
          if (height == 0) return 0;
          low = std::min(low, height);
          high = std::max(high, height);
        }
    }
    return low == 0 ? high : high == 0 ? low : 0;
  }

  /// Anywhere; in the plane of the face; or so that the inside of the face, or an edge, passes a corner of a
  /// wall.
  Point<3> target(const Point<3>& from, const Point<3>& q, const Point<3>& r) {
    Random& random = source_.random();
    const std::uint64_t way = random.below(8);
    if (way == 0) return source_.random().below(8) == 0 ? from : source_.target(kind(), from, from);
    if (way == 1) {
      const double of_q = static_cast<double>(random.below(17)) / 8 - 1;
      const double of_r = static_cast<double>(random.below(17)) / 8 - 1;
      return from + of_q * (q - from) + of_r * (r - from);
    }
    if (way < 6) {
      // The vertex has half of the weight there, and one or both of the others the rest.
      const Point<3> over = 2.0 * near_corner(from) - (way < 4 ? 0.5 * (q + r) : q);
      return from + (random.chance(0.3) ? 1.0 : 1.25) * (over - from);
    }
    return source_.target(kind(), from, from);
  }

  Point<3> any_corner() {
    const auto& wall = walls_[source_.random().below(walls_.size())];
    return wall[source_.random().below(3)];
  }

  /// The nearest of some corners of walls.
  Point<3> near_corner(const Point<3>& x) {
    constexpr int tries = 6;
    Point<3> best = any_corner();
    for (int i = 1; i < tries; ++i)
      if (const Point<3> other = any_corner(); length(other - x) < length(best - x)) best = other;
    return best;
  }

  /// True if a wall in the plane of the face meets the hull of what it sweeps.
  bool meets_in_plane(const test::Triangle& face, const Point<3>& to) const {
    const auto& [a, q, r] = face;
    return std::ranges::any_of(walls_, [&](const auto& wall) {
      const auto in_plane = [&](const Point<3>& x) { return test::orientation_of(a, q, r, x) == 0; };
      if (!std::ranges::all_of(wall, in_plane)) return false;
      const std::vector<Vec> closed = rational(wall);
      return std::ranges::any_of(
          std::array<test::Triangle, 4>{{{a, q, r}, {to, q, r}, {a, to, q}, {a, to, r}}},
          [&](const test::Triangle& part) { return meet(rational(part), closed); });
    });
  }

  static std::vector<Vec> rational(const std::array<Point<3>, 3>& points) {
    return {exact<3>(points[0]), exact<3>(points[1]), exact<3>(points[2])};
  }

  const World<3>& world_;
  std::vector<std::array<Point<3>, 3>> walls_;
  Edge_judge<3> judge_;
  const oracle::World<3> source_world_;
  oracle::Motion_source<3> source_;
};

}  // namespace

std::unique_ptr<Maker<3>> face_maker(const World<3>& world, std::uint64_t seed) {
  return std::make_unique<Face_maker>(world, seed);
}

}  // namespace cellwalk::corpus
