// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes of several cubes, whose sides are several facets in one plane: bodies move among them as among cubes,
// in whatever order the facets are listed.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "body/membrane_room.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

using Corner = std::array<int, 3>;
struct Box_of_cubes {
  Corner low, high;
};
constexpr Corner block_size{3, 3, 2};

/// The boxes as cells whose facets are the unit squares of their sides.
Environment<3> built(const std::vector<Box_of_cubes>& boxes, bool is_reversed) {
  Cell_soup<3> soup;
  const auto point = [](const Corner& x) {
    return static_cast<std::uint32_t>(x[0] + (block_size[0] + 1) * (x[1] + (block_size[1] + 1) * x[2]));
  };
  for (int z = 0; z <= block_size[2]; ++z)
    for (int y = 0; y <= block_size[1]; ++y)
      for (int x = 0; x <= block_size[0]; ++x)
        soup.points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  for (const auto& [low, high] : boxes) {
    for (std::size_t n = 0; n < 6; ++n) {
      const std::size_t side = is_reversed ? 5 - n : n, a = side / 2, u = (a + 1) % 3, v = (a + 2) % 3;
      const bool is_high = side % 2 != 0;
      for (int i = low[u]; i < high[u]; ++i)
        for (int j = low[v]; j < high[v]; ++j) {
          const auto corner = [&](int du, int dv) {
            Corner x{};
            x[a] = is_high ? high[a] : low[a];
            x[u] = i + du;
            x[v] = j + dv;
            return point(x);
          };
          if (is_high)
            soup.add_facet({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)});
          else
            soup.add_facet({corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)});
        }
    }
    soup.end_cell();
  }
  return Environment<3>::build(soup);
}

std::vector<Box_of_cubes> cubes() {
  std::vector<Box_of_cubes> result;
  for (int z = 0; z < block_size[2]; ++z)
    for (int y = 0; y < block_size[1]; ++y)
      for (int x = 0; x < block_size[0]; ++x) result.push_back({{x, y, z}, {x + 1, y + 1, z + 1}});
  return result;
}

/// Makes walls of the unit squares with these centres.
void close(Environment<3>& environment, const std::set<std::array<double, 3>>& centres) {
  const Snapshot<3>& snapshot = environment.snapshot();
  std::size_t closed = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      const Point<3> x = centroid(snapshot, f);
      if (snapshot.is_impassable(f) || !centres.contains({x[0], x[1], x[2]})) continue;
      environment.set_impassable(f, true);
      ++closed;
    }
  ASSERT_EQ(closed, centres.size());
}

TEST(MergedCells, AFaceLiesBesideAWallThatStandsBelowTheFloor) {
  std::vector<Box_of_cubes> boxes = cubes();
  std::erase_if(boxes, [](const Box_of_cubes& box) { return box.low[1] == 0 && box.low[2] == 1; });
  boxes.push_back({{0, 0, 1}, {3, 1, 2}});
  for (const bool is_reversed : {false, true}) {
    auto environment = built(boxes, is_reversed);
    close(environment, {{0.5, 0.5, 1}, {1.5, 0.5, 1}, {1, 0.5, 0.5}});
    Moving face(environment.snapshot(), {{1, 0.25, 1.5}, {1, 0.75, 1.5}, {2, 0.5, 1.5}}, {{0, 1, 2}});
    EXPECT_TRUE(face.lift(1, 3)) << "onto the floor, of which a part is open";
    EXPECT_TRUE(face.lift(1.5, 3));
  }
}

/// An edge in the plane of a wall: whether its sides are searched must not depend on which facet comes first.
/// It prefers to pass above the wall, and its face is below.
TEST(MergedCells, AnEdgePassesAWallOnTheSideOnWhichItDoesAmongCubes) {
  const std::vector<Box_of_cubes> merged{
      {{0, 1, 1}, {1, 2, 2}}, {{1, 0, 0}, {2, 1, 2}}, {{0, 0, 0}, {1, 2, 1}}, {{1, 1, 0}, {2, 2, 1}},
      {{1, 2, 1}, {3, 3, 2}}, {{2, 1, 0}, {3, 3, 1}}, {{1, 1, 1}, {3, 2, 2}}, {{1, 2, 0}, {2, 3, 1}},
      {{0, 0, 1}, {1, 1, 2}}, {{0, 2, 0}, {1, 3, 1}}, {{0, 2, 1}, {1, 3, 2}}, {{2, 0, 0}, {3, 1, 1}},
      {{2, 0, 1}, {3, 1, 2}}};
  for (const auto& boxes : {cubes(), merged})
    for (const bool is_reversed : {false, true}) {
      auto environment = built(boxes, is_reversed);
      close(environment, {{2.5, 1.5, 1}});
      Moving face(environment.snapshot(), {{1.375, 0.625, 0.625}, {3, 2, 0.5}, {2.125, 2.625, 0.625}},
                  {{0, 1, 2}});
      EXPECT_FALSE(face.move(2, {2.125, 2.625, 1}));
      EXPECT_FALSE(face.move(0, {1.375, 0.625, 1}));
      EXPECT_FALSE(face.move(2, {2.625, 2.625, 1}));
      EXPECT_TRUE(face.move(2, {2.625, 2.625, 1.5})) << "the face is below the wall";
    }
}

/// Cubes merged at random, none of which has a wall inside.
class Merged {
 public:
  explicit Merged(Random& random) {
    const double flat = random.chance(0.5) ? 0.4 : 0.7, upright = random.chance(0.5) ? 0.1 : 0.3;
    for (const auto& [low, high] : cubes())
      for (std::size_t a = 0; a < 3; ++a) {
        std::array<double, 3> centre{low[0] + 0.5, low[1] + 0.5, low[2] + 0.5};
        centre[a] -= 0.5;
        if (low[a] > 0 && random.chance(a == 2 ? flat : upright)) walls.insert(centre);
      }
    std::set<Corner> used;
    const auto is_free = [&](const Box_of_cubes& box) {
      const auto holds = [&](const auto& x) {
        for (std::size_t a = 0; a < 3; ++a)
          if (x[a] <= box.low[a] || x[a] >= box.high[a]) return false;
        return true;
      };
      if (std::ranges::any_of(walls, holds)) return false;
      return std::ranges::none_of(cubes_of(box), [&](const Corner& x) { return used.contains(x); });
    };
    const auto add = [&](const Box_of_cubes& box) {
      if (!is_free(box)) return;
      boxes.push_back(box);
      for (const Corner& x : cubes_of(box)) used.insert(x);
    };
    for (int k = 0; k < 60; ++k) {
      Box_of_cubes box{};
      for (std::size_t a = 0; a < 3; ++a) {
        box.low[a] = static_cast<int>(random.below(static_cast<std::size_t>(block_size[a])));
        box.high[a] = std::min(box.low[a] + (random.chance(0.5) ? 1 : 2), block_size[a]);
      }
      add(box);
    }
    for (const Box_of_cubes& cube : cubes()) add(cube);
  }

  std::set<std::array<double, 3>> walls;  ///< their centres
  std::vector<Box_of_cubes> boxes;

 private:
  static std::vector<Corner> cubes_of(const Box_of_cubes& box) {
    std::vector<Corner> result;
    for (int z = box.low[2]; z < box.high[2]; ++z)
      for (int y = box.low[1]; y < box.high[1]; ++y)
        for (int x = box.low[0]; x < box.high[0]; ++x) result.push_back({x, y, z});
    return result;
  }
};

struct Merged_seen {
  std::size_t moves = 0, free = 0, blocked = 0;
};

/// The same moves of a triangle among cubes and among boxes of cubes.
void move_in_both(std::uint64_t number, Merged_seen& seen) {
  Random random(number);
  const Merged world(random);
  std::array environments{built(cubes(), false), built(world.boxes, number % 2 != 0)};
  for (Environment<3>& environment : environments) close(environment, world.walls);
  const auto odd = [&](std::size_t n) { return 0.125 * static_cast<double>(1 + 2 * random.below(n)); };
  const std::vector<Point<3>> points{
      {odd(12), odd(12), odd(8)}, {odd(12), odd(12), odd(8)}, {odd(12), odd(12), odd(8)}};
  std::vector<Moving> bodies;
  int refused = 0;
  for (const Environment<3>& environment : environments) try {
      bodies.emplace_back(environment.snapshot(), points, std::vector{std::array<std::uint32_t, 3>{0, 1, 2}});
    } catch (const Error&) {
      ++refused;
    }
  EXPECT_NE(refused, 1) << "in one of them";
  if (refused > 0) return;
  std::vector<Point<3>> at = points;
  for (int k = 0; k < 120; ++k) {
    const auto v = static_cast<std::uint32_t>(random.below(3));
    Point<3> target = at[v];
    const std::size_t a = random.below(3);
    // Mostly to the plane between the layers, where most of the walls are, and to planes of other walls.
    const auto grid = [&](std::size_t axis) {
      return static_cast<double>(random.below(static_cast<std::size_t>(block_size[axis] + 1)));
    };
    const auto kind = random.below(10);
    if (kind < 4)
      target[2] = 1;
    else if (kind < 7)
      target[a] = grid(a);
    else if (kind < 8)
      target = {grid(0), grid(1), grid(2)};
    else
      target = {odd(12), odd(12), odd(8)};
    const auto one = bodies[0].move(v, target), other = bodies[1].move(v, target);
    ++seen.moves;
    ASSERT_EQ(one.has_value(), other.has_value()) << "move " << k;
    if (!one) at[v] = target;
    ++(one ? seen.blocked : seen.free);
    if (one) {
      EXPECT_EQ(one->exact_time(), other->exact_time()) << "move " << k;
    }
  }
}

TEST(MergedCells, TrianglesMoveAsAmongCubes) {
  Merged_seen seen;
  const std::size_t worlds = oracle::scaled_count(400);
  for (std::uint64_t number = 1; number <= worlds && !::testing::Test::HasFailure(); ++number) {
    SCOPED_TRACE(number);
    move_in_both(number, seen);
  }
  EXPECT_GT(seen.free, 10 * worlds);
  EXPECT_GT(seen.blocked, 2 * worlds);
}

}  // namespace
}  // namespace cellwalk::test
