// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice between volume cells, planar cells and a surface.
#include "element_soup.h"

#include <fmt/format.h>

#include <algorithm>

#include "element_groups.h"
#include "io/files/text.h"

namespace cellwalk::io {

bool is_flat(const std::vector<Point<3>>& points) {
  return !points.empty() &&
         std::all_of(points.begin(), points.end(), [](const Point<3>& p) { return p[2] == 0; });
}

Mesh_file surface_or_plane(Surface_soup surface, Read_report report) {
  report.points = surface.points.size();
  report.facets = surface.facets.size();
  if (!is_flat(surface.points)) return {std::move(surface), std::move(report)};
  Cell_soup<2> cells;
  for (const Point<3>& p : surface.points) cells.points.push_back({p[0], p[1]});
  for (const auto& polygon : surface.facets) add_polygon(cells, polygon);
  report.cells = cells.cell_count();
  report.facets = cells.facet_count();
  report.notes.push_back("every z is zero: the polygons are 2D cells");
  return {std::move(cells), std::move(report)};
}

Mesh_file volumes_or_polygons(const std::string& name, Element_soup elements, Read_report report) {
  if (elements.volumes.cell_count() == 0) {
    if (elements.polygons.empty()) fail(name, "holds neither volume cells nor polygons");
    Mesh_file file = surface_or_plane({std::move(elements.volumes.points), std::move(elements.polygons)},
                                      std::move(report));
    if (const auto* cells = std::get_if<Cell_soup<2>>(&file.mesh))
      file.groups = groups_of_cells(*cells, elements, file.report);
    else if (!elements.groups.empty())
      file.report.notes.push_back(
          fmt::format("{} groups ignored: a surface is meshed anew", elements.groups.size()));
    return file;
  }
  Mesh_file file{Mesh{}, std::move(report), {}};
  file.groups = groups_of_cells(elements.volumes, elements, file.report);
  std::vector<std::uint32_t> in_groups;
  for (const auto& [group, members] : elements.groups)
    in_groups.insert(in_groups.end(), members.polygons.begin(), members.polygons.end());
  std::sort(in_groups.begin(), in_groups.end());
  const auto grouped = std::unique(in_groups.begin(), in_groups.end()) - in_groups.begin();
  if (const std::size_t others = elements.polygons.size() - static_cast<std::size_t>(grouped); others > 0)
    file.report.notes.push_back(fmt::format("{} polygons beside the volume cells ignored", others));
  file.report.points = elements.volumes.points.size();
  file.report.cells = elements.volumes.cell_count();
  file.report.facets = elements.volumes.facet_count();
  file.mesh = std::move(elements.volumes);
  return file;
}

}  // namespace cellwalk::io
