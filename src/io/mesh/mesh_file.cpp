// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of each format, chosen by the content of the file.
#include <cellwalk/internal/io/build_features.h>
#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/internal/io/planar_file.h>
#include <cellwalk/io/mesh_file.h>

#include <fmt/format.h>

#include <array>
#include <utility>

#include "element_parsers.h"
#include "format.h"
#include "io/files/text.h"
#include "optional_readers.h"
#include "parse_mesh.h"
#include "poly_mesh.h"

namespace cellwalk::io {
namespace {

constexpr const char* vtk_purpose = "reads .vtk, .vtu and .vtp";

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

template <class Parse>
Mesh_file elements(const std::string& name, std::string_view bytes, Parse parse) {
  Read_report report;
  Element_soup soup = parse(name, bytes, Lines::left_out, report);
  return volumes_or_polygons(name, std::move(soup), std::move(report));
}

}  // namespace

Mesh_file parse_mesh(const std::string& name, const std::string& bytes, Format format) {
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
      return elements(name, bytes, parse_msh);
    case Format::medit:
      return elements(name, bytes, parse_medit);
    case Format::unv:
      return elements(name, bytes, parse_unv);
    case Format::foam:
      fail(name, "is one file of OpenFOAM: give the folder polyMesh of a mesh, with all its files");
    case Format::vtk:
    case Format::vtk_xml:
      return parse_by_vtk(name, bytes, format);
    case Format::csv:
    case Format::unknown:
      break;
  }
  fail(name, fmt::format("the format is not known, neither by its content nor by its extension; read are {}",
                         supported_formats()));
}

std::string_view kind_name(const Mesh& mesh) {
  constexpr std::array<std::string_view, 4> names{"surface", "volume", "planar cells", "planar domain"};
  return names[mesh.index()];
}

Mesh_file read_mesh(const std::filesystem::path& path) {
  if (const auto folder = poly_mesh_folder(path)) return read_poly_mesh(*folder);
  return read_mesh(path, load_packed(path));
}

Mesh_file read_mesh(const std::filesystem::path& path, std::string bytes) {
  const Recognized_file recognized = recognized_file(path, std::move(bytes));
  Mesh_file file = parse_mesh(path.string(), recognized.bytes, recognized.format);
  if (!recognized.note.empty()) file.report.notes.push_back(recognized.note);
  return file;
}

std::vector<Build_feature> build_features() {
  const Reader_module* const vtk = has_vtk() ? vtk_module().module : nullptr;
  return {{"vtk", vtk != nullptr, vtk ? vtk->library : "", vtk_purpose}};
}

std::string supported_formats() {
  std::string text = ".ovm, .off, .obj, .stl, .ply, .poly, .wkt, .msh, .mesh, .unv, polyMesh (OpenFOAM)";
  const auto add = [&text](bool is_in, const char* formats, const char* library, const char* purpose) {
    text += is_in ? formats : fmt::format(" (this build lacks {}, which {})", library, purpose);
  };
  add(has_vtk(), ", .vtk, .vtu, .vtp", "vtk", vtk_purpose);
  return text;
}

}  // namespace cellwalk::io
