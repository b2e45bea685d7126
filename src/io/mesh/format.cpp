// SPDX-License-Identifier: LGPL-3.0-or-later
// Formats recognised by their first bytes, and otherwise by the extension of the name.
#include "format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "io/files/text.h"
#include "surface_parsers.h"

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
constexpr std::array<Named, 9> openings{{{"OVM", Format::ovm},
                                         {"$", Format::msh},
                                         {"MeshVersionFormatted", Format::medit},
                                         {"FoamFile", Format::foam},
                                         {"# vtk DataFile", Format::vtk},
                                         {"<?xml", Format::vtk_xml},
                                         {"<VTKFile", Format::vtk_xml},
                                         {"POLYGON", Format::wkt},
                                         {"MULTIPOLYGON", Format::wkt}}};

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

/// The text after white space and a comment, such as files of OpenFOAM begin with.
std::string_view without_comment(std::string_view text) {
  text = without_blanks(text);
  const std::size_t end = text.starts_with("/*") ? text.find("*/") : std::string_view::npos;
  return end == std::string_view::npos ? text : without_blanks(text.substr(end + 2));
}

}  // namespace

std::size_t end_of_off_keyword(std::string_view word) {
  const std::size_t digits = word.find_last_not_of("0123456789") + 1;  // 0 if there is nothing else
  return word.substr(0, digits).ends_with(off_keyword) ? digits : 0;
}

Format format_by_content(std::string_view bytes) {
  bytes = without_comment(bytes);
  if (bytes.empty()) return Format::unknown;
  for (const auto& [opening, format] : openings)
    if (bytes.size() >= opening.size() && same_word(bytes.substr(0, opening.size()), opening)) return format;
  Line_reader in("", bytes.substr(0, 4096));
  if (!in.next_line()) return Format::unknown;
  const std::string_view word = in.word();
  if (end_of_off_keyword(word) != 0) return Format::off;
  if (word == "ply" && in.at_line_end()) return Format::ply;
  return Format::unknown;
}

Format guessed_format(std::string_view bytes) {
  if (is_binary_stl(bytes)) return Format::stl;
  Line_reader in("", bytes.substr(0, 4096));
  if (!in.next_line()) return Format::unknown;
  const std::string_view word = in.word();
  if (word == "solid") return Format::stl;
  if (word == "-1" && in.at_line_end()) return Format::unv;
  if (is_one_of(word, {"v", "vn", "vt", "f", "l", "o", "g", "s", "mtllib", "usemtl"})) return Format::obj;
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
    case Format::foam:
      return "OpenFOAM";
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

Recognized_file recognized_file(const std::filesystem::path& path, std::string bytes) {
  if (is_gzip(bytes)) bytes = unpack(path.string(), bytes);
  Recognized_file file{std::move(bytes), Format::unknown, {}};
  if (file.bytes.find_first_not_of(" \t\r\n") == std::string::npos) fail(path.string(), "is empty");
  const Format named = format_by_extension(path), found = format_by_content(file.bytes);
  file.format = found != Format::unknown   ? found
                : named != Format::unknown ? named
                                           : guessed_format(file.bytes);
  if (named != Format::unknown && named != file.format)
    file.note = fmt::format("the extension says {}, the content {}: read by its content", format_name(named),
                            format_name(file.format));
  return file;
}

}  // namespace cellwalk::io
