// SPDX-License-Identifier: LGPL-3.0-or-later
// The parser of each surface format, chosen by the extension.
#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/io/mesh_file.h>

#include "io/files/text.h"
#include "surface_parsers.h"

namespace cellwalk::io {
namespace {

Surface_format format_of(const std::filesystem::path& path) {
  std::filesystem::path bare = path;
  if (lower(bare.extension().string()) == ".gz") bare = bare.stem();
  const std::string extension = lower(bare.extension().string());
  if (extension == ".off") return Surface_format::off;
  if (extension == ".obj") return Surface_format::obj;
  if (extension == ".stl") return Surface_format::stl;
  if (extension == ".ply") return Surface_format::ply;
  fail(path.string(),
       "not a surface by its extension: .off, .obj, .stl and .ply are read, also with .gz after it");
}

}  // namespace

Surface_soup parse_polygons(const std::string& name, std::string_view bytes, Surface_format format,
                            Read_report& report, Body_elements* body) {
  switch (format) {
    case Surface_format::off:
      return parse_off(name, bytes, report, body);
    case Surface_format::obj:
      return parse_obj(name, bytes, report, body);
    case Surface_format::stl:
      return parse_stl(name, bytes, report, body);
    case Surface_format::ply:
      break;
  }
  return parse_ply(name, bytes, report, body);
}

Surface_soup parse_surface(const std::string& name, std::string_view bytes, Surface_format format,
                           Read_report* report) {
  Read_report own;
  Surface_soup soup = parse_polygons(name, bytes, format, own);
  if (soup.facets.empty()) fail(name, "holds no polygons: a surface is needed");
  own.points = soup.points.size();
  own.facets = soup.facets.size();
  if (report) *report = std::move(own);
  return soup;
}

Surface_soup read_surface(const std::filesystem::path& path, Read_report* report) {
  const Surface_format format = format_of(path);
  return parse_surface(path.string(), load(path), format, report);
}

}  // namespace cellwalk::io
