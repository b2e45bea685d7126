// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges in the worlds in which the walk is tested.
#ifndef CELLWALK_TESTS_EDGE_EDGE_WORLDS_H
#define CELLWALK_TESTS_EDGE_EDGE_WORLDS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/environment/gluing.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "edge/wall_list.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::test {

/// A world, and edges in it: at least half of them degenerate unless they are to be generic.
template <int D>
class Edge_world {
 public:
  Edge_world(std::uint64_t number, bool generic)
      : Edge_world(oracle::make_world<D>(number), number, generic) {}
  /// `tamper`, if given, changes the snapshot that is swept.
  Edge_world(oracle::World<D> w, std::uint64_t seed, bool generic,
             const std::function<void(Snapshot<D>&)>& tamper = {})
      : world(std::move(w)),
        snapshot([&] {
          auto compiled = Snapshot<D>::compile(world.soup, glue(world.soup));
          if (tamper) tamper(compiled);
          return compiled;
        }()),
        locator(snapshot),
        walls(snapshot),
        generic_(generic),
        source_(world, seed) {}
  Edge_world(const Edge_world&) = delete;  // the source refers to the world

  /// A particle where a motion may start; Cell::none as its cell if that is not in free space.
  Particle<D> start() {
    kind_ = slides ? oracle::Motion_kind::in_wall_plane : source_.kind(generic_);
    return on_any_side(source_.start(kind_));
  }
  /// A particle where a motion of this kind from p ends.
  Particle<D> end(const Particle<D>& p) { return on_any_side(target(p)); }
  /// Where p may move.
  Point<D> target(const Particle<D>& p) { return source_.target(kind_, p.position, p.position); }
  /// Another kind of motion for target() and end(); not one that needs a start made for it.
  void choose_kind() {
    if (slides) return;
    do kind_ = source_.kind(generic_);
    while (kind_ == oracle::Motion_kind::in_wall_plane || kind_ == oracle::Motion_kind::along_edge);
  }

  const oracle::World<D> world;
  const Snapshot<D> snapshot;
  const Locator<D> locator;
  const Wall_list<D> walls;
  bool slides = false;  ///< all edges lie in the plane of a wall and move within it

 private:
  Particle<D> on_any_side(const Point<D>& x) {
    Particle<D> particle = locator.particle_at(x).value_or(Particle<D>{x});
    if (particle.cell == Cell::none) return particle;
    const auto cells = locator.locate(x).cells;
    particle.cell = cells[source_.random().below(cells.size())];
    return particle;
  }

  bool generic_;
  oracle::Motion_kind kind_{};
  oracle::Motion_source<D> source_;
};

/// Follows a chain through passable facets from one cell to the other.
template <int D>
void expect_leads(const Snapshot<D>& snapshot, const Chain& chain, Cell from, Cell to) {
  Cell cell = from;
  for (const Half_facet f : chain) {
    ASSERT_EQ(snapshot.cell_of(f), cell);
    ASSERT_FALSE(snapshot.is_impassable(f));
    cell = snapshot.neighbour(f);
  }
  EXPECT_EQ(cell, to);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_EDGE_WORLDS_H
