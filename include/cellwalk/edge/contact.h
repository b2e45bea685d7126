// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts of bodies, however they were found. Paper: section III.
#ifndef CELLWALK_EDGE_CONTACT_H
#define CELLWALK_EDGE_CONTACT_H

#include <cellwalk/kernel/exact_time.h>
#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <tuple>

namespace cellwalk {

/// The feature of a body that meets a wall. Ties in time go to the first of them.
enum class Body_feature : std::uint8_t { vertex, edge, face };

/// When, where and by what the motion of a vertex p is blocked, be it itself, an edge at it or a face.
///
/// time: share of the motion of p that is free, never later than the contact; impact is the same before rounding, where the
/// search is exact. point: rounded. normal: unit, on the free side. If the vertex is blocked, or an edge by the inside of a
/// facet, that of the wall; if an edge is blocked by an edge or vertex, the direction that is perpendicular to both. Always
/// against the motion: docs/bodies.md says what it is where that asks for another. kind, facet, corner: of the environment.
template <int D>
struct Contact : Wall_contact<D> {
  Body_feature body = Body_feature::vertex;
  Exact_time impact;
};

/// The order of contacts: by exact time, then vertices of the body before edges before faces, then features of the environment
/// in that order, then by place and normal, last by half-facets.
template <int D>
bool is_before(const Contact<D>& a, const Contact<D>& b) {
  if (const auto order = a.impact <=> b.impact; order != 0) return order < 0;
  return std::tie(a.body, a.kind, a.point, a.normal, a.facet) <
         std::tie(b.body, b.kind, b.point, b.normal, b.facet);
}

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_CONTACT_H
