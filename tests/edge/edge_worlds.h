// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges in the worlds in which the walk is tested.
#ifndef CELLWALK_TESTS_EDGE_EDGE_WORLDS_H
#define CELLWALK_TESTS_EDGE_EDGE_WORLDS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <optional>
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
  Edge_world(oracle::World<D> w, std::uint64_t seed, bool generic)
      : world(std::move(w)),
        snapshot(Snapshot<D>::compile(world.soup, glue(world.soup))),
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

/// A move of one end of an edge.
template <int D>
struct Moved_end {
  /// `to` has its target as its position, where it was blocked as well, and the last cell it passed.
  Particle<D> from, to;
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  std::optional<Contact<D>> contact;  ///< of the end itself

  Vertex_path<D> path() const { return {from, to, visited, crossed, contact.has_value()}; }
};

/// Puts edges into a world and moves one end of each on and on, so that chains grow, shrink and turn. For
/// each move, sweep(moved, q, chain) returns the chain of the edge after it, or nothing if the edge meets a
/// wall: its last move, then. An end that was blocked stays, and so does the chain.
template <int D, class Sweep>
void for_each_sweep(Edge_world<D>& w, int edges, Walk_counts& counts, Sweep sweep) {
  constexpr int moves_of_an_edge = 6;
  for (int k = 0; k < edges; ++k) {
    Particle<D> p = w.start();
    if (p.cell == Cell::none) continue;
    const Particle<D> q = w.end(p);
    if (q.cell == Cell::none) continue;
    const Chain_result<D> start = find_chain(w.snapshot, p, q, counts);
    if (start.contact) continue;
    Chain chain = start.chain;
    for (int step = 0; step < moves_of_an_edge; ++step) {
      Moved_end<D> moved;
      moved.from = p;
      w.choose_kind();
      const Point<D> target = w.target(p);
      moved.contact = move(w.snapshot, p, target, counts, {&moved.visited, &moved.crossed}).contact;
      moved.to = p;
      if (moved.contact) {
        moved.to.position = target;
        moved.to.cell = moved.visited.back();
      }
      const std::optional<Chain> after = sweep(std::as_const(moved), q, std::as_const(chain));
      if (moved.contact) continue;
      if (!after) break;
      chain = *after;
    }
  }
}

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
