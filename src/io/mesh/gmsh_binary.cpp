// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gmsh_binary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "gmsh_types.h"
#include "io/files/text.h"

namespace cellwalk::io {
namespace {

class Binary_msh {
 public:
  Binary_msh(const std::string& name, std::string_view bytes, const Msh_header& header)
      : name_(name), bytes_(bytes), is_4_(header.version.starts_with('4')) {}

  void check() {
    for (std::string section = next_section(); !section.empty(); section = next_section()) read(section);
  }

 private:
  using Number = std::int64_t;

  [[noreturn]] void refuse(const std::string& what) const { fail(name_, what); }
  [[noreturn]] void cut_short() const {
    refuse("the file ends inside its nodes or elements: it is cut short, or broken");
  }

  /// The name in the next line that begins with $; empty at the end. The position is after that line.
  std::string next_section() {
    while (at_ < bytes_.size() && bytes_[at_] != '$') {
      const std::size_t end = bytes_.find('\n', at_);
      if (end == std::string_view::npos) return {};
      at_ = end + 1;
    }
    return std::string(line());
  }

  void read(const std::string& section) {
    if (section.starts_with("$End")) return;
    for (const char* known :
         {"$MeshFormat", "$Nodes", "$Elements", "$ParametricNodes"})  // Gmsh compares only the beginning
      if (section.starts_with(known) && section != known)
        refuse(fmt::format("text follows '{}', where the line should end", known));
    if (section == "$MeshFormat") {
      line();
      std::int32_t one = 0;
      copy(&one, sizeof one);
      is_swapped_ = one != 1;
    } else if (section == "$Nodes") {
      once(section, has_nodes_);
      is_4_ ? blocks_of_nodes() : nodes();
      nodes_.sort();
    } else if (section == "$Elements") {
      once(section, has_elements_);
      is_4_ ? blocks_of_elements() : elements();
    } else if (section == "$ParametricNodes") {
      refuse("binary nodes with parameters are not read: write them without, or the mesh as text");
    } else {
      // Of other sections only the end is known.
      const std::size_t end = bytes_.find("$End" + section.substr(1), at_);
      if (end == std::string_view::npos) refuse(fmt::format("the section '{}' has no end", shown(section)));
      at_ = end;
    }
  }

  void once(const std::string& section, bool& seen) {
    if (seen) refuse(fmt::format("the section '{}' occurs twice", section));
    seen = true;
  }

  std::string_view line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  Number count_on_line() {
    const std::string_view text = line();
    Number count = 0;
    std::from_chars(text.data(), text.data() + text.size(), count);
    return count;
  }

  void copy(void* to, std::size_t size) {
    if (bytes_.size() - at_ < size) cut_short();
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  void skip(Number count, std::size_t size) {
    if (count < 0 || static_cast<std::uint64_t>(count) > (bytes_.size() - at_) / size) cut_short();
    at_ += static_cast<std::size_t>(count) * size;
  }

  template <class Integer>
  Number take() {
    std::array<char, sizeof(Integer)> bytes;
    copy(bytes.data(), bytes.size());
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    Integer value;
    std::memcpy(&value, bytes.data(), bytes.size());
    if (std::cmp_greater(value, std::numeric_limits<Number>::max()))
      return std::numeric_limits<Number>::max();
    return static_cast<Number>(value);
  }
  Number take_int() { return take<std::int32_t>(); }
  Number take_size() { return take<std::uint64_t>(); }

  void add_node(Number node) {
    if (!Node_numbers::is_number(node)) refuse(fmt::format("{} is no number of a node", node));
    nodes_.add(node);
  }

  template <class Take>
  void check_nodes(Number element, int count, Take take) {
    for (int i = 0; i < count; ++i)
      if (const Number node = take(); !nodes_.contains(node))
        refuse(fmt::format("element {} names node {}, which does not exist", element, node));
  }

  int known_type(Number type) const {
    const int count = nodes_of_msh_type(type);
    if (count == 0)
      refuse(
          fmt::format("elements of type {} are not read: tetrahedra, hexahedra, prisms, pyramids are", type));
    return count;
  }

  void nodes() {
    const Number count = count_on_line();
    for (Number i = 0; i < count; ++i) {
      add_node(take_int());
      skip(3, sizeof(double));
    }
  }

  void elements() {
    Number left = count_on_line();
    while (left > 0) {
      const Number type = take_int(), count = take_int(), tags = take_int();
      const int corners = known_type(type);
      if (count <= 0 || count > left)
        refuse(fmt::format("a block of {} elements, where {} are left", count, left));
      left -= count;
      for (Number i = 0; i < count; ++i) {
        const Number element = take_int();
        skip(tags, sizeof(std::int32_t));
        check_nodes(element, corners, [this] { return take_int(); });
      }
    }
  }

  /// The number of blocks, and the total number of their members.
  std::pair<Number, Number> section_head() {
    const Number blocks = take_size(), total = take_size();
    skip(2, sizeof(std::uint64_t));
    return {blocks, total};
  }

  struct Block {
    Number dimension, kind, size;
  };

  Block block_head() {
    const Number dimension = take_int();
    take_int();  // the tag of the entity
    const Number kind = take_int(), size = take_size();
    return {dimension, kind, size};
  }

  void expect_all(const char* what, Number announced, Number held) const {
    if (announced != held)
      refuse(fmt::format("the section announces {} {}, and its blocks hold {}", announced, what, held));
  }

  void blocks_of_nodes() {
    const auto [blocks, total] = section_head();
    Number held = 0;
    for (Number b = 0; b < blocks; ++b) {
      const Block block = block_head();
      const Number axes = 3 + (block.kind != 0 ? std::clamp<Number>(block.dimension, 0, 3) : 0);
      for (Number i = 0; i < block.size; ++i, ++held) add_node(take_size());
      for (Number i = 0; i < block.size; ++i) skip(axes, sizeof(double));
    }
    expect_all("nodes", total, held);
  }

  void blocks_of_elements() {
    const auto [blocks, total] = section_head();
    Number held = 0;
    for (Number b = 0; b < blocks; ++b) {
      const Block block = block_head();
      const int corners = known_type(block.kind);
      for (Number i = 0; i < block.size; ++i, ++held) {
        const Number element = take_size();
        check_nodes(element, corners, [this] { return take_size(); });
      }
    }
    expect_all("elements", total, held);
  }

  const std::string& name_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_4_, is_swapped_ = false, has_nodes_ = false, has_elements_ = false;
  Node_numbers nodes_;
};

}  // namespace

int nodes_of_msh_type(std::int64_t type) {
  // As in Gmsh's GmshDefines.h: lines, triangles, quadrilaterals, tetrahedra, hexahedra, prisms and pyramids,
  // up to high orders.
  constexpr std::array<int, 32> first{0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                      8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
  constexpr std::array<std::pair<int, int>, 18> others{{{36, 16},
                                                        {37, 25},
                                                        {38, 36},
                                                        {39, 12},
                                                        {40, 16},
                                                        {41, 20},
                                                        {62, 7},
                                                        {63, 8},
                                                        {64, 9},
                                                        {65, 10},
                                                        {66, 11},
                                                        {90, 40},
                                                        {91, 75},
                                                        {92, 64},
                                                        {93, 125},
                                                        {94, 216},
                                                        {118, 30},
                                                        {119, 55}}};
  if (type >= 0 && type < static_cast<std::int64_t>(first.size()))
    return first[static_cast<std::size_t>(type)];
  const auto found =
      std::find_if(others.begin(), others.end(), [type](const auto& entry) { return entry.first == type; });
  return found == others.end() ? 0 : found->second;
}

void check_binary_msh_nodes(const std::string& name, std::string_view bytes, const Msh_header& header) {
  Binary_msh(name, bytes, header).check();
}

}  // namespace cellwalk::io
