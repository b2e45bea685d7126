// SPDX-License-Identifier: LGPL-3.0-or-later
// Wavefront OBJ: vertices and faces. CGAL's reader names no line.
#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <set>

#include "surface_parsers.h"
#include "text.h"

namespace cellwalk::io {
namespace {

/// How many of the keywords that were ignored a note names.
constexpr std::size_t named_keywords = 12;

/// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`: counted from 1, or backward from the last vertex.
/// A vertex that is still to come is allowed here and checked at the end.
std::uint32_t corner(Line_reader& in, std::string_view word, std::size_t point_count) {
  const std::string_view digits = word.substr(0, word.find('/'));
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc{} || end != digits.data() + digits.size() || index == 0)
    in.fail(fmt::format("'{}' is not a corner of a face: an index counted from 1, or a negative one", word));
  if (index < 0) index += static_cast<std::int64_t>(point_count) + 1;
  constexpr std::int64_t most = 0xfffffffe;
  if (index < 1 || index > most)
    in.fail(fmt::format("corner '{}' of a face names a vertex that does not exist", word));
  return static_cast<std::uint32_t>(index - 1);
}

bool is_keyword(std::string_view word) {
  constexpr std::size_t longest = 16;
  return word.size() <= longest &&
         word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_") ==
             std::string_view::npos;
}

}  // namespace

Surface_soup parse_obj(const std::string& name, std::string_view bytes, Read_report& report) {
  report.format = "OBJ";
  Surface_soup soup;
  std::set<std::string, std::less<>> ignored;
  struct Forward {
    std::uint32_t vertex;
    std::size_t line;
  };
  std::optional<Forward> forward;  // the face that reaches furthest ahead
  Line_reader in(name, bytes);
  while (in.next_line()) {
    const std::string_view keyword = in.word();
    if (keyword == "v") {
      Point<3> p;
      for (double& x : p) x = in.number("a coordinate");
      soup.points.push_back(p);
    } else if (keyword == "f") {
      std::vector<std::uint32_t> loop;
      while (!in.at_line_end()) {
        const std::string_view w = in.word();
        if (w == "\\") {  // the face goes on in the next line
          in.need_line("the rest of a face");
          continue;
        }
        loop.push_back(corner(in, w, soup.points.size()));
        if (loop.back() >= soup.points.size() && (!forward || loop.back() > forward->vertex))
          forward = Forward{loop.back(), in.line()};
      }
      if (loop.size() < 3) in.fail(fmt::format("a face of {} vertices: at least 3 are needed", loop.size()));
      soup.facets.push_back(std::move(loop));
    } else if (is_keyword(keyword)) {
      if (!ignored.contains(keyword)) ignored.emplace(keyword);
    } else {
      in.fail(fmt::format("'{}' opens no statement of an OBJ file", keyword.substr(0, 20)));
    }
  }
  if (forward && forward->vertex >= soup.points.size())
    fail(name, forward->line,
         fmt::format("a face names vertex {}, of {}", forward->vertex + 1, soup.points.size()));
  if (!ignored.empty()) {
    std::string list;
    std::size_t n = 0;
    for (const std::string& k : ignored)
      if (n++ < named_keywords) list += (list.empty() ? "" : ", ") + k;
    report.notes.push_back(
        fmt::format("statements ignored: {}{}", list, n > named_keywords ? " and others" : ""));
  }
  return soup;
}

}  // namespace cellwalk::io
