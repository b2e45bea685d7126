// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move among bodies with a radius, judged by distances of hulls in rationals.
#include <cellwalk/internal/edge/thick_wall.h>
#include <cellwalk/internal/kernel/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "kernel/rational_distance.h"
#include "reshape/reshape_world.h"
#include "reshape/thick_world.h"

namespace cellwalk::test {
namespace {

using detail::first_meeting;
using detail::Thick_meeting;
using Points = std::vector<Point<3>>;

/// The wall of cases 49 and 50: a triangle that turns up about one of its sides.
const std::array<Point<3>, 4> turning_wall{{{4, 8, 0}, {4, 8, 8}, {0, 0, 0}, {8, 0, 0}}};

bool is_free(const Points& feature, double r) {
  Vector<3> direction{};
  Distance_counts counts;
  return detail::is_apart<3>(turning_wall, feature, r, direction, counts);
}

TEST(ThickWalls, AWallComesWithinTheRadius) {
  const Points edge{{2, 2, 4}, {6, 2, 4}};
  ASSERT_FALSE(is_free(edge, 1.5));
  const Thick_meeting<3> met = *first_meeting<3>(turning_wall, edge, 1.5);
  EXPECT_EQ(met.time.rounded(), 0.9602215257815605);
  EXPECT_GT(dot(met.normal, {0, 0, 1}), 0.5);
  EXPECT_TRUE(is_free(edge, 1.25));
}

TEST(ThickWalls, AWallPassesAndGoesOn) {
  const Points particle{{4, 2, 1}};
  ASSERT_FALSE(is_free(particle, 0.5));
  const Thick_meeting<3> met = *first_meeting<3>(turning_wall, particle, 0.5);
  EXPECT_EQ(met.time.rounded(), 0.24274007043062176);
  EXPECT_EQ(met.of_wall.size, 3);
  EXPECT_FALSE(first_meeting<3>(turning_wall, particle, 0.5, Exact_time(0.125)));
  EXPECT_NEAR(met.normal[2], 0.97, 0.02);
  // Where the wall ends, it is far behind.
  EXPECT_GT(length(detail::nearest_in_doubles<3>(
                       std::array{turning_wall[1], turning_wall[2], turning_wall[3]}, particle)
                       .on_a -
                   particle[0]),
            0.5);
}

/// The side that stands still is at the radius itself: the wall may turn away, or until it is in the plane
/// across the shortest way.
TEST(ThickWalls, AWallTurnsAboutASideAtTheRadius) {
  const Points edge{{2, -3, 0}, {6, -3, 0}};
  EXPECT_TRUE(is_free(edge, 3));
  std::array<Point<3>, 4> back{{{4, 8, 0}, {4, -8, 8}, {0, 0, 0}, {8, 0, 0}}};
  const Thick_meeting<3> met = *first_meeting<3>(back, edge, 3);
  EXPECT_EQ(met.time, Exact_time(0.5));
  EXPECT_EQ(met.normal, (Vector<3>{0, -1, 0}));
  EXPECT_EQ(met.of_wall.size, 2);
}

struct Tally {
  int moves = 0, reached = 0, contacts = 0, others = 0, by_faces = 0, of_faces = 0, at_once = 0;
  int missed = 0, false_blocks = 0, wrong_times = 0, wrong_places = 0, too_near = 0;
  int wrong() const { return missed + false_blocks + wrong_times + wrong_places + too_near; }
};

/// One move of a vertex by At_contact::hold.
template <int D, class World>
class Move_judge {
 public:
  Move_judge(World& world, Tally& tally) : world_(world), tally_(tally) {}

  void judge(Reshaping<D>& reshaping, std::uint32_t v, const Point<D>& target) {
    from_ = world_.snapshot.point(v);
    target_ = target;
    find_walls(v);
    parts_.clear();
    for (const auto& body : world_.bodies)
      for (const Thick_part<D>& part : thick_parts(*body)) parts_.push_back(part);
    const bool is_blocked = !is_free_until(Fraction(1));
    const Vertex_result<D> result = reshaping.move(v, target);
    ++tally_.moves;
    if (result.end == Move_end::cell || result.end == Move_end::boundary) {
      ++tally_.others;
      return;
    }
    tally_.reached += result.end == Move_end::reached;
    tally_.missed += is_blocked && result.end == Move_end::reached;
    tally_.false_blocks += !is_blocked && result.end != Move_end::reached;
    if (!is_blocked || result.end == Move_end::reached) return;
    if (!result.hit) {
      ++tally_.wrong_times;
      return;
    }
    ++tally_.contacts;
    judge_time(result.hit->time);
    judge_place(*result.hit);
  }

 private:
  struct Wall {
    std::vector<std::uint32_t> still;
    std::vector<Half_facet> sides;  ///< free ones
  };

  void find_walls(std::uint32_t v) {
    walls_.clear();
    const Snapshot<D>& s = world_.snapshot;
    std::map<std::vector<std::uint32_t>, Wall> walls;
    for (const Cell c : world_.environment.cells_around(v))
      for (std::size_t i = 0; i < s.facet_count(c); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        std::vector<std::uint32_t> loop = s.loop(f);
        if (std::ranges::find(loop, v) == loop.end() || !s.is_impassable(f) || s.is_solid(c)) continue;
        std::rotate(loop.begin(), std::ranges::find(loop, v), loop.end());
        std::vector<std::uint32_t> key = loop;
        std::ranges::sort(key);
        Wall& wall = walls[key];
        wall.still.assign(loop.begin() + 1, loop.end());
        wall.sides.push_back(f);
      }
    for (auto& [key, wall] : walls) walls_.push_back(std::move(wall));
  }

  Hull<D> hull_of(const Wall& wall, const Fraction& time) const {
    Hull<D> hull{to_rational_point(from_), at_time(from_, target_, time)};
    for (const std::uint32_t p : wall.still) hull.push_back(to_rational_point(world_.snapshot.point(p)));
    return hull;
  }

  bool is_free_until(const Fraction& time) const {
    for (const Wall& wall : walls_) {
      const Hull<D> hull = hull_of(wall, time);
      for (const Thick_part<D>& part : parts_)
        if (!root_is_at_least(shortest_vector<D>(hull, to_hull<D>(part.corners)).square, part.radius))
          return false;
    }
    return true;
  }

  void judge_time(double time) {
    tally_.at_once += time == 0;
    const bool is_right = time >= 0 && time <= 1 && is_free_until(Fraction(time)) &&
                          !is_free_until(Fraction(std::nextafter(time, 2)));
    tally_.wrong_times += !is_right;
  }

  /// The point lies on the wall at that time, and the resident is at its radius from there along the normal.
  void judge_place(const Wall_hit<D>& hit) {
    const auto wall = std::ranges::find_if(
        walls_, [&](const Wall& w) { return std::ranges::find(w.sides, hit.facet) != w.sides.end(); });
    const Body<D>& body = *world_.bodies[hit.resident.owner];
    std::vector<std::uint32_t> vertices{hit.resident.number};
    double r = 0;
    for (const Thick_part<D>& part : thick_parts(body)) {
      if (part.feature != hit.resident.feature || part.number != hit.resident.number) continue;
      // The weights are those of the corners in their order.
      if (part.feature == Body_feature::face)
        vertices.assign(body.faces()[part.number].begin(), body.faces()[part.number].end());
      else
        vertices = part.vertices;
      r = part.radius;
    }
    const Vector<D> way = target_ - from_;
    double size = length(way);
    Point<D> on_resident{}, on_wall{};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      on_resident = on_resident + hit.resident_weights[i] * body.positions()[vertices[i]];
      size += length(body.positions()[vertices[i]] - from_);
    }
    bool is_right = wall != walls_.end();
    if (is_right) {
      on_wall = on_wall + hit.weights[0] * (from_ + hit.time * way);
      // The order of the others is that of the loop, seen from one of both sides.
      std::vector<Point<D>> still;
      for (const std::uint32_t p : wall->still) still.push_back(world_.snapshot.point(p));
      Point<D> one = on_wall, other = on_wall;
      for (std::size_t i = 0; i < still.size(); ++i) {
        one = one + hit.weights[1 + i] * still[i];
        other = other + hit.weights[1 + i] * still[still.size() - 1 - i];
        size += length(still[i] - from_);
      }
      is_right = std::min(length(one - hit.point), length(other - hit.point)) <= 0x1p-30 * size;
    }
    const Vector<D> between = on_resident - hit.point;
    const double apart = length(between);
    if (vertices.size() > 1) is_right &= std::abs(apart - r) <= 0x1p-30 * size;
    // Inside of a wall, it is seen from the side on which the resident is. At the start it may be the other
    // side of a slit, whose walls are in one place but have different corners.
    if (hit.time > 0 && std::ranges::all_of(hit.weights, [](double w) { return w > 1e-9; }))
      for (const std::uint32_t p : world_.snapshot.view(world_.snapshot.cell_of(hit.facet)).vertices)
        if (const auto loop = world_.snapshot.loop(hit.facet); std::ranges::find(loop, p) == loop.end())
          is_right &= dot(world_.snapshot.point(p) - hit.point, hit.normal) > 0;
    is_right &= std::abs(length(hit.normal) - 1) < 0x1p-40;
    is_right &= length(between - apart * hit.normal) <= 0x1p-26 * size;
    is_right &= dot(hit.normal, way) * hit.weights[0] >= -0x1p-30 * length(way);
    is_right &= std::abs(std::accumulate(hit.weights.begin(), hit.weights.end(), -1.0)) < 1e-9;
    tally_.wrong_places += !is_right;
    tally_.by_faces += hit.kind == Contact_kind::facet;
    tally_.of_faces += hit.body == Body_feature::face;
  }

  World& world_;
  Tally& tally_;
  Point<D> from_, target_;
  std::vector<Wall> walls_;
  std::vector<Thick_part<D>> parts_;
};

/// A vertex of a cell that a body is in.
template <int D>
std::uint32_t vertex_near_body(Reshape_world<D>& world) {
  const auto particles = world.bodies[world.random.below(world.bodies.size())]->particles();
  const Cell c = particles[world.random.below(particles.size())].cell;
  const auto vertices = world.snapshot.view(c).vertices;
  return vertices[world.random.below(vertices.size())];
}

template <int D>
void expect_moves_right(bool generic, std::size_t worlds, At_contact at_contact) {
  Tally tally;
  std::uint64_t pushes = 0;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Reshape_world<D> world(number, generic);
    world.populate(0, 8);
    give_radii<D>(world, 0.4);
    if (world.bodies.empty()) continue;
    Move_judge<D, Reshape_world<D>> judge(world, tally);
    for (int phase = 0; phase < 3; ++phase) {
      Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = at_contact});
      for (int i = 0; i < 12; ++i) {
        const std::uint32_t v = vertex_near_body(world);
        const Point<D> target = world.target(v);
        if (at_contact == At_contact::hold)
          judge.judge(reshaping, v, target);
        else
          tally.reached += reshaping.move(v, target).end == Move_end::reached, ++tally.moves;
      }
      pushes += reshaping.counts().pushes;
      reshaping.finish();
      tally.too_near += count_too_near<D>(world);
    }
    EXPECT_EQ(tally.wrong(), 0) << world.name() << ", world " << number;
    if (testing::Test::HasFailure()) break;
  }
  const auto& t = tally;
  std::printf(
      "%dD: %d moves, %d reached, %d contacts (%d inside of walls, %d of faces, %d at once), %d others; "
      "missed %d, false "
      "blocks %d, wrong times %d, wrong places %d, too near %d; pushes %d\n",
      D, t.moves, t.reached, t.contacts, t.by_faces, t.of_faces, t.at_once, t.others, t.missed,
      t.false_blocks, t.wrong_times, t.wrong_places, t.too_near, static_cast<int>(pushes));
  if (oracle::is_shortened()) return;
  EXPECT_GT(tally.reached, tally.moves / 10);
  if (at_contact == At_contact::hold) {
    EXPECT_GT(tally.contacts, tally.moves / 20);
    EXPECT_GT(tally.by_faces, 0);
    EXPECT_GT(tally.at_once, 0);
  } else {
    EXPECT_GT(pushes, worlds);
  }
}

TEST(ThickWalls, MoveAmongBodies2D) {
  expect_moves_right<2>(true, some_worlds(40), At_contact::hold);
  expect_moves_right<2>(false, some_worlds(80), At_contact::hold);
}
TEST(ThickWalls, MoveAmongBodies3D) {
  expect_moves_right<3>(true, some_worlds(15), At_contact::hold);
  expect_moves_right<3>(false, some_worlds(30), At_contact::hold);
}
TEST(ThickWalls, PushBodies2D) { expect_moves_right<2>(false, some_worlds(40), At_contact::push); }
TEST(ThickWalls, PushBodies3D) { expect_moves_right<3>(false, some_worlds(15), At_contact::push); }

}  // namespace
}  // namespace cellwalk::test
