// SPDX-License-Identifier: LGPL-3.0-or-later
// The edges of membranes split at both borders of the slit, and the facets between opened.
#include "slitter.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <utility>

namespace cellwalk::detail {

template <int D>
bool Slitter<D>::is_membrane(Half_facet facet) const {
  const Snapshot<D>& s = snapshot();
  const Cell other = s.neighbour(facet);
  return s.is_impassable(facet) && !s.is_solid(s.cell_of(facet)) && other != Cell::none && !s.is_solid(other);
}

/// Edges of membranes that are triangles (2D: segments), of simplices near the blade.
template <int D>
std::set<std::array<std::uint32_t, 2>> Slitter<D>::near_edges() const {
  const Snapshot<D>& s = snapshot();
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const Cell c : s.tissue_boxes().find(s, [&](const Box<D>& box) { return blade_.may_pass(box); })) {
    if (s.view(c).vertex_count() != D + 1) continue;
    for (std::size_t f = 0; f < s.facet_count(c); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(c, f);
      if (!is_membrane(facet)) continue;
      const std::vector<std::uint32_t> loop = s.loop(facet);
      for (const std::uint32_t u : loop)
        for (const std::uint32_t v : loop)
          if (u < v) edges.insert({u, v});
    }
  }
  return edges;
}

/// Where an edge that meets the blade crosses a border of the slit; nothing if it leads to the other border
/// only, lies in the blade, or does not meet it.
template <int D>
std::optional<double> Slitter<D>::share_at(Border border, std::uint32_t u, std::uint32_t v) const {
  const Point<D>&x = snapshot().point(u), &y = snapshot().point(v);
  const bool has_u = blade_.has(x), has_v = blade_.has(y);
  if (has_u && has_v) return std::nullopt;
  std::optional<double> at = has_u ? 0 : has_v ? 1 : blade_.passes(x, y);
  if (!at) return std::nullopt;
  const double height_u = has_u ? 0 : blade_.side(x), height_v = has_v ? 0 : blade_.side(y);
  const double rise = height_v - height_u;  // from the one end to the other
  const double sign = border == Border::front ? 1 : -1;
  const bool goes_to_u = sign * rise < 0;
  if (goes_to_u ? has_u : has_v) return std::nullopt;
  return *at + sign * half_width_ / rise;
}

template <int D>
std::vector<typename Slitter<D>::Crossing> Slitter<D>::crossings(Border border) const {
  std::vector<Crossing> result;
  for (const auto& edge : near_edges())
    if (const auto share = share_at(border, edge[0], edge[1])) result.push_back({edge, *share});
  return result;
}

template <int D>
void Slitter<D>::split(Border border) {
  for (const auto& [edge, share] : crossings(border)) {
    ++report_.edges;
    // Not greater than 0, or not less than 1, if the edge runs along the blade, too.
    if (!(share > 0 && share < 1)) {
      vertices_.insert(edge[share > 0 ? 1 : 0]);
      ++report_.snapped;
      continue;
    }
    const Point<D> at = point_on<D>(snapshot().point(edge[0]), snapshot().point(edge[1]), share);
    const auto point = splitter_.split_edge(edge[0], edge[1], at, Splitter<D>::Walls::move_among_nothing);
    if (!point) continue;
    ++report_.split;
    report_.points.push_back({*point, edge, share});
    vertices_.insert(*point);
  }
}

/// Opens the membranes between the borders.
template <int D>
void Slitter<D>::open() {
  const Snapshot<D>& s = snapshot();
  for (const std::uint32_t vertex : vertices_)
    for (const Cell c : environment_.cells_around(vertex))
      for (std::size_t f = 0; f < s.facet_count(c); ++f) {
        const Half_facet facet = Snapshot<D>::half_facet(c, f);
        if (!is_membrane(facet)) continue;
        const std::vector<std::uint32_t> loop = s.loop(facet);
        if (!std::ranges::all_of(loop, [&](std::uint32_t v) { return vertices_.contains(v); })) continue;
        toggle_.open(facet);
        ++report_.slit;
      }
}

template <int D>
void Slitter<D>::prepare() {
  for (const auto& edge : near_edges()) splitter_.open_groups(edge[0], edge[1]);
}

template <int D>
Cut_report Slitter<D>::run() {
  for (const auto& edge : near_edges())
    for (const std::uint32_t v : edge)
      if (blade_.has(snapshot().point(v))) vertices_.insert(v);
  split(Border::back);
  split(Border::front);
  open();
  return std::move(report_);
}

template class Slitter<2>;
template class Slitter<3>;

}  // namespace cellwalk::detail
