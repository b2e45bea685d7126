// SPDX-License-Identifier: LGPL-3.0-or-later
// OFF, as text and binary. CGAL's reader names no line, refuses `group` lines and accepts some broken files.
#include <fmt/format.h>

#include "format.h"
#include "io/files/binary.h"
#include "io/files/text.h"
#include "surface_parsers.h"

namespace cellwalk::io {
namespace {

struct Header {
  bool binary = false, colours = false, normals = false;
};

/// `[ST][C][N][4][n]OFF [BINARY]`, with the counts in the same line, even without a blank, or the next; the
/// keyword may be missing.
Header read_header(Line_reader& in, Read_report& report) {
  in.need_line("'OFF'");
  std::string_view keyword = in.word();
  if (keyword.find_first_not_of("0123456789") == std::string_view::npos) {
    report.notes.push_back("the keyword OFF is missing");
    in.unread();
    in.next_line();
    return {};
  }
  const std::size_t end = end_of_off_keyword(keyword);
  if (end == 0) in.fail(fmt::format("not an OFF file: it begins with '{}'", keyword.substr(0, 20)));
  if (end < keyword.size()) in.unread(keyword.substr(end));
  keyword = keyword.substr(0, end - off_keyword.size());
  Header header;
  auto prefix = [&](std::string_view p) {
    const bool found = keyword.starts_with(p);
    if (found) keyword.remove_prefix(p.size());
    return found;
  };
  prefix("ST");
  header.colours = prefix("C");
  header.normals = prefix("N");
  if (!keyword.empty())
    in.fail(fmt::format("'{}OFF' holds points that are not in 3-space: only three coordinates are read",
                        shown(keyword)));
  if (same_word(in.rest().substr(std::min(in.rest().find_first_not_of(" \t"), in.rest().size())), "binary"))
    header.binary = true;
  return header;
}

/// Binary: counts of vertices, facets and edges; vertices; facets with their colours. All big endian, of 32
/// bits.
Surface_soup parse_binary(const std::string& name, std::string_view data, const Header& header,
                          Read_report& report, Body_elements* body) {
  if (header.colours || header.normals) fail(name, "binary OFF is read without colours and normals only");
  report.format = "OFF (binary)";
  constexpr bool big_endian = true;
  Binary_reader in(name, data, big_endian);
  const auto point_count = in.take<std::uint32_t>("the number of vertices");
  const auto facet_count = in.take<std::uint32_t>("the number of facets");
  in.take<std::uint32_t>("the number of edges");
  Surface_soup soup;
  for (std::uint32_t i = 0; i < point_count; ++i) {
    Point<3> p;
    for (double& x : p) x = in.take<float>("a vertex");
    if (!is_finite(p)) in.fail(fmt::format("vertex {} has a coordinate that is not finite", i));
    check_planar(in, body, p);
    soup.points.push_back(p);
  }
  for (std::uint32_t f = 0; f < facet_count; ++f) {
    const auto n = in.take<std::uint32_t>("a facet");
    const std::uint32_t fewest = body ? 2 : 3;
    if (n < fewest || n > in.left())
      in.fail(fmt::format("facet {} has {} vertices: the file is broken", f, n));
    std::vector<std::uint32_t> loop(n);
    for (std::uint32_t& v : loop) {
      v = in.take<std::uint32_t>("a facet");
      if (v >= point_count) in.fail(fmt::format("facet {} names vertex {}, of {}", f, v, point_count));
    }
    if (n == 2)
      body->edges.push_back({loop[0], loop[1]});
    else
      soup.facets.push_back(std::move(loop));
    in.skip(std::size_t{4} * in.take<std::uint32_t>("the number of colours of a facet"));
  }
  if (in.left() > 0) report.notes.push_back(fmt::format("{} bytes after the last facet ignored", in.left()));
  return soup;
}

}  // namespace

Surface_soup parse_off(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body) {
  Line_reader in(name, bytes);
  const Header header = read_header(in, report);
  if (header.binary) return parse_binary(name, in.remaining(), header, report, body);
  report.format = "OFF";
  if (in.at_line_end()) in.need_line("the numbers of vertices and facets");
  const std::uint64_t point_count = in.count("the number of vertices");
  const std::uint64_t facet_count = in.count("the number of facets");

  Surface_soup soup;
  soup.points.reserve(in.plausible(point_count, 6));
  std::size_t groups = 0, degenerate = 0;
  bool extra = false;
  auto next_row = [&](const std::string& what) {
    in.need_line(what);
    while (in.rest().starts_with("group")) {
      ++groups;
      in.need_line(what);
    }
  };
  for (std::uint64_t i = 0; i < point_count; ++i) {
    next_row(fmt::format("vertex {} of {}", i + 1, point_count));
    Point<3> p;
    for (double& x : p) x = in.number("a coordinate");
    check_planar(in, body, p);
    extra |= !in.at_line_end();
    soup.points.push_back(p);
  }
  soup.facets.reserve(in.plausible(facet_count, 4));
  for (std::uint64_t i = 0; i < facet_count; ++i) {
    next_row(fmt::format("facet {} of {}", i + 1, facet_count));
    const std::uint64_t n = in.count("the number of vertices of a facet");
    std::vector<std::uint32_t> loop;
    loop.reserve(in.plausible(n, 2));
    for (std::uint64_t k = 0; k < n; ++k) loop.push_back(in.index("vertex", soup.points.size()));
    if (n >= 3)
      soup.facets.push_back(std::move(loop));
    else if (n == 2 && body)
      body->edges.push_back({loop[0], loop[1]});
    else
      ++degenerate;
  }
  if (extra && !header.colours && !header.normals)
    report.notes.push_back("values after the three coordinates of vertices ignored");
  if (groups > 0) report.notes.push_back(fmt::format("{} 'group' lines ignored", groups));
  if (degenerate > 0)
    report.notes.push_back(
        fmt::format("{} facets of fewer than {} vertices ignored", degenerate, body ? 2 : 3));
  std::size_t further = 0;
  while (in.next_line()) ++further;
  if (further > 0) report.notes.push_back(fmt::format("{} lines after the last facet ignored", further));
  return soup;
}

}  // namespace cellwalk::io
