// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of .ovm: edges, faces and polyhedra in text, with properties for walls and groups.
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

/// The content of the file: rows of halfedges and halffaces, 2i in the direction of edge or face i, 2i+1
/// against it. Read here, since OpenVolumeMesh would be a further dependency for a single format.
struct Raw {
  std::vector<Point<3>> points;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::uint32_t> face_begin{0}, face_halfedges;
  std::vector<std::uint32_t> cell_begin{0}, cell_halffaces;
  std::vector<std::uint8_t> edge_impassable, face_impassable, face_solid, cell_solid;
  /// The groups of a name, as flags of all; empty where the file has none of that kind.
  struct Group {
    std::vector<std::uint8_t> edges, faces, cells;
  };
  std::map<std::string, Group> groups;
  std::optional<int> dimension;

  std::size_t face_count() const { return face_begin.size() - 1; }
  std::size_t cell_count() const { return cell_begin.size() - 1; }
  std::uint32_t tail(std::uint32_t halfedge) const { return edges[halfedge / 2][halfedge % 2]; }
  std::uint32_t head(std::uint32_t halfedge) const { return edges[halfedge / 2][1 - halfedge % 2]; }
};

/// A property of this name, and then that of a group, is the group.
constexpr std::string_view group_prefix = "group ";

class Ovm_reader {
 public:
  Ovm_reader(const std::string& name, std::string_view text) : in_(name, text) {}

  Mesh_file read() {
    header();
    section("Vertices", 3 * 2, [&](std::uint64_t) {
      Point<3> p;
      for (double& x : p) x = in_.number("a coordinate");
      raw_.points.push_back(p);
    });
    section("Edges", 2 * 2, [&](std::uint64_t) {
      const std::size_t n = raw_.points.size();
      const std::uint32_t a = in_.index("vertex", n), b = in_.index("vertex", n);
      if (a == b) in_.fail(fmt::format("an edge from vertex {} to itself", a));
      raw_.edges.push_back({a, b});
    });
    section("Faces", 4 * 2, [&](std::uint64_t) { face(); });
    section("Polyhedra", 3 * 2, [&](std::uint64_t) { cell(); });
    while (in_.next_line()) property();
    return raw_.dimension.value_or(is_flat() ? 2 : 3) == 2 ? planar() : spatial();
  }

 private:
  void header() {
    in_.need_line("'OVM ASCII'");
    const std::string_view magic = in_.word(), encoding = in_.word();
    if (magic.starts_with("OVMB") || same_word(encoding, "BINARY"))
      in_.fail(
          "only OVM ASCII is read: load the binary file with OpenVolumeMesh and write it as .ovm "
          "(OpenVolumeMesh::IO::FileManager::writeFile)");
    if (!same_word(magic, "OVM")) in_.fail("not an OpenVolumeMesh file: it does not begin with 'OVM ASCII'");
    // Files written by OpenVolumeMesh omit the encoding.
    if (!encoding.empty() && !same_word(encoding, "ASCII"))
      in_.fail(fmt::format("'{}' is no encoding of OpenVolumeMesh: only OVM ASCII is read", shown(encoding)));
  }

  template <class Row>
  void section(std::string_view title, std::size_t least_bytes, Row row) {
    in_.need_line(fmt::format("the section '{}'", title));
    const std::string_view found = in_.word();
    if (!same_word(found, title))
      in_.fail(fmt::format("'{}' where the section '{}' should begin", shown(found), title));
    if (in_.at_line_end()) in_.need_line(fmt::format("the number of {}", lower(title)));
    const std::uint64_t count = in_.count(fmt::format("the number of {}", lower(title)));
    in_.expect_line_end("the number");
    reserve(title, in_.plausible(count, least_bytes));
    for (std::uint64_t i = 0; i < count; ++i) {
      in_.need_line(fmt::format("row {} of {} of the section '{}'", i + 1, count, title));
      row(i);
      in_.expect_line_end(fmt::format("a row of the section '{}'", title));
    }
  }

  void reserve(std::string_view title, std::size_t count) {
    if (title == "Vertices") raw_.points.reserve(count);
    if (title == "Edges") raw_.edges.reserve(count);
    if (title == "Faces") raw_.face_begin.reserve(count + 1), raw_.face_halfedges.reserve(3 * count);
    if (title == "Polyhedra") raw_.cell_begin.reserve(count + 1), raw_.cell_halffaces.reserve(4 * count);
  }

  void face() {
    const std::uint64_t n = in_.count("the number of halfedges");
    if (n < 3) in_.fail(fmt::format("a face of {} halfedges: at least 3 are needed", n));
    const std::size_t first = raw_.face_halfedges.size();
    for (std::uint64_t i = 0; i < n; ++i)
      raw_.face_halfedges.push_back(in_.index("halfedge", 2 * raw_.edges.size()));
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t h = raw_.face_halfedges[first + i], next = raw_.face_halfedges[first + (i + 1) % n];
      if (raw_.head(h) != raw_.tail(next))
        in_.fail(fmt::format("the halfedges form no loop: {} ends at vertex {}, {} starts at vertex {}", h,
                             raw_.head(h), next, raw_.tail(next)));
    }
    raw_.face_begin.push_back(size32(raw_.face_halfedges));
  }

  void cell() {
    const std::uint64_t n = in_.count("the number of halffaces");
    if (n < 4) in_.fail(fmt::format("a polyhedron of {} halffaces: at least 4 are needed", n));
    for (std::uint64_t i = 0; i < n; ++i)
      raw_.cell_halffaces.push_back(in_.index("halfface", 2 * raw_.face_count()));
    raw_.cell_begin.push_back(size32(raw_.cell_halffaces));
  }

  std::uint32_t size32(const std::vector<std::uint32_t>& v) {
    if (v.size() > std::numeric_limits<std::uint32_t>::max())
      in_.fail("the mesh is too large for 32-bit indices");
    return static_cast<std::uint32_t>(v.size());
  }

  static bool is_property(std::string_view word) {
    for (const char* title : {"VProp", "EProp", "HEProp", "FProp", "HFProp", "CProp", "MProp"})
      if (same_word(word, title)) return true;
    return false;
  }

  void property() {
    const std::string entity(in_.word()), type(in_.word());
    if (!is_property(entity))
      in_.fail(fmt::format("'{}' where a property or the end of the file should be", shown(entity)));
    std::string_view name = in_.rest();
    const std::size_t open = name.find('"'), close = name.rfind('"');
    if (open == std::string_view::npos || open == close) in_.fail("a property without a name in quotes");
    name = name.substr(open + 1, close - open - 1);
    if (same_word(type, "bool") && name == "impassable") {
      if (same_word(entity, "EProp")) return flags(raw_.edge_impassable, raw_.edges.size());
      if (same_word(entity, "FProp")) return flags(raw_.face_impassable, raw_.face_count());
    }
    if (same_word(type, "bool") && name == "solid") {
      if (same_word(entity, "FProp")) return flags(raw_.face_solid, raw_.face_count());
      if (same_word(entity, "CProp")) return flags(raw_.cell_solid, raw_.cell_count());
    }
    if (same_word(entity, "MProp") && same_word(type, "int") && name == "dimension") return dimension();
    if (name == "group" || name.starts_with(group_prefix)) return group(entity, type, name);
    if (name == "impassable" || name == "solid")
      in_.fail(fmt::format(
          "'{} {} \"{}\"' has a meaning only as 'FProp bool' (walls), 'CProp bool' (solid cells); in 2D "
          "'EProp bool' and 'FProp bool': rename or change it",
          shown(entity), shown(type), shown(name)));
    report_.notes.push_back(fmt::format("property {} \"{}\" ignored", shown(entity), shown(name)));
    // Values of unknown types cannot be parsed: skip to the next line that opens a property.
    while (in_.next_line())
      if (is_property(in_.word())) return in_.unread();
  }

  void group(const std::string& entity, const std::string& type, std::string_view property) {
    const std::string name(property.substr(std::min(property.size(), group_prefix.size())));
    if (name.empty()) in_.fail("a group without a name: write \"group NAME\"");
    if (same_word(type, "bool")) {
      if (same_word(entity, "EProp")) return flags(raw_.groups[name].edges, raw_.edges.size());
      if (same_word(entity, "FProp")) return flags(raw_.groups[name].faces, raw_.face_count());
      if (same_word(entity, "CProp")) return flags(raw_.groups[name].cells, raw_.cell_count());
    }
    in_.fail(fmt::format(
        "'{} {} \"{}\"': a group is 'FProp bool' (facets) or 'CProp bool' (cells), in 2D 'EProp bool' and "
        "'FProp bool': rename or change it",
        shown(entity), shown(type), shown(property)));
  }

  void flags(std::vector<std::uint8_t>& values, std::size_t count) {
    if (!values.empty()) in_.fail("this property occurs twice");
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (in_.at_line_end() || i == 0)
        in_.need_line(fmt::format("value {} of {} of the property", i + 1, count));
      values.push_back(static_cast<std::uint8_t>(in_.index("a value of 0 or 1:", 2)));
    }
    in_.expect_line_end("the last value of the property");
  }

  void dimension() {
    in_.need_line("the dimension");
    const std::uint64_t d = in_.count("the dimension");
    if (d != 2 && d != 3) in_.fail(fmt::format("dimension {}: only 2 and 3 are known", d));
    raw_.dimension = static_cast<int>(d);
  }

  bool is_flat() const {
    if (raw_.cell_count() > 0 || raw_.points.empty()) return false;
    for (const Point<3>& p : raw_.points)
      if (p[2] != 0) return false;
    return true;
  }

  static bool flag(const std::vector<std::uint8_t>& values, std::size_t i) {
    return !values.empty() && values[i];
  }

  /// Refuses a face of more than two cells. It would be copied for each of them, so a short file could demand
  /// any amount of memory.
  void check_sides() const {
    std::uint64_t corners = 0;
    for (const std::uint32_t halfface : raw_.cell_halffaces)
      corners += raw_.face_begin[halfface / 2 + 1] - raw_.face_begin[halfface / 2];
    if (corners > 2 * std::uint64_t{raw_.face_halfedges.size()})
      fail(in_.file(), "has cells that name more halffaces than there are: some belong to several cells");
  }

  Mesh_file spatial() {
    if (raw_.cell_count() == 0)
      fail(in_.file(), "holds no polyhedra, and is no 2D environment (z is not zero throughout)");
    check_sides();
    if (!raw_.edge_impassable.empty() || !raw_.face_solid.empty())
      report_.notes.push_back("'EProp impassable' and 'FProp solid' have no meaning in 3D: ignored");
    Cell_soup<3> soup;
    soup.points = std::move(raw_.points);
    std::vector<std::uint32_t> loop;
    for (std::size_t c = 0; c < raw_.cell_count(); ++c) {
      for (std::uint32_t i = raw_.cell_begin[c]; i < raw_.cell_begin[c + 1]; ++i) {
        const std::uint32_t face = raw_.cell_halffaces[i] / 2;
        loop.clear();
        for (std::uint32_t j = raw_.face_begin[face]; j < raw_.face_begin[face + 1]; ++j)
          loop.push_back(raw_.tail(raw_.face_halfedges[j]));
        if (raw_.cell_halffaces[i] % 2) std::reverse(loop.begin(), loop.end());
        if (soup.vertices.size() + loop.size() > std::numeric_limits<std::uint32_t>::max())
          fail(in_.file(), "the mesh is too large for 32-bit indices");
        soup.add_facet(loop, flag(raw_.face_impassable, face));
      }
      soup.end_cell(flag(raw_.cell_solid, c));
    }
    std::vector<std::uint32_t> face_of(raw_.cell_halffaces.size());
    for (std::size_t i = 0; i < face_of.size(); ++i) face_of[i] = raw_.cell_halffaces[i] / 2;
    for (const auto& [name, group] : raw_.groups) {
      if (!group.edges.empty())
        report_.notes.push_back(
            fmt::format("group \"{}\" of edges has no meaning in 3D: ignored", shown(name)));
      if (!group.faces.empty() || !group.cells.empty()) add_group(name, group.faces, face_of, group.cells);
    }
    return finish(std::move(soup));
  }

  /// \param facet_of the facet of the file of which each half-facet of the soup is a side
  void add_group(const std::string& name, const std::vector<std::uint8_t>& facets,
                 const std::vector<std::uint32_t>& facet_of, const std::vector<std::uint8_t>& cells) {
    Soup_group& group = groups_[name];
    std::vector<std::uint8_t> unused = facets;
    for (std::uint32_t f = 0; f < facet_of.size(); ++f)
      if (flag(facets, facet_of[f])) {
        group.facets.push_back(f);
        unused[facet_of[f]] = 0;
      }
    for (std::uint32_t c = 0; c < cells.size(); ++c)
      if (cells[c]) group.cells.push_back(c);
    if (const auto count = std::count(unused.begin(), unused.end(), 1))
      report_.notes.push_back(
          fmt::format("group \"{}\": {} of its facets belong to no cell: left out", shown(name), count));
  }

  Mesh_file planar() {
    if (!is_flat())
      fail(in_.file(),
           "is said to be of dimension 2, yet has polyhedra or z that are not zero: correct either");
    Cell_soup<2> soup;
    soup.points.reserve(raw_.points.size());
    for (const Point<3>& p : raw_.points) soup.points.push_back({p[0], p[1]});
    for (std::size_t f = 0; f < raw_.face_count(); ++f) {
      for (std::uint32_t j = raw_.face_begin[f]; j < raw_.face_begin[f + 1]; ++j) {
        const std::uint32_t h = raw_.face_halfedges[j];
        soup.add_facet({raw_.tail(h), raw_.head(h)}, flag(raw_.edge_impassable, h / 2));
      }
      soup.end_cell(flag(raw_.face_solid, f));
    }
    std::vector<std::uint32_t> edge_of(raw_.face_halfedges.size());
    for (std::size_t i = 0; i < edge_of.size(); ++i) edge_of[i] = raw_.face_halfedges[i] / 2;
    for (const auto& [name, group] : raw_.groups)
      if (!group.edges.empty() || !group.faces.empty()) add_group(name, group.edges, edge_of, group.faces);
    return finish(std::move(soup));
  }

  template <int D>
  Mesh_file finish(Cell_soup<D> soup) {
    report_.format = "OpenVolumeMesh ASCII";
    report_.points = soup.points.size();
    report_.cells = soup.cell_count();
    report_.facets = soup.facet_count();
    return {std::move(soup), std::move(report_), std::move(groups_)};
  }

  Line_reader in_;
  Raw raw_;
  Read_report report_;
  Soup_groups groups_;
};

}  // namespace

Mesh_file parse_ovm(const std::string& name, std::string_view text) { return Ovm_reader(name, text).read(); }

Mesh_file read_ovm(const std::filesystem::path& path) { return parse_ovm(path.string(), load(path)); }

}  // namespace cellwalk::io
