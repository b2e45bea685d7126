// SPDX-License-Identifier: LGPL-3.0-or-later
// Chains: the cells and facets that a body edge crosses. Theory: docs/sweep.md. Paper: section III.
#ifndef CELLWALK_EDGE_CHAIN_H
#define CELLWALK_EDGE_CHAIN_H

#include <cellwalk/walk/walk.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace cellwalk {

/// The passable facets that a segment pq crosses, in order from p to q, each seen from the cell on the side
/// of p. Empty if p and q share a cell. Together with the cells of p and q it determines the side of a wall
/// on which a segment in the wall lies.
using Chain = boost::container::small_vector<Half_facet, 4>;

/// The counts of the checks of edges. They are machine-independent.
struct Edge_counts {
  std::uint64_t edges = 0;          ///< edges checked
  std::uint64_t same_cell = 0;      ///< proved by both ends being in one cell, without a sign
  std::uint64_t same_chain = 0;     ///< proved by the new edge crossing the old chain
  std::uint64_t chain_facets = 0;   ///< facets examined for that
  std::uint64_t relinked = 0;       ///< proved by leading the chain round the ridges that the edge meets
  std::uint64_t event_sweeps = 0;   ///< swept triangles whose events were followed
  std::uint64_t changed = 0;        ///< the chain is different, or there is none
  std::uint64_t floods = 0;         ///< swept triangles flooded by exhaustive searches, and for touches
  std::uint64_t flooded_cells = 0;  ///< cells visited by floods
  std::uint64_t searches = 0;       ///< contacts located by a dichotomic or exhaustive search
  std::uint64_t search_sweeps = 0;  ///< sweeps made by dichotomic searches
  std::uint64_t search_walks = 0;   ///< walks along the edge made by dichotomic searches of the segment
  std::uint64_t search_walls = 0;   ///< walls examined by exhaustive searches, and for touches
  /// Exhaustive searches that found no obstacle in their cells, and bisections of a segment that is free at
  /// the end.
  std::uint64_t search_misses = 0;
  Walk_counts walk;  ///< of all walks and signs

  static constexpr std::array<std::string_view, 14> names{
      "checked",       "same_cell",    "same_chain",   "chain_facets",  "relinked",
      "event_sweeps",  "changed",      "floods",       "flooded_cells", "searches",
      "search_sweeps", "search_walks", "search_walls", "search_misses"};
};
static_assert(names_all_before<Edge_counts>(offsetof(Edge_counts, walk)));

/// The counts of the sweeps of faces. They are machine-independent.
struct Face_counts {
  std::uint64_t faces = 0;          ///< swept or registered
  std::uint64_t clear = 0;          ///< proved to meet no wall, by planes and boxes
  std::uint64_t flooded_cells = 0;  ///< cells visited by floods
  std::uint64_t walls = 0;          ///< walls near the other faces, whose vertices were tested
  std::uint64_t clipped = 0;        ///< walls clipped in rational numbers
  std::uint64_t flat = 0;           ///< moves in the plane of the face that determined its supporting walls
  Walk_counts walk;                 ///< of all signs

  static constexpr std::array<std::string_view, 6> names{"swept", "clear",   "flooded_cells",
                                                         "walls", "clipped", "flat"};
};
static_assert(names_all_before<Face_counts>(offsetof(Face_counts, walk)));

/// The chain of a segment, or the wall that blocks it.
template <int D>
struct Chain_result {
  Chain chain;
  /// If set, there is no chain: a wall blocks the segment, at contact->time from p to q. The time 1 means
  /// that it leads to q on another side of the walls there.
  std::optional<Contact<D>> contact;
  /// The segment continues along a wall from its rim, and has chains on both sides of it.
  bool has_choice = false;
};

/// Walks a temporary particle from p to q.
/// \pre each particle lies in the closure of its cell
/// \param snapshot in which the particles lie
/// \param p,q the ends of the segment, with their cells
/// \param counts raised by the walk
/// \param locates_contact if false, a contact is left to locate_contact()
/// Degenerate cases: if the segment may pass a wall on either side, a fixed rule chooses one, see walk().
/// Cost: that of the walk.
template <int D>
Chain_result<D> find_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                           Walk_counts& counts, bool locates_contact = true);

/// The same as find_chain(), but exhaustive: if the segment may pass a wall on either side, or lies in a
/// plane of facets, through each of which it may change sides, all paths are tried until one leads to the
/// side of q. If the result is a contact, no chain leads from the cell of p to that of q.
/// Cost: that of find_chain() if it succeeds; otherwise rational arithmetic for each facet of the cells along
/// the segment that the segment touches.
template <int D>
Chain_result<D> find_any_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                               Walk_counts& counts);

/// Invariant I2: the chain leads from the cell of p to that of q through passable facets, and the segment
/// passes them in order. Exact in every position.
/// \param snapshot in which the particles lie
/// \param p,q the ends of the segment, with their cells
/// \param chain the half-facets from p to q
/// \param counts raised by the tests
/// Cost: that of passes(), and rational arithmetic if that is inconclusive.
template <int D>
bool is_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, const Chain& chain,
              Walk_counts& counts);

/// The chain of qp, given that of pq.
/// Cost: a search for each facet among those of its cell.
template <int D>
Chain reversed(const Snapshot<D>& snapshot, const Chain& chain);

/// Prepends the facets that p crossed to the chain of pq, and deletes those that are thereby crossed in both
/// directions (free reduction). The result leads from the current cell of p to that of q; passes() decides
/// whether pq crosses it.
/// \param crossed the facets as reported by Walk_options::crossed
template <int D>
void prepend_crossed_facets(const Snapshot<D>& snapshot, Chain& chain, std::span<const Half_facet> crossed);

/// True proves that the segment pq crosses the facets of a chain in order. Then the chain is valid for pq,
/// and if it was derived from the chain of another segment p'q before p moved (prepend_crossed_facets), the
/// whole triangle p'pq is free. False is inconclusive: facets in whose plane the segment lies, and facets of
/// a star crossed backwards in one point, are not examined. All signs are exact.
/// \param snapshot whose half-facets the chain names
/// \param chain the half-facets from p to q
/// \param p,q the ends of the segment
/// \param counts raised by the tests
/// Cost: two signs a facet and one for each of its ridges.
template <int D>
bool passes(const Snapshot<D>& snapshot, const Chain& chain, const Point<D>& p, const Point<D>& q,
            Walk_counts& counts);

/// The result of the sweep of an edge.
template <int D>
struct Sweep_result {
  std::optional<Contact<D>> contact;  ///< none: the move is free
  Chain chain;                        ///< of the edge after the move
  // Of sweep_edge() only:
  Particle<D> p{};          ///< after the move, or before it if there is a contact
  std::uint32_t cells = 0;  ///< number of cells visited by p
};

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_CHAIN_H
