// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets and cells by where they are.
#ifndef CELLWALK_TESTS_BODY_PLACES_H
#define CELLWALK_TESTS_BODY_PLACES_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

namespace cellwalk::test {

template <int D>
Half_facet facet_at(const Snapshot<D>& snapshot, const Point<D>& centre) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k)
      if (const Half_facet f = Snapshot<D>::half_facet(c, k); centroid(snapshot, f) == centre) return f;
  }
  ADD_FAILURE() << "no facet there";
  return Half_facet::none;
}

template <int D>
Cell cell_at(const Snapshot<D>& snapshot, const Point<D>& place) {
  return Locator<D>(snapshot).locate(place).cell;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_PLACES_H
