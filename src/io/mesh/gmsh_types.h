// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the numbers of element types and of nodes in .msh files.
#ifndef CELLWALK_IO_MESH_GMSH_TYPES_H
#define CELLWALK_IO_MESH_GMSH_TYPES_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace cellwalk::io {

/// The number of nodes of an element by its type; 0 if the type is unknown.
int nodes_of_msh_type(std::int64_t type);

/// The numbers of the nodes of a file, in any order and with gaps.
class Node_numbers {
 public:
  /// True for a valid number of a node, which Gmsh stores as an int.
  static bool is_number(std::int64_t node) {
    return node >= 0 && node <= std::numeric_limits<std::int32_t>::max();
  }

  void add(std::int64_t node) { nodes_.push_back(node); }

  /// To be called after the last one, before contains().
  void sort() {
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    is_gapless_ =
        !nodes_.empty() && nodes_.back() - nodes_.front() + 1 == static_cast<std::int64_t>(nodes_.size());
  }

  bool contains(std::int64_t node) const {
    if (nodes_.empty() || node < nodes_.front() || node > nodes_.back()) return false;
    return is_gapless_ || std::binary_search(nodes_.begin(), nodes_.end(), node);
  }

 private:
  std::vector<std::int64_t> nodes_;
  bool is_gapless_ = false;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_GMSH_TYPES_H
