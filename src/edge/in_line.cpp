// SPDX-License-Identifier: LGPL-3.0-or-later
#include "in_line.h"

#include <cellwalk/walk/detail/signs.h>
#include <cellwalk/walk/detail/star.h>

#include <cmath>

#include "equal_chains.h"

namespace cellwalk {

template <int D>
Rational detail::exit_time(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b,
                           Walk_counts& counts) {
  std::optional<Rational> first;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    if (side<Exact>(cell, i, b, counts) <= 0) continue;
    const Rational at_a = side<Exact_value>(cell, i, a, counts);
    const Rational time = at_a / (at_a - side<Exact_value>(cell, i, b, counts));
    if (!first || time < *first) first = time;
  }
  return *first;
}

template <int D>
Wall_contact<D> detail::edge_contact(const Snapshot<D>& snapshot, const Rational& time, Half_facet wall,
                                     const Rational_point<D>& x) {
  const Cell c = snapshot.cell_of(wall);
  const Cell_view<D> cell = snapshot.view(c);
  const std::size_t i = snapshot.facet_of(wall);
  Wall_contact<D> contact;
  contact.time = CGAL::to_double(time);
  if (Rational(contact.time) > time) contact.time = std::nextafter(contact.time, 0.0);
  contact.facet = wall;
  contact.cell = c;
  contact.normal = inner_normal(cell, i);
  contact.kind = lowest_feature<D>(cell, i, x);
  for (int k = 0; k < D; ++k) contact.point[k] = CGAL::to_double(x[k]);
  return contact;
}

template <int D>
Chain_result<D> detail::sweep_in_line(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                                      const Chain& before, Edge_counts& counts) {
  const Point<D>&a = way.from.position, &b = way.to.position;
  Chain_result<D> result{before, {}};
  int axis = 0;
  while (axis + 1 < D && a[axis] == b[axis]) ++axis;
  const bool shrinks =
      (a[axis] < b[axis] && a[axis] < q.position[axis]) || (a[axis] > b[axis] && a[axis] > q.position[axis]);
  if (!shrinks) {
    // Every chain passed before is passed behind the way of p.
    walk_start(snapshot, result.chain, way.crossed);
    return result;
  }
  // Shares of the way from a to b or to q, whichever is further: where q is, and where p ends.
  const auto from = exact<D>(a), to = exact<D>(b), other = exact<D>(q.position);
  const Rational way_of_p = CGAL::abs(Rational(to[axis] - from[axis]));
  const Rational way_to_q = CGAL::abs(Rational(other[axis] - from[axis]));
  const Rational whole = std::max<Rational>(way_of_p, way_to_q);
  const Rational_segment<D> line(from, way_of_p < way_to_q ? other : to);
  const Rational at_q = way_to_q / whole;
  Rational end = way_of_p / whole;
  if (way.blocked) end *= exit_time(snapshot.view(way.visited.back()), a, b, counts.walk);

  const auto pieces = pieces_of<D>(snapshot, line, way.from.cell, {before.data(), before.size()}, at_q);
  const auto walked = pieces_of<D>(snapshot, line, way.from.cell, way.crossed, end);
  if (const auto parting = parting_of(snapshot, line, pieces, walked)) {
    result.contact =
        edge_contact<D>(snapshot, parting->at * whole / way_of_p, parting->wall, line.at(parting->at));
    return result;
  }
  std::size_t i = 0;
  if (end <= at_q) {
    // What is left of the chain, and p linked with it.
    while (pieces[i].high < end) ++i;
    result.chain.assign(before.begin() + static_cast<std::ptrdiff_t>(i), before.end());
    walk_start<D>(snapshot, result.chain, link_at(snapshot, line, pieces[i].cell, way.to.cell, end));
  } else {
    // p has passed q: the way from there on.
    while (walked[i].high < at_q) ++i;
    const auto link = link_at(snapshot, line, walked[i].cell, q.cell, at_q);
    result.chain.assign(link.begin(), link.end());
    walk_start(snapshot, result.chain, way.crossed.subspan(i));
  }
  return result;
}

#define CELLWALK_INSTANTIATE(D)                                                                            \
  template Rational detail::exit_time<D>(const Cell_view<D>&, const Point<D>&, const Point<D>&,            \
                                         Walk_counts&);                                                    \
  template Wall_contact<D> detail::edge_contact<D>(const Snapshot<D>&, const Rational&, Half_facet,        \
                                                   const Rational_point<D>&);                              \
  template Chain_result<D> detail::sweep_in_line<D>(const Snapshot<D>&, const Way<D>&, const Particle<D>&, \
                                                    const Chain&, Edge_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
