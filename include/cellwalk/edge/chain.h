// SPDX-License-Identifier: LGPL-3.0-or-later
// Chains: how a body edge passes the cells of an environment. Theory: docs/sweep.md. Paper: section III.
#ifndef CELLWALK_EDGE_CHAIN_H
#define CELLWALK_EDGE_CHAIN_H

#include <cellwalk/walk/walk.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace cellwalk {

/// The passable facets that a segment pq passes, in order from p to q, each seen from the cell on the side of p. Empty if
/// p and q share a cell. With the cells of p and q it says on which side of a wall the segment lies, where it lies in one.
using Chain = boost::container::small_vector<Half_facet, 4>;

/// What the checks of edges did. All counts are machine-independent.
struct Edge_counts {
  std::uint64_t edges = 0;      ///< edges checked
  std::uint64_t same_cell = 0;  ///< proved by both ends being in one cell, no sign asked
  std::uint64_t convex_pair =
      0;  ///< proved by their cells being neighbours with a convex union, no sign asked
  std::uint64_t same_chain = 0;     ///< proved by their chain being passed by the new edge
  std::uint64_t chain_facets = 0;   ///< facets looked at for that
  std::uint64_t clear = 0;          ///< proved to meet no wall
  std::uint64_t event_sweeps = 0;   ///< swept triangles whose events were followed
  std::uint64_t changed = 0;        ///< their chain is another one, or there is none
  std::uint64_t floods = 0;         ///< swept triangles flooded
  std::uint64_t flooded_cells = 0;  ///< cells met by them
  std::uint64_t pierced = 0;        ///< proved to be pierced by a wall
  std::uint64_t searches = 0;       ///< contacts located by a dichotomic or exhaustive search
  std::uint64_t search_sweeps = 0;  ///< sweeps made by dichotomic ones
  std::uint64_t search_walks = 0;   ///< walks along the edge made by those that bisect its segment
  std::uint64_t search_walls = 0;   ///< walls looked at by exhaustive ones, and for touches
  /// Exhaustive ones that found no obstacle in their cells, and bisections of a segment that is free at the end.
  std::uint64_t search_misses = 0;
  Walk_counts walk;  ///< of all walks and signs

  static constexpr std::array<std::string_view, 16> names{
      "checked",       "same_cell",    "convex_pair",  "same_chain",    "chain_facets", "clear",
      "event_sweeps",  "changed",      "floods",       "flooded_cells", "pierced",      "searches",
      "search_sweeps", "search_walks", "search_walls", "search_misses"};
};
static_assert(names_all_before<Edge_counts>(offsetof(Edge_counts, walk)));

/// Which certificates a sweep tries before it follows events. Each is sound alone; leaving one out costs time only.
struct Edge_certificates {
  bool same_cell = true, convex_pair = true, same_chain = true, flood = true;
};

/// The chain of a segment, or what is in its way.
template <int D>
struct Chain_result {
  Chain chain;
  /// If set, there is no chain: a wall blocks the segment, at contact->time from p to q. 1: it leads to q on another
  /// side of the walls there than the one that q is on.
  std::optional<Wall_contact<D>> contact;
  /// The segment runs along a wall from its rim on, and has chains on both sides of it.
  bool has_choice = false;
};

/// Walks a temporary particle from p to q.
/// \pre each particle lies in the closure of its cell
/// Degenerate cases: where the segment may pass a wall on either side, one is taken by a fixed rule, see walk().
/// \param locates_contact If false, a contact in the way is left to locate_contact().
/// Cost: that of the walk.
template <int D>
Chain_result<D> find_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                           Walk_counts& counts, bool locates_contact = true);

/// The same, but where the segment may pass a wall on either side, or lies in a plane of facets, through any of which it may
/// change sides, all ways are tried until one leads to the side of q.
/// Complete: if there is a contact, no chain leads from the cell of p to that of q.
/// Cost: that of find_chain if that succeeds; else rational arithmetic for each facet of the cells along the segment that it
/// touches.
template <int D>
Chain_result<D> find_any_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                               Walk_counts& counts);

/// Invariant I2: the chain leads from the cell of p to that of q through passable facets, and the segment passes them in
/// order. Exact in every position. Cost: that of passes(), and rational arithmetic where that does not tell.
template <int D>
bool is_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, const Chain& chain,
              Walk_counts& counts);

/// The chain of qp, given that of pq. Cost: a search for each facet among those of its cell.
template <int D>
Chain reversed(const Snapshot<D>& snapshot, const Chain& chain);

/// Puts the facets that p crossed, as Walk_options::crossed reports them, in front of the chain of pq, and drops those
/// that are thereby passed there and back. The result leads from the cell of p now to that of q; whether pq passes it is
/// for passes() to say.
template <int D>
void walk_start(const Snapshot<D>& snapshot, Chain& chain, std::span<const Half_facet> crossed);

/// True proves that the segment pq passes the facets of a chain in order: then the chain is that of pq, and if it was that
/// of another segment p'q before p moved (walk_start), the whole triangle p'pq is free. False proves nothing: facets in whose
/// plane the segment lies, and facets of a star passed backwards in one point, are not looked into. All signs are exact.
/// Cost: two signs a facet and one for each of its ridges.
template <int D>
bool passes(const Snapshot<D>& snapshot, const Chain& chain, const Point<D>& p, const Point<D>& q,
            Walk_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_CHAIN_H
