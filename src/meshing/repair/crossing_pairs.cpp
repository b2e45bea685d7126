// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that meet, found by their boxes and decided exactly.
#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>

#include "crossings.h"

namespace cellwalk::detail {
namespace {

using K = Repair_kernel;

class Crossing {
 public:
  explicit Crossing(const Facets& surface) : surface_(surface) {}

  bool operator()(std::uint32_t f, std::uint32_t g) const {
    const Triangle &s = surface_.facets[f].corners, &t = surface_.facets[g].corners;
    std::array<int, 3> in_t{};  // per corner of s: its place in t, or -1
    int common = 0;
    for (int i = 0; i < 3; ++i) {
      in_t[i] = static_cast<int>(std::find(t.begin(), t.end(), s[i]) - t.begin());
      in_t[i] == 3 ? in_t[i] = -1 : ++common;
    }
    if (common == 3) return false;
    if (common == 0) return K().do_intersect_3_object()(triangle(s), triangle(t));
    if (common == 1) {
      const int i = in_t[0] >= 0 ? 0 : in_t[1] >= 0 ? 1 : 2;
      const int j = in_t[i];
      return K().do_intersect_3_object()(K::Segment_3(point(s[(i + 1) % 3]), point(s[(i + 2) % 3])),
                                         triangle(t)) ||
             K().do_intersect_3_object()(K::Segment_3(point(t[(j + 1) % 3]), point(t[(j + 2) % 3])),
                                         triangle(s));
    }
    // A common edge: they overlap if they lie in a plane, on the same side of it.
    const int i = in_t[0] < 0 ? 0 : in_t[1] < 0 ? 1 : 2;
    const std::uint32_t a = s[(i + 1) % 3], b = s[(i + 2) % 3];
    std::uint32_t apex = t[0];
    for (const std::uint32_t v : t)
      if (v != a && v != b) apex = v;
    return K().coplanar_3_object()(point(a), point(b), point(s[i]), point(apex)) &&
           K().coplanar_orientation_3_object()(point(a), point(b), point(s[i]), point(apex)) ==
               CGAL::POSITIVE;
  }

 private:
  K::Point_3 point(std::uint32_t v) const { return to_cgal(surface_.points[v]); }
  K::Triangle_3 triangle(const Triangle& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }

  const Facets& surface_;
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_pairs(const Facets& surface) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    CGAL::Bbox_3 box;
    for (std::size_t k = 0; k < 3; ++k) box += to_cgal(surface.corner(surface.facets[f], k)).bbox();
    boxes.emplace_back(box, f);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const Crossing cross(surface);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (cross(a.info(), b.info())) pairs.push_back(std::minmax(a.info(), b.info()));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace cellwalk::detail
