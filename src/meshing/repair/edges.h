// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a surface under repair, with the triangles at each, and sets that are joined step by step.
#ifndef CELLWALK_MESHING_REPAIR_EDGES_H
#define CELLWALK_MESHING_REPAIR_EDGES_H

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "facets.h"

namespace cellwalk::detail {

/// The use of an edge by a triangle.
struct Edge_use {
  std::uint32_t low, high;
  std::uint32_t facet;
  bool forward;  ///< from low to high

  std::uint32_t from() const { return forward ? low : high; }
  std::uint32_t to() const { return forward ? high : low; }
  bool same_edge(const Edge_use& other) const { return low == other.low && high == other.high; }
};

/// The uses of all edges, those of an edge one after the other. Sheets are left out.
inline std::vector<Edge_use> edge_uses(const std::vector<Facet>& facets) {
  std::vector<Edge_use> uses;
  uses.reserve(3 * facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    if (facets[f].part == Part::sheet) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = facets[f].corners[k], b = facets[f].corners[(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Edge_use& a, const Edge_use& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  return uses;
}

/// Calls visit(uses of the edge) for each edge.
template <class Visit>
void for_each_edge(std::span<const Edge_use> uses, const Visit& visit) {
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    for (j = i; j < uses.size() && uses[j].same_edge(uses[i]);) ++j;
    visit(uses.subspan(i, j - i));
  }
}

/// Disjoint sets of numbers; the smallest member represents each.
class Joined_sets {
 public:
  explicit Joined_sets(std::size_t n) : root_(n) { std::iota(root_.begin(), root_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    root_[std::max(i, j)] = std::min(i, j);
  }
  /// The sets numbered from 0, in the order of their smallest members.
  std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number(root_.size());
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < root_.size(); ++i) number[i] = find(i) == i ? count++ : number[find(i)];
    return number;
  }

 private:
  std::vector<std::uint32_t> root_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_EDGES_H
