// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gmsh_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <unordered_set>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

/// The start of the line after the one that begins with `keyword`; npos if there is no such line.
std::size_t line_after(std::string_view bytes, std::string_view keyword) {
  std::size_t at = bytes.find(keyword);
  while (at != std::string_view::npos && at > 0 && bytes[at - 1] != '\n') at = bytes.find(keyword, at + 1);
  if (at != std::string_view::npos) at = bytes.find('\n', at);
  return at == std::string_view::npos ? at : at + 1;
}

/// The word of number `position` on the line that starts at `begin`, as an integer.
std::optional<std::uint64_t> integer_at(std::string_view bytes, std::size_t begin, int position) {
  if (begin == std::string_view::npos) return std::nullopt;
  Line_reader in("", bytes.substr(begin, 256), std::nullopt);
  if (!in.next_line()) return std::nullopt;
  std::string_view w = in.word();
  for (int i = 0; i < position; ++i) w = in.word();
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
  return error == std::errc{} && end == w.data() + w.size() && !w.empty() ? std::optional(value)
                                                                          : std::nullopt;
}

bool is_version_1_or_2(const Msh_header& header) {
  return header.version == "1" || header.version.starts_with('2');
}

std::string_view element_keyword(const Msh_header& header) {
  return header.version == "1" ? "$ELM" : "$Elements";
}

}  // namespace

Msh_header read_msh_header(const std::string& name, std::string_view bytes) {
  if (!bytes.starts_with('$'))
    fail(name, 1, "not a mesh of Gmsh: it does not begin with '$MeshFormat' or '$NOD'");
  Line_reader in(name, bytes, std::nullopt);
  in.next_line();
  const std::string_view opening = in.word();
  if (opening == "$NOD" || opening == "$NOE") return {"1", false};
  if (opening != "$MeshFormat" && opening != "$Comments")
    in.fail(fmt::format("not a mesh of Gmsh: it begins with '{}'", opening.substr(0, 20)));
  while (opening == "$Comments" && in.next_line() && in.word() != "$MeshFormat") continue;
  in.need_line("the version of the format");
  Msh_header header{std::string(in.word()), false};
  header.binary = in.word() == "1";
  return header;
}

Msh_counts announced_counts(std::string_view bytes, const Msh_header& header) {
  const bool old = is_version_1_or_2(header);
  if (header.binary && !old) return {};
  const int position = old ? 0 : 1;  // version 4: blocks, then members
  return {integer_at(bytes, line_after(bytes, header.version == "1" ? "$NO" : "$Nodes"), position),
          integer_at(bytes, line_after(bytes, element_keyword(header)), position)};
}

Msh_counts check_medit(const std::string& name, std::string_view text) {
  constexpr std::array<std::string_view, 8> read{"Edges",     "Triangles",   "Quadrilaterals", "Tetrahedra",
                                                 "Hexahedra", "TrianglesP2", "TetrahedraP2",   "EdgesP2"};
  constexpr std::array<std::string_view, 6> lost{"Prisms",   "Pentahedra", "Pyramids",
                                                 "PrismsP2", "PyramidsP2", "HexahedraQ2"};
  Line_reader in(name, text);
  in.need_line("'MeshVersionFormatted'");
  if (in.word() != "MeshVersionFormatted")
    in.fail("not an ASCII MEDIT file: it does not begin with 'MeshVersionFormatted'");
  Msh_counts counts{std::nullopt, 0};
  while (in.next_line()) {
    const std::string keyword(in.word());
    const bool is_read = std::find(read.begin(), read.end(), keyword) != read.end();
    const bool is_lost = std::find(lost.begin(), lost.end(), keyword) != lost.end();
    if (!is_read && !is_lost && keyword != "Vertices") continue;
    const std::size_t line = in.line();
    if (in.at_line_end()) in.need_line("the number of " + lower(keyword));
    const std::uint64_t count = in.count("the number of " + lower(keyword));
    if (is_lost && count > 0)
      fail(
          name, line,
          fmt::format("'{}' are not read from MEDIT files by Gmsh: write the mesh as .msh or .vtu", keyword));
    if (is_read) *counts.elements += count;
    if (keyword == "Vertices") counts.nodes = count;
  }
  return counts;
}

std::optional<std::string> renumbered_elements(std::string_view text, const Msh_header& header) {
  if (header.binary || !is_version_1_or_2(header)) return std::nullopt;
  const std::size_t begin = line_after(text, element_keyword(header));
  if (begin == std::string_view::npos) return std::nullopt;
  Line_reader in("", text.substr(begin), std::nullopt);
  in.next_line();  // the count
  std::string renumbered(text.substr(0, begin));
  renumbered.append(in.rest()).append("\n");
  std::unordered_set<std::string_view> seen;
  bool repeats = false;
  std::size_t number = 0;
  while (in.next_line() && !in.rest().starts_with('$')) {
    repeats |= !seen.insert(in.word()).second;
    fmt::format_to(std::back_inserter(renumbered), "{}{}\n", ++number, in.rest());
  }
  if (!repeats) return std::nullopt;
  renumbered.append(in.rest()).append("\n").append(in.remaining());
  return renumbered;
}

}  // namespace cellwalk::io
