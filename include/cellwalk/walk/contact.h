// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts of all that moves: particles, edges, bodies and walls. Paper: sections II and III.
#ifndef CELLWALK_WALK_CONTACT_H
#define CELLWALK_WALK_CONTACT_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/exact_time.h>

#include <cstdint>
#include <memory>
#include <tuple>

namespace cellwalk {

/// The environment feature that blocks a motion.
enum class Contact_kind : std::uint8_t { vertex, edge, facet };

/// The feature of a body that meets a wall. At equal times the first of them counts.
enum class Body_feature : std::uint8_t { vertex, edge, face };

/// The contact that blocks a motion: of a point, or of an edge or a face at a vertex that moves.
template <int D>
struct Contact {
  /// The share of the motion that is free: the greatest double that is not later. Of the motion that is left,
  /// where a vertex that slides meets another wall in the same step.
  double time = 0;
  Point<D> point{};  ///< where the wall is met, rounded
  /// Unit, on the free side. If the point is blocked, or an edge by the interior of a facet, that of the
  /// wall; if an edge is blocked by an edge or vertex, the direction perpendicular to both. Always against
  /// the motion; docs/bodies.md describes the cases in which these would not be.
  Vector<D> normal{};
  Contact_kind kind = Contact_kind::facet;  ///< the kind of feature of the wall that is met
  /// The vertex of the wall at this position of its loop (kind vertex), or the edge from there to the next
  /// vertex (kind edge).
  std::uint16_t corner = 0;
  Half_facet facet = Half_facet::none;       ///< the wall seen from the free side; names its dart
  Cell cell = Cell::none;                    ///< in which the motion ends
  Body_feature body = Body_feature::vertex;  ///< the kind of feature that meets the wall
  std::uint32_t vertex = 0;                  ///< of a Body: the vertex that moves
  std::uint32_t feature = 0;  ///< of a Body: the number of its vertex, edge or face that meets the wall
  std::shared_ptr<const Exact_fraction> fraction;  ///< see exact_time()
  /// Of a start that is nearer to a wall than a radius: how far it is from there, rounded down.
  double distance = 0;

  /// The exact time. Walks report it rounded, as `time`; a bisection gives a time before it, and a walk with
  /// an inexact kernel one that is computed in doubles.
  Exact_time exact_time() const { return {time, fraction}; }
  void set_time(const Exact_time& exact) {
    time = exact.rounded();
    fraction = exact.fraction();
  }
};

/// The order of contacts: by exact time, then by the feature of the body (vertices, edges, faces), then
/// likewise by the feature of the environment, then by point and normal, and finally by half-facet. The
/// numbers of vertices and features do not count.
template <int D>
bool is_before(const Contact<D>& a, const Contact<D>& b) {
  if (const auto order = a.exact_time() <=> b.exact_time(); order != 0) return order < 0;
  return std::tie(a.body, a.kind, a.point, a.normal, a.facet) <
         std::tie(b.body, b.kind, b.point, b.normal, b.facet);
}

}  // namespace cellwalk

#endif  // CELLWALK_WALK_CONTACT_H
