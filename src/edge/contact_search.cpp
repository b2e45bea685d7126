// SPDX-License-Identifier: LGPL-3.0-or-later
#include "contact_search.h"

#include <cellwalk/walk/detail/star.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "events.h"
#include "may_meet.h"
#include "swept_meeting.h"

namespace cellwalk::detail {
namespace {

/// The unit mean of the normals of the walls round a vertex, on the side of a cell.
template <int D>
Vector<D> vertex_normal(const Snapshot<D>& snapshot, Cell start, std::uint32_t vertex) {
  Vector<D> sum{};
  Flooded found{start};
  for (std::size_t head = 0; head < found.size(); ++head) {
    const Cell_view<D> cell = snapshot.view(found[head]);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      if (!facet_contains(cell, i, vertex, vertex)) continue;
      const Half_facet f = Snapshot<D>::half_facet(found[head], i);
      if (snapshot.is_impassable(f)) {
        sum = sum + inner_normal(cell, i);
      } else if (const Cell next = snapshot.neighbor(f);
                 std::find(found.begin(), found.end(), next) == found.end()) {
        found.push_back(next);
      }
    }
  }
  const double size = length(sum);
  return size > 0 ? (1 / size) * sum : sum;
}

/// The cells that the edge passes at its end.
template <int D>
Flooded traversed(const Snapshot<D>& snapshot, const Particle<D>& p, const Point<D>& q, Walk_counts& counts) {
  std::vector<Cell> visited;
  Walk_options options;
  options.visited = &visited;
  walk(snapshot, p, q, counts, options);
  return {visited.begin(), visited.end()};
}

template <int D>
Flooded flooded(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle,
                Edge_counts& counts) {
  Flooded cells;
  flood(snapshot, start, triangle, counts, std::numeric_limits<std::size_t>::max(), cells,
        [](Half_facet) { return true; });
  return cells;
}

}  // namespace

template <int D>
Contact<D> dichotomic_search(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                             const Chain& before, double tolerance, Edge_counts& counts) {
  ++counts.searches;
  std::optional<Wall_contact<D>> last;
  const auto is_free_until = [&](std::optional<double> time) {
    ++counts.search_sweeps;
    const Chain_result<D> sweep = follow_events(snapshot, way, q, before, counts.walk, time);
    if (sweep.contact) last = sweep.contact;
    return !sweep.contact;
  };
  if (is_free_until({})) throw std::logic_error("a search for a contact that does not exist");
  double low = 0, high = 1;
  while (high - low > tolerance) {
    const double middle = low + (high - low) / 2;
    (is_free_until(middle) ? low : high) = middle;
  }
  Contact<D> contact;
  static_cast<Wall_contact<D>&>(contact) = *last;
  contact.body = Body_feature::edge;
  contact.impact = Exact_time(low);
  contact.time = low;
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(contact.facet));
  const std::uint32_t vertex = cell.point_index(cell.loop(snapshot.facet_of(contact.facet))[contact.corner]);
  const Vector<D> normal = vertex_normal(snapshot, snapshot.cell_of(contact.facet), vertex);
  if (length(normal) > 0) contact.normal = normal;
  return contact;
}

template <int D>
std::optional<Contact<D>> exhaustive_search(const Snapshot<D>& snapshot, const Way<D>& way,
                                            const Particle<D>& q, Search_cells which, Edge_counts& counts) {
  ++counts.searches;
  const Swept_triangle<D> triangle{way.from.position, way.to.position, q.position};
  const Flooded cells = which == Search_cells::flooded ? flooded(snapshot, way.from.cell, triangle, counts)
                                                       : traversed(snapshot, way.to, q.position, counts.walk);
  std::optional<Contact<D>> first;
  for (const Cell c : cells) {
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (!snapshot.is_impassable(f) || !may_meet(cell, i, triangle, counts.walk)) continue;
      ++counts.search_walls;
      for (std::size_t k = 0; k < cell.loop(i).size(); ++k) {
        if (!may_meet_ridge(cell, i, k, triangle, counts.walk)) continue;
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

#define CELLWALK_INSTANTIATE(D)                                                                   \
  template Contact<D> dichotomic_search<D>(const Snapshot<D>&, const Way<D>&, const Particle<D>&, \
                                           const Chain&, double, Edge_counts&);                   \
  template std::optional<Contact<D>> exhaustive_search<D>(const Snapshot<D>&, const Way<D>&,      \
                                                          const Particle<D>&, Search_cells, Edge_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
