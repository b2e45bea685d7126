// SPDX-License-Identifier: LGPL-3.0-or-later
// Readers of meshes. What they accept must keep what its record promises, since all that follows relies on
// it.
#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/internal/io/planar_file.h>
#include <cellwalk/io/mesh_file.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "fuzz/targets.h"
#include "io/mesh/poly_mesh.h"
#include "io/mesh/surface_parsers.h"

namespace cellwalk::fuzz {
namespace {

template <class Points>
void demand_finite(const Points& points) {
  for (const auto& p : points) demand(is_finite(p), "a coordinate is not finite");
}

template <class Indices>
void demand_below(const Indices& indices, std::size_t count) {
  for (const std::uint32_t i : indices) demand(i < count, "an index is out of range");
}

template <int D>
void demand_well_formed(const Cell_soup<D>& soup) {
  demand_finite(soup.points);
  demand_below(soup.vertices, soup.points.size());
  demand(soup.impassable.size() == soup.facet_count() && soup.solid.size() == soup.cell_count() &&
             soup.cell_begin.front() == 0 && soup.cell_begin.back() == soup.facet_count() &&
             soup.facet_begin.front() == 0 && soup.facet_begin.back() == soup.vertices.size(),
         "a soup's arrays do not fit each other");
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    demand(soup.facet_begin[f] + (D == 2 ? 2 : 3) <= soup.facet_begin[f + 1], "a facet of too few corners");
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    demand(soup.cell_begin[c] + D < soup.cell_begin[c + 1], "a cell of too few facets");
}

void demand_well_formed(const Surface_soup& soup) {
  demand_finite(soup.points);
  for (const auto& loop : soup.facets) {
    demand(loop.size() >= 3, "a facet of too few corners");
    demand_below(loop, soup.points.size());
  }
}

void demand_well_formed(const Planar_domain& domain) {
  demand_finite(domain.points);
  demand_finite(domain.holes);
  demand(!domain.segments.empty(), "a domain without segments");
  for (const auto& segment : domain.segments) {
    demand_below(segment, domain.points.size());
    demand(segment[0] != segment[1], "a segment from a point to itself");
  }
}

/// As a surface, and as bodies of space and of the plane.
void surface(std::string_view bytes, io::Surface_format format) {
  reads([&] { demand_well_formed(io::parse_surface("in", bytes, format)); });
  for (const bool planar : {false, true})
    reads([&] {
      io::Read_report report;
      io::Body_elements body{planar, {}};
      const Surface_soup soup = io::parse_polygons("in", bytes, format, report, &body);
      demand_well_formed(soup);
      for (const auto& edge : body.edges) demand_below(edge, soup.points.size());
      demand(body.radii.empty() || body.radii.size() == body.edges.size(), "edges with and without a radius");
      for (const double r : body.radii) demand(r >= 0 && std::isfinite(r), "a radius that is none");
      for (const auto& p : soup.points) demand(!planar || p[2] == 0, "a body of the plane that leaves it");
    });
}

}  // namespace

void ovm(std::string_view bytes) {
  reads([&] {
    const io::Mesh_file file = io::parse_ovm("in", bytes);
    std::visit([](const auto& mesh) { demand_well_formed(mesh); }, file.mesh);
    demand(file.mesh.index() == 1 || file.mesh.index() == 2, "OVM that is neither a volume nor planar cells");
  });
}

void off(std::string_view bytes) { surface(bytes, io::Surface_format::off); }
void obj(std::string_view bytes) { surface(bytes, io::Surface_format::obj); }
void stl(std::string_view bytes) { surface(bytes, io::Surface_format::stl); }
void ply(std::string_view bytes) { surface(bytes, io::Surface_format::ply); }

void poly(std::string_view bytes) {
  // There is no file beside this one that could hold the points.
  reads([&] { demand_well_formed(io::parse_poly("no folder/in.poly", bytes)); });
}

void wkt(std::string_view bytes) {
  reads([&] { demand_well_formed(io::parse_wkt("in", bytes)); });
}

void foam(std::string_view bytes) {
  constexpr std::string_view between = "\n%%%%\n";
  const auto next = [&](const char* name) {
    const std::size_t end = std::min(bytes.find(between), bytes.size());
    io::Named_bytes file{name, std::string(bytes.substr(0, end))};
    bytes.remove_prefix(std::min(end + between.size(), bytes.size()));
    return file;
  };
  io::Poly_mesh_files files{
      next("points"), next("faces"), next("owner"), next("neighbour"), next("boundary"), {}, {}};
  if (!bytes.empty()) files.face_zones = next("faceZones");
  if (!bytes.empty()) files.cell_zones = next("cellZones");
  reads([&] {
    const io::Mesh_file file = io::parse_poly_mesh(files);
    const auto& soup = std::get<Cell_soup<3>>(file.mesh);
    demand_well_formed(soup);
    for (const auto& [name, group] : file.groups) {
      demand(!name.empty() && name.find('"') == name.npos, "a name that no group has");
      demand_below(group.facets, soup.facet_count());
      demand_below(group.cells, soup.cell_count());
    }
  });
}

}  // namespace cellwalk::fuzz
