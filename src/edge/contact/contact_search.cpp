// SPDX-License-Identifier: LGPL-3.0-or-later
// The bisection of the motion, and the segment-wise and exhaustive searches.
#include "contact_search.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/star.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "edge/exact/exit_time.h"
#include "swept_meeting.h"

namespace cellwalk::detail {
namespace {

/// The unit mean of the normals of the walls around a vertex, on the side of a cell.
template <int D>
Vector<D> mean_normal(const Snapshot<D>& snapshot, Cell start, std::uint32_t vertex) {
  Vector<D> sum{};
  Link_search<D> links(snapshot, start);
  const auto is_at_vertex = [vertex](const Cell_view<D>& cell, std::size_t i) {
    return facet_contains(cell, i, vertex, vertex);
  };
  const auto add_normal = [&sum](const Cell_view<D>& cell, std::size_t i, Half_facet) {
    sum = sum + inner_normal(cell, i);
  };
  while (links.next()) links.expand_all(is_at_vertex, add_normal);
  const double size = length(sum);
  return size > 0 ? (1 / size) * sum : sum;
}

/// The contact of a bisection at its time, with the normal at a vertex of the wall if that points against the
/// motion.
template <int D>
Contact<D> bisected(const Snapshot<D>& snapshot, const Vertex_path<D>& path, Contact<D> contact, double time,
                    std::size_t corner) {
  contact.set_time(Exact_time(time));
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(contact.facet));
  const std::uint32_t vertex = cell.point_index(cell.loop(snapshot.facet_of(contact.facet))[corner]);
  const Vector<D> normal = mean_normal(snapshot, snapshot.cell_of(contact.facet), vertex);
  if (dot(normal, path.from.position - path.to.position) > 0) contact.normal = normal;
  return contact;
}

/// The position in its loop of the vertex of a wall that is nearest to a point.
template <int D>
std::size_t nearest_corner(const Snapshot<D>& snapshot, Half_facet wall, const Point<D>& x) {
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(wall));
  const auto loop = cell.loop(snapshot.facet_of(wall));
  const auto nearest = std::min_element(loop.begin(), loop.end(), [&](std::uint16_t u, std::uint16_t v) {
    return length(cell.point(u) - x) < length(cell.point(v) - x);
  });
  return static_cast<std::size_t>(nearest - loop.begin());
}

}  // namespace

template <int D>
Contact<D> dichotomic_search(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                             const Sweep_until<D>& sweep_until, double tolerance, Edge_counts& counts) {
  ++counts.searches;
  std::optional<Contact<D>> last;
  const auto is_free_until = [&](std::optional<double> time) {
    ++counts.search_sweeps;
    const Sweep_result<D> sweep = sweep_until(time);
    if (sweep.contact) last = sweep.contact;
    return !sweep.contact;
  };
  [[maybe_unused]] const bool is_free = is_free_until({});
  assert(!is_free && "the caller has found a contact by the same sweep");
  double low = 0, high = 1;
  while (high - low > tolerance) {
    const double middle = low + (high - low) / 2;
    (is_free_until(middle) ? low : high) = middle;
  }
  last->normal =
      edge_normal(snapshot, {path.from.position, path.to.position, q.position}, *last, last->normal);
  return bisected(snapshot, path, *last, low, last->corner);
}

template <int D>
std::optional<Contact<D>> segment_search(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                         const Particle<D>& q, double tolerance, Edge_counts& counts) {
  ++counts.searches;
  const Point<D>&a = path.from.position, &b = path.to.position;
  std::optional<Contact<D>> last;
  const auto is_free_at = [&](const Particle<D>& p) {
    ++counts.search_walks;
    Chain_result<D> walked = find_chain(snapshot, p, q, counts.walk);
    if (walked.contact && walked.has_choice) walked = find_any_chain(snapshot, p, q, counts.walk);
    if (walked.contact) last = walked.contact;
    return !walked.contact;
  };
  double low = 0, high = 1;
  if (path.blocked)
    high = exit_time<D>(snapshot.view(path.visited.back()), a, b, counts.walk).exact().rounded();
  else if (is_free_at(path.to)) {
    ++counts.search_misses;
    return {};
  }
  Particle<D> reached = path.from;
  while (high - low > tolerance) {
    const double middle = low + (high - low) / 2;
    Particle<D> p = reached;
    const bool arrives =
        move(snapshot, p, point_on<D>(a, b, middle), counts.walk).status == Walk_status::arrived;
    if (arrives && is_free_at(p)) {
      low = middle;
      reached = p;
    } else {
      high = middle;
    }
  }
  if (!last) {
    ++counts.search_misses;
    return {};
  }
  Contact<D> contact = *last;
  contact.time = low;
  contact.body = Body_feature::edge;
  contact.normal = edge_normal(snapshot, {a, b, q.position}, contact, contact.normal);
  return bisected(snapshot, path, contact, low, nearest_corner(snapshot, contact.facet, contact.point));
}

template <int D>
Flooded traversed_cells(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                        Edge_counts& counts) {
  std::vector<Cell> visited;
  Walk_options options;
  options.visited = &visited;
  walk(snapshot, path.to, q.position, counts.walk, options);
  return {visited.begin(), visited.end()};
}

template <int D>
Flooded flooded_cells(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                      Edge_counts& counts) {
  Flooded cells;
  flood<D>(snapshot, path.from.cell, {path.from.position, path.to.position, q.position}, counts,
           std::numeric_limits<std::size_t>::max(), cells, [](Half_facet) { return true; });
  return cells;
}

template <int D>
std::optional<Contact<D>> exhaustive_search(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                            const Particle<D>& q, std::span<const Cell> cells, bool below,
                                            Edge_counts& counts) {
  ++counts.searches;
  const Swept_triangle<D> triangle{path.from.position, path.to.position, q.position};
  std::optional<Contact<D>> first;
  for (const Cell c : cells) {
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (!snapshot.is_impassable(f) || (below && !may_intersect(cell, i, triangle, counts.walk))) continue;
      ++counts.search_walls;
      for (std::size_t k = 0; k < cell.loop(i).size(); ++k) {
        if (below && !may_meet_ridge(cell, i, k, triangle, counts.walk)) continue;
        const auto meeting = first_meeting<D>(triangle, half_spaces_of_ridge(cell, i, k));
        if (!meeting) continue;
        const Contact<D> contact = contact_with(snapshot, triangle, f, *meeting);
        if (!first || is_before(contact, *first)) first = contact;
      }
    }
  }
  counts.search_misses += !first;
  return first;
}

#define CELLWALK_INSTANTIATE(D)                                                                            \
  template Contact<D> dichotomic_search<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&,  \
                                           const Sweep_until<D>&, double, Edge_counts&);                   \
  template std::optional<Contact<D>> segment_search<D>(const Snapshot<D>&, const Vertex_path<D>&,          \
                                                       const Particle<D>&, double, Edge_counts&);          \
  template Flooded traversed_cells<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&,       \
                                      Edge_counts&);                                                       \
  template Flooded flooded_cells<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&,         \
                                    Edge_counts&);                                                         \
  template std::optional<Contact<D>> exhaustive_search<D>(const Snapshot<D>&, const Vertex_path<D>&,       \
                                                          const Particle<D>&, std::span<const Cell>, bool, \
                                                          Edge_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
