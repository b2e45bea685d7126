// SPDX-License-Identifier: LGPL-3.0-or-later
// The test whether a point lies in a closed cell.
#include <cellwalk/kernel/exact.h>
#include <cellwalk/walk/locate.h>

namespace cellwalk {

template <int D>
bool in_closure(const Snapshot<D>& snapshot, Cell cell, const Point<D>& point) {
  if (!snapshot.is_cell(cell) || !is_finite(point)) return false;
  const Cell_view<D> view = snapshot.view(cell);
  Predicate_counts counts;
  for (std::size_t f = 0; f < view.facet_count(); ++f) {
    const auto loop = view.loop(f);
    if constexpr (D == 2) {
      if (Exact::orientation(counts, view.point(loop[0]), view.point(loop[1]), point) < 0) return false;
    } else {
      // Every triangle of the fan, since the first three vertices may be collinear.
      for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        if (Exact::orientation(counts, view.point(loop[0]), view.point(loop[i]), view.point(loop[i + 1]),
                               point) > 0)
          return false;
    }
  }
  return true;
}

template bool in_closure<2>(const Snapshot<2>&, Cell, const Point<2>&);
template bool in_closure<3>(const Snapshot<3>&, Cell, const Point<3>&);

}  // namespace cellwalk
