// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/may_intersect.h>

#include "confirm_chain.h"
#include "edge/flood/pierced.h"
#include "events.h"

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

/// The conclusion from the walls near a swept triangle.
enum class Triangle_verdict { free, blocked, undecided };

template <int D>
Triangle_verdict classify_triangle(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle,
                                   Edge_counts& counts) {
  detail::Flooded found;
  bool is_met = false, is_pierced = false;
  const auto on_wall = [&](Half_facet f) {
    is_met = true;
    const Cell_view<D> cell = snapshot.view(snapshot.cell_of(f));
    is_pierced = detail::is_pierced(cell, snapshot.facet_of(f), triangle, counts.walk);
    return !is_pierced;
  };
  const bool is_whole =
      detail::flood(snapshot, start, triangle, counts, detail::most_flooded, found, on_wall);
  if (is_pierced) {
    ++counts.pierced;
    return Triangle_verdict::blocked;
  }
  if (!is_whole || is_met) return Triangle_verdict::undecided;
  ++counts.clear;
  return Triangle_verdict::free;
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
  if (options.sweep == Sweep::three_segments)
    return result.contact || result.has_choice ? chain_by_events(snapshot, path, q, before, counts)
                                               : Free_chain{result.chain};
  if (options.certificates.flood) {
    const Swept_triangle<D> triangle{path.from.position, path.to.position, q.position};
    switch (classify_triangle(snapshot, path.from.cell, triangle, counts)) {
      case Triangle_verdict::blocked:
        return {};
      case Triangle_verdict::free:
        if (!result.contact) return Free_chain{result.chain, true};
        break;
      case Triangle_verdict::undecided:
        break;
    }
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
