// SPDX-License-Identifier: LGPL-3.0-or-later
// What is looked at before a library of others reads a file: Gmsh, VTK.
#include <cellwalk/io/mesh_file.h>

#include "fuzz/targets.h"
#include "io/mesh/gmsh_input.h"
#include "io/mesh/vtk_text.h"

namespace cellwalk::fuzz {

void msh(std::string_view bytes) {
  for (const io::Format format : {io::Format::msh, io::Format::medit, io::Format::unv})
    reads([&] {
      io::Read_report report;
      const io::Gmsh_input input = io::prepare_for_gmsh("in", bytes, format, report);
      if (input.changed.empty()) return;
      const io::Gmsh_input again = io::prepare_for_gmsh("in", input.changed, format, report);
      demand(again.changed.empty(), "numbers that repeat after they were made anew");
      demand((!input.counts.nodes || input.counts.nodes == again.counts.nodes) &&
                 (!input.counts.elements || input.counts.elements == again.counts.elements),
             "numbers anew change the counts");
    });
}

void vtk(std::string_view bytes) {
  for (const io::Format format : {io::Format::vtk, io::Format::vtk_xml})
    reads([&] { io::check_vtk_counts("in", bytes, format); });
}

}  // namespace cellwalk::fuzz
