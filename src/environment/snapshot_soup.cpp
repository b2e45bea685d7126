// SPDX-License-Identifier: LGPL-3.0-or-later
// The loops, marks and links of the cells in use, numbered without gaps.
#include "snapshot_soup.h"

#include <cstdint>

#include "environment/soup/parallel.h"

namespace cellwalk {

template <int D>
Cell_soup<D> soup_of(const Snapshot<D>& snapshot, std::vector<Half_facet>* names) {
  Cell_soup<D> soup;
  soup.points.assign(snapshot.points().begin(), snapshot.points().end());
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    const std::size_t n = snapshot.facet_count(c);
    std::size_t facet = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Half_facet f = snapshot.half_facet(c, facet);
      const std::vector<std::uint32_t> loop = snapshot.loop(f);
      soup.add_facet(loop, snapshot.is_impassable(f));
      if (names) names->push_back(f);
      ++facet;
      if constexpr (D == 2) {
        // The snapshot may store the edges of a cell in any order; a soup stores them in order around the
        // cell.
        for (std::size_t j = 0; j < n; ++j)
          if (snapshot.loop(snapshot.half_facet(c, j))[0] == loop[1]) facet = j;
      }
    }
    soup.end_cell(snapshot.is_solid(c));
  }
  return soup;
}

template <int D>
Gluing gluing_of(const Snapshot<D>& snapshot, const std::vector<Half_facet>& names) {
  std::vector<std::uint32_t> facet_of(snapshot.half_facet_slots(), no_facet);
  for (std::uint32_t f = 0; f < names.size(); ++f) facet_of[to_index(names[f])] = f;
  Gluing gluing;
  gluing.opposite.resize(names.size());
  for_each_parallel(names.size(), [&](std::size_t f) {
    const Half_facet other = snapshot.opposite(names[f]);
    gluing.opposite[f] = other == Half_facet::none ? no_facet : facet_of[to_index(other)];
  });
  return gluing;
}

#define CELLWALK_INSTANTIATE(D)                                                \
  template Cell_soup<D> soup_of(const Snapshot<D>&, std::vector<Half_facet>*); \
  template Gluing gluing_of(const Snapshot<D>&, const std::vector<Half_facet>&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
