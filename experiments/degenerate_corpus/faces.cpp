// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangles of which one vertex moves, and that start off all walls. The oracles of walks and chains judge
// the vertex and its edges, the rational arithmetic of the tests what comes through the face.
#include <algorithm>
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
      : world_(world),
        judge_(world.soup),
        source_world_{"", world.soup, true},
        source_(source_world_, seed) {
    for (const Wall<3>& wall : world.walls) {
      std::array<Point<3>, 3>& corners = walls_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) corners[i] = world.soup.points[wall.corners[i]];
    }
  }

  std::optional<Case<3>> propose() override {
    Case<3> c;
    c.points = {source_.start(kind())};
    for (int i = 0; i < 2; ++i) c.points.push_back(source_.target(kind(), c.points[0], c.points[0]));
    const auto v = static_cast<std::uint32_t>(source_.random().below(3));
    c.moves = {{v, target(c.points[v], c.points[(v + 1) % 3], c.points[(v + 2) % 3])}};
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
    const std::optional<Rational>& first = is_flat ? first_of_edges : first_of_face;
    if (!first) return true;
    c.crossing = Crossing::yes;
    c.crossings = {meeting(world_, c, 0, *first)};
    c.nature = is_flat ? "in its plane" : first_of_edges == first_of_face ? "at an edge" : "within";
    return true;
  }

 private:
  static void keep(std::optional<Rational>& first, const Rational& time) {
    if (!first || time < *first) first = time;
  }

  oracle::Motion_kind kind() {
    for (;;) {
      const oracle::Motion_kind k = source_.kind(source_.random().below(12) == 0);
      if (k != oracle::Motion_kind::in_wall_plane && k != oracle::Motion_kind::along_edge) return k;
    }
  }

  /// Anywhere; in the plane of the face; or so that the inside of the face passes a corner of a wall.
  Point<3> target(const Point<3>& from, const Point<3>& q, const Point<3>& r) {
    Random& random = source_.random();
    const std::uint64_t way = random.below(6);
    if (way == 0) {
      const double of_q = static_cast<double>(random.below(17)) / 8 - 1;
      const double of_r = static_cast<double>(random.below(17)) / 8 - 1;
      return from + of_q * (q - from) + of_r * (r - from);
    }
    if (way < 3) {
      const auto& wall = walls_[random.below(walls_.size())];
      const Point<3> over = 2.0 * wall[random.below(3)] - 0.5 * (q + r);  // half its weight, and a quarter of each
      return from + (random.chance(0.4) ? 1.0 : 1.25) * (over - from);
    }
    return source_.target(kind(), from, from);
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
