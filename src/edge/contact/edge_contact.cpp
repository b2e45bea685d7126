// SPDX-License-Identifier: LGPL-3.0-or-later
// The rounded time, place and normal of a contact with a wall, at a point or at a ridge.
#include "edge_contact.h"

#include <cellwalk/internal/edge/edge_contact.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/internal/walk/star.h>

namespace cellwalk::detail {
namespace {

/// When and where an edge passes the line of a ridge.
Crossing<2> passage_of(const Swept_triangle<2>& t, const Point<2>& u, const Point<2>&) {
  return {t.a, t.b, {t.q, u}};
}
Crossing<3> passage_of(const Swept_triangle<3>& t, const Point<3>& u, const Point<3>& v) {
  return {t.a, t.b, {t.q, u, v}};
}

Point_bounds<2> place_of_passage(const Swept_triangle<2>&, const Point<2>& u, const Point<2>&) {
  return {u, u};
}
Point_bounds<3> place_of_passage(const Swept_triangle<3>& t, const Point<3>& u, const Point<3>& v) {
  return bounds_at<3>({u, v, {t.a, t.b, t.q}});
}

/// Towards 0, as Exact_point::rounded() does.
double towards_zero(double below, double above) { return (below >= 0 ? below : above) + 0.0; }

}  // namespace

template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall) {
  if (wall == Half_facet::none) refuse_uncertified();
  Contact<D> contact;
  contact.set_time(time);
  contact.body = Body_feature::edge;
  contact.facet = wall;
  contact.cell = snapshot.cell_of(wall);
  contact.normal = inner_normal(snapshot.view(contact.cell), snapshot.facet_of(wall));
  return contact;
}

template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall,
                        const Exact_point<D>& x) {
  Contact<D> contact = edge_contact(snapshot, time, wall);
  const Facet_feature feature = lowest_feature<D>(snapshot.view(contact.cell), snapshot.facet_of(wall), x);
  contact.kind = feature.kind;
  contact.corner = feature.corner;
  contact.point = x.rounded();
  return contact;
}

template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, Half_facet wall,
                        const Ridge& ridge) {
  const Point<D>&u = snapshot.point(ridge.u), &v = snapshot.point(ridge.v);
  Contact<D> contact = edge_contact(snapshot, to_time(passage_of(triangle, u, v)), wall);
  const auto corner = position_of(snapshot.view(contact.cell), snapshot.facet_of(wall), ridge);
  contact.corner = static_cast<std::uint16_t>(*corner);
  const Point_bounds<D> x = place_of_passage(triangle, u, v);
  for (std::size_t k = 0; k < D; ++k) contact.point[k] = towards_zero(x.below[k], x.above[k]);
  contact.kind = D == 2 ? Contact_kind::vertex : Contact_kind::edge;
  return contact;
}

template <int D>
Contact<D> contact_at_ridge(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle,
                            const Relink_scratch<D>& blocked) {
  return edge_contact(snapshot, triangle, blocked.wall, Ridge{blocked.u, blocked.v});
}

template Contact<2> edge_contact<2>(const Snapshot<2>&, const Exact_time&, Half_facet);
template Contact<3> edge_contact<3>(const Snapshot<3>&, const Exact_time&, Half_facet);
template Contact<2> edge_contact<2>(const Snapshot<2>&, const Exact_time&, Half_facet, const Exact_point<2>&);
template Contact<3> edge_contact<3>(const Snapshot<3>&, const Exact_time&, Half_facet, const Exact_point<3>&);
template Contact<2> edge_contact<2>(const Snapshot<2>&, const Swept_triangle<2>&, Half_facet, const Ridge&);
template Contact<3> edge_contact<3>(const Snapshot<3>&, const Swept_triangle<3>&, Half_facet, const Ridge&);
template Contact<2> contact_at_ridge<2>(const Snapshot<2>&, const Swept_triangle<2>&,
                                        const Relink_scratch<2>&);
template Contact<3> contact_at_ridge<3>(const Snapshot<3>&, const Swept_triangle<3>&,
                                        const Relink_scratch<3>&);

}  // namespace cellwalk::detail
