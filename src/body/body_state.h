// SPDX-License-Identifier: LGPL-3.0-or-later
// The state of a registered body, and its renewal: particles and chains that are stale are registered anew
// where they are needed.
#ifndef CELLWALK_BODY_BODY_STATE_H
#define CELLWALK_BODY_BODY_STATE_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/body/certificates.h>
#include <cellwalk/internal/edge/certain_line.h>
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/ridge_relink.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "body/region/region_cache.h"
#include "body/region/region_pool.h"
#include "body/registration/registration.h"
#include "body/shape/body_topology.h"
#include "body/thick/thick_parts.h"

namespace cellwalk::detail {

/// The chain of an edge after the move of a vertex.
template <int D>
struct Moved_chain {
  Chain chain;  ///< seen from the vertex
  bool is_free = false;
  bool is_stale = false;     ///< it is not known, but there is one
  bool is_in_place = false;  ///< it is the word of the edge, see Chains_in_place
  bool is_relinked = false;  ///< the chain is seen from the first end of the edge, and its corners are known
  std::vector<Facet_corners<D>> corners;
};

/// The results of the tests of one move of a vertex, before it is made. Kept for its memory only.
template <int D>
struct Move_scratch {
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  bool crosses_inside = false;         ///< planes prove that the facets crossed are so in their interiors
  std::vector<Moved_chain<D>> chains;  ///< of the edges of the vertex, the first ones
  std::vector<std::pair<std::uint32_t, Supporting_walls>> supporting_walls;
  std::vector<Half_facet> behind;  ///< the facets crossed, seen from their other sides, as far as needed
  std::vector<Half_facet> word;    ///< that of an edge, see Edge_words
  /// Of the facets crossed, in order, and from the other sides, from the last to the first; or empty.
  std::vector<Facet_corners<D>> corners_ahead, corners_behind;
  Relink_scratch<D> relink;

  /// Makes room for the chains of this number of edges.
  void take_up_chains(std::size_t edges) {
    if (chains.size() < edges) chains.resize(edges);
  }
  /// The cells visited, if all facets were crossed in their interiors.
  void visit_crossed(const Snapshot<D>& snapshot, Cell first) {
    visited.assign(1, first);
    for (const Half_facet f : crossed) visited.push_back(snapshot.neighbour(f));
  }
  void clear_walk() {
    visited.clear();
    crosses_inside = false;
    if (crossed.empty()) return;
    crossed.clear();
    behind.clear();
    corners_ahead.clear();
    corners_behind.clear();
  }
};

/// Those of the chosen certificates that are worth their cost for a body.
Body_certificates worthwhile(Body_certificates chosen, const Body_topology& topology, std::size_t vertices);

template <int D>
struct Body_state {
  /// Registers a body; faces are left.
  /// \throw Error(outside) as Body does
  Body_state(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
             const Registered_before<D>& before, const Body_certificates& of_body);
  /// A body of a snapshot that is not registered anywhere yet.
  Body_state(const Snapshot<D>& snapshot, std::vector<Point<D>> points, Body_topology joined,
             std::span<const double> radii, const Body_certificates& of_body);

  /// \throw Error(usage) if the environment was edited since the body was registered
  void check_epoch() const {
    snapshot->check_epoch(epoch, "this body was registered: call Body::register_again(), or make it anew");
  }
  /// True if an edge or, where they are swept, a face of a vertex has no radius, or the vertex has neither.
  bool has_thin(std::uint32_t vertex, Sweep sweep) const {
    return thick.are_none() || thick.has_thin(topology, vertex, sweep);
  }
  Chain seen_from(const Corner& corner) const;
  void set_chain(std::uint32_t edge, const Chain& chain);
  /// The corners of the facets of a chain, facet after facet.
  /// \pre forget_corners() was called since points of the environment moved
  std::span<const Facet_corners<D>> corners_of(std::uint32_t edge) {
    std::vector<Facet_corners<D>>& corners = corners_of_chains[edge];
    if (corners.empty() && !chains[edge].empty()) [[unlikely]]
      read_corners(edge);
    return corners;
  }
  /// Forgets the corners of facets if points were moved, or facets renamed.
  void refresh_corners() {
    if (corners_epoch != snapshot->geometry_epoch()) [[unlikely]]
      forget_corners();
  }

  /// Moves all vertices without a test.
  /// \pre the region holds the body and the targets
  void move_all(std::span<const Point<D>> targets, Body_counts& counts) {
    region.mark_all_moved();
    counts.in_region += targets.size();
    // Last, so that nothing needs to be saved over the call.
    std::memcpy(positions.data(), targets.data(), targets.size_bytes());
  }
  /// If that region does not hold all: moves all in a new one, if there is one for all. Else prepares moves
  /// one by one.
  bool try_move_all_in_new_region(std::span<const Point<D>> targets, bool clearance, Body_counts& counts);
  /// Moves one vertex without a test, if the region allows it.
  bool try_move_in_region(std::uint32_t vertex, const Point<D>& target, Body_counts& counts) {
    return region.holds_star(vertex, target) ? move_in_region(vertex, target, counts)
                                             : pool.is_used() && try_move_in_pool(vertex, target, counts);
  }
  /// Gives the region up.
  /// \pre nothing is stale
  void give_region_up();
  /// Gives it up, and looks for regions by these certificates from now on.
  /// \pre nothing is stale
  void begin_regions(const Body_certificates& chosen);
  /// The body where it is.
  Body_soup<D> soup() const;

  /// Moves a particle of a stale vertex to where the vertex is.
  void follow(std::uint32_t vertex, Particle<D>& particle, Walk_counts& walks) const;
  /// Registers a vertex or an edge if it is stale.
  void refresh_vertex(std::uint32_t vertex, Body_counts& counts);
  void refresh_edge(std::uint32_t edge, Body_counts& counts);
  /// True if an edge is, or its other end.
  /// \pre that at which it is seen is not
  bool is_stale(const Corner& corner) const {
    return region.is_edge_stale(corner.edge) || region.is_vertex_stale(corner.other);
  }
  void refresh_all(Body_counts& counts);

  /// Makes a move: takes the chains of the moved vertex over, whose contents are lost, and its particle.
  void commit(std::uint32_t vertex, const Particle<D>& particle, std::vector<Moved_chain<D>>& moved);
  void place(std::uint32_t vertex, const Point<D>& position);

  const Snapshot<D>* snapshot;
  std::uint64_t epoch;  ///< of the snapshot, when the body was registered
  std::vector<Point<D>> positions;
  Body_topology topology;
  std::vector<Particle<D>> particles;
  std::vector<Chain> chains;  ///< of the edges, from their first end to their second
  std::vector<std::vector<Facet_corners<D>>> corners_of_chains;  ///< empty until they are needed
  std::uint64_t corners_epoch;                     ///< Snapshot::geometry_epoch() when these were read
  std::vector<Supporting_walls> supporting_walls;  ///< of each face
  bool may_have_supporting_walls = false;          ///< some face has; else none
  bool are_faces_swept = true;
  bool is_apart = false;  ///< it is known that no vertex and no edge touches a wall
  Thick_parts<D> thick;
  Region_cache<D> region;
  Region_pool<D> pool;
  Body_certificates certificates;
  Move_scratch<D> scratch;

 private:
  void forget_corners();
  void read_corners(std::uint32_t edge);
  bool move_in_region(std::uint32_t vertex, const Point<D>& target, Body_counts& counts);
  bool try_move_in_pool(std::uint32_t vertex, const Point<D>& target, Body_counts& counts);
  void move_untested(std::uint32_t vertex, const Point<D>& target, Body_counts& counts);
  void spread_marks();
  bool renew_region(std::span<const Point<D>> targets, Body_counts& counts);
};

extern template struct Body_state<2>;
extern template struct Body_state<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_BODY_STATE_H
