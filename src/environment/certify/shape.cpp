// SPDX-License-Identifier: LGPL-3.0-or-later
// The tests that facets form a sphere, that they are planar, and that the cell is convex.
#include "shape.h"

#include <cellwalk/internal/environment/cell_check.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

namespace cellwalk {
namespace detail {
namespace {

/// The use of an edge by a facet.
struct Edge_use {
  std::uint16_t low, high;
  bool ascending;
  std::uint16_t facet;

  bool operator<(const Edge_use& other) const {
    return std::tie(low, high, ascending) < std::tie(other.low, other.high, other.ascending);
  }
};

std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

template <>
Cell_check check_shape<3>(const Cell_shape& shape) {
  const std::size_t facets = shape.facet_count();
  std::vector<Edge_use> uses;
  std::vector<std::size_t> latest_facet(shape.vertex_count, facets);  // to use each vertex; none yet
  for (std::size_t f = 0; f < facets; ++f) {
    const auto loop = shape.loop(f);
    if (loop.size() < 3) return {Cell_defect::degenerate_facet, f};
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint16_t u = loop[i], v = loop[(i + 1) % loop.size()];
      if (latest_facet[u] == f) return {Cell_defect::facet_not_convex, f};
      latest_facet[u] = f;
      uses.push_back({std::min(u, v), std::max(u, v), u < v, static_cast<std::uint16_t>(f)});
    }
  }
  std::sort(uses.begin(), uses.end());
  std::vector<std::size_t> parent(facets);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::size_t components = facets;
  for (std::size_t i = 0; i < uses.size(); i += 2) {
    // Sorted, the two uses of a sound edge are neighbours: descending, then ascending.
    const bool is_pair = i + 1 < uses.size() && uses[i].low == uses[i + 1].low &&
                         uses[i].high == uses[i + 1].high && !uses[i].ascending && uses[i + 1].ascending;
    if (!is_pair) return {Cell_defect::not_closed, uses[i].facet};
    const bool is_crowded =
        i + 2 < uses.size() && uses[i].low == uses[i + 2].low && uses[i].high == uses[i + 2].high;
    if (is_crowded) return {Cell_defect::not_closed, uses[i + 2].facet};
    const std::size_t a = root(parent, uses[i].facet), b = root(parent, uses[i + 1].facet);
    if (a != b) --components;
    parent[a] = b;
  }
  // A connected closed surface of characteristic 2 is a sphere, without vertices where it touches itself.
  const std::size_t vertices = latest_facet.size() - static_cast<std::size_t>(std::count(
                                                         latest_facet.begin(), latest_facet.end(), facets));
  const bool is_sphere = components == 1 && vertices + facets == uses.size() / 2 + 2;
  if (!is_sphere || vertices != shape.vertex_count) return {Cell_defect::not_closed, 0};
  return {};
}

template <>
Cell_check check_shape<2>(const Cell_shape& shape) {
  const std::size_t n = shape.facet_count();
  std::vector<bool> is_used(shape.vertex_count, false);
  for (std::size_t i = 0; i < n; ++i) {
    const auto edge = shape.loop(i), next = shape.loop((i + 1) % n);
    if (edge.size() != 2 || next.size() != 2 || edge[1] != next[0] || is_used[edge[0]])
      return {Cell_defect::not_closed, i};
    is_used[edge[0]] = true;
  }
  if (n < 3 || n != shape.vertex_count) return {Cell_defect::not_closed, 0};
  return {};
}

}  // namespace detail

template <int D>
Cell_check check_cell(const Cell_view<D>& cell) {
  const Cell_check check = detail::check_shape<D>(*cell.shape);
  return check.defect == Cell_defect::none ? detail::check_geometry<D>(cell) : check;
}

template Cell_check check_cell<2>(const Cell_view<2>&);
template Cell_check check_cell<3>(const Cell_view<3>&);

std::string describe(const Cell_check& check) {
  return detail::describe(check.defect, "facet " + std::to_string(check.facet));
}

std::string detail::describe(Cell_defect defect, const std::string& facet) {
  switch (defect) {
    case Cell_defect::none:
      return "no defect";
    case Cell_defect::not_finite:
      return "a coordinate is not a finite number";
    case Cell_defect::not_closed:
      return "its facets do not form one closed surface (see " + facet + ")";
    case Cell_defect::degenerate_facet:
      return facet + " has all its vertices on one line";
    case Cell_defect::facet_not_planar:
      return facet + " is not exactly planar";
    case Cell_defect::facet_not_convex:
      return facet + " is not a convex polygon that turns exactly once";
    case Cell_defect::not_convex:
      return "a vertex lies strictly outside " + facet;
    case Cell_defect::inverted:
      return "it is inverted: all its facets face inwards";
    case Cell_defect::flat:
      return "it has no volume";
    case Cell_defect::wound:
      return "its surface winds over itself at " + facet;
  }
  return "unknown defect";
}

}  // namespace cellwalk
