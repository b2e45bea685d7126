// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gmsh_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

#include "gmsh_binary.h"
#include "gmsh_types.h"
#include "text.h"

namespace cellwalk::io {
namespace {

/// Thrown where the text ends, or has no number where one should be: Gmsh says so better.
struct Unreadable {};

class Msh_nodes {
 public:
  Msh_nodes(const std::string& name, std::string_view text, const Msh_header& header)
      : in_(name, text, '\0'), version_(header.version) {}

  void check() {
    const bool is_1 = version_ == "1", is_4 = version_.starts_with('4');
    try {
      while (in_.next_line()) {
        const std::string_view section = in_.word();
        if (section == (is_1 ? "$NOD" : "$Nodes") || section == "$NOE" || section == "$ParametricNodes") {
          once(section, has_nodes_);
          is_4 ? blocks_of_nodes() : nodes();
          nodes_.sort();
        } else if (section == (is_1 ? "$ELM" : "$Elements")) {
          once(section, has_elements_);
          is_4 ? blocks_of_elements() : elements(is_1);
        }
      }
    } catch (const Unreadable&) {
    }
  }

 private:
  using Number = std::int64_t;

  void once(std::string_view section, bool& seen) {
    if (seen) in_.fail(fmt::format("the section '{}' occurs twice", section));
    seen = true;
  }

  std::string_view word() {
    for (;;) {
      if (const std::string_view w = in_.word(); !w.empty()) return w;
      if (!in_.next_line()) throw Unreadable();
    }
  }

  Number number() {
    const std::string_view w = word();
    Number value = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error == std::errc::result_out_of_range) return std::numeric_limits<Number>::max();
    if (error != std::errc{} || end != w.data() + w.size()) throw Unreadable();
    return value;
  }

  void skip(Number count) {
    for (Number i = 0; i < count; ++i) word();
  }

  void add_node(Number node) {
    if (!Node_numbers::is_number(node)) in_.fail(fmt::format("{} is no number of a node", node));
    nodes_.add(node);
  }

  void check_node(Number element, Number node) {
    if (!nodes_.contains(node))
      in_.fail(fmt::format("element {} names node {}, which does not exist", element, node));
  }

  /// The nodes of an element whose type is not listed are what is left of its line.
  void check_nodes(Number element, Number type, Number count) {
    if (count < 0) count = nodes_of_msh_type(type);
    for (Number i = 0; i < count; ++i) check_node(element, number());
    while (count == 0 && !in_.at_line_end()) check_node(element, number());
  }

  /// Versions 1 and 2: a line each. What follows the coordinates of a node, parameters, is passed over.
  void nodes() {
    const Number count = number();
    for (Number i = 0; i < count; ++i) {
      add_node(number());
      skip(3);
      while (!in_.at_line_end()) in_.word();
    }
  }

  void elements(bool is_1) {
    const Number count = number();
    for (Number i = 0; i < count; ++i) {
      const Number element = number(), type = number();
      if (is_1) {
        skip(2);
        check_nodes(element, type, std::max<Number>(number(), 0));
      } else {
        skip(number());
        check_nodes(element, type, listed);
      }
    }
  }

  /// Version 4: blocks of entities.
  struct Block {
    Number kind, size;
  };

  /// The head of a section: the number of blocks, and of all that they hold.
  Block section_head() {
    const Number blocks = number(), total = number();
    if (is_4_1()) skip(2);
    return {blocks, total};
  }

  /// The head of a block; its third number says how the members are written.
  Block block_head(std::string_view what, Number& left, Number& dimension) {
    const Number first = number(), second = number();
    dimension = is_4_1() ? first : second;
    const Number kind = number(), size = number();
    const Number held = std::max<Number>(size, 0);
    if (held > left) in_.fail(fmt::format("the blocks hold more {} than the section announces", what));
    left -= held;
    return {kind, size};
  }

  void blocks_of_nodes() {
    const auto [blocks, total] = section_head();
    Number left = total, dimension = 0;
    for (Number b = 0; b < blocks; ++b) {
      const auto [parametric, size] = block_head("nodes", left, dimension);
      const Number coordinates = 3 + (parametric != 0 ? std::clamp<Number>(dimension, 0, 3) : 0);
      for (Number i = 0; i < size; ++i) {
        add_node(number());
        if (!is_4_1()) skip(coordinates);
      }
      if (is_4_1()) skip(size * coordinates);
    }
  }

  void blocks_of_elements() {
    const auto [blocks, total] = section_head();
    Number left = total, dimension = 0;
    for (Number b = 0; b < blocks; ++b) {
      const auto [type, size] = block_head("elements", left, dimension);
      for (Number i = 0; i < size; ++i) {
        const Number element = number();
        check_nodes(element, type, listed);
      }
    }
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
  Line_reader in(name, text, '\0');
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
