// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact times at which a motion passes its choices and meets walls, and their comparison.
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/internal/walk/star.h>

#include <tuple>

namespace cellwalk::detail {
namespace {

/// When the line ab passes that of ridge uv, which meets it in one point.
Fraction passing_time(const Point<3>& a, const Point<3>& b, const Point<3>& u, const Point<3>& v) {
  // Any plane of the ridge that does not contain ab gives it: the plane through a point beside u on some
  // axis.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Point<3> beside = u;
    beside[axis] = u[axis] == 0 ? 1 : 0;
    const Ring at_a = Exact_value::orientation(u, v, beside, a);
    const Ring span = at_a - Exact_value::orientation(u, v, beside, b);
    if (CGAL::sign(span) != CGAL::ZERO) return {at_a, span};
  }
  refuse_uncertified();
}

template <int D>
Fraction blocking_time(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, Half_facet wall) {
  const auto corners = spanning_corners(snapshot.view(snapshot.cell_of(wall)), snapshot.facet_of(wall));
  return std::apply(
      [&](const auto&... corner) {
        return fraction_of(Crossing<D>{a, b, {*corner...}});
      },
      corners);
}

}  // namespace

template <int D>
Fraction passing_time(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, std::uint32_t u,
                      std::uint32_t v) {
  const Point<D>&at_u = snapshot.point(u), &at_v = snapshot.point(v);
  if (u == v) {
    for (std::size_t axis = 0; axis < D; ++axis)
      if (a[axis] != b[axis]) return {Ring(at_u[axis]) - Ring(a[axis]), Ring(b[axis]) - Ring(a[axis])};
    refuse_uncertified();
  }
  if constexpr (D == 3) {
    if (!are_collinear(a, b, at_u) || !are_collinear(a, b, at_v)) return passing_time(a, b, at_u, at_v);
  }
  return {};
}

template <int D>
Exact_time time_of(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b,
                   const Side_taken& choice) {
  return to_time(passing_time(snapshot, a, b, choice.u, choice.v));
}

template <int D>
bool blocks_later(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, Half_facet wall,
                  Half_facet other) {
  return blocking_time(snapshot, a, b, other) < blocking_time(snapshot, a, b, wall);
}

#define CELLWALK_INSTANTIATE(D)                                                                            \
  template Fraction passing_time<D>(const Snapshot<D>&, const Point<D>&, const Point<D>&, std::uint32_t,   \
                                    std::uint32_t);                                                        \
  template Exact_time time_of<D>(const Snapshot<D>&, const Point<D>&, const Point<D>&, const Side_taken&); \
  template bool blocks_later<D>(const Snapshot<D>&, const Point<D>&, const Point<D>&, Half_facet, Half_facet);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
