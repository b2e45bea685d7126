// SPDX-License-Identifier: LGPL-3.0-or-later
#include "boundary_index.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace cellwalk::detail {
namespace {

bool is_same(const Box_corner<2>& a, const Box_corner<2>& b) {
  return a.get<0>() == b.get<0>() && a.get<1>() == b.get<1>();
}

bool is_same(const Box_corner<3>& a, const Box_corner<3>& b) {
  return a.get<0>() == b.get<0>() && a.get<1>() == b.get<1>() && a.get<2>() == b.get<2>();
}

/// Exact equality; Boost's equals() allows a tolerance.
template <class Corner>
bool is_same(const boost::geometry::model::box<Corner>& a, const boost::geometry::model::box<Corner>& b) {
  return is_same(a.min_corner(), b.min_corner()) && is_same(a.max_corner(), b.max_corner());
}

}  // namespace

template <int D>
Tree_box<D> box_of(std::span<const Point<D>> points, std::span<const std::uint32_t> vertices) {
  Point<D> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const std::uint32_t v : vertices)
    for (int i = 0; i < D; ++i) {
      low[i] = std::min(low[i], points[v][i]);
      high[i] = std::max(high[i], points[v][i]);
    }
  if constexpr (D == 2) return {{low[0], low[1]}, {high[0], high[1]}};
  if constexpr (D == 3) return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

template <int D>
Tree_box<D> box_of(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
  Tree_box<D> box = box_of<D>(snapshot.points(), snapshot.view(cells[0]).vertices);
  for (const Cell c : cells)
    boost::geometry::expand(box, box_of<D>(snapshot.points(), snapshot.view(c).vertices));
  return box;
}

template <int D>
std::vector<typename Boundary_index<D>::Entry> Boundary_index<D>::entries(const Snapshot<D>& snapshot,
                                                                          std::span<const Cell> cells) {
  std::vector<Entry> result;
  for (const Cell c : cells)
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = snapshot.half_facet(c, i);
      if (snapshot.neighbour(f) == Cell::none)
        result.emplace_back(box_of<D>(snapshot.points(), snapshot.loop(f)), to_index(f));
    }
  return result;
}

template <int D>
Boundary_index<D>::Boundary_index(const Snapshot<D>& snapshot) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (snapshot.cell(i) != Cell::none) cells.push_back(snapshot.cell(i));
  tree_ = decltype(tree_)(entries(snapshot, cells));
}

template <int D>
void Boundary_index<D>::replace(std::span<const Entry> old, std::span<const Entry> now) {
  const auto is_in = [](const Entry& entry, std::span<const Entry> entries) {
    return std::any_of(entries.begin(), entries.end(), [&](const Entry& other) {
      return other.second == entry.second && is_same(other.first, entry.first);
    });
  };
  for (const Entry& entry : old)
    if (!is_in(entry, now)) tree_.remove(entry);
  for (const Entry& entry : now)
    if (!is_in(entry, old)) tree_.insert(entry);
}

template <int D>
std::vector<Half_facet> Boundary_index<D>::meeting(const Tree_box<D>& box) const {
  std::vector<Half_facet> result;
  for (auto it = tree_.qbegin(boost::geometry::index::intersects(box)); it != tree_.qend(); ++it)
    result.push_back(Half_facet{it->second});
  std::sort(result.begin(), result.end());
  return result;
}

template Tree_box<2> box_of<2>(std::span<const Point<2>>, std::span<const std::uint32_t>);
template Tree_box<3> box_of<3>(std::span<const Point<3>>, std::span<const std::uint32_t>);
template Tree_box<2> box_of<2>(const Snapshot<2>&, std::span<const Cell>);
template Tree_box<3> box_of<3>(const Snapshot<3>&, std::span<const Cell>);
template class Boundary_index<2>;
template class Boundary_index<3>;

}  // namespace cellwalk::detail
