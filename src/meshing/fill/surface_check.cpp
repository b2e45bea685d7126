// SPDX-License-Identifier: GPL-3.0-or-later
// Facets cut into triangles, tested for intersections and oriented outwards, by CGAL.
#include <cellwalk/kernel/error.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "surface_mesh.h"
#include "surface_topology.h"

namespace cellwalk {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using detail::Surface_mesh;
using Face = Surface_mesh::Face_index;

/// Records the polygon from which each triangle was cut.
struct Source_visitor : PMP::Triangulate_faces::Default_visitor<Surface_mesh> {
  Surface_mesh::Property_map<Face, std::uint32_t>* source;
  std::uint32_t current = 0;

  void before_subface_creations(Face polygon) { current = (*source)[polygon]; }
  void after_subface_created(Face triangle) const { (*source)[triangle] = current; }
};

std::vector<std::uint32_t> loop_of(const Surface_mesh& mesh, Face face) {
  std::vector<std::uint32_t> loop;
  for (auto v : mesh.vertices_around_face(mesh.halfedge(face))) loop.push_back(v.idx());
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

/// Orients the components so that they bound a volume: outer ones outwards, the next inwards.
void orient_outwards(Surface_mesh& mesh, Surface_report& report) {
  std::vector<std::vector<std::uint32_t>> before;
  for (Face face : mesh.faces()) before.push_back(loop_of(mesh, face));
  PMP::orient_to_bound_a_volume(mesh);
  std::size_t turned = 0, i = 0;
  for (Face face : mesh.faces()) turned += loop_of(mesh, face) != before[i++];
  report.inside_out = turned == before.size();
  if (!report.inside_out) report.turned_facets += turned;
}

/// The first face that is no triangle, of which there is one.
Face first_polygon(const Surface_mesh& mesh) {
  for (Face face : mesh.faces())
    if (mesh.degree(face) > 3) return face;
  return *mesh.faces_begin();
}

std::string pair_of(std::uint32_t a, std::uint32_t b) {
  return "facets " + std::to_string(a) + " and " + std::to_string(b);
}

}  // namespace

namespace detail {

void append(Surface_mesh& mesh, const Surface_soup& surface) {
  std::vector<Surface_mesh::Vertex_index> vertices, loop;
  for (const auto& p : surface.points) vertices.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
  for (const auto& facet : surface.facets) {
    loop.clear();
    for (std::uint32_t v : facet) loop.push_back(vertices[v]);
    if (mesh.add_face(loop) == Surface_mesh::null_face())
      throw Error(Error_code::other,
                  "surface mesh: CGAL refused a facet of a surface that was found manifold");
  }
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> intersecting_faces(const Surface_mesh& mesh) {
  std::vector<std::pair<Face, Face>> found;
  PMP::self_intersections(mesh, std::back_inserter(found));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(found.size());
  for (const auto& [f, g] : found) pairs.push_back(std::minmax(std::uint32_t{f}, std::uint32_t{g}));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace detail

std::vector<std::string> describe(const Surface_report& report) {
  std::vector<std::string> lines;
  const auto say = [&lines](std::size_t n, const std::string& one, const std::string& many) {
    if (n > 0) lines.push_back(n == 1 ? "1 " + one : std::to_string(n) + " " + many);
  };
  say(report.merged_points, "duplicate vertex merged", "duplicate vertices merged");
  say(report.unused_points, "unused vertex dropped", "unused vertices dropped");
  say(report.collapsed_facets, "collapsed facet dropped", "collapsed facets dropped");
  say(report.triangulated_facets, "polygon cut into triangles", "polygons cut into triangles");
  say(report.turned_facets, "facet turned to agree with its neighbours",
      "facets turned to agree with their neighbours");
  if (report.inside_out) lines.push_back("the surface was inside out: all facets turned");
  return lines;
}

namespace detail {

Traced_surface check_traced(const Surface_soup& soup, const std::string& name, Surface_report& r) {
  r = {};
  Traced_surface traced = clean(soup, name, r);
  make_oriented_manifold(traced, name, r);

  Surface_mesh mesh;
  append(mesh, traced.soup);
  auto source = mesh.add_property_map<Face, std::uint32_t>("f:source", 0).first;
  for (Face face : mesh.faces()) source[face] = traced.input_facet[face];
  for (const auto& facet : traced.soup.facets) r.triangulated_facets += facet.size() > 3;
  Source_visitor visitor;
  visitor.source = &source;
  if (!PMP::triangulate_faces(mesh, CGAL::parameters::visitor(visitor)))
    throw Error(Error_code::input, name + " has a polygon that cannot be cut into triangles: facet " +
                                       std::to_string(source[first_polygon(mesh)]) +
                                       "; triangulate it beforehand");

  const auto pairs = intersecting_faces(mesh);
  if (!pairs.empty()) {
    auto first = std::minmax(source[Face(pairs[0].first)], source[Face(pairs[0].second)]);
    throw Error(Error_code::input, name + " intersects itself: " + std::to_string(pairs.size()) +
                                       (pairs.size() == 1 ? " pair" : " pairs") + " of facets, the first " +
                                       pair_of(first.first, first.second) +
                                       "; repair it, or mesh a wrapped copy");
  }
  orient_outwards(mesh, r);
  r.volume = CGAL::to_double(PMP::volume(mesh));

  Traced_surface result;
  result.input_point = std::move(traced.input_point);
  for (auto v : mesh.vertices())
    result.soup.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  for (Face face : mesh.faces()) {
    result.soup.facets.push_back(loop_of(mesh, face));
    result.input_facet.push_back(source[face]);
  }
  return result;
}

}  // namespace detail

Surface_soup check_surface(const Surface_soup& soup, const std::string& name, Surface_report* report) {
  Surface_report own;
  return detail::check_traced(soup, name, report ? *report : own).soup;
}

}  // namespace cellwalk
