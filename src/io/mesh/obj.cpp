// SPDX-License-Identifier: LGPL-3.0-or-later
// Wavefront OBJ: vertices and faces, lines for bodies. CGAL's reader names no line.
#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "io/files/text.h"
#include "surface_parsers.h"

namespace cellwalk::io {
namespace {

/// The largest number of ignored keywords that a note names.
constexpr std::size_t named_keywords = 12;

bool is_keyword(std::string_view word) {
  constexpr std::size_t longest = 16;
  return word.size() <= longest &&
         word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_") ==
             std::string_view::npos;
}

class Obj_reader {
 public:
  Obj_reader(const std::string& name, std::string_view bytes, Body_elements* body)
      : in_(name, bytes), body_(body) {}

  Surface_soup read(Read_report& report) {
    while (in_.next_line()) statement(in_.word());
    if (furthest_ && furthest_->vertex >= soup_.points.size())
      fail(in_.file(), furthest_->line,
           fmt::format("a {} names vertex {}, of {}", furthest_->kind, furthest_->vertex + 1,
                       soup_.points.size()));
    if (!ignored_.empty()) report.notes.push_back(note());
    if (short_faces_ > 0)
      report.notes.push_back(fmt::format("{} face{} of fewer than 3 vertices left out, the first at line {}",
                                         short_faces_, short_faces_ > 1 ? "s" : "", first_short_face_));
    return std::move(soup_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "v") {
      Point<3> p;
      for (double& x : p) x = in_.number("a coordinate");
      check_planar(in_, body_, p);
      soup_.points.push_back(p);
    } else if (keyword == "f") {
      face();
    } else if (keyword == "l" && body_) {
      const auto line = corners("line");
      if (line.size() < 2) in_.fail(fmt::format("a line of {} vertices: at least 2 are needed", line.size()));
      for (std::size_t i = 1; i < line.size(); ++i) body_->edges.push_back({line[i - 1], line[i]});
    } else if (is_keyword(keyword)) {
      if (!ignored_.contains(keyword)) ignored_.emplace(keyword);
      while (in_.rest().ends_with('\\') && in_.next_line()) continue;
    } else {
      in_.fail(fmt::format("'{}' opens no statement of an OBJ file", keyword.substr(0, 20)));
    }
  }

  /// Points and lines that programs write as faces bound nothing.
  void face() {
    const std::size_t line = in_.line();
    std::vector<std::uint32_t> loop = corners("face");
    if (loop.size() >= 3)
      soup_.facets.push_back(std::move(loop));
    else if (short_faces_++ == 0)
      first_short_face_ = line;
  }

  /// The vertices in the rest of the statement.
  std::vector<std::uint32_t> corners(const char* kind) {
    std::vector<std::uint32_t> result;
    while (!in_.at_line_end()) {
      const std::string_view w = in_.word();
      if (w == "\\")  // the statement continues in the next line
        in_.need_line(fmt::format("the rest of a {}", kind));
      else
        result.push_back(corner(kind, w));
    }
    return result;
  }

  /// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or backwards from the last vertex. A
  /// vertex that is not yet defined is allowed here and checked at the end.
  std::uint32_t corner(const char* kind, std::string_view word) {
    const std::string_view digits = word.substr(0, word.find('/'));
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc{} || end != digits.data() + digits.size() || index == 0)
      in_.fail(fmt::format("'{}' is not a corner of a {}: an index counted from 1, or a negative one",
                           shown(word), kind));
    if (index < 0) index += static_cast<std::int64_t>(soup_.points.size()) + 1;
    constexpr std::int64_t most = 0xfffffffe;
    if (index < 1 || index > most)
      in_.fail(fmt::format("corner '{}' of a {} names a vertex that does not exist", shown(word), kind));
    const auto vertex = static_cast<std::uint32_t>(index - 1);
    if (vertex >= soup_.points.size() && (!furthest_ || vertex > furthest_->vertex))
      furthest_ = Ahead{vertex, in_.line(), kind};
    return vertex;
  }

  std::string note() const {
    std::string list;
    std::size_t n = 0;
    for (const std::string& k : ignored_)
      if (n++ < named_keywords) list += (list.empty() ? "" : ", ") + k;
    return fmt::format("statements ignored: {}{}", list, n > named_keywords ? " and others" : "");
  }

  /// A vertex that is used before its definition.
  struct Ahead {
    std::uint32_t vertex;
    std::size_t line;
    const char* kind;
  };

  Line_reader in_;
  Body_elements* body_;
  Surface_soup soup_;
  std::set<std::string, std::less<>> ignored_;
  std::optional<Ahead> furthest_;
  std::size_t short_faces_ = 0, first_short_face_ = 0;  ///< their number, and the line of the first
};

}  // namespace

Surface_soup parse_obj(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body) {
  report.format = "OBJ";
  return Obj_reader(name, bytes, body).read(report);
}

}  // namespace cellwalk::io
