// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gmsh_input.h"

#include <fmt/format.h>

#include <utility>

#include "gmsh_nodes.h"
#include "io/files/text.h"

namespace cellwalk::io {

Gmsh_input prepare_for_gmsh(const std::string& name, std::string_view bytes, Format format,
                            Read_report& report) {
  if (format == Format::medit) {
    report.format = "MEDIT";
    return {"mesh.mesh", {}, check_medit(name, bytes)};
  }
  if (format == Format::unv) {
    report.format = "UNV";
    Line_reader in(name, bytes);
    in.need_line("'-1'");
    if (in.word() != "-1") in.fail("not a UNV file: it does not begin with '-1'");
    check_unv_nodes(name, bytes);
    return {"mesh.unv", {}, {}};
  }
  const Msh_header header = read_msh_header(name, bytes);
  report.format = fmt::format("Gmsh {}{}", header.version, header.binary ? " (binary)" : "");
  check_msh_nodes(name, bytes, header);
  Gmsh_input input{"mesh.msh", {}, announced_counts(bytes, header)};
  if (auto text = renumbered_elements(bytes, header)) {
    report.notes.push_back("numbers of elements repeat: the elements were numbered anew");
    input.changed = std::move(*text);
  }
  return input;
}

}  // namespace cellwalk::io
