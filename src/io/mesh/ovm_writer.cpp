// SPDX-License-Identifier: LGPL-3.0-or-later
// The writer of .ovm: numbers of edges and faces, and properties of walls, solid cells and groups.
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/ovm_writer.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <iterator>
#include <limits>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Edges of all loops, each once, numbered by first occurrence; the halfedge of every corner of every loop.
struct Edges {
  std::vector<std::array<std::uint32_t, 2>> ends;
  std::vector<std::uint32_t> halfedge;  ///< of the corner at which it starts
};

/// The corner after `i` in the loop [begin, end).
std::uint32_t next_corner(std::uint32_t i, std::uint32_t begin, std::uint32_t end) {
  return i + 1 < end ? i + 1 : begin;
}

/// \pre loops as compressed rows of vertices
Edges number_edges(const std::vector<std::uint32_t>& loop_begin, const std::vector<std::uint32_t>& vertices) {
  struct Corner {
    std::uint64_t key;
    std::uint32_t index;
    bool operator<(const Corner& o) const { return key != o.key ? key < o.key : index < o.index; }
  };
  std::vector<Corner> corners;
  corners.reserve(vertices.size());
  std::vector<std::uint8_t> backward(vertices.size());
  for (std::size_t f = 0; f + 1 < loop_begin.size(); ++f)
    for (std::uint32_t i = loop_begin[f]; i < loop_begin[f + 1]; ++i) {
      const std::uint64_t a = vertices[i], b = vertices[next_corner(i, loop_begin[f], loop_begin[f + 1])];
      backward[i] = a > b;
      corners.push_back({std::min(a, b) << 32 | std::max(a, b), i});
    }
  std::sort(corners.begin(), corners.end());
  std::vector<std::uint32_t> first(vertices.size());  // the first corner on the same edge
  for (std::size_t i = 0; i < corners.size(); ++i)
    first[corners[i].index] =
        i > 0 && corners[i].key == corners[i - 1].key ? first[corners[i - 1].index] : corners[i].index;
  Edges edges;
  edges.halfedge.resize(vertices.size());
  for (std::size_t f = 0; f + 1 < loop_begin.size(); ++f)
    for (std::uint32_t i = loop_begin[f]; i < loop_begin[f + 1]; ++i) {
      if (first[i] == i) {
        edges.halfedge[i] = static_cast<std::uint32_t>(2 * edges.ends.size());
        edges.ends.push_back({vertices[i], vertices[next_corner(i, loop_begin[f], loop_begin[f + 1])]});
      } else {
        edges.halfedge[i] =
            edges.halfedge[first[i]] ^ static_cast<std::uint32_t>(backward[i] != backward[first[i]]);
      }
    }
  return edges;
}

/// The pairs of half-facets that are the two sides of one face, the second with its loop in opposite order.
class Faces {
 public:
  explicit Faces(const Cell_soup<3>& soup) : soup_(soup), halfface_(soup.facet_count(), none) {
    const auto n = static_cast<std::uint32_t>(soup.facet_count());
    std::vector<Corner> corners;
    corners.reserve(n);
    for (std::uint32_t f = 0; f < n; ++f) corners.push_back(lowest_corner(f));
    std::sort(corners.begin(), corners.end());
    std::vector<std::uint32_t> partner(n, none);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t f = corners[i].facet;
      for (std::uint32_t j = i + 1; partner[f] == none && j < n && corners[j].key == corners[i].key; ++j) {
        const std::uint32_t g = corners[j].facet;
        if (partner[g] != none || !are_opposite(f, g)) continue;
        partner[f] = g;
        partner[g] = f;
      }
    }
    for (std::uint32_t f = 0; f < n; ++f) {
      if (halfface_[f] != none) continue;
      halfface_[f] = static_cast<std::uint32_t>(2 * first_.size());
      if (partner[f] != none) halfface_[partner[f]] = halfface_[f] + 1;
      first_.push_back(f);
      impassable_.push_back(soup.impassable[f] || (partner[f] != none && soup.impassable[partner[f]]));
    }
  }

  const std::vector<std::uint32_t>& halfface() const { return halfface_; }  ///< of each half-facet
  const std::vector<std::uint32_t>& first() const { return first_; }  ///< of each face, its first half-facet
  const std::vector<std::uint8_t>& impassable() const { return impassable_; }

 private:
  /// The lowest vertex of a loop and its two neighbours, the lower one first: equal on both sides of a face,
  /// and hardly ever equal otherwise.
  struct Corner {
    std::array<std::uint32_t, 3> key;
    std::uint32_t facet;
    auto operator<=>(const Corner&) const = default;
  };

  Corner lowest_corner(std::uint32_t f) const {
    const auto loop = soup_.facet(f);
    const std::size_t n = loop.size();
    const auto i = static_cast<std::size_t>(std::min_element(loop.begin(), loop.end()) - loop.begin());
    const std::uint32_t a = loop[(i + 1) % n], b = loop[(i + n - 1) % n];
    return {{loop[i], std::min(a, b), std::max(a, b)}, f};
  }

  bool are_opposite(std::uint32_t f, std::uint32_t g) const {
    const auto a = soup_.facet(f), b = soup_.facet(g);
    if (a.size() != b.size()) return false;
    const auto start = std::find(b.begin(), b.end(), a[0]);
    if (start == b.end()) return false;
    std::size_t j = static_cast<std::size_t>(start - b.begin());
    for (std::uint32_t v : a) {
      if (b[j] != v) return false;
      j = j > 0 ? j - 1 : b.size() - 1;
    }
    return true;
  }

  const Cell_soup<3>& soup_;
  std::vector<std::uint32_t> halfface_, first_;
  std::vector<std::uint8_t> impassable_;
};

class Writer {
 public:
  explicit Writer(Atomic_file& file) : file_(file) {}

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    line_.clear();
    fmt::format_to(std::back_inserter(line_), format, std::forward<Arguments>(arguments)...);
    line_.push_back('\n');
    file_.write({line_.data(), line_.size()});
  }

  template <class Range>
  void row(const Range& values) {
    line("{} {}", values.size(), fmt::join(values, " "));
  }

  void edges(const Edges& edges) {
    line("Edges\n{}", edges.ends.size());
    for (const auto& [a, b] : edges.ends) line("{} {}", a, b);
  }

  /// Writes a flag of each entity; omitted if all are zero.
  void property(std::string_view entity, std::string_view name, const std::vector<std::uint8_t>& values) {
    if (std::find(values.begin(), values.end(), 1) != values.end()) whole_property(entity, name, values);
  }

  void whole_property(std::string_view entity, std::string_view name,
                      const std::vector<std::uint8_t>& values) {
    line("{} bool \"{}\"", entity, name);
    for (std::uint8_t v : values) line("{}", v ? 1 : 0);
  }

  void dimension(int d) { line("MProp int \"dimension\"\n{}", d); }

 private:
  Atomic_file& file_;
  fmt::memory_buffer line_;
};

template <int D>
void check(const Cell_soup<D>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      if (soup.facet(f).size() < static_cast<std::size_t>(D))
        throw Error(Error_code::input,
                    fmt::format("cell {}: a facet of {} vertices", c, soup.facet(f).size()));
      for (std::size_t i = 0; i < soup.facet(f).size(); ++i) {
        const std::uint32_t v = soup.facet(f)[i];
        if (v >= soup.points.size())
          throw Error(Error_code::input, fmt::format("cell {}: vertex {} does not exist", c, v));
        if (v == soup.facet(f)[(i + 1) % soup.facet(f).size()])
          throw Error(Error_code::input, fmt::format("cell {}: a facet has vertex {} twice in a row", c, v));
      }
    }
  // The numbers of halfedges and halffaces have one bit more.
  if (soup.vertices.size() >= none / 2)
    throw Error(Error_code::input, "the mesh is too large for 32-bit indices");
}

template <int D>
void check(const Cell_soup<D>& soup, const std::string& name, const Soup_group& group) {
  const auto refuse = [&](const std::string& why) {
    throw Error(Error_code::input, fmt::format("group \"{}\" {}", shown(name), why));
  };
  if (name.empty() ||
      std::ranges::any_of(name, [](char c) { return c == '"' || static_cast<unsigned char>(c) < ' '; }))
    refuse("needs a name without quotes and control characters");
  for (const std::uint32_t facet : group.facets)
    if (facet >= soup.facet_count()) refuse(fmt::format("has facet {} of {}", facet, soup.facet_count()));
  for (const std::uint32_t cell : group.cells)
    if (cell >= soup.cell_count()) refuse(fmt::format("has cell {} of {}", cell, soup.cell_count()));
}

/// Writes the groups; one without facets has its cells, even if there are none.
/// \param side of each facet: twice the number of the entity that it is written as, or one more
void write_groups(Writer& out, const Soup_groups& groups, std::string_view facets, std::string_view cells,
                  const std::vector<std::uint32_t>& side, std::size_t facet_count, std::size_t cell_count) {
  for (const auto& [name, group] : groups) {
    const std::string title = "group " + name;
    std::vector<std::uint8_t> of_facets(facet_count), of_cells(cell_count);
    for (const std::uint32_t f : group.facets) of_facets[side[f] / 2] = 1;
    for (const std::uint32_t c : group.cells) of_cells[c] = 1;
    if (!group.facets.empty()) out.whole_property(facets, title, of_facets);
    if (!group.cells.empty() || group.facets.empty()) out.whole_property(cells, title, of_cells);
  }
}

void write_cells(Writer& out, const Cell_soup<3>& soup, const Soup_groups& groups) {
  const Faces faces(soup);
  std::vector<std::uint32_t> begin{0}, vertices;
  for (std::uint32_t f : faces.first()) {
    vertices.insert(vertices.end(), soup.facet(f).begin(), soup.facet(f).end());
    begin.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
  const Edges edges = number_edges(begin, vertices);
  out.edges(edges);
  out.line("Faces\n{}", faces.first().size());
  for (std::size_t f = 0; f < faces.first().size(); ++f)
    out.row(std::span(edges.halfedge).subspan(begin[f], begin[f + 1] - begin[f]));
  out.line("Polyhedra\n{}", soup.cell_count());
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    out.row(
        std::span(faces.halfface()).subspan(soup.cell_begin[c], soup.cell_begin[c + 1] - soup.cell_begin[c]));
  out.property("FProp", "impassable", faces.impassable());
  out.property("CProp", "solid", soup.solid);
  write_groups(out, groups, "FProp", "CProp", faces.halfface(), faces.first().size(), soup.cell_count());
}

void write_cells(Writer& out, const Cell_soup<2>& soup, const Soup_groups& groups) {
  // The facets of a cell are its edges in order, so that their first vertices are its loop.
  std::vector<std::uint32_t> vertices;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) vertices.push_back(soup.facet(f)[0]);
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      if (soup.facet(f)[1] != vertices[next_corner(f, soup.cell_begin[c], soup.cell_begin[c + 1])])
        throw Error(Error_code::input, fmt::format("cell {}: its edges are not in order round it", c));
  const Edges edges = number_edges(soup.cell_begin, vertices);
  std::vector<std::uint8_t> impassable(edges.ends.size());
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    impassable[edges.halfedge[f] / 2] |= soup.impassable[f];
  out.edges(edges);
  out.line("Faces\n{}", soup.cell_count());
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    out.row(
        std::span(edges.halfedge).subspan(soup.cell_begin[c], soup.cell_begin[c + 1] - soup.cell_begin[c]));
  out.line("Polyhedra\n0");
  out.property("EProp", "impassable", impassable);
  out.property("FProp", "solid", soup.solid);
  write_groups(out, groups, "EProp", "FProp", edges.halfedge, edges.ends.size(), soup.cell_count());
}

}  // namespace

template <int D>
void write_ovm(Atomic_file& file, const Cell_soup<D>& soup, const Soup_groups& groups) {
  check(soup);
  for (const auto& [name, group] : groups) check(soup, name, group);
  Writer out(file);
  out.line("OVM ASCII\nVertices\n{}", soup.points.size());
  for (const Point<D>& p : soup.points) {
    if constexpr (D == 3)
      out.line("{} {} {}", p[0], p[1], p[2]);
    else
      out.line("{} {} 0", p[0], p[1]);
  }
  write_cells(out, soup, groups);
  out.dimension(D);
}

template <int D>
void write_ovm(const std::filesystem::path& path, const Cell_soup<D>& soup, const Soup_groups& groups) {
  Atomic_file file(path);
  write_ovm(file, soup, groups);
  file.commit();
}

template void write_ovm<2>(Atomic_file&, const Cell_soup<2>&, const Soup_groups&);
template void write_ovm<3>(Atomic_file&, const Cell_soup<3>&, const Soup_groups&);
template void write_ovm<2>(const std::filesystem::path&, const Cell_soup<2>&, const Soup_groups&);
template void write_ovm<3>(const std::filesystem::path&, const Cell_soup<3>&, const Soup_groups&);

}  // namespace cellwalk::io
