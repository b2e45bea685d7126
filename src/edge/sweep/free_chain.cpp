// SPDX-License-Identifier: LGPL-3.0-or-later
// The chain of an edge after a free move, by the cheapest test that proves it.
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/sweep_along.h>

#include "confirm_chain.h"
#include "events.h"
#include "round_ridges.h"

namespace cellwalk {
namespace {

template <int D>
std::optional<Free_chain> chain_by_events(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                          const Particle<D>& q, const Chain& before, Edge_counts& counts) {
  ++counts.event_sweeps;
  Sweep_result<D> result = detail::follow_events(snapshot, path, q, before, counts.walk);
  if (result.contact) return {};
  return Free_chain{std::move(result.chain)};
}

}  // namespace

template <int D>
std::optional<Free_chain> free_chain(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                     const Particle<D>& q, const Chain& before, const Sweep_options& options,
                                     Edge_counts& counts) {
  if (path.from.position == path.to.position) {
    ++counts.edges;
    ++counts.same_chain;
    return Free_chain{before, path.is_apart};
  }
  Chain_result<D> result;
  const std::uint64_t signs = counts.walk.predicates.orientations;
  if (detail::confirm_chain(snapshot, path, q, before, options.certificates, result, counts)) {
    // If no sign was computed, planes alone prove that the edge at its end passes the interiors of its
    // facets, or that its ends lie in the interiors of cells. With the path of p, this holds for the edge at
    // all times before, except possibly at its start.
    return Free_chain{result.chain, path.is_apart && counts.walk.predicates.orientations == signs};
  }
  ++counts.changed;
  // An edge that passes the interior of a facet has points on both sides of it, wherever it came from.
  const bool is_crossed =
      result.contact && result.contact->kind == Contact_kind::facet && result.contact->time < 1;
  if (is_crossed) return {};
  if (options.sweep == Sweep::three_segments && !result.contact && !result.has_choice)
    return Free_chain{result.chain};
  if (options.sweep != Sweep::three_segments && options.certificates) {
    detail::Relink_scratch<D> scratch;
    Free_chain free;
    const detail::Relink_answer answer =
        detail::lead_round_ridges(snapshot, path, q, before, scratch, free.chain, counts);
    if (answer == detail::Relink_answer::free) return free;
    if (answer == detail::Relink_answer::blocked) return {};
  }
  return chain_by_events(snapshot, path, q, before, counts);
}

template std::optional<Free_chain> free_chain<2>(const Snapshot<2>&, const Vertex_path<2>&,
                                                 const Particle<2>&, const Chain&, const Sweep_options&,
                                                 Edge_counts&);
template std::optional<Free_chain> free_chain<3>(const Snapshot<3>&, const Vertex_path<3>&,
                                                 const Particle<3>&, const Chain&, const Sweep_options&,
                                                 Edge_counts&);

}  // namespace cellwalk
