// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of an environment, by parts of space or by name: facets are opened and closed, cells excavated,
// filled and cut, and cuts are sewn up. See docs/cutting.md.
#ifndef CELLWALK_INTERNAL_RECORDS_ENVIRONMENT_CHANGE_H
#define CELLWALK_INTERNAL_RECORDS_ENVIRONMENT_CHANGE_H

#include <cellwalk/records/environment_part.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk {

enum class Change_kind : std::uint8_t {
  open,      ///< walls between free cells become passable
  close,     ///< facets between free cells become walls
  excavate,  ///< solid cells become free
  fill,      ///< free cells become solid
  cut,       ///< solid cells are cut along a blade
  sew        ///< the sides of cuts are joined again, point by point
};
constexpr std::size_t change_kind_count = 6;

/// A blade that cuts solid cells, and how far they are opened.
template <int D>
struct Blade_stroke {
  /// 3D: the corners of a convex polygon in order, or a line that is swept; 2D: a line.
  std::vector<Point<D>> points;
  std::optional<Vector<D>> sweep;  ///< 3D only: the displacement of the line
  double opening = 0.01;
};

template <int D>
struct Environment_change {
  Change_kind kind = Change_kind::open;
  Environment_part<D> part;  ///< of cuts: none; of sutures: no group
  Blade_stroke<D> blade{};   ///< of cuts only
  /// The step of a run before which it is made, from 1; refused parts are tried again before each step up to
  /// `until`.
  std::uint32_t step = 1, until = 1;
};

template <int D>
struct Environment_changes {
  /// Named parts, with the facets and cells that they have before the first change; not groups themselves.
  std::map<std::string, Environment_part<D>> groups;
  std::vector<Environment_change<D>> list;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_ENVIRONMENT_CHANGE_H
