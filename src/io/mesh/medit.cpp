// SPDX-License-Identifier: LGPL-3.0-or-later
// MEDIT, as text: words, wherever lines end, and # before comments. Versions differ in the sizes of numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <vector>

#include "element_parsers.h"
#include "io/files/text.h"
#include "word_reader.h"

namespace cellwalk::io {
namespace {

struct Section {
  std::string_view keyword, member;
  Element_kind kind;
};

constexpr std::array<Section, 16> sections_of_elements{{{"Edges", "an edge", {1, 2, 2}},
                                                        {"Triangles", "a triangle", {2, 3, 3}},
                                                        {"Quadrilaterals", "a quadrilateral", {2, 4, 4}},
                                                        {"Tetrahedra", "a tetrahedron", {3, 4, 4}},
                                                        {"Hexahedra", "a hexahedron", {3, 8, 8}},
                                                        {"Prisms", "a prism", {3, 6, 6}},
                                                        {"Pentahedra", "a prism", {3, 6, 6}},
                                                        {"Pyramids", "a pyramid", {3, 5, 5}},
                                                        {"EdgesP2", "an edge", {1, 2, 3}},
                                                        {"TrianglesP2", "a triangle", {2, 3, 6}},
                                                        {"QuadrilateralsQ2", "a quadrilateral", {2, 4, 9}},
                                                        {"TetrahedraP2", "a tetrahedron", {3, 4, 10}},
                                                        {"HexahedraQ2", "a hexahedron", {3, 8, 27}},
                                                        {"PrismsP2", "a prism", {3, 6, 18}},
                                                        {"PentahedraP2", "a prism", {3, 6, 18}},
                                                        {"PyramidsP2", "a pyramid", {3, 5, 14}}}};

class Medit_reader {
 public:
  Medit_reader(const std::string& name, std::string_view text, Read_report& report)
      : in_(name, text, '#'), elements_(name), report_(report) {}

  Element_soup read(Lines lines) {
    head();
    while (in_.has_word()) {
      const std::string keyword(in_.word("a keyword"));
      if (same_word(keyword, "End")) break;
      section(keyword);
    }
    if (!has_vertices_) elements_.sort_nodes();
    for (const std::string& keyword : ignored_)
      report_.notes.push_back(fmt::format("section '{}' ignored", shown(keyword)));
    if (has_references_) report_.notes.push_back("references of elements ignored");
    return elements_.take(lines, report_);
  }

 private:
  void head() {
    constexpr std::int64_t newest = 4;
    if (!in_.has_word() || !same_word(in_.word("'MeshVersionFormatted'"), "MeshVersionFormatted"))
      in_.fail("not an ASCII MEDIT file: it does not begin with 'MeshVersionFormatted'");
    const std::int64_t version = in_.integer("the version of the format");
    if (version < 1 || version > newest)
      in_.fail(fmt::format("version {} of MEDIT is not read: 1 to {} are", version, newest));
  }

  std::int64_t count(const std::string& keyword) {
    const std::string what = "the number of " + lower(keyword);
    const std::int64_t n = in_.integer(what);
    if (n < 0) in_.fail(fmt::format("{}: '{}' is not an integer >= 0", what, n));
    return n;
  }

  void section(const std::string& keyword) {
    if (!std::isalpha(static_cast<unsigned char>(keyword.front())))
      in_.fail(fmt::format("'{}' where a keyword should be", shown(keyword)));
    if (same_word(keyword, "Dimension")) {
      dimension_ = in_.integer("the dimension");
      if (dimension_ != 2 && dimension_ != 3)
        in_.fail(fmt::format("dimension {}: only 2 and 3 are known", dimension_));
      return;
    }
    if (same_word(keyword, "Vertices")) return vertices();
    for (const Section& known : sections_of_elements)
      if (same_word(known.keyword, keyword)) return elements(known);
    if (!skip_numbers()) return;
    if (std::find(ignored_.begin(), ignored_.end(), keyword) == ignored_.end()) ignored_.push_back(keyword);
  }

  void vertices() {
    if (has_vertices_) in_.fail("the section 'Vertices' occurs twice");
    has_vertices_ = true;
    const std::int64_t n = count("Vertices");
    for (std::int64_t i = 1; i <= n; ++i) {
      Point<3> p{};
      for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k)
        p[k] = in_.coordinate("a coordinate");
      in_.integer("the reference of a vertex");
      elements_.add_node(i, p);
    }
    elements_.sort_nodes();
  }

  void elements(const Section& section) {
    const std::int64_t n = count(std::string(section.keyword));
    if (n > 0 && !has_vertices_)
      in_.fail(fmt::format("'{}' before 'Vertices': put the vertices first", section.keyword));
    std::vector<std::uint32_t> nodes(static_cast<std::size_t>(section.kind.nodes));
    for (std::int64_t i = 0; i < n; ++i) {
      ++number_;
      for (std::uint32_t& node : nodes) {
        const std::int64_t vertex = in_.integer(section.member);
        const auto index = elements_.index(vertex);
        if (!index) in_.fail(fmt::format("{} names vertex {}, which does not exist", section.member, vertex));
        node = *index;
      }
      has_references_ |= in_.integer("a reference") != 0;
      elements_.add_element(number_, section.kind, nodes);
    }
  }

  /// Skips all numbers up to the next keyword, in a section that is not read. True if there are any.
  bool skip_numbers() {
    bool is_any = false;
    while (in_.has_word() && !std::isalpha(static_cast<unsigned char>(in_.peek("a number").front())))
      is_any |= in_.word("a number") != "0";
    return is_any;
  }

  Word_reader in_;
  Element_list elements_;
  Read_report& report_;
  std::int64_t dimension_ = 3, number_ = 0;
  bool has_vertices_ = false, has_references_ = false;
  std::vector<std::string> ignored_;
};

}  // namespace

Element_soup parse_medit(const std::string& name, std::string_view text, Lines lines, Read_report& report) {
  report.format = "MEDIT";
  return Medit_reader(name, text, report).read(lines);
}

}  // namespace cellwalk::io
