// SPDX-License-Identifier: GPL-3.0-or-later
// The constrained triangulation of segments, and the marks of its regions and holes.
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>
#include <cellwalk/meshing/triangulate.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace cellwalk {
namespace {

enum class Face_kind { inside, outside, hole };

constexpr std::uint32_t unnumbered = 0xffffffffu;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Face_base =
    CGAL::Triangulation_face_base_with_info_2<Face_kind, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Planar_triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Segment = std::array<std::uint32_t, 2>;

[[noreturn]] void refuse(const std::string& what) {
  throw Error(Error_code::input, "planar domain: " + what);
}

/// True if the open segments cross in one point.
bool cross(const Planar_domain& domain, const Segment& s, const Segment& t) {
  Predicate_counts counts;
  const auto side = [&](const Segment& line, std::uint32_t v) {
    return Exact::orientation(counts, domain.points[line[0]], domain.points[line[1]], domain.points[v]);
  };
  return side(s, t[0]) * side(s, t[1]) < 0 && side(t, s[0]) * side(t, s[1]) < 0;
}

/// Refuses the first crossing of segment `last` with an earlier one.
[[noreturn]] void refuse_crossing(const Planar_domain& domain, std::size_t last) {
  for (std::size_t i = 0; i < last; ++i)
    if (cross(domain, domain.segments[i], domain.segments[last]))
      refuse("segments " + std::to_string(i) + " and " + std::to_string(last) +
             " cross; split both at a common point");
  refuse("segment " + std::to_string(last) + " crosses an earlier one; split both at a common point");
}

/// The triangulation of all segments.
Planar_triangulation constrain(const Planar_domain& domain, Triangulate_report& report) {
  if (domain.segments.empty()) refuse("it has no segments; give its boundary");
  for (std::size_t v = 0; v < domain.points.size(); ++v)
    if (!is_finite(domain.points[v])) refuse("point " + std::to_string(v) + " is not finite");

  Planar_triangulation triangulation;
  std::vector<Planar_triangulation::Vertex_handle> vertices(domain.points.size());
  std::map<Point<2>, std::uint32_t> places;
  const auto vertex = [&](std::uint32_t v) {
    if (vertices[v] == nullptr) {
      vertices[v] = triangulation.insert({domain.points[v][0], domain.points[v][1]});
      report.merged_points += !places.insert({domain.points[v], v}).second;
    }
    return vertices[v];
  };
  std::set<Segment> seen;
  for (std::size_t i = 0; i < domain.segments.size(); ++i) {
    for (std::uint32_t v : domain.segments[i])
      if (v >= domain.points.size())
        refuse("segment " + std::to_string(i) + " names point " + std::to_string(v) + " of " +
               std::to_string(domain.points.size()));
    for (std::uint32_t v : domain.segments[i]) vertex(v);
  }
  for (std::size_t i = 0; i < domain.segments.size(); ++i) {
    const auto [a, b] = domain.segments[i];
    const auto [low, high] = std::minmax(places.at(domain.points[a]), places.at(domain.points[b]));
    if (low == high || !seen.insert({low, high}).second) {
      ++report.dropped_segments;
      continue;
    }
    try {
      triangulation.insert_constraint(vertices[a], vertices[b]);
    } catch (const Planar_triangulation::Intersection_of_constraints_exception&) {
      refuse_crossing(domain, i);
    }
  }
  for (const auto& v : vertices) report.unused_points += v == nullptr;
  if (triangulation.dimension() < 2)
    refuse("its segments lie on one line and enclose nothing; close its boundary");
  return triangulation;
}

/// Marks all faces connected with a face through edges that are not segments.
void mark(Planar_triangulation::Face_handle start, Face_kind kind) {
  std::vector<Planar_triangulation::Face_handle> stack{start};
  start->info() = kind;
  while (!stack.empty()) {
    const auto face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (face->is_constrained(i) || next->info() == kind) continue;
      next->info() = kind;
      stack.push_back(next);
    }
  }
}

void mark_holes(Planar_triangulation& triangulation, const Planar_domain& domain,
                Triangulate_report& report) {
  for (std::size_t h = 0; h < domain.holes.size(); ++h) {
    if (!is_finite(domain.holes[h])) refuse("the point of hole " + std::to_string(h) + " is not finite");
    Planar_triangulation::Locate_type type{};
    int i = 0;
    const auto face = triangulation.locate({domain.holes[h][0], domain.holes[h][1]}, type, i);
    if (type == Planar_triangulation::VERTEX ||
        (type == Planar_triangulation::EDGE && face->is_constrained(i)))
      refuse("the point of hole " + std::to_string(h) + " lies on a segment; move it inside the hole");
    if (type == Planar_triangulation::OUTSIDE_CONVEX_HULL || face->info() == Face_kind::outside)
      ++report.outer_holes;
    else if (face->info() == Face_kind::inside)
      mark(face, Face_kind::hole);
  }
}

Cell_soup<2> collect(Planar_triangulation& triangulation, bool keep_holes, Triangulate_report& report) {
  Cell_soup<2> soup;
  std::size_t free_cells = 0;
  const auto is_kept = [&](Face_kind kind) {
    return kind == Face_kind::inside || (keep_holes && kind == Face_kind::hole);
  };
  for (const auto& face : triangulation.finite_face_handles()) {
    if (!is_kept(face->info())) continue;
    const bool solid = face->info() == Face_kind::hole;
    std::array<std::uint32_t, 3> index;
    for (int i = 0; i < 3; ++i) {
      auto& number = face->vertex(i)->info();
      if (number == unnumbered) {
        number = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back({face->vertex(i)->point().x(), face->vertex(i)->point().y()});
      }
      index[i] = number;
    }
    for (int i = 0; i < 3; ++i) {
      const bool wall = face->is_constrained((i + 2) % 3);  // the edge opposite that vertex
      soup.add_facet({index[i], index[(i + 1) % 3]}, wall || solid);
      report.walls += wall && !solid && face->neighbor((i + 2) % 3)->info() == Face_kind::inside;
    }
    soup.end_cell(solid);
    ++(solid ? report.solid_cells : free_cells);
  }
  report.walls /= 2;  // seen from both sides
  if (free_cells == 0) refuse("its segments enclose nothing outside holes; close its boundary");
  return soup;
}

}  // namespace

Cell_soup<2> triangulate(const Planar_domain& domain, const Triangulate_options& options,
                         Triangulate_report* report) {
  Triangulate_report own;
  Triangulate_report& r = report ? *report : own;
  r = {};
  Planar_triangulation triangulation = constrain(domain, r);
  for (const auto& v : triangulation.finite_vertex_handles()) v->info() = unnumbered;
  for (const auto& face : triangulation.all_face_handles()) face->info() = Face_kind::inside;
  mark(triangulation.infinite_face(), Face_kind::outside);
  mark_holes(triangulation, domain, r);
  return collect(triangulation, options.keep_holes, r);
}

}  // namespace cellwalk
