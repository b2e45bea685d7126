// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts of bodies, independent of the method that found them. Paper: section III.
#ifndef CELLWALK_EDGE_CONTACT_H
#define CELLWALK_EDGE_CONTACT_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/kernel/exact_time.h>
#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <optional>
#include <tuple>

namespace cellwalk {

/// The feature of a body that meets a wall. At equal times the first of them counts.
enum class Body_feature : std::uint8_t { vertex, edge, face };

/// A contact that blocks the motion of a vertex p: of the vertex itself, or of an edge or a face at it. All
/// that meets a wall reports it so: particles, single edges and bodies.
template <int D>
struct Contact {
  /// The share of the motion of p that is free. Exact wherever signs are: only a bisection gives a time
  /// before it, and a walk with an inexact kernel one that is computed in doubles.
  Exact_time time;
  Point<D> point{};  ///< where the wall is met, rounded
  /// Unit, on the free side. If the vertex is blocked, or an edge by the interior of a facet, that of the
  /// wall; if an edge is blocked by an edge or vertex, the direction perpendicular to both. Always against
  /// the motion; docs/bodies.md describes the cases in which these would not be.
  Vector<D> normal{};
  Contact_kind kind = Contact_kind::facet;   ///< what of the wall is met
  std::uint16_t corner = 0;                  ///< which vertex or edge of it, see Wall_contact
  Half_facet facet = Half_facet::none;       ///< the wall seen from the free side; names its dart
  Cell cell = Cell::none;                    ///< in which the motion ends
  Body_feature body = Body_feature::vertex;  ///< what of the body meets the wall
  std::uint32_t vertex = 0;                  ///< of a Body: the vertex that moves
  std::uint32_t feature = 0;  ///< of a Body: the number of its vertex, edge or face that meets the wall

  /// The time as it is reported: the greatest double that is not later.
  double rounded_time() const { return time.rounded(); }
};

/// The contact at a time with the wall that a walk met.
template <int D>
Contact<D> to_contact(const Wall_contact<D>& met, const Exact_time& time, Body_feature body) {
  return {time, met.point, met.normal, met.kind, met.corner, met.facet, met.cell, body};
}

/// The order of contacts: by exact time, then by the feature of the body (vertices, edges, faces), then
/// likewise by the feature of the environment, then by point and normal, and finally by half-facet. The
/// numbers of vertices and features do not count.
template <int D>
bool is_before(const Contact<D>& a, const Contact<D>& b) {
  if (const auto order = a.time <=> b.time; order != 0) return order < 0;
  return std::tie(a.body, a.kind, a.point, a.normal, a.facet) <
         std::tie(b.body, b.kind, b.point, b.normal, b.facet);
}

/// The result of the sweep of an edge.
template <int D>
struct Sweep_result {
  std::optional<Contact<D>> contact;  ///< none: the move is free
  Chain chain;                        ///< of the edge after the move
  // Of sweep_edge() only:
  Particle<D> p{};          ///< after the move, or before it if there is a contact
  std::uint32_t cells = 0;  ///< number of cells visited by p
};

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_CONTACT_H
