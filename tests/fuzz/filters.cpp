// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of elements, and what is looked at before VTK reads a file.
#include <cellwalk/io/mesh_file.h>

#include <string>

#include "fuzz/targets.h"
#include "io/mesh/element_parsers.h"
#include "io/mesh/vtk_lists.h"
#include "io/mesh/vtk_text.h"

namespace cellwalk::fuzz {

void msh(std::string_view bytes) {
  for (const auto parse : {io::parse_msh, io::parse_medit, io::parse_unv})
    for (const io::Lines lines : {io::Lines::left_out, io::Lines::read})
      reads([&] {
        io::Read_report report;
        const io::Element_soup soup = parse("in", bytes, lines, report);
        const auto demand_known = [&](std::uint32_t v) {
          demand(v < soup.volumes.points.size(), "an element that names a point that is not there");
        };
        for (const std::uint32_t v : soup.volumes.vertices) demand_known(v);
        for (const auto& polygon : soup.polygons)
          for (const std::uint32_t v : polygon) demand_known(v);
        for (const auto& line : soup.lines)
          for (const std::uint32_t v : line) demand_known(v);
        io::volumes_or_polygons("in", soup, report);
      });
}

void vtk(std::string_view bytes) {
  reads([&] { io::check_vtk_counts("in", bytes); });
  std::string legacy(bytes);
  io::hide_broken_lists(legacy);
  demand(!io::hide_broken_lists(legacy), "a broken list that is not hidden");
}

}  // namespace cellwalk::fuzz
