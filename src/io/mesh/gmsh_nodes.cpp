// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gmsh_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

#include "gmsh_binary.h"
#include "gmsh_types.h"
#include "io/files/text.h"

namespace cellwalk::io {
namespace {

class Msh_nodes {
 public:
  Msh_nodes(const std::string& name, std::string_view text, const Msh_header& header)
      : in_(name, text, '\0'), version_(header.version) {}

  void check() {
    const bool is_1 = version_ == "1", is_4 = version_.starts_with('4');
    while (in_.next_line()) {
      if (!in_.rest().starts_with('$')) continue;
      const std::string_view section = in_.word();
      if (is_section(section, is_1 ? "$NOD" : "$Nodes") || is_section(section, "$NOE") ||
          is_section(section, "$ParametricNodes")) {
        once(section, has_nodes_);
        is_4 ? blocks_of_nodes() : nodes();
        nodes_.sort();
      } else if (is_section(section, is_1 ? "$ELM" : "$Elements")) {
        once(section, has_elements_);
        is_4 ? blocks_of_elements() : elements(is_1);
      }
    }
  }

 private:
  using Number = std::int64_t;

  void once(std::string_view section, bool& seen) {
    if (seen) in_.fail(fmt::format("the section '{}' occurs twice", section));
    seen = true;
  }

  /// True if a line opens a section. Gmsh compares only the beginning of the line.
  bool is_section(std::string_view found, std::string_view section) {
    if (!found.starts_with(section)) return false;
    if (found != section || !in_.at_line_end())
      in_.fail(fmt::format("text follows '{}', where the line should end", section));
    return true;
  }

  /// Continues with the next line at the end of one, as Gmsh does.
  void need_word(std::string_view what) {
    while (in_.at_line_end()) in_.need_line(what);
  }

  Number number(std::string_view what) {
    need_word(what);
    const std::string_view w = in_.word();
    Number value = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error == std::errc::result_out_of_range) return std::numeric_limits<Number>::max();
    if (error != std::errc{} || end != w.data() + w.size())
      in_.fail(fmt::format("{}: '{}' is not an integer", what, shown(w)));
    return value;
  }

  void skip_integers(Number count, std::string_view what) {
    for (Number i = 0; i < count; ++i) number(what);
  }

  void coordinates(Number count) {
    for (Number i = 0; i < count; ++i) {
      need_word("a coordinate");
      in_.number("a coordinate");
    }
  }

  void add_node(Number node) {
    if (!Node_numbers::is_number(node)) in_.fail(fmt::format("{} is no number of a node", node));
    nodes_.add(node);
  }

  void check_node(Number element, Number node) {
    if (!nodes_.contains(node))
      in_.fail(fmt::format("element {} names node {}, which does not exist", element, node));
  }

  /// The nodes of an element of a type that is not listed are the rest of its line.
  void check_nodes(Number element, Number type, Number count) {
    if (count == listed) count = nodes_of_msh_type(type);
    for (Number i = 0; i < count; ++i) check_node(element, number("a node"));
    while (count == 0 && !in_.at_line_end()) check_node(element, number("a node"));
  }

  /// Versions 1 and 2: one line each. The coordinates of a node are followed by its parameters.
  void nodes() {
    const Number count = number("the number of nodes");
    for (Number i = 0; i < count; ++i) {
      add_node(number("a node"));
      coordinates(3);
      while (!in_.at_line_end()) in_.number("a parameter");
    }
  }

  void elements(bool is_1) {
    const Number count = number("the number of elements");
    for (Number i = 0; i < count; ++i) {
      const Number element = number("an element"), type = number("a type of elements");
      if (is_1) {
        skip_integers(2, "a tag");
        check_nodes(element, type, std::max<Number>(number("a number of nodes"), 0));
      } else {
        skip_integers(number("a number of tags"), "a tag");
        check_nodes(element, type, listed);
      }
    }
  }

  /// The head of a section of version 4: the number of blocks, and the total number of their members.
  struct Section {
    Number blocks, total;
  };

  Section section_head(std::string_view what) {
    const Number blocks = number("the number of blocks"), total = number(what);
    if (is_4_1()) skip_integers(2, what);
    return {blocks, total};
  }

  /// The head of a block: the form of its members (their type, or whether they have parameters), and their
  /// number.
  struct Block {
    Number dimension, kind, size;
  };

  Block block_head() {
    const Number first = number("a block"), second = number("a block");
    const Number kind = number("a block"), size = number("the size of a block");
    return {is_4_1() ? first : second, kind, size};
  }

  void expect_all(std::string_view what, Number announced, Number held) {
    if (announced != held)
      in_.fail(fmt::format("the section announces {} {}, and its blocks hold {}", announced, what, held));
  }

  void blocks_of_nodes() {
    const Section section = section_head("the number of nodes");
    Number held = 0;
    for (Number b = 0; b < section.blocks; ++b) {
      const Block block = block_head();
      const Number axes = 3 + (block.kind != 0 ? std::clamp<Number>(block.dimension, 0, 3) : 0);
      for (Number i = 0; i < block.size; ++i, ++held) {
        add_node(number("a node"));
        if (!is_4_1()) coordinates(axes);
      }
      for (Number i = 0; is_4_1() && i < block.size; ++i) coordinates(axes);
    }
    expect_all("nodes", section.total, held);
  }

  void blocks_of_elements() {
    const Section section = section_head("the number of elements");
    Number held = 0;
    for (Number b = 0; b < section.blocks; ++b) {
      const Block block = block_head();
      for (Number i = 0; i < block.size; ++i, ++held) {
        const Number element = number("an element");
        check_nodes(element, block.kind, listed);
      }
    }
    expect_all("elements", section.total, held);
  }

  bool is_4_1() const { return version_ != "4" && version_ != "4.0"; }

  static constexpr Number listed = -1;  // as many nodes as the type has

  Line_reader in_;
  std::string version_;
  Node_numbers nodes_;
  bool has_nodes_ = false, has_elements_ = false;
};

}  // namespace

void check_msh_nodes(const std::string& name, std::string_view bytes, const Msh_header& header) {
  if (header.version != "1" && !header.version.starts_with('2') && !header.version.starts_with('4')) return;
  if (header.binary && (header.version == "4" || header.version == "4.0")) return;  // Gmsh reads none
  if (header.binary)
    check_binary_msh_nodes(name, bytes, header);
  else
    Msh_nodes(name, bytes, header).check();
}

void check_unv_nodes(const std::string& name, std::string_view text) {
  Line_reader in(name, text, std::nullopt);
  const auto begins_or_ends = [](const Line_reader& line) {
    const std::string_view rest = line.rest();
    return rest.substr(std::min(rest.find_first_not_of(' '), rest.size())) == "-1";
  };
  bool is_inside = false, has_elements = false;
  while (in.next_line()) {
    if (begins_or_ends(in)) {
      is_inside = !is_inside;
      if (is_inside && in.next_line()) {
        if (begins_or_ends(in))
          is_inside = false;
        else
          has_elements = in.word() == "2412";
      }
    } else if (is_inside && has_elements && in.rest().find('-') != std::string_view::npos) {
      in.fail("an element with a negative number: there is no such node");
    }
  }
}

}  // namespace cellwalk::io
