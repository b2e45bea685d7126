// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's two searches for the contact of an edge, on any linear cell complex. Paper: section III.
// Manual: docs/lcc.md.
#ifndef CELLWALK_LCC_CONTACT_SEARCH_H
#define CELLWALK_LCC_CONTACT_SEARCH_H

#include <cellwalk/internal/lcc/obstacle.h>
#include <cellwalk/lcc/walker.h>

#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace cellwalk::lcc {

namespace detail {

/// The unit mean of the normals of the walls at the vertex at which a dart starts, on the side of its cell.
template <class Lcc, class Is_wall>
auto mean_normal(const Walker<Lcc, Is_wall>& walker, const Signs<Lcc>& signs, Dart<Lcc> d) {
  std::array<double, static_cast<std::size_t>(Lcc::dimension)> sum{};
  Linked_cells<Lcc> linked(signs.cells(), {d, true});
  const auto is_wall = [&](Dart<Lcc> facet) { return walker.is_impassable(facet); };
  for (std::size_t k = 0; k < linked.size(); ++k)
    linked.expand(k, is_wall, [&](const auto&, Dart<Lcc> facet, bool blocks) {
      if (!blocks) return;
      const auto normal = inner_normal(signs, facet);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += normal[i];
    });
  double squares = 0;
  for (const double x : sum) squares += x * x;
  if (squares > 0)
    for (double& x : sum) x /= std::sqrt(squares);
  return sum;
}

}  // namespace detail

/// The approximate and numerically reliable search: bisects the motion of p. At each time p walks from the
/// last position at which the edge was free, and a temporary particle from there along the edge. The edge is
/// free at the time found, and blocked no later than `tolerance` after it; obstacles that it met and left
/// before are not found.
/// \param tolerance length of the final interval of time, as far as doubles resolve it
/// \pre 0 < tolerance <= 1; p and q as for Walker::check_edge()
/// \return the contact: its time as a share of the motion of p, the wall that blocked the edge last, and the
///         mean normal of the walls around the vertex of the last dart met. That of p itself, with its exact
///         time, if the edge is free at all times tried before a wall stops p. None if the edge is free at
///         the end, or the check of it is lost.
/// Degenerate cases: positions are rounded where the kernel's numbers are, answers about them are exact.
/// Cost: log2(1 / tolerance) checks.
template <class Lcc, class Is_wall>
std::optional<Contact<Lcc>> dichotomic_search(const Walker<Lcc, Is_wall>& walker, const Particle<Lcc>& p,
                                              const typename Lcc::Point& target, const Particle<Lcc>& q,
                                              double tolerance, Counts& counts) {
  const Edge_check<Lcc> at_end = walker.check_edge(p, target, q, counts);
  if (!at_end.contact) return {};
  double low = 0, high = at_end.is_by_vertex ? CGAL::to_double(at_end.contact->time) : 1;
  std::optional<Contact<Lcc>> last;
  if (!at_end.is_by_vertex) last = at_end.contact;
  Particle<Lcc> reached = p;
  const auto between = [&](double s) {
    const auto along = [&](int i) { return p.position[i] + s * (target[i] - p.position[i]); };
    if constexpr (Walker<Lcc, Is_wall>::D == 2)
      return typename Lcc::Point(along(0), along(1));
    else
      return typename Lcc::Point(along(0), along(1), along(2));
  };
  while (high - low > tolerance) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;  // neighbouring numbers
    const Edge_check<Lcc> check = walker.check_edge(reached, between(middle), q, counts);
    if (check.status == Status::arrived) {
      low = middle;
      reached = check.p;
    } else {
      high = middle;
      if (check.contact && !check.is_by_vertex) last = check.contact;
    }
  }
  if (!last) return at_end.contact;
  last->time = low;
  const detail::Cells<Lcc> cells(walker.map());
  last->normal =
      detail::mean_normal(walker, detail::Signs<Lcc>(cells, walker.orientation(), counts), last->feature);
  return last;
}

/// The exact search: of the obstacles of the cells that a temporary particle traverses from the target to q,
/// their edges (vertices in the plane), the one that the edge meets first. That is the one of the smallest
/// angle at q.
/// \pre p and q as for Walker::check_edge()
/// \return the contact: its exact time as a share of the motion of p, the obstacle, and a unit normal
///         perpendicular to both edges against the motion. That of p itself where p is blocked. None if the
///         edge is free, or if no obstacle of these cells lies in the swept triangle: the paper's limit.
/// Degenerate cases: an obstacle that is only touched counts; at its start the edge meets it if it goes on to
/// do so. Cost: rational arithmetic for each edge of a wall of these cells.
template <class Lcc, class Is_wall>
std::optional<Contact<Lcc>> exhaustive_search(const Walker<Lcc, Is_wall>& walker, const Particle<Lcc>& p,
                                              const typename Lcc::Point& target, const Particle<Lcc>& q,
                                              Counts& counts) {
  constexpr int D = Walker<Lcc, Is_wall>::D;
  std::vector<Dart<Lcc>> traversed;
  const Edge_check<Lcc> at_end = walker.check_edge(p, target, q, counts, &traversed);
  if (!at_end.contact || at_end.is_by_vertex) return at_end.contact;
  const detail::Cells<Lcc> cells(walker.map());
  const detail::Swept_triangle<Lcc> triangle(p.position, target, q.position);
  std::optional<Contact<Lcc>> first;
  const auto test = [&](Dart<Lcc> wall, Dart<Lcc> d) {
    const auto met = triangle.first_meeting(cells.point(d), D == 2 ? cells.point(d) : cells.end(d));
    if (!met) return;
    const bool at_end_of_d = D == 3 && met->place == 1;
    const int dimension = D == 2 || at_end_of_d || CGAL::is_zero(met->place) ? 0 : 1;
    if (first && (first->time < met->time || (first->time == met->time && first->dimension <= dimension)))
      return;
    first = Contact<Lcc>{met->time, dimension, wall, at_end_of_d ? cells.next(d) : d, {}};
  };
  for (const Dart<Lcc>& cell : traversed)
    for (const Dart<Lcc>& facet : cells.facets(cell)) {
      if (!walker.is_impassable(facet)) continue;
      cells.for_each_dart(facet, [&](Dart<Lcc> d) {
        test(facet, d);
        if (D == 2) test(facet, cells.next(d));
      });
    }
  if (first)
    first->normal = detail::normal_of_meeting(detail::Signs<Lcc>(cells, walker.orientation(), counts), *first,
                                              p.position, target, q.position);
  return first;
}

}  // namespace cellwalk::lcc

#endif  // CELLWALK_LCC_CONTACT_SEARCH_H
