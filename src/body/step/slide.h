// SPDX-License-Identifier: LGPL-3.0-or-later
// How a motion goes on along walls.
#ifndef CELLWALK_BODY_STEP_SLIDE_H
#define CELLWALK_BODY_STEP_SLIDE_H

#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <span>

namespace cellwalk::detail {

/// How far a new move is lifted off the wall it starts from. Rounding of a position and of a projected motion
/// is a few ulp each; a lift that is too small only costs another contact, since every move is checked
/// exactly.
constexpr double contact_offset_ulps = 16;

/// The lift of a motion from a position at a wall, along the normal of that. At the origin, where doubles are
/// as near to each other as they get anywhere, the motion determines the size of a few ulp, so that the lift
/// is in proportion to the environment.
template <int D>
Vector<D> lift(const Point<D>& position, const Vector<D>& motion, const Vector<D>& normal) {
  return (contact_offset_ulps * ulp<D>(position == Point<D>{} ? motion : position)) * normal;
}

/// The part of a motion that two walls leave: none in the plane, that along their edge in space.
inline Vector<2> project_on_both_planes(const Vector<2>&, const Vector<2>&, const Vector<2>&) { return {}; }
inline Vector<3> project_on_both_planes(const Vector<3>& v, const Vector<3>& n, const Vector<3>& m) {
  const Vector<3> edge = cross(n, m);
  const double square = dot(edge, edge);
  return square > 0 ? (dot(v, edge) / square) * edge : Vector<3>{};
}

/// A motion along two walls leads into a wall by no more than this share of its length if it only seems to,
/// by rounding.
constexpr double rounding = 0x1p-40;

/// The rest of a motion that met walls with these normals, the last of them just now: its part along the last
/// one; where that leads into another, its part along both; nothing where that leads into a third.
template <int D>
Vector<D> slide(const Vector<D>& motion, std::span<const Vector<D>> normals) {
  const Vector<D>& last = normals.back();
  const Vector<D> along = motion - std::min(0.0, dot(motion, last)) * last;
  for (std::size_t i = normals.size() - 1; i-- > 0;) {
    if (dot(along, normals[i]) >= 0) continue;
    const Vector<D> both = project_on_both_planes(along, last, normals[i]);
    const double most_into = rounding * length(both);
    const bool leads_out = std::all_of(normals.begin(), normals.end(),
                                       [&](const Vector<D>& n) { return dot(both, n) >= -most_into; });
    return leads_out ? both : Vector<D>{};
  }
  return along;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_STEP_SLIDE_H
