// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice of the sweep and the search, and the first of the contacts that they find.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/furthest_move.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/edge/three_segments.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/kernel/error.h>

#include <utility>
#include <vector>

#include "confirm_chain.h"
#include "edge/contact/contact_search.h"
#include "edge/contact/swept_meeting.h"
#include "edge/contact/touch.h"
#include "edge/exact/exit_time.h"
#include "events.h"
#include "moving_line_walk.h"

namespace cellwalk {
namespace {

template <int D>
Swept_triangle<D> triangle_of(const Vertex_path<D>& path, const Particle<D>& q) {
  return {path.from.position, path.to.position, q.position};
}

template <int D>
void keep_first(std::optional<Contact<D>>& first, const std::optional<Contact<D>>& other) {
  if (other && (!first || is_before(*other, *first))) first = other;
}

/// The third segment if a wall stops p: a temporary particle walks to q from the position of p just before,
/// which need not be a double. If p moves in the line of the edge, the events decide this.
template <int D>
bool is_free_where_blocked(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                           Walk_counts& counts) {
  if (are_collinear(path.from.position, path.to.position, q.position)) return false;
  // The reversed motion: p enters its last cell at the last of the times at which it passes planes of facets
  // from outside. The position just after that time is the position just before the block.
  const Swept_triangle<D> backwards{path.to.position, path.from.position, q.position};
  const Cell last = path.visited.back();
  const Cell_view<D> cell = snapshot.view(last);
  detail::Event_time<D> time;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    const auto side = detail::moving_side<D>(cell, i, backwards.a, backwards.b, counts);
    if (side.at_0() <= 0) continue;
    if (!side.has_root()) return true;  // p is blocked at once
    if (const auto root = detail::Event_time<D>::root_of(side); time < root) time = root;
  }
  const detail::Moving_line<D> line(backwards, time, counts);
  const auto accept = [](const Chain&) { return true; };
  return detail::Moving_line_walk<D, decltype(accept)>(snapshot, line, q, accept).from(last);
}

/// The first contact of the edge, or its chain: by the paper's segments or by the complete sweep.
template <int D>
Sweep_result<D> detect(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                       const Chain& before, const Sweep_options& options, Edge_counts& counts,
                       const std::optional<Contact<D>>& met) {
  if (options.sweep != Sweep::three_segments)
    return sweep_triangle(snapshot, path, q, before, counts, options.certificates);
  if (path.blocked) {
    Chain_result<D> found;
    if (detail::confirm_chain(snapshot, path, q, before, options.certificates, found, counts))
      return {{}, std::move(found.chain)};
    ++counts.changed;
    if (is_free_where_blocked(snapshot, path, q, counts.walk)) {
      Sweep_result<D> result{{}, before};
      prepend_crossed_facets(snapshot, result.chain, path.crossed);
      return result;
    }
  } else {
    Chain_result<D> found = check_third_segment(snapshot, path, q, before, counts, options.certificates);
    if (!found.contact && !found.has_choice) return {{}, std::move(found.chain)};
  }
  // The segments find a contact of the edge at its end only. The events determine its time, and the sides of
  // walls on which an edge that lies in them continues.
  if (met) return {met, {}};
  ++counts.event_sweeps;
  return detail::follow_events(snapshot, path, q, before, counts.walk);
}

/// The contact that a search of the paper finds, if any.
template <int D>
std::optional<Contact<D>> search_contact(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                         const Particle<D>& q, const Chain& before,
                                         const Search_options& search, Edge_counts& counts) {
  const auto sweep_until = [&](std::optional<double> until) {
    return detail::follow_events(snapshot, path, q, before, counts.walk, until);
  };
  switch (search.method) {
    case Contact_search::dichotomic:
      return detail::dichotomic_search<D>(snapshot, path, q, sweep_until, search.tolerance, counts);
    case Contact_search::dichotomic_segment:
      return detail::segment_search(snapshot, path, q, search.tolerance, counts);
    case Contact_search::exhaustive:
      break;
  }
  const detail::Flooded cells = search.cells == Search_cells::flooded
                                    ? detail::flooded_cells(snapshot, path, q, counts)
                                    : detail::traversed_cells(snapshot, path, q, counts);
  return detail::exhaustive_search<D>(snapshot, path, q, {cells.data(), cells.size()}, search.below, counts);
}

template <int D>
Contact<D> locate(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                  const Chain& before, const Contact<D>& first, const Sweep_options& options,
                  Edge_counts& counts) {
  if (options.search)
    if (const auto found = search_contact(snapshot, path, q, before, *options.search, counts)) return *found;
  Contact<D> contact = first;
  contact.normal = detail::edge_normal(snapshot, triangle_of(path, q), first, first.normal);
  return contact;
}

/// The sweep of an edge whose end p takes the given sides of walls or, without, those that it prefers.
template <int D>
Sweep_result<D> sweep_on_sides(const Snapshot<D>& snapshot, const Particle<D>& p, const Point<D>& target,
                               const Particle<D>& q, const Chain& before, const Sweep_options& options,
                               Edge_counts& counts, detail::Sides_taken* choices, Walk_result<D>& walked) {
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  Particle<D> moved = p;
  walked = detail::move_on_sides(snapshot, moved, target, counts.walk, {&visited, &crossed}, choices);
  moved.position = target;
  const Vertex_path<D> path{p, moved, visited, crossed, walked.contact.has_value()};
  Sweep_result<D> result = sweep_edge_along(snapshot, path, q, before, options, counts);
  if (walked.contact)
    keep_first<D>(result.contact, vertex_contact(snapshot, p.position, target, *walked.contact, counts.walk));
  result.cells = walked.cells;
  result.p = result.contact ? p : moved;
  if (result.contact) result.chain = before;
  return result;
}

}  // namespace

void detail::check_search(const Search_options& search) {
  if (search.method != Contact_search::exhaustive && !(search.tolerance > 0 && search.tolerance <= 1))
    throw Error(Error_code::usage, "the tolerance of a dichotomic search must lie in (0,1]");
}

template <int D>
Sweep_result<D> sweep_edge_along(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                 const Particle<D>& q, const Chain& before, const Sweep_options& options,
                                 Edge_counts& counts, const std::optional<Contact<D>>& met) {
  Sweep_result<D> result;
  if (met && options.sweep != Sweep::three_segments) {
    ++counts.edges;
    ++counts.changed;
    result.contact = met;
  } else {
    result = detect(snapshot, path, q, before, options, counts, met);
  }
  if (result.contact) result.contact = locate(snapshot, path, q, before, *result.contact, options, counts);
  if (options.touch == Touch::stop)
    keep_first(result.contact, detail::first_touch(snapshot, path.from.cell, triangle_of(path, q), counts));
  return result;
}

template <int D>
Contact<D> vertex_contact(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& target,
                          const Contact<D>& met, Walk_counts& counts) {
  const detail::Event_time<D> time = detail::exit_time<D>(snapshot.view(met.cell), from, target, counts);
  Contact<D> contact = met;
  contact.set_time(time.exact());
  return contact;
}

template <int D>
std::optional<Contact<D>> closed_meeting(const Snapshot<D>& snapshot, Cell start,
                                         const Swept_triangle<D>& triangle, Edge_counts& counts) {
  if (!snapshot.is_cell(start)) detail::refuse_removed_cell();
  for (const Point<D>& x : {triangle.a, triangle.b, triangle.q})
    detail::check_finite(x, "a corner of a swept triangle");
  return detail::first_touch(snapshot, start, triangle, counts, true);
}

template <int D>
std::optional<Contact<D>> first_touch(const Snapshot<D>& snapshot, const Particle<D>& p,
                                      const Point<D>& target, Edge_counts& counts) {
  const Walk_result<D> walked = walk(snapshot, p, target, counts.walk);
  std::optional<Contact<D>> first =
      detail::first_touch<D>(snapshot, p.cell, {p.position, target, p.position}, counts);
  if (walked.contact)
    keep_first<D>(first, vertex_contact(snapshot, p.position, target, *walked.contact, counts.walk));
  return first;
}

template <int D>
Sweep_result<D> sweep_edge(const Snapshot<D>& snapshot, const Particle<D>& p, const Point<D>& target,
                           const Particle<D>& q, const Chain& before, const Sweep_options& options,
                           Edge_counts& counts) {
  if (!snapshot.is_cell(q.cell)) detail::refuse_removed_cell();  // the walk of p checks that of p
  detail::check_finite(q.position, "the end of an edge that stands still");
  if (options.search) detail::check_search(*options.search);
  Walk_result<D> walked;
  const auto sweep = [&](const Sweep_options& chosen, detail::Sides_taken* choices) {
    return sweep_on_sides(snapshot, p, target, q, before, chosen, counts, choices, walked);
  };
  Sweep_result<D> result = sweep(options, nullptr);
  if (!result.contact || !detail::may_pass_on_other_sides(snapshot, p.position, target, walked,
                                                          *result.contact, options.touch, counts.walk))
    return result;
  Sweep_options exact = options;
  exact.search = nullptr;
  detail::Sides_taken choices;
  const auto contact = detail::furthest_move<D>(snapshot, p.position, target, choices, [&](auto& tried) {
    result = sweep(exact, &tried);
    return result.contact;
  });
  if (contact) return sweep(options, &choices);
  return result;
}

#define CELLWALK_INSTANTIATE(D)                                                                              \
  template Sweep_result<D> sweep_edge_along<D>(const Snapshot<D>&, const Vertex_path<D>&,                    \
                                               const Particle<D>&, const Chain&, const Sweep_options&,       \
                                               Edge_counts&, const std::optional<Contact<D>>&);              \
  template Contact<D> vertex_contact<D>(const Snapshot<D>&, const Point<D>&, const Point<D>&,                \
                                        const Contact<D>&, Walk_counts&);                                    \
  template std::optional<Contact<D>> first_touch<D>(const Snapshot<D>&, const Particle<D>&, const Point<D>&, \
                                                    Edge_counts&);                                           \
  template std::optional<Contact<D>> closed_meeting<D>(const Snapshot<D>&, Cell, const Swept_triangle<D>&,   \
                                                       Edge_counts&);                                        \
  template Sweep_result<D> sweep_edge<D>(const Snapshot<D>&, const Particle<D>&, const Point<D>&,            \
                                         const Particle<D>&, const Chain&, const Sweep_options&,             \
                                         Edge_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
