// SPDX-License-Identifier: LGPL-3.0-or-later
// Points renamed by their coordinates, and corners within the tolerance by a union of pairs.
#include "joining.h"

#include <cellwalk/internal/environment/box_grid.h>
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
bool join_corners(Cell_soup<D>& cells, std::span<const Lone_facet<D>> facets, double tolerance,
                  Refinement& done) {
  std::vector<double> within(cells.points.size(), tolerance);
  Box_grid<D> corners;
  for (const Lone_facet<D>& facet : facets)
    for (const std::uint32_t v : facet.loop) {
      within[v] = std::min(within[v], largest_gap<D>(facet.box, tolerance));
      corners.set(v, {cells.points[v], cells.points[v]});
    }
  Unions unions(cells.points.size());
  bool is_any = false;
  std::vector<std::uint32_t> near;
  for (const Lone_facet<D>& facet : facets)
    for (const std::uint32_t u : facet.loop) {
      const Vector<D> margin = with_all_coordinates<D>(within[u]);
      near.clear();
      corners.find({cells.points[u] - margin, cells.points[u] + margin}, near);
      for (const std::uint32_t v : near) {
        const double distance = length(cells.points[u] - cells.points[v]);
        if (u == v || distance > std::min(within[u], within[v]) || unions.root(u) == unions.root(v)) continue;
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
template bool join_corners<2>(Cell_soup<2>&, std::span<const Lone_facet<2>>, double, Refinement&);
template bool join_corners<3>(Cell_soup<3>&, std::span<const Lone_facet<3>>, double, Refinement&);

}  // namespace cellwalk::detail
