// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: nodes and elements of a file of Gmsh, MEDIT or I-deas, by the numbers that they have there.
#ifndef CELLWALK_IO_MESH_ELEMENT_LIST_H
#define CELLWALK_IO_MESH_ELEMENT_LIST_H

#include <cellwalk/io/mesh_file.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "collapsed_cells.h"
#include "element_soup.h"

namespace cellwalk::io {

/// A kind of elements. Its first nodes are its corners; those of volumes are in the order of the soup's
/// functions.
struct Element_kind {
  int dimension = 0, corners = 0, nodes = 0;
  bool is_straightened() const { return dimension > 0 && nodes != corners; }
};

/// Whether line elements are read.
enum class Lines { left_out, read };

class Element_list {
 public:
  explicit Element_list(std::string name) : name_(std::move(name)) {}

  /// Of several nodes with one number the first counts.
  /// \pre the number is at least 0, and needs at most 31 bits
  void add_node(std::int64_t number, const Point<3>& point) { nodes_.emplace_back(number, point); }

  /// To be called once, after the last node and before the first element.
  void sort_nodes();

  /// The index of a node among all in the order of their numbers.
  std::optional<std::uint32_t> index(std::int64_t number) const;

  /// Adds an element whose nodes are given by index(). Returns its position in the list.
  std::uint32_t add_element(std::int64_t number, const Element_kind& kind,
                            std::span<const std::uint32_t> nodes);

  /// The positions of all elements by their numbers; of several with one number, the first.
  std::unordered_map<std::int64_t, std::uint32_t> positions() const;

  /// Adds elements, by position, to a group. A name that a group cannot have is changed, with a note.
  void add_group(const std::string& name, std::span<const std::uint32_t> elements);

  /// Nodes of no element stay points.
  void keep_unused_nodes() { keeps_unused_ = true; }

  /// The content in the order of the elements' numbers, or of the file if these repeat.
  /// \throw Error(input) for an element that has no inside
  Element_soup take(Lines lines, Read_report& report);

 private:
  struct Element {
    std::int64_t number;
    std::uint32_t first;  ///< of its corners
    std::uint8_t dimension, corners;
  };

  /// The points of used nodes; corners are renumbered.
  std::vector<Point<3>> take_points(Read_report& report);
  std::vector<std::uint32_t> order(Read_report& report) const;
  void add(Element_soup& soup, const Element& element, Collapsed_cells& collapsed) const;

  std::string name_;
  std::vector<std::pair<std::int64_t, Point<3>>> nodes_;
  std::vector<std::uint8_t> is_used_;  ///< per node
  bool is_gapless_ = false, keeps_unused_ = false;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> corners_;
  std::map<std::string, std::vector<std::uint32_t>> groups_;
  std::vector<std::string> notes_;
  std::size_t straightened_ = 0;
};

/// The kind of an element of Gmsh by its number; none if it is not known.
std::optional<Element_kind> element_kind_of_msh(std::int64_t type);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_ELEMENT_LIST_H
