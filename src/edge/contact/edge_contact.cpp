// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge_contact.h"

#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/internal/walk/star.h>

namespace cellwalk::detail {

template <int D>
Contact<D> edge_contact(const Snapshot<D>& snapshot, const Exact_time& time, Half_facet wall,
                        const Exact_point<D>& x) {
  if (wall == Half_facet::none) refuse_uncertified();
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(wall));
  const std::size_t i = snapshot.facet_of(wall);
  Contact<D> contact;
  contact.time = time;
  contact.body = Body_feature::edge;
  contact.facet = wall;
  contact.cell = snapshot.cell_of(wall);
  contact.normal = inner_normal(cell, i);
  const Facet_feature feature = lowest_feature<D>(cell, i, x);
  contact.kind = feature.kind;
  contact.corner = feature.corner;
  contact.point = x.rounded();
  return contact;
}

template Contact<2> edge_contact<2>(const Snapshot<2>&, const Exact_time&, Half_facet, const Exact_point<2>&);
template Contact<3> edge_contact<3>(const Snapshot<3>&, const Exact_time&, Half_facet, const Exact_point<3>&);

}  // namespace cellwalk::detail
