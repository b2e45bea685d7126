// SPDX-License-Identifier: LGPL-3.0-or-later
// Boundary facets against the interiors of cells. Signs of input points suffice, because a plane that
// separates two convex polytopes can be moved until it contains D of their vertices.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "complex.h"
#include "polygon.h"

namespace cellwalk::detail {
namespace {

using Loop = std::vector<std::uint32_t>;

template <int D>
using Box_corner = boost::geometry::model::point<double, D, boost::geometry::cs::cartesian>;
template <int D>
using Tree_box = boost::geometry::model::box<Box_corner<D>>;

/// The bounding box of points.
template <int D>
Tree_box<D> tree_box(std::span<const Point<D>> points, std::span<const std::uint32_t> vertices) {
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
struct Boundary_facet {
  Half_facet facet;
  Plane_points<D> plane;
  Loop loop;
};

template <int D>
Loop loop_of(const Cell_view<D>& cell, std::size_t facet) {
  Loop loop;
  for (const std::uint16_t v : cell.loop(facet)) loop.push_back(cell.point_index(v));
  return loop;
}

/// Decides whether the interior of a cell lies directly on the inner side of a boundary facet.
template <int D>
class Overlap_test {
 public:
  explicit Overlap_test(std::span<const Point<D>> points) : points_(points) {}

  /// True if an open part of the facet, moved inwards by an arbitrarily small amount, lies inside the cell.
  bool operator()(const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    bool has_outer = false, has_inner = false;
    for (const std::uint32_t v : cell.vertices) {
      const int s = side<D>(counts_, points_, facet.plane, v);
      has_outer |= s > 0;
      has_inner |= s < 0;
    }
    if (!has_inner) return false;
    if (!has_outer) return shares_plane(facet, cell);
    for (std::size_t g = 0; g < cell.facet_count(); ++g) {
      const Plane_points<D> plane = plane_of_facet<D>(counts_, cell, g);
      bool is_outside = true;
      for (std::size_t i = 0; is_outside && i < facet.loop.size(); ++i)
        is_outside = side<D>(counts_, points_, plane, facet.loop[i]) >= 0;
      if (is_outside) return false;
    }
    return !has_mixed_separation(facet, cell);
  }

 private:
  /// True if the cell, which lies inside the facet's plane, has a facet in that plane that overlaps it.
  bool shares_plane(const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    for (std::size_t g = 0; g < cell.facet_count(); ++g) {
      const Loop loop = loop_of(cell, g);
      bool is_coplanar = true;
      for (std::size_t i = 0; is_coplanar && i < loop.size(); ++i)
        is_coplanar = side<D>(counts_, points_, facet.plane, loop[i]) == 0;
      if (is_coplanar && overlap_in_plane(facet, loop)) return true;
    }
    return false;
  }

  bool overlap_in_plane(const Boundary_facet<D>& facet, const Loop& loop) {
    if constexpr (D == 2) {
      const auto [a, b] = std::minmax(points_[facet.loop[0]], points_[facet.loop[1]]);
      const auto [c, d] = std::minmax(points_[loop[0]], points_[loop[1]]);
      return a < d && c < b;
    } else {
      const auto& [p, q, r] = facet.plane;
      const int axis = projection_axis(counts_, points_[p], points_[q], points_[r]);
      const int sign = turn(counts_, points_[p], points_[q], points_[r], axis);
      const Polygon<2> own = flat(facet.loop, axis), other = flat(loop, axis);
      return !are_apart(counts_, {own.data(), own.size()}, {other.data(), other.size()}, sign);
    }
  }

  Polygon<2> flat(const Loop& loop, int axis) const requires(D == 3) {
    Polygon<2> polygon;
    for (const std::uint32_t v : loop) polygon.push_back(drop(points_[v], axis));
    return polygon;
  }

  /// True if a plane through vertices of both (a vertex of one and an edge of the other) separates them.
  bool has_mixed_separation(const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    if constexpr (D == 2) {
      for (const std::uint32_t u : facet.loop)
        for (const std::uint32_t v : cell.vertices)
          if (separates({u, v}, facet, cell)) return true;
    } else {
      for (std::size_t g = 0; g < cell.facet_count(); ++g) {
        const Loop loop = loop_of(cell, g);
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const std::uint32_t u = loop[i], v = loop[(i + 1) % loop.size()];
          if (v < u) continue;  // each edge occurs in both directions
          for (const std::uint32_t w : facet.loop)
            if (separates({u, v, w}, facet, cell)) return true;
        }
      }
      for (std::size_t i = 0; i < facet.loop.size(); ++i)
        for (const std::uint32_t w : cell.vertices)
          if (separates({facet.loop[i], facet.loop[(i + 1) % facet.loop.size()], w}, facet, cell))
            return true;
    }
    return false;
  }

  /// True if the cell lies on one side of a plane, with points off it, and the facet on the other or in it.
  bool separates(const Plane_points<D>& plane, const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    int side_of_cell = 0;
    for (const std::uint32_t v : cell.vertices) {
      const int s = side<D>(counts_, points_, plane, v);
      if (s * side_of_cell < 0) return false;
      if (s != 0) side_of_cell = s;
    }
    if (side_of_cell == 0) return false;  // the points do not span a plane
    for (const std::uint32_t v : facet.loop)
      if (side<D>(counts_, points_, plane, v) * side_of_cell > 0) return false;
    return true;
  }

  std::span<const Point<D>> points_;
  Predicate_counts counts_;
};

/// Appends the boundary facets of a cell.
template <int D>
void append_boundary_facets(const Snapshot<D>& snapshot, Cell c, std::vector<Boundary_facet<D>>& facets) {
  Predicate_counts counts;
  const Cell_view<D> view = snapshot.view(c);
  for (std::size_t k = 0; k < view.facet_count(); ++k)
    if (const Half_facet f = snapshot.half_facet(c, k); snapshot.neighbour(f) == Cell::none)
      facets.push_back({f, plane_of_facet<D>(counts, view, k), loop_of(view, k)});
}

template <int D>
std::vector<Boundary_facet<D>> boundary_facets(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  std::vector<Boundary_facet<D>> facets;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none) append_boundary_facets(snapshot, c, facets);
  return facets;
}

template <int D>
[[noreturn]] void refuse_overlap(const Snapshot<D>& snapshot, Half_facet f, Cell c) {
  refuse(full_name(snapshot, f) + " lies on the boundary, but " + name(snapshot, c) +
         " reaches across it: cells overlap; repair the mesh, or glue what should be glued");
}

}  // namespace

template <int D>
void certify_boundary(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  const std::vector<Boundary_facet<D>> facets = boundary_facets(complex);
  using Entry = std::pair<Tree_box<D>, std::uint32_t>;
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < facets.size(); ++i)
    entries.push_back({tree_box<D>(snapshot.points(), facets[i].loop), i});
  const boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<16>> tree(entries);

  constexpr std::uint32_t none = 0xffffffffu;
  // The lowest boundary facet with cell c on its inner side.
  const auto lowest_overlap = [&](Cell c, Overlap_test<D>& test, std::vector<Entry>& candidates) {
    const Cell_view<D> view = snapshot.view(c);
    candidates.clear();
    tree.query(boost::geometry::index::intersects(tree_box<D>(snapshot.points(), view.vertices)),
               std::back_inserter(candidates));
    std::uint32_t lowest = none;
    for (const Entry& entry : candidates) {
      const Boundary_facet<D>& facet = facets[entry.second];
      if (entry.second < lowest && snapshot.cell_of(facet.facet) != c && test(facet, view))
        lowest = entry.second;
    }
    return lowest;
  };
  const std::uint32_t failure = complex.lowest_failure([&] {
    return [&, test = Overlap_test<D>(snapshot.points()), candidates = std::vector<Entry>()](Cell c) mutable {
      return lowest_overlap(c, test, candidates) == none ? complex.no_failure : snapshot.index(c);
    };
  });
  if (failure == complex.no_failure) return;
  const Cell c = snapshot.cell(failure);
  Overlap_test<D> test(snapshot.points());
  std::vector<Entry> candidates;
  const Half_facet f = facets[lowest_overlap(c, test, candidates)].facet;
  refuse_overlap(snapshot, f, c);
}

template <int D>
void certify_boundary_of_star(const Snapshot<D>& snapshot, std::span<const Cell> star,
                              std::span<const Half_facet> near) {
  std::vector<Boundary_facet<D>> facets;
  for (const Cell c : star) append_boundary_facets(snapshot, c, facets);
  Predicate_counts counts;
  for (const Half_facet f : near) {
    const Cell c = snapshot.cell_of(f);
    if (std::find(star.begin(), star.end(), c) != star.end()) continue;
    const Cell_view<D> view = snapshot.view(c);
    const std::size_t k = snapshot.facet_of(f);
    facets.push_back({f, plane_of_facet<D>(counts, view, k), loop_of(view, k)});
  }
  Overlap_test<D> test(snapshot.points());
  for (const Cell c : star) {
    const Cell_view<D> view = snapshot.view(c);
    const Tree_box<D> box = tree_box<D>(snapshot.points(), view.vertices);
    for (const Boundary_facet<D>& facet : facets)
      if (snapshot.cell_of(facet.facet) != c &&
          boost::geometry::intersects(box, tree_box<D>(snapshot.points(), facet.loop)) && test(facet, view))
        refuse_overlap(snapshot, facet.facet, c);
  }
}

template void certify_boundary(const Complex<2>&);
template void certify_boundary(const Complex<3>&);
template void certify_boundary_of_star(const Snapshot<2>&, std::span<const Cell>,
                                       std::span<const Half_facet>);
template void certify_boundary_of_star(const Snapshot<3>&, std::span<const Cell>,
                                       std::span<const Half_facet>);

}  // namespace cellwalk::detail
