// SPDX-License-Identifier: LGPL-3.0-or-later
#include "format.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

using Named = std::pair<std::string_view, Format>;

constexpr std::array<Named, 17> extensions{{{".off", Format::off},
                                            {".obj", Format::obj},
                                            {".stl", Format::stl},
                                            {".ply", Format::ply},
                                            {".ovm", Format::ovm},
                                            {".ovmb", Format::ovm},
                                            {".poly", Format::poly},
                                            {".wkt", Format::wkt},
                                            {".msh", Format::msh},
                                            {".gmsh", Format::msh},
                                            {".mesh", Format::medit},
                                            {".meshb", Format::medit},
                                            {".unv", Format::unv},
                                            {".vtk", Format::vtk},
                                            {".vtu", Format::vtk_xml},
                                            {".vtp", Format::vtk_xml},
                                            {".csv", Format::csv}}};

/// The first bytes that occur in one format only.
constexpr std::array<Named, 10> openings{{{"OVM", Format::ovm},
                                          {"$", Format::msh},
                                          {"MeshVersionFormatted", Format::medit},
                                          {"# vtk DataFile", Format::vtk},
                                          {"<?xml", Format::vtk_xml},
                                          {"<VTKFile", Format::vtk_xml},
                                          {"ply\n", Format::ply},
                                          {"ply\r\n", Format::ply},
                                          {"POLYGON", Format::wkt},
                                          {"MULTIPOLYGON", Format::wkt}}};

}  // namespace

Format format_by_content(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Format::unknown;
  bytes.remove_prefix(first);
  for (const auto& [opening, format] : openings)
    if (bytes.size() >= opening.size() && same_word(bytes.substr(0, opening.size()), opening)) return format;
  Line_reader in("", bytes.substr(0, 4096));
  if (in.next_line() && in.word().ends_with("OFF")) return Format::off;
  return Format::unknown;
}

Format format_by_extension(const std::filesystem::path& path) {
  std::filesystem::path bare = path.filename();
  if (same_word(bare.extension().string(), ".gz")) bare = bare.stem();
  const std::string extension = lower(bare.extension().string());
  for (const auto& [known, format] : extensions)
    if (extension == known) return format;
  return Format::unknown;
}

std::string_view format_name(Format format) {
  switch (format) {
    case Format::off:
      return "OFF";
    case Format::obj:
      return "OBJ";
    case Format::stl:
      return "STL";
    case Format::ply:
      return "PLY";
    case Format::ovm:
      return "OpenVolumeMesh";
    case Format::poly:
      return "Triangle .poly";
    case Format::wkt:
      return "WKT";
    case Format::msh:
      return "Gmsh";
    case Format::medit:
      return "MEDIT";
    case Format::unv:
      return "UNV";
    case Format::vtk:
      return "VTK legacy";
    case Format::vtk_xml:
      return "VTK XML";
    case Format::csv:
      return "CSV";
    case Format::unknown:
      break;
  }
  return "unknown";
}

Recognized_file load_recognized(const std::filesystem::path& path) {
  Recognized_file file{load(path), Format::unknown, {}};
  if (file.bytes.find_first_not_of(" \t\r\n") == std::string::npos) fail(path.string(), "is empty");
  const Format named = format_by_extension(path), found = format_by_content(file.bytes);
  file.format = found != Format::unknown ? found : named;
  if (named != Format::unknown && named != file.format)
    file.note = fmt::format("the extension says {}, the content {}: read by its content", format_name(named),
                            format_name(file.format));
  return file;
}

}  // namespace cellwalk::io
