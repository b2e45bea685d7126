// SPDX-License-Identifier: LGPL-3.0-or-later
// The corners of cells joined around each vertex, and vertices doubled where slits part them.
#include <cellwalk/internal/generators/slits.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace cellwalk {
namespace {

constexpr std::uint32_t on_boundary = 0xffffffffu;

/// Disjoint sets, joined pairwise. Each is named by its least member, unlike those of Boost, which are named
/// by rank.
class Disjoint_sets {
 public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The other side of each half-facet, or on_boundary.
template <int D>
std::vector<std::uint32_t> pair_up(const Cell_soup<D>& soup) {
  std::vector<std::uint32_t> opposite(soup.facet_count(), on_boundary);
  std::map<std::vector<std::uint32_t>, std::uint32_t> open;
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    std::vector<std::uint32_t> key(soup.facet(f).begin(), soup.facet(f).end());
    std::sort(key.begin(), key.end());
    const auto [other, is_new] = open.try_emplace(std::move(key), f);
    if (is_new) continue;
    opposite[f] = other->second;
    opposite[other->second] = f;
    open.erase(other);
  }
  return opposite;
}

/// Joins the corners of cells at each vertex across the facets for which `passes` holds. A corner is an entry
/// of soup.vertices; those of one cell at one vertex are joined from the start.
template <int D, class Passes>
Disjoint_sets join_corners(const Cell_soup<D>& soup, const std::vector<std::uint32_t>& opposite,
                           const Passes& passes) {
  Disjoint_sets corners(soup.vertices.size());
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    std::map<std::uint32_t, std::uint32_t> first;
    for (std::uint32_t i = soup.facet_begin[soup.cell_begin[c]]; i < soup.facet_begin[soup.cell_begin[c + 1]];
         ++i)
      corners.join(first.try_emplace(soup.vertices[i], i).first->second, i);
  }
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = opposite[f];
    if (g == on_boundary || g < f || !passes(f)) continue;
    for (std::uint32_t i = soup.facet_begin[f]; i < soup.facet_begin[f + 1]; ++i)
      for (std::uint32_t j = soup.facet_begin[g]; j < soup.facet_begin[g + 1]; ++j)
        if (soup.vertices[i] == soup.vertices[j]) corners.join(i, j);
  }
  return corners;
}

/// A point strictly inside a facet, if one of those tried is exact in doubles.
template <int D>
std::optional<Point<D>> inner_point(const Cell_soup<D>& soup, std::span<const std::uint32_t> loop) {
  Predicate_counts counts;
  const Point<D>& a = soup.points[loop[0]];
  const Point<D>& b = soup.points[loop[1]];
  if constexpr (D == 2) {
    const Point<2> middle = a + 0.5 * (b - a);
    if (Exact::orientation(counts, a, b, middle) != 0) return {};
    return middle;
  } else {
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Point<3>& c = soup.points[loop[i]];
      if (are_collinear(a, b, c)) continue;
      const Point<3> inside = a + 0.5 * (c - a) + 0.25 * (b - a);
      if (Exact::orientation(counts, a, b, c, inside) != 0) return {};
      return inside;
    }
    return {};
  }
}

/// Appends a facet cut around a point inside it.
template <int D>
void add_cut_facet(Cell_soup<D>& soup, std::span<const std::uint32_t> loop, std::uint32_t inside) {
  if constexpr (D == 2) {
    soup.add_facet({loop[0], inside});
    soup.add_facet({inside, loop[1]});
  } else {
    for (std::size_t i = 0; i < loop.size(); ++i)
      soup.add_facet({inside, loop[i], loop[(i + 1) % loop.size()]});
  }
}

template <int D>
bool have_equal_vertices(const Cell_soup<D>& soup, std::uint32_t f, std::uint32_t g) {
  return std::is_permutation(soup.facet(f).begin(), soup.facet(f).end(), soup.facet(g).begin(),
                             soup.facet(g).end());
}

/// Gives each group of corners that slits separate a vertex of its own.
template <int D>
void part_vertices(Cell_soup<D>& soup, const std::vector<std::uint32_t>& opposite,
                   const std::vector<std::uint8_t>& is_parted) {
  Disjoint_sets whole = join_corners(soup, opposite, [](std::uint32_t) { return true; });
  Disjoint_sets parts = join_corners(soup, opposite, [&](std::uint32_t f) { return !is_parted[f]; });
  std::map<std::uint32_t, std::uint32_t> copy_of;  // of each part except the first of its whole
  for (std::uint32_t i = 0; i < soup.vertices.size(); ++i) {
    const std::uint32_t part = parts.find(i);
    if (part == whole.find(i)) continue;  // both are named by their least corner
    const auto [copy, is_new] = copy_of.try_emplace(part, static_cast<std::uint32_t>(soup.points.size()));
    if (is_new) soup.points.push_back(Point<D>(soup.points[soup.vertices[i]]));
    soup.vertices[i] = copy->second;
  }
}

}  // namespace

template <int D>
void open_slits(Cell_soup<D>& soup, std::span<const std::uint8_t> is_slit) {
  const std::vector<std::uint32_t> opposite = pair_up(soup);
  std::vector<std::uint8_t> is_parted(soup.facet_count());
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f)
    is_parted[f] = opposite[f] != on_boundary && (is_slit[f] || is_slit[opposite[f]]);
  part_vertices(soup, opposite, is_parted);

  // For each facet that is to be cut, the new point in it.
  std::vector<std::uint32_t> inside(soup.facet_count(), on_boundary);
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = opposite[f];
    if (!is_parted[f] || g < f || !have_equal_vertices(soup, f, g)) continue;
    const auto point = inner_point(soup, soup.facet(f));
    if (!point) soup.impassable[f] = soup.impassable[g] = 1;
    if (!point) continue;
    const auto add_point = [&] {
      soup.points.push_back(*point);
      return static_cast<std::uint32_t>(soup.points.size() - 1);
    };
    if (f % 3 != 1) inside[f] = add_point();
    if (f % 3 != 0) inside[g] = add_point();
  }
  Cell_soup<D> result;
  result.points = std::move(soup.points);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      if (inside[f] == on_boundary)
        result.add_facet(soup.facet(f), soup.impassable[f]);
      else
        add_cut_facet(result, soup.facet(f), inside[f]);
    result.end_cell(soup.solid[c]);
  }
  soup = std::move(result);
}

template void open_slits(Cell_soup<2>&, std::span<const std::uint8_t>);
template void open_slits(Cell_soup<3>&, std::span<const std::uint8_t>);

}  // namespace cellwalk
