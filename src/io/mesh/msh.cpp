// SPDX-License-Identifier: LGPL-3.0-or-later
// .msh of Gmsh: versions 1, 2 and 4, as text, 2 and 4.1 as binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "element_parsers.h"
#include "io/files/text.h"
#include "msh_source.h"

namespace cellwalk::io {
namespace {

using Number = std::int64_t;

/// Elements are members of all groups of their entity. An element takes at least four bytes, so this bound is
/// beyond 60 groups for each; it keeps a file in which both are many from taking the memory of their product.
constexpr std::size_t most_members_per_byte = 16;

using Dimension_and_tag = std::pair<Number, Number>;

class Msh_reader {
 public:
  Msh_reader(const std::string& name, Msh_source& in, const Msh_header& header, std::size_t bytes)
      : in_(in),
        header_(header),
        elements_(name),
        major_(header.version.front()),
        most_members_(most_members_per_byte * bytes) {
    if (major_ == '4') elements_.keep_unused_nodes();
  }

  Element_soup read(Lines lines, Read_report& report) {
    for (std::string section = in_.next_section(); !section.empty(); section = in_.next_section())
      read(section);
    if (!seen_.contains("$Nodes")) elements_.sort_nodes();
    for (const auto& [physical, members] : groups_) elements_.add_group(name_of(physical), members);
    if (repeated_ > 0)
      report.notes.push_back(
          fmt::format("{} elements repeated, once for each of their physical groups: read once", repeated_));
    return elements_.take(lines, report);
  }

 private:
  void read(const std::string& section) {
    const bool is_1 = major_ == '1', has_entities = header_.version == "4.1" || is_4_0();
    if (section == (is_1 ? "$NOD" : "$Nodes") || (is_1 && section == "$NOE"))
      all_nodes(section, false);
    else if (section == "$ParametricNodes" && !is_1 && header_.binary)
      in_.fail("binary nodes with parameters are not read: write them without, or the mesh as text");
    else if (section == "$ParametricNodes" && !is_1)
      all_nodes(section, true);
    else if (section == (is_1 ? "$ELM" : "$Elements"))
      all_elements(section);
    else if (section == "$PhysicalNames")
      physical_names();
    else if (section == "$Entities" && has_entities)
      entities(false);
    else if (section == "$PartitionedEntities" && has_entities)
      entities(true);
    else
      return in_.skip_section(section);
    in_.end_section(section);
  }

  void all_nodes(const std::string& section, bool have_parameters) {
    once("$Nodes", section);
    if (major_ == '4' && !have_parameters)
      blocks_of_nodes();
    else
      nodes(have_parameters);
    elements_.sort_nodes();
  }

  void all_elements(const std::string& section) {
    once("$Elements", section);
    if (major_ == '4')
      blocks_of_elements();
    else
      elements();
  }

  void once(const std::string& kind, const std::string& section) {
    if (!seen_.insert(kind).second) in_.fail(fmt::format("the section '{}' occurs twice", section));
  }

  bool is_4_0() const { return header_.version == "4" || header_.version == "4.0"; }

  /// An integer that is of 64 bits from version 4.1 on.
  Number larger(std::string_view what) { return major_ == '4' ? in_.size(what) : in_.integer(what); }

  std::array<double, 3> point() {
    std::array<double, 3> p;
    for (double& x : p) x = in_.real("a coordinate");
    return p;
  }

  /// A tag, or a number of tags.
  Number of_32_bits(std::string_view what) {
    const Number value = in_.integer(what);
    if (value != static_cast<std::int32_t>(value))  // as in Gmsh
      in_.fail(fmt::format("{}: '{}' needs more than 32 bits", what, value));
    return value;
  }

  void skip_reals(Number count) {
    for (Number i = 0; i < count; ++i) in_.real("a coordinate");
  }
  void skip_integers(Number count, std::string_view what) {
    for (Number i = 0; i < count; ++i) in_.integer(what);
  }

  Number node_number() {
    const Number node = larger("a node");
    if (node < 0 || node > std::numeric_limits<std::int32_t>::max())  // as in Gmsh
      in_.fail(fmt::format("{} is no number of a node", node));
    return node;
  }

  void node(Number number, Number parameters) {
    elements_.add_node(number, point());
    skip_reals(parameters);
  }

  void nodes(bool have_parameters) {
    const Number count = in_.number_on_line("the number of nodes");
    for (Number i = 0; i < count; ++i) {
      const Number node = node_number();
      elements_.add_node(node, point());
      if (!have_parameters) continue;
      const Number dimension = in_.integer("the dimension of an entity");
      in_.integer("an entity");
      if (dimension == 1 || dimension == 2) skip_reals(dimension);
    }
  }

  void element(Number number, const Element_kind& kind, std::span<const Number> physical) {
    nodes_.resize(static_cast<std::size_t>(kind.nodes));
    for (std::uint32_t& node : nodes_) {
      const Number named = larger("a node");
      const auto index = elements_.index(named);
      if (!index) in_.fail(fmt::format("element {} names node {}, which does not exist", number, named));
      node = *index;
    }
    const std::uint32_t position =
        is_repeated(kind, physical) ? latest_.position : elements_.add_element(number, kind, nodes_);
    if (major_ != '4') {
      latest_.dimension = kind.dimension;
      latest_.nodes = nodes_;
      latest_.physical = physical.front();
      latest_.position = position;
    }
    for (const Number tag : physical) {
      if (tag == 0) continue;
      groups_[{kind.dimension, std::abs(tag)}].push_back(position);
      if (++members_ > most_members_)
        in_.fail("its elements are in more groups than a mesh of this size has: it is broken");
    }
  }

  /// Versions 1 and 2 have one group for each element, and Gmsh writes one of several groups several times.
  bool is_repeated(const Element_kind& kind, std::span<const Number> physical) {
    const bool is_repeated = major_ != '4' && physical.front() != 0 && latest_.physical != 0 &&
                             physical.front() != latest_.physical && kind.dimension == latest_.dimension &&
                             nodes_ == latest_.nodes;
    repeated_ += is_repeated;
    return is_repeated;
  }

  Element_kind kind_of(Number type) const {
    const auto kind = element_kind_of_msh(type);
    if (!kind)
      in_.fail(
          fmt::format("elements of type {} are not read: tetrahedra, hexahedra, prisms, pyramids are", type));
    return *kind;
  }

  /// Versions 1 and 2.
  void elements() {
    const Number count = in_.number_on_line("the number of elements");
    if (header_.binary) return blocks_of_binary_elements(count);
    for (Number i = 0; i < count; ++i) {
      const Number number = in_.integer("an element"), type = in_.integer("a type of elements");
      const Element_kind kind = kind_of(type);
      const Number tags = major_ == '1' ? 2 : of_32_bits("a number of tags");
      const Number physical = tags > 0 ? of_32_bits("a tag") : 0;
      skip_integers(tags - 1, "a tag");
      if (major_ == '1')
        if (const Number n = in_.integer("a number of nodes"); n != kind.nodes)
          in_.fail(fmt::format("element {} has {} nodes, and its type {}", number, n, kind.nodes));
      element(number, kind, std::array{physical});
    }
  }

  void blocks_of_binary_elements(Number left) {
    while (left > 0) {
      const Number type = in_.integer("a type"), count = in_.integer("a size"), tags = of_32_bits("tags");
      const Element_kind kind = kind_of(type);
      if (count <= 0 || count > left)
        in_.fail(fmt::format("a block of {} elements, where {} are left", count, left));
      left -= count;
      for (Number i = 0; i < count; ++i) {
        const Number number = in_.integer("an element"), physical = tags > 0 ? of_32_bits("a tag") : 0;
        skip_integers(tags - 1, "a tag");
        element(number, kind, std::array{physical});
      }
    }
  }

  /// The head of a section of version 4: the number of blocks, and the total number of their members.
  std::pair<Number, Number> section_head(std::string_view what) {
    const Number blocks = in_.size("the number of blocks"), total = in_.size(what);
    if (!is_4_0())
      for (int i = 0; i < 2; ++i) in_.size(what);
    return {blocks, total};
  }

  struct Block {
    Dimension_and_tag entity;
    Number kind, size;  ///< the type of elements, or whether nodes have parameters
  };

  Block block_head() {
    const Number first = in_.integer("a block"), second = in_.integer("a block");
    const Number kind = in_.integer("a block"), size = in_.size("the size of a block");
    return {is_4_0() ? Dimension_and_tag{second, first} : Dimension_and_tag{first, second}, kind, size};
  }

  void expect_all(std::string_view what, Number announced, Number held) const {
    if (announced != held)
      in_.fail(fmt::format("the section announces {} {}, and its blocks hold {}", announced, what, held));
  }

  void blocks_of_nodes() {
    const auto [blocks, total] = section_head("the number of nodes");
    Number held = 0;
    std::vector<Number> numbers;
    for (Number b = 0; b < blocks; ++b) {
      const Block block = block_head();
      const Number parameters = block.kind != 0 ? std::clamp<Number>(block.entity.first, 0, 3) : 0;
      numbers.clear();
      for (Number i = 0; i < block.size; ++i, ++held) {
        numbers.push_back(node_number());
        if (is_4_0()) node(numbers.back(), parameters);
      }
      for (std::size_t i = 0; !is_4_0() && i < numbers.size(); ++i) node(numbers[i], parameters);
    }
    expect_all("nodes", total, held);
  }

  void blocks_of_elements() {
    const auto [blocks, total] = section_head("the number of elements");
    Number held = 0;
    for (Number b = 0; b < blocks; ++b) {
      const Block block = block_head();
      const Element_kind kind = kind_of(block.kind);
      const auto known = physical_of_.find({kind.dimension, block.entity.second});
      const std::vector<Number> physical =
          known != physical_of_.end() ? known->second : std::vector<Number>{};
      for (Number i = 0; i < block.size; ++i, ++held) element(in_.size("an element"), kind, physical);
    }
    expect_all("elements", total, held);
  }

  void physical_names() {
    const Number count = in_.number_on_line("the number of physical names");
    for (Number i = 0; i < count; ++i) {
      const Number dimension = in_.number_on_line("the dimension of a physical group"),
                   tag = in_.number_on_line("a physical group");
      names_[{dimension, tag}] = in_.quoted("a name in quotes");
    }
  }

  /// The physical groups of the entities of version 4: of points, curves, surfaces and volumes.
  void entities(bool are_partitioned) {
    constexpr std::string_view what = "an entity";
    if (are_partitioned) {
      in_.size(what);  // the number of partitions
      for (Number ghosts = in_.size(what); ghosts > 0; --ghosts) skip_integers(2, what);
    }
    std::array<Number, 4> counts;
    for (Number& count : counts) count = in_.size(what);
    for (Number dimension = 0; dimension < 4; ++dimension)
      for (Number i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        const Number tag = in_.integer(what);
        if (are_partitioned) {
          skip_integers(2, what);  // the entity that it is part of
          skip_integers(in_.size(what), what);
        }
        skip_reals(dimension == 0 && !is_4_0() ? 3 : 6);  // a point, or a box
        auto& physical = physical_of_[{dimension, tag}];
        for (Number groups = in_.size(what); groups > 0; --groups) physical.push_back(of_32_bits(what));
        if (dimension > 0) skip_integers(in_.size(what), what);  // its boundary
      }
  }

  std::string name_of(const Dimension_and_tag& physical) const {
    constexpr std::array<const char*, 4> kinds{"point", "curve", "surface", "volume"};
    const auto named = names_.find(physical);
    if (named != names_.end() && !named->second.empty()) return named->second;
    return fmt::format("physical {} {}", kinds[static_cast<std::size_t>(physical.first)], physical.second);
  }

  /// The element before.
  struct Latest {
    int dimension = 0;
    std::vector<std::uint32_t> nodes;
    Number physical = 0;
    std::uint32_t position = 0;
  };

  Msh_source& in_;
  const Msh_header& header_;
  Element_list elements_;
  char major_;
  std::size_t members_ = 0, most_members_;  ///< of all groups
  std::set<std::string> seen_;
  std::vector<std::uint32_t> nodes_;
  Latest latest_;
  std::size_t repeated_ = 0;
  std::map<Dimension_and_tag, std::string> names_;
  std::map<Dimension_and_tag, std::vector<Number>> physical_of_;    ///< of an entity
  std::map<Dimension_and_tag, std::vector<std::uint32_t>> groups_;  ///< elements of physical groups
};

}  // namespace

Element_soup parse_msh(const std::string& name, std::string_view bytes, Lines lines, Read_report& report) {
  const Msh_header header = read_msh_header(name, bytes);
  report.format = fmt::format("Gmsh {}{}", header.version, header.binary ? " (binary)" : "");
  constexpr std::array<std::string_view, 8> known{"1", "2", "2.0", "2.1", "2.2", "4", "4.0", "4.1"};
  if (std::find(known.begin(), known.end(), header.version) == known.end())
    fail(name, fmt::format("version {} of .msh is not read: 1, 2, 4.0 and 4.1 are", shown(header.version)));
  if (header.binary && header.version.starts_with("4") && header.version != "4.1")
    fail(name, "binary files of version 4.0 are not read: write the mesh as version 4.1, or as text");
  constexpr std::int64_t size_of_sizes = 8;  // bytes
  if (header.binary && header.size_of_sizes != size_of_sizes)
    fail(name, fmt::format("has numbers of {} bytes: only those of 8 are read", header.size_of_sizes));
  const auto source = header.binary ? msh_binary(name, bytes) : msh_text(name, bytes);
  return Msh_reader(name, *source, header, bytes.size()).read(lines, report);
}

}  // namespace cellwalk::io
