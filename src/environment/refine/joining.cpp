// SPDX-License-Identifier: LGPL-3.0-or-later
// Points renamed by their coordinates, and corners within the tolerance by a union of pairs.
#include "joining.h"

#include <cellwalk/kernel/error.h>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "environment/certify/common_part.h"
#include "environment/soup/describe_place.h"

namespace cellwalk::detail {
namespace {

/// Points with others that stand for them.
class Unions {
 public:
  explicit Unions(std::size_t points) : parent_(points) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void unite(std::uint32_t u, std::uint32_t v) {
    const auto [low, high] = std::minmax({root(u), root(v)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

template <int D>
void refuse_collapsed(const Cell_soup<D>& cells, Unions& unions) {
  for (std::size_t c = 0; c < cells.cell_count(); ++c)
    for (std::size_t f = cells.cell_begin[c]; f < cells.cell_begin[c + 1]; ++f) {
      const auto loop = cells.facet(f);
      for (std::size_t i = 0; i < loop.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (unions.root(loop[i]) == unions.root(loop[j]))
            throw Error(Error_code::not_certified, "cell " + std::to_string(c) + ": two of its corners at " +
                                                       describe_place(cells.points[loop[i]]) +
                                                       " would become one: give a smaller --conform");
    }
}

}  // namespace

template <int D>
Cell_soup<D> united(const Cell_soup<D>& soup) {
  Cell_soup<D> cells = soup;
  const auto& points = soup.points;
  std::vector<std::uint32_t> order(points.size()), name(points.size());
  std::iota(order.begin(), order.end(), 0u);
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t u, std::uint32_t v) {
    return points[u] != points[v] ? points[u] < points[v] : u < v;
  });
  for (std::size_t i = 0, first = 0; i < order.size(); ++i) {
    if (points[order[i]] != points[order[first]]) first = i;
    name[order[i]] = order[first];
  }
  for (std::uint32_t& v : cells.vertices) v = name[v];
  return cells;
}

template <int D>
bool join_corners(Cell_soup<D>& cells, std::span<const Lone_facet<D>> facets,
                  std::span<const Facet_pair> pairs, double tolerance, Refinement& done) {
  Unions unions(cells.points.size());
  bool is_any = false;
  for (const auto& [i, j] : pairs) {
    const double within =
        std::min(largest_gap<D>(facets[i].box, tolerance), largest_gap<D>(facets[j].box, tolerance));
    for (const std::uint32_t u : facets[i].loop)
      for (const std::uint32_t v : facets[j].loop) {
        const double distance = length(cells.points[u] - cells.points[v]);
        if (u == v || distance > within) continue;
        unions.unite(u, v);
        done.farthest = std::max(done.farthest, distance);
        is_any = true;
      }
  }
  if (!is_any) return false;
  refuse_collapsed(cells, unions);
  for (std::uint32_t v = 0; v < cells.points.size(); ++v) done.points_joined += unions.root(v) != v;
  for (std::uint32_t& v : cells.vertices) v = unions.root(v);
  return true;
}

template Cell_soup<2> united(const Cell_soup<2>&);
template Cell_soup<3> united(const Cell_soup<3>&);
template bool join_corners<2>(Cell_soup<2>&, std::span<const Lone_facet<2>>, std::span<const Facet_pair>,
                              double, Refinement&);
template bool join_corners<3>(Cell_soup<3>&, std::span<const Lone_facet<3>>, std::span<const Facet_pair>,
                              double, Refinement&);

}  // namespace cellwalk::detail
