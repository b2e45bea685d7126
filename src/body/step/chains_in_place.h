// SPDX-License-Identifier: LGPL-3.0-or-later
// The edges of a vertex that moves, whose chains are confirmed where they stand. Theory: docs/sweep.md,
// chains in place.
#ifndef CELLWALK_BODY_STEP_CHAINS_IN_PLACE_H
#define CELLWALK_BODY_STEP_CHAINS_IN_PLACE_H

#include <cellwalk/internal/edge/certain_line.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_state.h"

namespace cellwalk::detail {

/// The words of the edges of a vertex: the facets that it crossed, followed by the chain of the edge, freely
/// reduced. The facets crossed and their corners are in the scratch of the body.
template <int D>
class Edge_words {
 public:
  explicit Edge_words(Body_state<D>& body)
      : body_(body), snapshot_(*body.snapshot), crossed_(body.scratch.crossed) {
    body.refresh_corners();
  }

  /// How many facets of the chain of an edge the vertex crossed first, which are in its word no more.
  std::size_t undone(const Corner& corner) { return crossed_.empty() ? 0 : count_undone(corner); }
  std::size_t size(const Corner& corner, std::size_t undone) const {
    return body_.chains[corner.edge].size() + crossed_.size() - 2 * undone;
  }
  /// The corners of the facets that the word has of the chain, in the order of the chain.
  std::span<const Facet_corners<D>> corners_kept(const Corner& corner, std::size_t undone) const {
    const std::span<const Facet_corners<D>> all = body_.corners_of(corner.edge);
    return undone == 0 ? all : without(all, corner, undone);
  }
  /// The corners of its other facets, in the same order.
  std::span<const Facet_corners<D>> corners_added(const Corner& corner, std::size_t undone) {
    return undone == crossed_.size() ? std::span<const Facet_corners<D>>() : read_added(corner, undone);
  }
  /// The facets of the word in the order of the chain, in the scratch of the body.
  std::span<const Half_facet> facets(const Corner& corner, std::size_t undone);
  /// The first facet seen from the vertex: as it is seen from there or, of reversed edges, from behind.
  /// \pre the word is not empty
  Half_facet first_facet(const Corner& corner, std::size_t undone);
  /// The word as a chain, from the first end of the edge to the second.
  Chain chain(const Corner& corner) {
    const std::span<const Half_facet> word = facets(corner, undone(corner));
    return Chain(word.begin(), word.end());
  }
  /// The word becomes the chain of the edge.
  void take_over(const Corner& corner);

 private:
  std::size_t count_undone(const Corner& corner);
  std::span<const Facet_corners<D>> without(std::span<const Facet_corners<D>> all, const Corner& corner,
                                            std::size_t undone) const;
  std::span<const Facet_corners<D>> read_added(const Corner& corner, std::size_t undone);
  const std::vector<Half_facet>& behind();
  const std::vector<Facet_corners<D>>& corners_ahead();

  Body_state<D>& body_;
  const Snapshot<D>& snapshot_;
  const std::vector<Half_facet>& crossed_;
};

/// If the line from the target to the other end of an edge certainly passes the facets of its word, the edge
/// is free on the way, and the word is its chain.
template <int D>
class Chains_in_place {
 public:
  /// \param to the vertex at its target; if a wall blocks it, only the position counts
  /// \param mapped the position in the frame of the environment
  Chains_in_place(Body_state<D>& body, const Particle<D>& to, const Float_point<D>& mapped, bool is_blocked)
      : body_(body),
        words_(body),
        has_inner_end_(!is_blocked && to.dimension == D),
        is_blocked_(is_blocked),
        line_(body.snapshot->frame(), to.position, mapped) {}

  /// True proves the edge of a corner free, until the vertex is blocked.
  /// \pre it is not stale
  /// Cost: some 40 operations on lanes a facet.
  bool confirms(const Corner& corner);
  /// Follows the edge round the ridges that it meets on the way, see relink_at_ridges().
  /// \param from the vertex before the move
  /// \param wall in whose interior the vertex is stopped, or none
  /// \param moved the chain of a free edge; it is left undefined otherwise
  /// \pre the edge is not stale
  Relink_answer relink(const Corner& corner, const Particle<D>& from, Half_facet wall, Moved_chain<D>& moved);
  /// Adds the counts of proofs; those of a move that is decided otherwise are counted there.
  void add_to(Edge_counts& counts) const {
    counts.edges += edges_;
    counts.same_cell += same_cell_;
    counts.same_chain += edges_ - same_cell_ - relinked_;
    counts.chain_facets += chain_facets_;
    counts.relinked += relinked_;
    counts.changed += relinked_;
  }

 private:
  bool passes(std::span<const Facet_corners<D>> facets) const {
    return std::ranges::all_of(facets, [&](const auto& corners) { return line_.passes(corners); });
  }
  bool is_before_wall(const Corner& corner, std::size_t undone);

  Body_state<D>& body_;
  Edge_words<D> words_;
  bool has_inner_end_, is_blocked_;
  Certain_line<D> line_;
  std::uint64_t edges_ = 0, same_cell_ = 0, chain_facets_ = 0, relinked_ = 0;
};

extern template class Edge_words<2>;
extern template class Edge_words<3>;
extern template class Chains_in_place<2>;
extern template class Chains_in_place<3>;

/// True if chains may be confirmed in place: a sweep allows it, and touching is free, or nothing was touched,
/// and an edge that certainly passes the interiors of facets touches nothing.
template <int D>
bool may_be_in_place(const Body_state<D>& body, const Sweep_options& sweep, bool is_apart) {
  return body.certificates.chains_in_place && sweep.certificates && (sweep.touch == Touch::pass || is_apart);
}

/// The results for a move that planes and edges in place alone do not prove free.
template <int D>
struct Settled_move {
  /// The vertex at its target, if planes alone prove its way free: the facets crossed are in the scratch.
  std::optional<Particle<D>> to;
  std::size_t free_edges = 0;  ///< the number of first edges that are free, with chains in the scratch
  Relink_answer next_edge =
      Relink_answer::open;  ///< of the next one, if planes prove the way of the vertex free
};

/// Moves a vertex if planes alone prove it free, and all its edges in place: so are most moves. Faces are
/// left alone.
/// \param settled set to the results, unless the vertex moved
/// \pre may_be_in_place(), and the vertex does not stand still
template <int D>
bool try_move_in_place(Body_state<D>& body, std::uint32_t vertex, const Point<D>& target,
                       Settled_move<D>& settled, Body_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_STEP_CHAINS_IN_PLACE_H
