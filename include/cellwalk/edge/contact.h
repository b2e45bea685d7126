// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts of bodies, independent of the method that found them. Paper: section III.
#ifndef CELLWALK_EDGE_CONTACT_H
#define CELLWALK_EDGE_CONTACT_H

#include <cellwalk/kernel/exact_time.h>
#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <tuple>

namespace cellwalk {

/// The feature of a body that meets a wall. At equal times the first of them counts.
enum class Body_feature : std::uint8_t { vertex, edge, face };

/// A contact that blocks the motion of a vertex p: of the vertex itself, or of an edge or a face at it.
///
/// - time: the fraction of the motion of p that is free, never later than the contact; impact is its exact
///   value, if the search is exact
/// - point: rounded
/// - normal: a unit vector on the free side, always against the motion. If the vertex is blocked, or an edge
///   by the interior of a facet, it is that of the wall; if an edge is blocked by an edge or vertex, it is
///   perpendicular to both. Degenerate cases: docs/bodies.md
/// - kind, facet, corner: the feature of the environment
template <int D>
struct Contact : Wall_contact<D> {
  Body_feature body = Body_feature::vertex;
  Exact_time impact;
};

/// The order of contacts: by exact time, then by the feature of the body (vertices, edges, faces), then
/// likewise by the feature of the environment, then by point and normal, and finally by half-facet.
template <int D>
bool is_before(const Contact<D>& a, const Contact<D>& b) {
  if (const auto order = a.impact <=> b.impact; order != 0) return order < 0;
  return std::tie(a.body, a.kind, a.point, a.normal, a.facet) <
         std::tie(b.body, b.kind, b.point, b.normal, b.facet);
}

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_CONTACT_H
