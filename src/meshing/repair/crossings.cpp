// SPDX-License-Identifier: GPL-3.0-or-later
// Constrained triangulations of the triangles that cross, with exact constructions.
#include "crossings.h"

#define CGAL_NO_CDT_2_WARNING
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>
#include <boost/variant.hpp>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <variant>

#include "near_points.h"

namespace cellwalk::detail {
namespace {

using E = CGAL::Exact_predicates_exact_constructions_kernel;
using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, E>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    E, CGAL::Triangulation_data_structure_2<Vertex_base, CGAL::Constrained_triangulation_face_base_2<E>>,
    CGAL::Exact_intersections_tag>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr int most_rounds = 12;
constexpr std::uint32_t no_point = 0xffffffffu;

/// Results of CGAL::intersection: boost's variants up to CGAL 5, those of the standard from 6 on.
template <class Visitor, class... T>
void visit_found(const Visitor& visitor, const boost::variant<T...>& value) {
  boost::apply_visitor(visitor, value);
}
template <class Visitor, class... T>
void visit_found(const Visitor& visitor, const std::variant<T...>& value) {
  std::visit(visitor, value);
}

/// A point or segment in which a triangle meets others, twice the same point for a point.
using Trace = std::pair<E::Point_3, E::Point_3>;

/// The traces of an intersection.
struct Collect {
  using result_type = void;
  std::vector<Trace>* traces;

  void operator()(const E::Point_3& p) const { traces->push_back({p, p}); }
  void operator()(const E::Segment_3& s) const { traces->push_back({s.source(), s.target()}); }
  void operator()(const E::Triangle_3& t) const {
    for (int i = 0; i < 3; ++i) traces->push_back({t[i], t[(i + 1) % 3]});
  }
  void operator()(const std::vector<E::Point_3>& loop) const {
    for (std::size_t i = 0; i < loop.size(); ++i) traces->push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
};

double round(const E::FT& x) { return CGAL::to_double(CGAL::exact(x)); }  // equal numbers alike

/// One round of cuts.
class Round {
 public:
  explicit Round(Facets& surface) : surface_(surface) {
    for (std::uint32_t v = 0; v < surface.points.size(); ++v) number_.insert({surface.points[v], v});
  }

  void cut(const Pairs& pairs) {
    std::unordered_map<std::uint32_t, std::vector<Trace>> traces;
    for (const auto& [f, g] : pairs) {
      const auto found = CGAL::intersection(exact(f), exact(g));
      if (!found) continue;
      std::vector<Trace> common;
      visit_found(Collect{&common}, *found);
      for (const std::uint32_t h : {f, g}) traces[h].insert(traces[h].end(), common.begin(), common.end());
    }
    std::vector<Facet> result;
    for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
      const auto at = traces.find(f);
      if (at == traces.end())
        result.push_back(surface_.facets[f]);
      else
        cut(f, at->second, result);
    }
    surface_.facets = std::move(result);
  }

 private:
  static E::Point_3 exact(const Point<3>& p) { return {p[0], p[1], p[2]}; }
  E::Triangle_3 exact(std::uint32_t f) const {
    const Facet& t = surface_.facets[f];
    return {exact(surface_.corner(t, 0)), exact(surface_.corner(t, 1)), exact(surface_.corner(t, 2))};
  }

  void cut(std::uint32_t f, const std::vector<Trace>& traces, std::vector<Facet>& result) {
    const Facet facet = surface_.facets[f];
    const E::Triangle_3 triangle = exact(f);
    // Seen along the axis that is the nearest to its normal. The projection turns it if its normal points
    // against that axis.
    const Vector<3> normal = area_vector(surface_, facet);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto seen = [&](const E::Point_3& p) { return E::Point_2(p[u], p[v]); };
    Triangulation t;
    std::array<typename Triangulation::Vertex_handle, 3> corner;
    for (int i = 0; i < 3; ++i) {
      corner[i] = t.insert(seen(triangle[i]));
      corner[i]->info() = facet.corners[i];
    }
    const bool is_turned =
        CGAL::orientation(corner[0]->point(), corner[1]->point(), corner[2]->point()) == CGAL::CLOCKWISE;
    for (const auto& [from, to] : traces) {
      if (from == to)
        t.insert(seen(from));
      else
        t.insert_constraint(seen(from), seen(to));
    }
    const E::Plane_3 plane = triangle.supporting_plane();
    for (auto vertex = t.finite_vertices_begin(); vertex != t.finite_vertices_end(); ++vertex) {
      const typename Triangulation::Vertex_handle at = vertex;
      if (std::find(corner.begin(), corner.end(), at) == corner.end())
        vertex->info() = point(lifted(vertex->point(), plane, axis));
    }
    for (auto face = t.finite_faces_begin(); face != t.finite_faces_end(); ++face) {
      Facet part = facet;
      for (int i = 0; i < 3; ++i) part.corners[i] = face->vertex(i)->info();
      if (is_turned) turn(part);
      const Triangle& c = part.corners;
      if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) result.push_back(part);
    }
  }

  /// The point of a plane that is seen at p along an axis, rounded.
  static Point<3> lifted(const E::Point_2& p, const E::Plane_3& plane, int axis) {
    const std::array<E::FT, 3> normal{plane.a(), plane.b(), plane.c()};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Point<3> result;
    result[u] = round(p.x()), result[v] = round(p.y());
    result[axis] = round(-(normal[u] * p.x() + normal[v] * p.y() + plane.d()) / normal[axis]);
    return result;
  }

  std::uint32_t point(const Point<3>& p) {
    const auto [at, is_new] = number_.insert({p, static_cast<std::uint32_t>(surface_.points.size())});
    if (is_new) surface_.points.push_back(p);
    return at->second;
  }

  Facets& surface_;
  std::map<Point<3>, std::uint32_t> number_;
};

}  // namespace

Cut cut_crossings(Facets& surface, Pairs pairs, double joined_within, const std::function<void()>& between) {
  Cut result;
  for (const auto& [f, g] : pairs) result.pairs.add(centre(surface, surface.facets[f]));
  const std::size_t points = surface.points.size();
  for (; !pairs.empty(); pairs = crossing_pairs(surface)) {
    if (result.rounds++ == most_rounds)
      refuse_surface(
          fmt::format("crosses itself: {} still cross after {} rounds of cuts, the first at {}; "
                      "repair it there",
                      counted(pairs.size(), "pair of facets", "pairs of facets"), most_rounds,
                      describe(centre(surface, surface.facets[pairs[0].first]))));
    between();
    Round(surface).cut(pairs);
    const Found joined = weld(surface, joined_within, false);
    for (const Point<3>& place : joined.places) result.joined.add(place);
    result.joined.count += joined.count - joined.places.size();
    result.joined.measured = std::max(result.joined.measured, joined.measured);
    const Left_out left_out = leave_out_useless(surface);
    result.left_out.collinear.count += left_out.collinear.count;
    result.left_out.repeated.count += left_out.repeated.count;
  }
  result.added_points = surface.points.size() - points;
  return result;
}

}  // namespace cellwalk::detail
