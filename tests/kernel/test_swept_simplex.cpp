// SPDX-License-Identifier: LGPL-3.0-or-later
// Swept simplices against rational arithmetic, half of the time in degenerate positions.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/kernel/swept_simplex.h>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

#include "kernel/rational_meeting.h"

namespace cellwalk {
namespace {

using detail::Encounter;
using detail::Swept_simplex;
using test::Relation;

template <int D>
Point<D> random_point(Random& random, bool generic) {
  Point<D> x;
  for (double& c : x) c = generic ? random.real(-2, 2) : static_cast<double>(random.below(5)) - 2;
  return x;
}

template <int D>
Swept_simplex<D> make(std::span<const Point<D>> simplex) {
  typename Swept_simplex<D>::Corners still;
  std::copy(simplex.begin() + 2, simplex.end(), still.begin());
  Predicate_counts counts;
  return Swept_simplex<D>(simplex[0], simplex[1], still, counts);
}

test::Fraction exact(const Ring& x) { return test::to_fraction(to_rational(Fraction(x, Ring(1)))); }

test::Fraction sum_of(const std::vector<Ring>& weights) {
  test::Fraction sum = 0;
  for (const Ring& w : weights) sum += exact(w);
  return sum;
}

/// The point with these weights is the same whether it is made of the wall at that time or of the set.
template <int D>
void expect_one_point(const detail::Collision& hit, std::span<const Point<D>> simplex,
                      std::span<const Point<D>> set) {
  const test::Fraction time = test::to_fraction(to_rational(hit.time));
  for (std::size_t k = 0; k < D; ++k) {
    test::Fraction of_wall = 0, of_set = 0;
    for (std::size_t i = 0; i < hit.wall_weights.size(); ++i) {
      const test::Fraction w = exact(hit.wall_weights[i]);
      const test::Fraction x = i > 0 ? test::Fraction(simplex[i + 1][k])
                                     : test::Fraction(test::Fraction(simplex[0][k]) * (1 - time) +
                                                      test::Fraction(simplex[1][k]) * time);
      of_wall += w * x;
    }
    for (std::size_t i = 0; i < set.size(); ++i)
      of_set += exact(hit.feature_weights[i]) * test::Fraction(set[i][k]);
    EXPECT_TRUE(of_wall * sum_of(hit.feature_weights) == of_set * sum_of(hit.wall_weights));
  }
}

template <int D>
void compare(bool generic, std::map<std::pair<std::size_t, Relation>, int>& seen, int& flat) {
  Random random(generic ? 7 : 8);
  Predicate_counts counts;
  int reached = 0, left = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<Point<D>> simplex, set;
    for (int i = 0; i <= D; ++i) simplex.push_back(random_point<D>(random, generic));
    const std::size_t size = 1 + random.below(D == 2 ? 2 : 3);
    for (std::size_t i = 0; i < size; ++i) set.push_back(random_point<D>(random, generic));
    // The wall is not degenerate before it moves.
    std::vector<Point<D>> wall{simplex[0]};
    wall.insert(wall.end(), simplex.begin() + 2, simplex.end());
    Point<D> off = simplex[0];
    bool is_degenerate = simplex[0] == simplex[1];
    if (D == 2) is_degenerate |= simplex[0] == simplex[2];
    for (int k = 0; k < D && D == 3; ++k) off[k] += k + 0.37;
    if (D == 3) {
      std::vector<Point<D>> apex = wall;
      apex.push_back(off);
      is_degenerate |= test::volume_sign<D>(apex) == 0;
    }
    if (is_degenerate) continue;
    if (random.chance(0.2)) set[0] = 0.25 * (simplex[0] + simplex[1]) + 0.5 * simplex[2];
    if (D == 3 && random.chance(0.2)) set[0] = 0.25 * (simplex[0] + simplex[1] + simplex[2] + simplex[3]);
    // Some of the sets touch the wall where it is.
    if (!generic && random.chance(0.3)) set[0] = wall[random.below(wall.size())];
    if (!generic && size > 1 && random.chance(0.3)) set[1] = wall[1 + random.below(wall.size() - 1)];

    const Swept_simplex<D> swept = make<D>(simplex);
    const Relation expected = test::relation<D>(simplex, set);
    flat += swept.is_flat();
    ++seen[{size, expected}];
    ASSERT_EQ(test::relation_by_clipping<D>(simplex, set), expected) << "round " << round;
    const Encounter meeting = swept.meet(set, counts);
    ASSERT_EQ(static_cast<int>(meeting), static_cast<int>(expected)) << "round " << round;
    if (expected == Relation::apart) {
      EXPECT_FALSE(swept.reaches(set, counts));
    }
    if (!swept.is_flat()) {
      const bool reaches = test::meets_off_start<D>(simplex, set);
      ++(reaches ? reached : left);
      EXPECT_EQ(swept.reaches(set, counts), reaches) << "round " << round;
    }
    if (expected != Relation::hit) continue;
    EXPECT_TRUE(swept.reaches(set, counts));
    const detail::Collision hit = swept.first_hit(set);
    EXPECT_TRUE(test::to_fraction(to_rational(hit.time)) == *test::first_time<D>(simplex, set));
    expect_one_point<D>(hit, simplex, set);
  }
  EXPECT_GT(reached, 100);
  EXPECT_GT(left, 100);
}

template <int D>
void compare_all() {
  for (const bool generic : {true, false}) {
    std::map<std::pair<std::size_t, Relation>, int> seen;
    int flat = 0;
    compare<D>(generic, seen, flat);
    for (std::size_t size = 1; size <= (D == 2 ? 2 : 3); ++size) {
      EXPECT_GT((seen[{size, Relation::hit}]), 20) << size << generic;
      EXPECT_GT((seen[{size, Relation::apart}]), 100) << size << generic;
      if (!generic) {
        EXPECT_GT((seen[{size, Relation::touch}]), 100) << size;
      }
    }
    if (!generic) {
      EXPECT_GT(flat, 100);
    }
  }
}

TEST(SweptSimplex, AgreesWithRationalsIn2D) { compare_all<2>(); }
TEST(SweptSimplex, AgreesWithRationalsIn3D) { compare_all<3>(); }

TEST(SweptSimplex, WhatAWallLeavesIsNotReached) {
  Predicate_counts counts;
  // The wall in z = 0 moves up; what lies on it below is left, what lies above is reached.
  const Swept_simplex<3> up({0, 0, 0}, {0, 0, 1}, {Point<3>{4, 0, 0}, Point<3>{0, 4, 0}}, counts);
  const std::vector<Point<3>> below{{1, 1, 0}, {1, 1, -1}, {2, 1, -1}},
      above{{1, 1, 0}, {1, 1, 1}, {2, 1, 1}};
  EXPECT_EQ(up.meet(below, counts), Encounter::touch);
  EXPECT_FALSE(up.reaches(below, counts));
  EXPECT_EQ(up.meet(above, counts), Encounter::hit);
  EXPECT_TRUE(up.reaches(above, counts));
  // In its own plane it reaches what it did not cover, but not what meets its still edge alone.
  const Swept_simplex<3> within({0, 0, 0}, {-2, -2, 0}, {Point<3>{4, 0, 0}, Point<3>{0, 4, 0}}, counts);
  ASSERT_TRUE(within.is_flat());
  const std::vector<Point<3>> on_edge{{2, 2, 0}, {3, 3, 0}, {2, 2, 2}},
      ahead{{-1, -1, 0}, {-1, -1, 1}, {-2, -1, 1}};
  EXPECT_EQ(within.meet(on_edge, counts), Encounter::touch);
  EXPECT_FALSE(within.reaches(on_edge, counts));
  EXPECT_TRUE(within.reaches(ahead, counts));
}

TEST(SweptSimplex, HitsAreOrderedByTheLowestFeatures) {
  // A segment along the path of the corner: its first end is met first, by the corner itself.
  Predicate_counts counts;
  const Swept_simplex<2> swept({0, 0}, {4, 0}, {Point<2>{2, 3}}, counts);
  const std::vector<Point<2>> segment{{1, 0}, {2, 1}};
  ASSERT_EQ(swept.meet(segment, counts), Encounter::hit);
  const detail::Collision hit = swept.first_hit(segment);
  EXPECT_EQ(hit.time, Fraction(Ring(1), Ring(4)));
  EXPECT_EQ(detail::corners_used(hit.wall_weights), 1u);
  EXPECT_EQ(detail::corners_used(hit.feature_weights), 1u);
}

}  // namespace
}  // namespace cellwalk
