// SPDX-License-Identifier: LGPL-3.0-or-later
// What must hold of every body, checked by the definition.
#ifndef CELLWALK_TESTS_RECORDS_BODY_CHECKS_H
#define CELLWALK_TESTS_RECORDS_BODY_CHECKS_H

#include <cellwalk/records/body_soup.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace cellwalk::test {

/// What is wrong with a body; empty if nothing is.
template <int D>
std::string flaw(const Body_soup<D>& body) {
  using Edge = std::array<std::uint32_t, 2>;
  for (const auto& p : body.points)
    if (!is_finite(p)) return "a coordinate is not finite";
  for (std::size_t i = 0; i < body.edges.size(); ++i) {
    const Edge& e = body.edges[i];
    if (e[0] >= e[1] || e[1] >= body.points.size()) return "edge " + std::to_string(i) + " is none";
    if (i > 0 && !(body.edges[i - 1] < e)) return "edge " + std::to_string(i) + " is not in order";
  }
  if (body.radii.size() > 1 && body.radii.size() != body.edges.size())
    return "as many radii as edges are needed";
  for (const double r : body.radii)
    if (!(r >= 0 && std::isfinite(r))) return "a radius is negative or not finite";
  if (D == 2 && !body.faces.empty()) return "a body of the plane has faces";
  const std::set<Edge> edges(body.edges.begin(), body.edges.end());
  std::set<std::array<std::uint32_t, 3>> seen;
  for (auto face : body.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % 3];
      if (!edges.contains({std::min(a, b), std::max(a, b)})) return "a side of a face is no edge";
    }
    std::sort(face.begin(), face.end());
    if (!seen.insert(face).second) return "a face occurs twice";
  }
  return {};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RECORDS_BODY_CHECKS_H
