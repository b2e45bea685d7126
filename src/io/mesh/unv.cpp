// SPDX-License-Identifier: LGPL-3.0-or-later
// I-deas universal files: datasets between lines of -1, in any order. Read are nodes, elements and groups.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "element_parsers.h"
#include "io/files/text.h"
#include "word_reader.h"

namespace cellwalk::io {
namespace {

/// The corners of elements of second order are among their other nodes.
struct Unv_kind {
  Element_kind kind;
  std::array<std::uint8_t, 8> corners;
  bool is_beam = false;  ///< has a further line
};

std::optional<Unv_kind> kind_of_unv(std::int64_t type) {
  switch (type) {
    case 11:
    case 21:
    case 22:
    case 31:
      return Unv_kind{{1, 2, 2}, {0, 1}, type != 31};
    case 23:
    case 24:
      return Unv_kind{{1, 2, 3}, {0, 2}, true};
    case 32:
      return Unv_kind{{1, 2, 3}, {0, 2}};
    case 41:
    case 51:
    case 61:
    case 74:
    case 81:
    case 91:
      return Unv_kind{{2, 3, 3}, {0, 1, 2}};
    case 42:
    case 52:
    case 62:
    case 72:
    case 82:
    case 92:
      return Unv_kind{{2, 3, 6}, {0, 2, 4}};
    case 44:
    case 54:
    case 64:
    case 71:
    case 84:
    case 94:
      return Unv_kind{{2, 4, 4}, {0, 1, 2, 3}};
    case 45:
    case 55:
    case 65:
    case 75:
    case 85:
    case 95:
      return Unv_kind{{2, 4, 8}, {0, 2, 4, 6}};
    case 111:
      return Unv_kind{{3, 4, 4}, {0, 1, 2, 3}};
    case 118:
      return Unv_kind{{3, 4, 10}, {0, 2, 4, 9}};
    case 104:
    case 115:
      return Unv_kind{{3, 8, 8}, {0, 1, 2, 3, 4, 5, 6, 7}};
    case 105:
    case 116:
      return Unv_kind{{3, 8, 20}, {0, 2, 4, 6, 12, 14, 16, 18}};
    case 101:
    case 112:
      return Unv_kind{{3, 6, 6}, {0, 1, 2, 3, 4, 5}};
    case 102:
    case 113:
      return Unv_kind{{3, 6, 15}, {0, 2, 4, 9, 11, 13}};
    default:
      return std::nullopt;
  }
}

/// The datasets of one kind are read in a pass over the file, so that all nodes are there before the
/// elements, and all elements before the groups.
enum class Kind { nodes, elements, groups, others };

Kind kind_of_dataset(std::int64_t number) {
  switch (number) {
    case 2411:
    case 781:
      return Kind::nodes;
    case 2412:
      return Kind::elements;
    case 2435:
    case 2452:
    case 2467:
    case 2477:
      return Kind::groups;
    default:
      return Kind::others;
  }
}

class Unv_reader {
 public:
  Unv_reader(const std::string& name, std::string_view text, Read_report& report)
      : start_(name, text, std::nullopt), elements_(name), report_(report) {}

  Element_soup read(Lines lines) {
    read(Kind::nodes);
    elements_.sort_nodes();
    read(Kind::elements);
    positions_ = elements_.positions();
    read(Kind::groups);
    return elements_.take(lines, report_);
  }

 private:
  void read(Kind kind) {
    in_ = start_;
    if (!in_.has_word() || in_.peek("'-1'") != "-1") in_.fail("not a UNV file: it does not begin with '-1'");
    while (in_.has_word()) {
      if (const std::string_view word = in_.word("'-1'"); word != "-1")
        in_.fail(fmt::format("'{}' where '-1' should begin a dataset", shown(word)));
      if (kind_of_dataset(in_.integer("the number of a dataset")) == kind)
        dataset(kind);
      else
        skip_dataset();
    }
  }

  void dataset(Kind kind) {
    while (!is_end()) {
      if (kind == Kind::nodes) node();
      if (kind == Kind::elements) element();
      if (kind == Kind::groups) group();
    }
  }

  static constexpr std::string_view end_of_dataset = "'-1', the end of a dataset,";

  /// True, and goes on, if a dataset ends here.
  bool is_end() {
    if (in_.peek(end_of_dataset) != "-1") return false;
    in_.word(end_of_dataset);
    return true;
  }

  /// The end is a line with nothing but -1: others may begin with it.
  void skip_dataset() {
    for (bool is_end = false; !is_end;) {
      in_.leave_line();
      is_end = in_.word(end_of_dataset) == "-1" && in_.at_line_end();
    }
  }

  void skip_integers(int count, std::string_view what) {
    for (int i = 0; i < count; ++i) in_.integer(what);
  }

  void node() {
    const std::int64_t number = in_.integer("a node");
    if (number < 0 || number > std::numeric_limits<std::int32_t>::max())
      in_.fail(fmt::format("{} is no number of a node", number));
    skip_integers(3, "a coordinate system or colour");
    Point<3> p;
    for (double& x : p) x = in_.coordinate("a coordinate");
    elements_.add_node(number, p);
  }

  void element() {
    const std::int64_t number = in_.integer("an element"), type = in_.integer("a type of elements");
    skip_integers(3, "a property or colour");
    const std::int64_t count = in_.integer("a number of nodes");
    auto known = kind_of_unv(type);
    if (!known && (count == 1 || count == 2))  // a mass or a spring
      known = Unv_kind{{0, static_cast<int>(count), static_cast<int>(count)}, {0, 1}};
    if (!known)
      in_.fail(
          fmt::format("elements of type {} are not read: tetrahedra, hexahedra, prisms, pyramids are", type));
    if (count != known->kind.nodes)
      in_.fail(fmt::format("element {} has {} nodes, and its type {}", number, count, known->kind.nodes));
    if (known->is_beam) skip_integers(3, "a beam");
    std::vector<std::uint32_t> corners, others;
    const auto last = known->corners.begin() + known->kind.corners;
    for (int i = 0; i < known->kind.nodes; ++i) {
      const std::int64_t node = in_.integer("a node");
      const auto index = elements_.index(node);
      if (!index) in_.fail(fmt::format("element {} names node {}, which does not exist", number, node));
      (std::find(known->corners.begin(), last, i) != last ? corners : others).push_back(*index);
    }
    corners.insert(corners.end(), others.begin(), others.end());
    elements_.add_element(number, known->kind, corners);
  }

  /// A group of elements and nodes, with a name.
  void group() {
    constexpr std::int64_t of_elements = 8;  // the code of an entity
    skip_integers(7, "a group");
    const std::int64_t count = in_.integer("the number of entities of a group");
    std::string name(in_.rest_of_line("the name of a group"));
    in_.leave_line();
    name.resize(name.find_last_not_of(" \t") + 1);
    std::vector<std::uint32_t> members;
    std::size_t others = 0;
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t code = in_.integer("an entity"), tag = in_.integer("an entity");
      skip_integers(2, "an entity");
      const auto found = positions_.find(tag);
      if (code == of_elements && found != positions_.end())
        members.push_back(found->second);
      else
        ++others;
    }
    if (others > 0)
      report_.notes.push_back(
          fmt::format("group \"{}\": {} entities that are no elements left out", shown(name), others));
    if (!members.empty()) elements_.add_group(name, members);
  }

  const Word_reader start_;
  Word_reader in_ = start_;
  Element_list elements_;
  std::unordered_map<std::int64_t, std::uint32_t> positions_;
  Read_report& report_;
};

}  // namespace

Element_soup parse_unv(const std::string& name, std::string_view text, Lines lines, Read_report& report) {
  report.format = "UNV";
  return Unv_reader(name, text, report).read(lines);
}

}  // namespace cellwalk::io
