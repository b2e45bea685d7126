// SPDX-License-Identifier: LGPL-3.0-or-later
// The edges and faces of a body, from a surface, from elements, from cells or from a table.
#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/internal/io/query_file.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/records/body_soup.h>

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "element_parsers.h"
#include "format.h"
#include "io/files/text.h"
#include "parse_mesh.h"
#include "poly_mesh.h"
#include "surface_parsers.h"

namespace cellwalk::io {
namespace {

/// The content of a file before its dimension is checked.
struct Content {
  Body_parts<3> parts;
  bool has_volumes = false;  ///< then inner facets occur twice, as they should
  double radius = 0;         ///< of a vertex that is the whole body
};

void add_cells(Content& content, const Cell_soup<3>& cells) {
  content.has_volumes |= cells.cell_count() > 0;
  for (std::size_t f = 0; f < cells.facet_count(); ++f)
    content.parts.polygons.emplace_back(cells.facet(f).begin(), cells.facet(f).end());
}

Content from_surface(const std::string& name, std::string_view bytes, Surface_format format, bool planar,
                     Read_report& report) {
  Body_elements lines{planar, {}};
  Surface_soup surface = parse_polygons(name, bytes, format, report, &lines);
  return {
      {std::move(surface.points), std::move(surface.facets), std::move(lines.edges), std::move(lines.radii)}};
}

template <class Parse>
Content from_elements(const std::string& name, std::string_view bytes, Parse parse, Read_report& report) {
  Element_soup soup = parse(name, bytes, Lines::read, report);
  if (!soup.groups.empty()) report.notes.push_back(fmt::format("{} groups ignored", soup.groups.size()));
  Content content;
  add_cells(content, soup.volumes);
  content.parts.points = std::move(soup.volumes.points);
  content.parts.segments = std::move(soup.lines);
  for (auto& polygon : soup.polygons) content.parts.polygons.push_back(std::move(polygon));
  return content;
}

/// Adds the radii of a polyline: of each row that of the edge to the next one. The last row may be without,
/// and has none unless it is the only one.
void add_radii(Content& content, const Csv_table& table, std::size_t column) {
  const std::size_t rows = table.row_count();
  for (std::size_t r = 0; r < rows; ++r) {
    const bool is_last = r + 1 == rows;
    if (is_last && table.field(r, column)->empty()) return;
    const Parsed_number radius = radius_of(table, r, column);
    if (!radius) fail(table.name(), table.line(r), radius.reason);
    if (!is_last)
      content.parts.radii.push_back(radius.value);
    else if (rows == 1)
      content.radius = radius.value;
  }
}

template <int D>
Content from_table(const std::string& name, std::string_view text, Read_report& report) {
  report.format = "CSV";
  Content content;
  const Csv_table table = Csv_table::parse(name, std::string(text));
  for (const auto& row : query_rows<D, 1>(table, {""})) {
    if (!row.error.empty()) fail(name, row.line, row.error);
    Point<3> p{};
    std::copy(row.points[0].begin(), row.points[0].end(), p.begin());
    const auto i = static_cast<std::uint32_t>(content.parts.points.size());
    if (i > 0) content.parts.segments.push_back({i - 1, i});
    content.parts.points.push_back(p);
  }
  if (const auto column = table.find_column("radius")) add_radii(content, table, *column);
  return content;
}

/// Collects the results of the other mesh readers.
struct From_mesh {
  Content operator()(Surface_soup& surface) const {
    return {{std::move(surface.points), std::move(surface.facets), {}}};
  }
  Content operator()(Cell_soup<3>& cells) const {
    Content content;
    add_cells(content, cells);
    content.parts.points = std::move(cells.points);
    return content;
  }
  Content operator()(Cell_soup<2>& cells) const {
    Content content{{in_space(cells.points), {}, {}}};
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      content.parts.polygons.emplace_back();
      for (std::size_t f = cells.cell_begin[c]; f < cells.cell_begin[c + 1]; ++f)
        content.parts.polygons.back().push_back(cells.facet(f)[0]);
    }
    return content;
  }
  Content operator()(Planar_domain& domain) const {
    return {{in_space(domain.points), {}, std::move(domain.segments)}};
  }

 private:
  static std::vector<Point<3>> in_space(const std::vector<Point<2>>& points) {
    std::vector<Point<3>> result;
    result.reserve(points.size());
    for (const auto& p : points) result.push_back({p[0], p[1], 0});
    return result;
  }
};

Content from_mesh(Mesh_file file, Read_report& report) {
  report = std::move(file.report);
  return std::visit(From_mesh{}, file.mesh);
}

template <int D>
Content content_of(const std::string& name, const Recognized_file& file, Read_report& report) {
  constexpr bool planar = D == 2;
  switch (file.format) {
    case Format::off:
      return from_surface(name, file.bytes, Surface_format::off, planar, report);
    case Format::obj:
      return from_surface(name, file.bytes, Surface_format::obj, planar, report);
    case Format::stl:
      return from_surface(name, file.bytes, Surface_format::stl, planar, report);
    case Format::ply:
      return from_surface(name, file.bytes, Surface_format::ply, planar, report);
    case Format::msh:
      return from_elements(name, file.bytes, parse_msh, report);
    case Format::medit:
      return from_elements(name, file.bytes, parse_medit, report);
    case Format::unv:
      return from_elements(name, file.bytes, parse_unv, report);
    case Format::csv:
      return from_table<D>(name, file.bytes, report);
    case Format::unknown:
      fail(name, fmt::format(
                     "the format is not known, neither by its content nor by its extension; bodies are read "
                     "from .csv, {}",
                     supported_formats()));
    default:
      return from_mesh(parse_mesh(name, file.bytes, file.format), report);
  }
}

/// \param note receives that of the file's recognition
template <int D>
Content content_at(const std::filesystem::path& path, Read_report& report, std::string& note) {
  if (const auto folder = poly_mesh_folder(path)) return from_mesh(read_poly_mesh(*folder), report);
  const Recognized_file recognized = recognized_file(path, load_packed(path));
  note = recognized.note;
  return content_of<D>(path.string(), recognized, report);
}

/// The same parts in D dimensions.
/// \throw Error(input) if a point of a 2D body has z other than 0
template <int D>
Body_parts<D> in_dimension(const std::string& name, Body_parts<3> parts) {
  if constexpr (D == 3) {
    return parts;
  } else {
    struct At_point {
      const std::string& name;
      std::size_t point;
      [[noreturn]] void fail(const std::string& what) const {
        io::fail(name, fmt::format("vertex {}: {}", point, what));
      }
    };
    const Body_elements planar{true, {}};
    std::vector<Point<2>> points;
    for (const Point<3>& p : parts.points) {
      check_planar(At_point{name, points.size()}, &planar, p);
      points.push_back({p[0], p[1]});
    }
    return {std::move(points), std::move(parts.polygons), std::move(parts.segments), std::move(parts.radii)};
  }
}

template <int D>
void add_notes(const Made_body<D>& made, bool has_volumes, Read_report& report) {
  const std::array<std::pair<std::size_t, const char*>, 5> notes{
      {{made.cut_polygons, "polygons cut into triangles: the diagonals are edges"},
       {has_volumes ? 0 : made.repeated_faces, "triangles with the corners of an earlier one left out"},
       {made.degenerate_faces, "triangles in which a corner occurs twice left out"},
       {made.null_edges, "edges from a vertex to itself left out"},
       {made.unused_points, "vertices on no edge"}}};
  for (const auto& [count, what] : notes)
    if (count > 0) report.notes.push_back(fmt::format("{} {}", count, what));
}

}  // namespace

template <int D>
Body_file<D> read_body(const std::filesystem::path& path) {
  const std::string name = path.string();
  Body_file<D> file;
  std::string note;
  Content content = content_at<D>(path, file.report, note);
  if (content.parts.points.empty()) fail(name, "holds no vertices: a body needs at least one");
  Made_body<D> made = make_body<D>(in_dimension<D>(name, std::move(content.parts)));
  if (content.radius > 0) made.body.radii = {content.radius};
  file.report.points = made.body.points.size();
  file.report.cells = 0;
  file.report.facets = made.body.faces.size();
  add_notes(made, content.has_volumes, file.report);
  if (!note.empty()) file.report.notes.push_back(note);
  file.body = std::move(made.body);
  return file;
}

template Body_file<2> read_body(const std::filesystem::path&);
template Body_file<3> read_body(const std::filesystem::path&);

}  // namespace cellwalk::io
