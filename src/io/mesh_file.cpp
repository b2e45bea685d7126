// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/io/ovm.h>
#include <cellwalk/io/planar_file.h>
#include <cellwalk/io/surface_file.h>

#include <fmt/format.h>

#include <array>

#include "element_soup.h"
#include "format.h"
#include "optional_readers.h"
#include "text.h"

namespace cellwalk::io {
namespace {

Mesh_file surface(const std::string& name, std::string_view bytes, Surface_format format) {
  Read_report report;
  Surface_soup soup = parse_surface(name, bytes, format, &report);
  return surface_or_plane(std::move(soup), std::move(report));
}

template <class Parse>
Mesh_file domain(const std::string& name, std::string_view bytes, Parse parse) {
  Read_report report;
  Planar_domain result = parse(name, bytes, &report);
  return {std::move(result), std::move(report)};
}

Mesh_file parse(const std::string& name, const std::string& bytes, Format format) {
  switch (format) {
    case Format::off:
      return surface(name, bytes, Surface_format::off);
    case Format::obj:
      return surface(name, bytes, Surface_format::obj);
    case Format::stl:
      return surface(name, bytes, Surface_format::stl);
    case Format::ply:
      return surface(name, bytes, Surface_format::ply);
    case Format::ovm:
      return parse_ovm(name, bytes);
    case Format::poly:
      return domain(name, bytes, parse_poly);
    case Format::wkt:
      return domain(name, bytes, parse_wkt);
    case Format::msh:
    case Format::medit:
    case Format::unv:
      return parse_by_gmsh(name, bytes, format);
    case Format::vtk:
    case Format::vtk_xml:
      return parse_by_vtk(name, bytes, format);
    case Format::unknown:
      break;
  }
  fail(name, fmt::format("the format is not known, neither by its content nor by its extension; read are {}",
                         supported_formats()));
}

}  // namespace

std::string_view kind_name(const Mesh& mesh) {
  constexpr std::array<std::string_view, 4> names{"surface", "volume", "planar cells", "planar domain"};
  return names[mesh.index()];
}

Mesh_file read_mesh(const std::filesystem::path& path) {
  const std::string name = path.string(), bytes = load(path);
  if (bytes.find_first_not_of(" \t\r\n") == std::string::npos) fail(name, "is empty");
  const Format named = format_by_extension(path), found = format_by_content(bytes);
  const Format format = found != Format::unknown ? found : named;
  Mesh_file file = parse(name, bytes, format);
  if (named != Format::unknown && named != format)
    file.report.notes.push_back(fmt::format("the extension says {}, the content {}: read by its content",
                                            format_name(named), format_name(format)));
  return file;
}

std::vector<Build_feature> build_features() {
  const std::string gmsh = gmsh_version(), vtk = vtk_version();
  return {{"gmsh", !gmsh.empty(), gmsh, "reads .msh, .mesh and .unv"},
          {"vtk", !vtk.empty(), vtk, "reads .vtk, .vtu and .vtp"}};
}

std::string supported_formats() {
  std::string text = ".ovm, .off, .obj, .stl, .ply, .poly, .wkt";
  for (const Build_feature& feature : build_features())
    text += feature.present
                ? std::string(feature.name == "gmsh" ? ", .msh, .mesh, .unv" : ", .vtk, .vtu, .vtp")
                : fmt::format(" (this build lacks {}, which {})", feature.name, feature.purpose);
  return text;
}

}  // namespace cellwalk::io
