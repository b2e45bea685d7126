// SPDX-License-Identifier: LGPL-3.0-or-later
// A chain led round the ridges that its edge meets on the way, one after the other, or to the wall that it
// meets at one. Theory: docs/sweep.md, relinking at ridges.
#ifndef CELLWALK_INTERNAL_EDGE_RIDGE_RELINK_H
#define CELLWALK_INTERNAL_EDGE_RIDGE_RELINK_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/certain_line.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// The edge of a vertex that moves, and its chain before the move.
template <int D>
struct Moving_edge {
  const Point<D>&from, &other;                ///< the vertex before the move, and the other end
  const Certain_line<D>& to;                  ///< from the vertex after the move to the other end
  bool is_reversed;                           ///< the vertex is the second end, and the lines lead backwards
  bool has_inner_end;                         ///< one of its ends lies in the interior of its cell in the end
  std::span<const Half_facet> crossed;        ///< by the vertex
  bool crosses_inside;                        ///< it is known to cross their interiors only
  Half_facet wall;                            ///< in whose interior the vertex is stopped, or none
  std::span<const Half_facet> chain;          ///< from the first end of the edge to the second
  std::span<const Facet_corners<D>> corners;  ///< of the chain
};

enum class Relink_answer { free, blocked, open };

/// Memory of relinks, kept from one to the next.
template <int D>
struct Relink_scratch {
  /// The time at which the edge meets the line of a ridge, beyond which it is in the end.
  struct Event {
    std::uint32_t u, v;  ///< the ridge by its points, the lesser one first
    double least, most;
  };
  struct Passed_facet {
    Half_facet facet;
    std::size_t corners, corners_end;  ///< its own among all
    std::size_t events, events_end;
  };
  std::vector<Passed_facet> word, exchanged;
  std::vector<Facet_corners<D>> corners;
  std::vector<Event> events;
  /// Of a blocked edge: the ridge at which it meets a wall, and the first wall round it seen from the vertex.
  std::uint32_t u = 0, v = 0;
  Half_facet wall = Half_facet::none;
};

/// Follows an edge in general position from ridge to ridge, by signs in lanes, in doubles or exact, and by
/// bounds of times.
/// free: the edge is free until the vertex is at its target or stopped, and `chain` is set to the chain then,
/// `its_corners` to those of its facets. blocked: the edge meets a wall at a ridge before. open: it is not
/// certain.
/// \pre the chain is valid before the move
/// Cost: some 30 operations on lanes a facet of the chain, 100 operations a ridge that the edge meets, and
/// reading the corners of the facets round those.
template <int D>
Relink_answer relink_at_ridges(const Snapshot<D>& snapshot, const Moving_edge<D>& edge,
                               Relink_scratch<D>& scratch, Chain& chain,
                               std::vector<Facet_corners<D>>& its_corners);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_RIDGE_RELINK_H
