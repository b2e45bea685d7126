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
#include "sides.h"

namespace cellwalk::detail {
namespace {

using E = CGAL::Exact_predicates_exact_constructions_kernel;
using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, E>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    E, CGAL::Triangulation_data_structure_2<Vertex_base, CGAL::Constrained_triangulation_face_base_2<E>>,
    CGAL::Exact_intersections_tag>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr int most_rounds = 12, most_passes = 12;
/// Later rounds have far fewer pairs than the first one, unless rounded parts cross more and more.
constexpr std::size_t most_growth = 4;
/// Corners are in a plane within this part of the distance at which points are joined, so that the points in
/// which two triangles see the same place become one.
constexpr double part_of_joined = 0.01;

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

/// A triangle seen along the axis that is the nearest to its normal, and its parts.
class Cut_triangle {
 public:
  explicit Cut_triangle(const E::Triangle_3& triangle) : plane_(triangle.supporting_plane()) {
    // Of a needle, the rounded normal may be 0, or along an axis in its plane.
    const std::array<E::FT, 3> normal{plane_.a(), plane_.b(), plane_.c()};
    for (int k = 1; k < 3; ++k)
      if (CGAL::abs(normal[k]) > CGAL::abs(normal[axis_])) axis_ = k;
    for (int i = 0; i < 3; ++i) corner_[i] = parts_.insert(seen(triangle[i]));
    is_turned_ = !E().left_turn_2_object()(corner_[0]->point(), corner_[1]->point(), corner_[2]->point());
  }

  void insert(const Trace& trace) {
    if (trace.first == trace.second)
      parts_.insert(seen(trace.first));
    else
      parts_.insert_constraint(seen(trace.first), seen(trace.second));
  }

  /// Calls visit(k, p) for each point p on the side from corner k to the next.
  template <class Visit>
  void for_each_point_on_a_side(const Visit& visit) const {
    for (auto v = parts_.finite_vertices_begin(); v != parts_.finite_vertices_end(); ++v) {
      if (is_corner(v)) continue;
      for (int k = 0; k < 3; ++k)
        if (E().collinear_2_object()(corner_[k]->point(), v->point(), corner_[(k + 1) % 3]->point()))
          visit(k, lifted(v->point()));
    }
  }

  /// Appends the parts of a facet, with points numbered by `number`.
  template <class Number>
  void append(const Facet& facet, const Number& number, std::vector<Facet>& result) {
    for (int i = 0; i < 3; ++i) corner_[i]->info() = facet.corners[i];
    for (auto v = parts_.finite_vertices_begin(); v != parts_.finite_vertices_end(); ++v)
      if (!is_corner(v)) v->info() = number(lifted(v->point()));
    for (auto face = parts_.finite_faces_begin(); face != parts_.finite_faces_end(); ++face) {
      Facet part = facet;
      for (int i = 0; i < 3; ++i) part.corners[i] = face->vertex(i)->info();
      if (is_turned_) turn(part);
      const Triangle& c = part.corners;
      if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) result.push_back(part);
    }
  }

  /// A triangle whose corners are moved into this one's plane along its axis, if they are within a distance
  /// of it. None are if all are and it would have no area.
  E::Triangle_3 snapped(const E::Triangle_3& other, double distance) const {
    std::array<E::Point_3, 3> p{other[0], other[1], other[2]};
    for (E::Point_3& q : p) {
      const E::Point_3 on_plane = lifted(seen(q));
      if (std::abs(CGAL::to_double(on_plane[axis_] - q[axis_])) <= distance) q = on_plane;
    }
    return E().collinear_3_object()(p[0], p[1], p[2]) ? other : E::Triangle_3(p[0], p[1], p[2]);
  }

 private:
  E::Point_2 seen(const E::Point_3& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }
  E::Point_3 lifted(const E::Point_2& p) const {
    const std::array<E::FT, 3> normal{plane_.a(), plane_.b(), plane_.c()};
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    std::array<E::FT, 3> x;
    x[u] = p.x(), x[v] = p.y();
    x[axis_] = -(normal[u] * p.x() + normal[v] * p.y() + plane_.d()) / normal[axis_];
    return {x[0], x[1], x[2]};
  }
  bool is_corner(const Triangulation::Vertex_handle v) const {
    return v == corner_[0] || v == corner_[1] || v == corner_[2];
  }

  E::Plane_3 plane_;
  int axis_ = 0;
  bool is_turned_ = false;
  Triangulation parts_;
  std::array<Triangulation::Vertex_handle, 3> corner_;
};

/// One round of cuts.
class Round {
 public:
  /// \param apart corners nearer to the plane of another triangle are in it: pairs in a plane up to rounding
  ///        are cut as such, and do not cross again in each round
  Round(Facets& surface, double apart) : surface_(surface), apart_(apart) {
    for (std::uint32_t v = 0; v < surface.points.size(); ++v) number_.insert({surface.points[v], v});
  }

  void cut(const Pairs& pairs) {
    for (const auto& [f, g] : pairs) {
      const E::Triangle_3 s = exact(f), t = exact(g);
      Cut_triangle &at_f = triangle(f), &at_g = triangle(g);
      insert(CGAL::intersection(s, at_f.snapped(t, apart_)), at_f);
      insert(CGAL::intersection(at_g.snapped(s, apart_), t), at_g);
    }
    cut_neighbours();
    std::vector<Facet> result;
    const auto number = [this](const E::Point_3& p) {
      return point({round(p.x()), round(p.y()), round(p.z())});
    };
    for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
      const auto at = cut_.find(f);
      if (at == cut_.end())
        result.push_back(surface_.facets[f]);
      else
        at->second.append(surface_.facets[f], number, result);
    }
    surface_.facets = std::move(result);
  }

 private:
  static E::Point_3 exact(const Point<3>& p) { return {p[0], p[1], p[2]}; }
  E::Triangle_3 exact(std::uint32_t f) const {
    const Facet& t = surface_.facets[f];
    return {exact(surface_.corner(t, 0)), exact(surface_.corner(t, 1)), exact(surface_.corner(t, 2))};
  }
  Side side(std::uint32_t f, int k) const {
    const Triangle& t = surface_.facets[f].corners;
    return std::minmax({t[k], t[(k + 1) % 3]});
  }

  Cut_triangle& triangle(std::uint32_t f) {
    const auto at = cut_.find(f);
    if (at != cut_.end()) return at->second;
    return cut_.try_emplace(f, exact(f)).first->second;
  }

  template <class Found>
  static void insert(const Found& found, Cut_triangle& triangle) {
    if (!found) return;
    std::vector<Trace> traces;
    visit_found(Collect{&traces}, *found);
    for (const Trace& trace : traces) triangle.insert(trace);
  }

  /// Points on sides belong to all triangles with that side.
  void cut_neighbours() {
    std::map<Side, std::vector<E::Point_3>> points;
    for (const auto& [f, parts] : cut_)
      parts.for_each_point_on_a_side(
          [&, f = f](int k, const E::Point_3& p) { points[side(f, k)].push_back(p); });
    for (std::uint32_t f = 0; f < surface_.facets.size() && !points.empty(); ++f)
      for (int k = 0; k < 3; ++k)
        if (const auto at = points.find(side(f, k)); at != points.end())
          for (const E::Point_3& p : at->second) triangle(f).insert({p, p});
  }

  std::uint32_t point(const Point<3>& p) {
    const auto [at, is_new] = number_.insert({p, static_cast<std::uint32_t>(surface_.points.size())});
    if (is_new) surface_.points.push_back(p);
    return at->second;
  }

  Facets& surface_;
  double apart_;
  std::map<Point<3>, std::uint32_t> number_;
  std::map<std::uint32_t, Cut_triangle> cut_;
};

/// Makes corners that lie on the side of another triangle, up to rounding, corners of all triangles with that
/// side: seen from one of them they may lie inside, from the next one outside, so that neither is cut there.
/// \param first_made points from this one on were made by cuts
void split_sides_near_cuts(Facets& surface, const Pairs& pairs, std::size_t first_made, double apart) {
  std::vector<bool> is_near(surface.points.size(), false), is_used(surface.points.size(), false);
  std::fill(is_near.begin() + static_cast<std::ptrdiff_t>(first_made), is_near.end(), true);
  for (const auto& [f, g] : pairs)
    for (const std::uint32_t facet : {f, g})
      for (const std::uint32_t v : surface.facets[facet].corners) is_near[v] = true;
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<Side> sides;
    std::vector<bool> is_near_now = is_near;
    for (const Facet& f : surface.facets) {
      const Triangle& t = f.corners;
      for (const std::uint32_t v : t) is_used[v] = true;
      if (!is_near[t[0]] && !is_near[t[1]] && !is_near[t[2]]) continue;
      for (int k = 0; k < 3; ++k) {  // of slivers, the longest side, too
        sides.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
        is_near_now[t[k]] = true;
      }
    }
    is_near = is_near_now;
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    std::vector<std::uint32_t> points;
    for (std::uint32_t v = 0; v < is_used.size(); ++v)
      if (is_used[v]) points.push_back(v);
    if (split_sides(surface, sides, points, apart).count == 0) return;
  }
}

}  // namespace

Cut cut_crossings(Facets& surface, Pairs pairs, double joined_within, const std::function<void()>& between) {
  Cut result;
  for (const auto& [f, g] : pairs) result.pairs.add(centre(surface, surface.facets[f]));
  const std::size_t points = surface.points.size();
  std::size_t facets_after_one = 0;
  const double apart = part_of_joined * joined_within;
  const auto leave_out = [&] {
    leave_out_collinear(surface);
    keep_one_in_each_place(surface);
    pairs = crossing_pairs(surface);
  };
  for (;;) {
    // The first round comes before: the sides of the file are split only where that does not suffice.
    if (result.rounds > 0) {
      split_sides_near_cuts(surface, pairs, points, apart);
      leave_out();
    }
    if (pairs.empty()) break;
    if (result.rounds == 1) facets_after_one = surface.facets.size();
    const bool explodes = pairs.size() > most_growth * result.pairs.count + most_rounds ||
                          (result.rounds > 1 && surface.facets.size() > 2 * most_growth * facets_after_one);
    if (explodes || result.rounds++ == most_rounds)
      throw Still_crossing(fmt::format(
          "surface crosses itself: {} still cross after {} rounds of cuts, the first at {}; "
          "repair it there",
          counted(pairs.size(), "pair of facets", "pairs of facets"), std::min(result.rounds, most_rounds),
          describe(centre(surface, surface.facets[pairs[0].first]))));
    between();
    Round(surface, apart).cut(pairs);
    const Found joined = weld(surface, joined_within, false);
    result.joined.add(joined);
    leave_out();
  }
  result.added_points = surface.points.size() - points;
  return result;
}

}  // namespace cellwalk::detail
