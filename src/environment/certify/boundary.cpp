// SPDX-License-Identifier: LGPL-3.0-or-later
// Boundary facets against the interiors of cells. Signs of input points suffice, because a plane that
// separates two convex polytopes can be moved until it contains D of their vertices.
#include <cellwalk/internal/kernel/box.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "boundary_facet.h"
#include "complex.h"
#include "facing.h"

namespace cellwalk::detail {
namespace {

template <int D>
using Box_corner = boost::geometry::model::point<double, D, boost::geometry::cs::cartesian>;
template <int D>
using Tree_box = boost::geometry::model::box<Box_corner<D>>;

template <int D>
Tree_box<D> tree_box(const Box<D>& box) {
  const auto& [low, high] = box;
  if constexpr (D == 2) return {{low[0], low[1]}, {high[0], high[1]}};
  if constexpr (D == 3) return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

/// The bounding box of points.
template <int D>
Box<D> box_of(std::span<const Point<D>> points, std::span<const std::uint32_t> vertices) {
  Box<D> box;
  for (const std::uint32_t v : vertices) box.extend(points[v]);
  return box;
}

template <int D>
Tree_box<D> tree_box(std::span<const Point<D>> points, std::span<const std::uint32_t> vertices) {
  return tree_box<D>(box_of<D>(points, vertices));
}

/// How a cell lies beside a boundary facet of another one.
enum class Meeting {
  apart,
  reaches_in,   ///< an open part of the facet, moved inwards by an arbitrarily small amount, is in the cell
  lies_against  ///< the cell is on the outer side of the facet's plane, with D vertices in it
};

/// Decides whether the interior of a cell lies directly on the inner side of a boundary facet.
template <int D>
class Overlap_test {
 public:
  explicit Overlap_test(std::span<const Point<D>> points) : points_(points) {}

  Meeting operator()(const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    bool has_outer = false, has_inner = false;
    std::size_t in_plane = 0;
    for (const std::uint32_t v : cell.vertices) {
      const int s = side<D>(counts_, points_, facet.plane, v);
      has_outer |= s > 0;
      has_inner |= s < 0;
      in_plane += s == 0;
    }
    if (!has_inner) return in_plane < D ? Meeting::apart : Meeting::lies_against;
    return reaches_in(facet, cell, has_outer) ? Meeting::reaches_in : Meeting::apart;
  }

 private:
  bool reaches_in(const Boundary_facet<D>& facet, const Cell_view<D>& cell, bool has_outer) {
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

  /// True if the cell, which lies inside the facet's plane, has a facet in that plane that overlaps it.
  bool shares_plane(const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    for (std::size_t g = 0; g < cell.facet_count(); ++g) {
      const Facet_loop loop = loop_of(cell, g);
      if (lies_in_plane<D>(counts_, points_, facet, loop) &&
          overlap_in_plane<D>(counts_, points_, facet, loop, false))
        return true;
    }
    return false;
  }

  /// True if a plane through vertices of both (a vertex of one and an edge of the other) separates them.
  bool has_mixed_separation(const Boundary_facet<D>& facet, const Cell_view<D>& cell) {
    if constexpr (D == 2) {
      for (const std::uint32_t u : facet.loop)
        for (const std::uint32_t v : cell.vertices)
          if (separates({u, v}, facet, cell)) return true;
    } else {
      for (std::size_t g = 0; g < cell.facet_count(); ++g) {
        const Facet_loop loop = loop_of(cell, g);
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

/// A boundary facet in the tree.
template <int D>
using Entry = std::pair<Tree_box<D>, std::uint32_t>;

/// The boundary facets near a cell.
template <int D>
struct Candidates {
  std::vector<Entry<D>> entries;
  std::vector<std::uint32_t> own;
  std::vector<Facing_candidate> others;

  void clear() {
    entries.clear();
    own.clear();
    others.clear();
  }
};

template <int D>
[[noreturn]] void refuse_overlap(const Snapshot<D>& snapshot, Half_facet f, Cell c) {
  refuse(full_name(snapshot, f) + " lies on the boundary, but " + name(snapshot, c) +
         " reaches across it: cells overlap; repair the mesh, or glue what should be glued");
}

}  // namespace

template <int D>
void certify_boundary(const Complex<D>& complex, Facing_walls* facing) {
  const Snapshot<D>& snapshot = complex.snapshot();
  const std::vector<Boundary_facet<D>> facets = boundary_facets(complex);
  std::vector<Entry<D>> entries;
  for (std::uint32_t i = 0; i < facets.size(); ++i)
    entries.push_back({tree_box<D>(snapshot.points(), facets[i].loop), i});
  const boost::geometry::index::rtree<Entry<D>, boost::geometry::index::rstar<16>> tree(entries);

  constexpr std::uint32_t none = 0xffffffffu;
  std::optional<Facing_search<D>> search;
  if (facing) search.emplace(snapshot, facets);
  // The lowest boundary facet with cell c on its inner side.
  const auto lowest_overlap = [&](Cell c, Overlap_test<D>& test, Candidates<D>& found) {
    const Cell_view<D> view = snapshot.view(c);
    const Box<D> box = box_of<D>(snapshot.points(), view.vertices);
    found.clear();
    tree.query(boost::geometry::index::intersects(tree_box<D>(search ? search->enlarged(box) : box)),
               std::back_inserter(found.entries));
    std::uint32_t lowest = none;
    for (const Entry<D>& entry : found.entries) {
      const std::uint32_t i = entry.second;
      if (snapshot.cell_of(facets[i].facet) == c) {
        found.own.push_back(i);
        continue;
      }
      const Meeting meeting =
          boost::geometry::intersects(entry.first, tree_box<D>(box)) ? test(facets[i], view) : Meeting::apart;
      if (meeting == Meeting::reaches_in) lowest = std::min(lowest, i);
      found.others.push_back({i, meeting == Meeting::lies_against});
    }
    if (search) search->compare(found.own, found.others);
    return lowest;
  };
  const std::uint32_t failure = complex.lowest_failure([&] {
    return [&, test = Overlap_test<D>(snapshot.points()), found = Candidates<D>()](Cell c) mutable {
      return lowest_overlap(c, test, found) == none ? complex.no_failure : snapshot.index(c);
    };
  });
  if (failure == complex.no_failure) {
    if (facing) *facing = search->result();
    return;
  }
  const Cell c = snapshot.cell(failure);
  Overlap_test<D> test(snapshot.points());
  Candidates<D> found;
  const Half_facet f = facets[lowest_overlap(c, test, found)].facet;
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
          boost::geometry::intersects(box, tree_box<D>(snapshot.points(), facet.loop)) &&
          test(facet, view) == Meeting::reaches_in)
        refuse_overlap(snapshot, facet.facet, c);
  }
}

template void certify_boundary(const Complex<2>&, Facing_walls*);
template void certify_boundary(const Complex<3>&, Facing_walls*);
template void certify_boundary_of_star(const Snapshot<2>&, std::span<const Cell>,
                                       std::span<const Half_facet>);
template void certify_boundary_of_star(const Snapshot<3>&, std::span<const Cell>,
                                       std::span<const Half_facet>);

}  // namespace cellwalk::detail
