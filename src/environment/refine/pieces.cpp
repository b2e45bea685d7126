// SPDX-License-Identifier: LGPL-3.0-or-later
// Overlays of facets in their planes, and a soup written cell by cell.
#include "pieces.h"

#include <algorithm>
#include <utility>

#include "bent_facets.h"
#include "crossings.h"
#include "overlay.h"

namespace cellwalk::detail {
namespace {

/// The points of one overlay, numbered as they come.
class Local_points {
 public:
  Local_points(std::span<const Point<3>> points, const Flat_view& view) : points_(points), view_(view) {}

  Overlay_loop loop(const Facet_loop& facet) {
    Overlay_loop loop;
    for (const std::uint32_t v : facet) {
      const auto [at, is_new] = local_.try_emplace(v, static_cast<std::uint32_t>(names_.size()));
      if (is_new) {
        names_.push_back(v);
        flat_.push_back(view_(points_[v]));
      }
      loop.push_back(at->second);
    }
    return loop;
  }
  std::span<const Point<2>> flat() const { return flat_; }
  Facet_loop facet(const Overlay_loop& loop) const {
    Facet_loop facet;
    for (const std::uint32_t v : loop) facet.push_back(names_[v]);
    return facet;
  }

 private:
  std::span<const Point<3>> points_;
  Flat_view view_;
  std::unordered_map<std::uint32_t, std::uint32_t> local_;
  std::vector<std::uint32_t> names_;
  std::vector<Point<2>> flat_;
};

/// The name that a point has in a cell.
template <int D>
class Own_names {
 public:
  Own_names(const Cell_soup<D>& soup, const Cell_soup<D>& cells, std::size_t c)
      : soup_(soup),
        cells_(cells),
        first_(soup.facet_begin[soup.cell_begin[c]]),
        last_(soup.facet_begin[soup.cell_begin[c + 1]]),
        are_same_(std::equal(soup.vertices.begin() + first_, soup.vertices.begin() + last_,
                             cells.vertices.begin() + first_)) {}

  std::uint32_t operator()(std::uint32_t v) const {
    for (std::uint32_t i = first_; !are_same_ && i < last_; ++i)
      if (cells_.vertices[i] == v && soup_.points[soup_.vertices[i]] == cells_.points[v])
        return soup_.vertices[i];
    return v;
  }

 private:
  const Cell_soup<D>&soup_, &cells_;
  std::uint32_t first_, last_;
  bool are_same_;
};

}  // namespace

template <>
std::optional<Pieces> pieces_of<3>(std::span<const Point<3>> points, std::span<const Lone_facet<3>> facets,
                                   std::span<const Facet_pair> pairs, const Sides<3>& sides,
                                   double tolerance) {
  std::vector<Facet_pair> both_ways;
  for (const auto& [i, j] : pairs) both_ways.insert(both_ways.end(), {{i, j}, {j, i}});
  std::sort(both_ways.begin(), both_ways.end());
  Pieces pieces;
  for (std::size_t begin = 0, end = 0; begin < both_ways.size(); begin = end) {
    const Lone_facet<3>& facet = facets[both_ways[begin][0]];
    Local_points local(points, flat_view(points, facet));
    const Overlay_loop rim = local.loop(sides.subdivided(facet.loop));
    std::vector<Overlay_loop> others;
    for (end = begin; end < both_ways.size() && both_ways[end][0] == both_ways[begin][0]; ++end) {
      others.push_back(local.loop(sides.subdivided(facets[both_ways[end][1]].loop)));
      std::reverse(others.back().begin(), others.back().end());
    }
    std::vector<Facet_loop>& parts = pieces[facet.facet];
    for (const Overlay_loop& loop : overlay(local.flat(), rim, others, tolerance))
      parts.push_back(local.facet(loop));
    if (parts.empty()) return {};
  }
  return pieces;
}

template <>
std::optional<Pieces> pieces_of<2>(std::span<const Point<2>>, std::span<const Lone_facet<2>> facets,
                                   std::span<const Facet_pair> pairs, const Sides<2>& sides, double) {
  Pieces pieces;
  for (const Facet_pair& pair : pairs)
    for (const std::uint32_t i : pair) {
      std::vector<Facet_loop>& parts = pieces[facets[i].facet];
      if (!parts.empty()) continue;
      const Facet_loop chain = sides.subdivided(facets[i].loop);
      for (std::size_t k = 1; k < chain.size(); ++k) parts.push_back({chain[k - 1], chain[k]});
    }
  return pieces;
}

template <int D>
Cell_soup<D> with_pieces(const Cell_soup<D>& soup, const Cell_soup<D>& cells, const Pieces& pieces,
                         const Sides<D>& sides, double tolerance, std::vector<std::uint32_t>& begin) {
  Cell_soup<D> result;
  result.points = cells.points;
  begin.assign(1, 0);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const Own_names<D> own(soup, cells, c);
    const auto add_whole = [&](Facet_loop loop, std::size_t f) {
      for (std::uint32_t& v : loop) v = own(v);
      result.add_facet(loop, soup.impassable[f]);
    };
    const auto add = [&](const Facet_loop& loop, std::size_t f) {
      std::vector<Facet_loop> triangles;
      if constexpr (D == 3)
        if (tolerance != 0) triangles = triangles_of_bent(cells.points, loop, tolerance);
      if (triangles.empty()) triangles.push_back(loop);
      for (const Facet_loop& triangle : triangles) add_whole(triangle, f);
    };
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      const auto found = pieces.find(f);
      if (found == pieces.end())
        add(D == 2 ? Facet_loop(cells.facet(f).begin(), cells.facet(f).end())
                   : sides.subdivided(cells.facet(f)),
            f);
      else
        for (const Facet_loop& loop : found->second) add(loop, f);
      begin.push_back(static_cast<std::uint32_t>(result.facet_count()));
    }
    result.end_cell(soup.solid[c]);
  }
  return result;
}

template Cell_soup<2> with_pieces(const Cell_soup<2>&, const Cell_soup<2>&, const Pieces&, const Sides<2>&,
                                  double, std::vector<std::uint32_t>&);
template Cell_soup<3> with_pieces(const Cell_soup<3>&, const Cell_soup<3>&, const Pieces&, const Sides<3>&,
                                  double, std::vector<std::uint32_t>&);

}  // namespace cellwalk::detail
