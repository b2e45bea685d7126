// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge_contact.h"

#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/internal/walk/star.h>

namespace cellwalk::detail {

template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall) {
  if (wall == Half_facet::none) refuse_uncertified();
  Contact<D> contact;
  contact.time = time;
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

template Contact<2> edge_contact<2>(const Snapshot<2>&, const Exact_time&, Half_facet);
template Contact<3> edge_contact<3>(const Snapshot<3>&, const Exact_time&, Half_facet);
template Contact<2> edge_contact<2>(const Snapshot<2>&, const Exact_time&, Half_facet, const Exact_point<2>&);
template Contact<3> edge_contact<3>(const Snapshot<3>&, const Exact_time&, Half_facet, const Exact_point<3>&);

}  // namespace cellwalk::detail
