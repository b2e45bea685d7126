// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a repair, as its steps write it.
#ifndef CELLWALK_MESHING_REPAIR_CHANGES_H
#define CELLWALK_MESHING_REPAIR_CHANGES_H

#include <cellwalk/internal/meshing/repair_surface.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "meshing/fill/narrow_place.h"

namespace cellwalk::detail {

/// Something found several times: its number and its first places.
struct Found {
  static constexpr std::size_t most_places = 100;

  std::size_t count = 0;
  std::vector<Point<3>> places{};
  double measured = 0;

  void add(const Point<3>& at, double distance = 0) {
    if (++count <= most_places) places.push_back(at);
    if (distance > measured) measured = distance;
  }
  void add(const Found& other) {
    for (const Point<3>& place : other.places) add(place);
    count += other.count - other.places.size();
    measured = std::max(measured, other.measured);
  }
  /// ", the first at (x, y, z)", or ", at (x, y, z)" for a single one.
  std::string where() const {
    return places.empty() ? "" : (count == 1 ? ", at " : ", the first at ") + describe(places[0]);
  }
};

/// "1 facet", "3 facets".
inline std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// Appends a change, if there is any. The text is followed by the place.
inline void report(std::vector<Repair_change>& changes, const std::string& step, const std::string& text,
                   Found found) {
  if (found.count == 0) return;
  const std::string where = found.where();
  changes.push_back({step, text + where, found.count, std::move(found.places), found.measured});
}

[[noreturn]] inline void refuse_surface(const std::string& what) {
  throw Error(Error_code::input, "surface " + what);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_CHANGES_H
