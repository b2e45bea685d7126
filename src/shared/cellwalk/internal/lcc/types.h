// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles, and what walks on a map report.
#ifndef CELLWALK_INTERNAL_LCC_TYPES_H
#define CELLWALK_INTERNAL_LCC_TYPES_H

#include <cellwalk/internal/lcc/signs.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace cellwalk::lcc {

/// A point with a dart of the cell that contains it: the aimed-at dart of the paper, whose facet spans the
/// predictive simplex with the position.
template <class Lcc>
struct Particle {
  typename Lcc::Point position;
  Dart<Lcc> dart;
};

enum class Status : std::uint8_t {
  arrived,  ///< the target lies in the closed cell of the dart
  contact,  ///< the motion cannot be continued through passable facets
  lost      ///< rounded signs or cells that are not convex only: no exit was found, or the walk did not end
};

/// The wall that blocks a motion.
template <class Lcc>
struct Contact {
  Rational time;      ///< the share of the motion that is free
  int dimension = 0;  ///< of the cell of the wall that is met: 0 vertex, 1 edge, 2 facet in space
  Dart<Lcc> wall;     ///< of the impassable facet, seen from the free side
  Dart<Lcc> feature;  ///< starts at the vertex, or is on the edge; for a facet the same as `wall`
  std::array<double, static_cast<std::size_t>(Lcc::dimension)> normal{};  ///< unit, on the free side, rounded
};

template <class Lcc>
struct Walk {
  Status status = Status::arrived;
  Dart<Lcc> dart;           ///< of the facet of the last cell at which the motion aims
  std::size_t cells = 1;    ///< visited
  bool had_choice = false;  ///< it went on along a wall, with free space on both sides
  std::optional<Contact<Lcc>> contact;
};

/// The answer about an edge pq whose end p moves.
template <class Lcc>
struct Edge_check {
  Status status = Status::arrived;
  Particle<Lcc> p;  ///< at its target, if arrived
  /// If contact: that of p on its way or, where p arrives, that of the temporary particle from there to q,
  /// whose time is a share of that way.
  std::optional<Contact<Lcc>> contact;
  bool is_by_vertex = false;  ///< p itself is blocked
};

}  // namespace cellwalk::lcc

#endif  // CELLWALK_INTERNAL_LCC_TYPES_H
