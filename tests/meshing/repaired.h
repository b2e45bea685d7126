// SPDX-License-Identifier: LGPL-3.0-or-later
// A surface repaired and certified, and shapes to be damaged.
#ifndef CELLWALK_TESTS_MESHING_REPAIRED_H
#define CELLWALK_TESTS_MESHING_REPAIRED_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/meshing/repair_surface.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "shapes.h"

namespace cellwalk::test {

struct Repaired {
  Repair_report report;
  Certificate certificate;
  Soup_groups groups;
  Cell_soup<3> soup;

  /// The texts of the changes of a step.
  std::string step(const std::string& name) const {
    std::string text;
    for (const Repair_change& c : report.changes)
      if (c.step == name) text += c.text + "\n";
    return text;
  }
  /// The area of the walls inside the free space.
  double membrane_area() const {
    std::map<std::set<std::uint32_t>, int> sides;
    const auto key = [this](std::size_t f) {
      return std::set<std::uint32_t>(soup.facet(f).begin(), soup.facet(f).end());
    };
    for (std::size_t f = 0; f < soup.facet_count(); ++f) ++sides[key(f)];
    double area = 0;
    for (std::size_t f = 0; f < soup.facet_count(); ++f) {
      if (soup.impassable[f] == 0 || sides[key(f)] != 2) continue;
      const auto t = soup.facet(f);
      area += length(cross(soup.points[t[1]] - soup.points[t[0]], soup.points[t[2]] - soup.points[t[0]])) / 4;
    }
    return area;
  }
};

inline Repaired repair(const Surface_soup& surface, const Repair_options& options = {},
                       const Tetrahedralize_options& mesh = {}) {
  Repaired result;
  Repaired_surface repaired = repair_surface(surface, options, mesh, result.report);
  result.soup = repaired.soup;
  result.groups = std::move(repaired.groups);
  Build_report built;
  (void)Environment<3>::build(std::move(repaired.soup), {.split = false, .keep_map = false}, &built);
  result.certificate = built.certificate;
  return result;
}

inline Surface_soup cube(const Point<3>& low, double side) {
  return box(low, low + Vector<3>{side, side, side});
}

/// Turned by two angles, so that nothing is parallel to the axes.
inline Surface_soup turned_by_angles(Surface_soup s, double a = 0.7) {
  const double b = 0.5 * a + 0.05;
  for (Point<3>& p : s.points) {
    p = {std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    p = {p[0], std::cos(b) * p[1] - std::sin(b) * p[2], std::sin(b) * p[1] + std::cos(b) * p[2]};
  }
  return s;
}

inline Surface_soup quadrangle(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  return {{a, b, c, d}, {{0, 1, 2, 3}}};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_MESHING_REPAIRED_H
