// SPDX-License-Identifier: LGPL-3.0-or-later
#include "narrow.h"

namespace cellwalk::moving_walls {

bool passes_exactly(const Moving_wall& wall, const Edge& edge, Predicate_counts& counts) {
  const auto& [from, to, still] = wall;
  const detail::Swept_simplex<3> swept(from, to, still, counts);
  if (swept.is_flat()) return false;  // the wall moves in its plane, and passes nothing that lies on one side
  const detail::Encounter met = swept.meet(edge, counts);
  if (met != detail::Encounter::touch) return met == detail::Encounter::hit;
  // A wall that comes to touch the edge, or has its ridge that stands still there, does not pass it. Nor does
  // one that touches it as it starts, unless it goes to where free space is.
  return detail::Swept_simplex<3>(to, from, still, counts).reaches(edge, counts) &&
         (swept.reaches(edge, counts) || Exact::orientation(counts, from, still[0], still[1], to) > 0);
}

bool passes(Arithmetic arithmetic, const Moving_wall& wall, const Edge& edge, Predicate_counts& counts) {
  switch (arithmetic) {
    case Arithmetic::single:
      return passes_rounded<float>(wall, edge);
    case Arithmetic::twice:
      return passes_rounded<double>(wall, edge);
    case Arithmetic::exact:
      break;
  }
  return passes_exactly(wall, edge, counts);
}

}  // namespace cellwalk::moving_walls
