// SPDX-License-Identifier: LGPL-3.0-or-later
// Random changes of facets and cells among bodies, each judged by the oracle of what closes.
#ifndef CELLWALK_TESTS_RESHAPE_TOGGLING_H
#define CELLWALK_TESTS_RESHAPE_TOGGLING_H

#include <gtest/gtest.h>

#include <vector>

#include "reshape/closing_judge.h"

namespace cellwalk::test {

template <class World>
std::vector<bool> with_faces(const World& world) {
  std::vector<bool> result;
  for (const auto& body : world.bodies) result.push_back(!body->faces().empty());
  return result;
}

/// What was opened.
struct Growth_tally {
  int opened = 0, excavated = 0, kept = 0;
};

/// Opens, closes, excavates or fills a facet or a cell near what lies in a world; the oracle judges it.
template <int D, class World>
void toggle_somewhere(World& world, Reshaping<D>& reshaping, Closing_tally& tally, Growth_tally& growth) {
  const Snapshot<D>& snapshot = world.snapshot;
  const Cell cell = world.cell();
  const Half_facet f = Snapshot<D>::half_facet(cell, world.random.below(D + 1));
  const Cell other = snapshot.neighbour(f);
  const bool is_cell = world.random.chance(0.4);
  const Cell subject = is_cell && other != Cell::none && world.random.chance(0.5) ? other : cell;
  if (is_cell ? snapshot.is_solid(subject) : snapshot.is_impassable(f)) {
    const bool is_possible =
        is_cell || (other != Cell::none && snapshot.is_solid(other) == snapshot.is_solid(cell));
    const Outcome result = is_cell ? reshaping.excavate(subject) : reshaping.open(f);
    ASSERT_EQ(result.is_made, is_possible);
    ASSERT_EQ(result.reason.empty(), is_possible);
    ASSERT_TRUE(result.held_by.empty());
    ++(!is_possible ? growth.kept : is_cell ? growth.excavated : growth.opened);
    if (is_possible) {
      ASSERT_FALSE(is_cell ? snapshot.is_solid(subject) : snapshot.is_impassable(f));
    }
    return;
  }
  if (!is_cell && snapshot.is_solid(cell)) return;
  std::vector<Half_facet> closed;
  for (std::size_t k = 0; k <= D; ++k) {
    const Half_facet g = is_cell ? Snapshot<D>::half_facet(subject, k) : f;
    if (!snapshot.is_impassable(g)) closed.insert(closed.end(), {g, snapshot.opposite(g)});
    if (!is_cell) break;
  }
  Closing_judge<D> judge(snapshot, world.bodies, world.particles, closed, is_cell ? subject : Cell::none,
                         with_faces(world));
  const Outcome result = is_cell ? reshaping.fill(subject) : reshaping.close(f);
  judge.judge(result, world.bodies, world.particles, tally);
  ASSERT_EQ(result.reason.empty(), result.is_made);
  for (const Half_facet g : closed) ASSERT_EQ(snapshot.is_impassable(g), result.is_made);
  if (is_cell) {
    ASSERT_EQ(snapshot.is_solid(subject), result.is_made);
  }
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_TOGGLING_H
