// SPDX-License-Identifier: LGPL-3.0-or-later
// The passes of certification in order, and the simplest of them. Proof: docs/certification.md.
#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <optional>

#include "complex.h"
#include "environment/soup/describe_place.h"
#include "shape.h"

namespace cellwalk {
namespace detail {
namespace {

/// The first facet by whose first vertices no side can be determined: all signs against it would be 0.
/// facet_count() if none.
std::size_t first_without_plane(const Cell_view<3>& cell) {
  std::size_t i = 0;
  for (; i < cell.facet_count(); ++i) {
    const auto loop = cell.loop(i);
    // Triangles have been checked with their cell.
    if (loop.size() > 3 && are_collinear(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2])))
      break;
  }
  return i;
}

std::size_t first_without_plane(const Cell_view<2>& cell) { return cell.facet_count(); }

/// The conflict between a facet and its other side; empty if there is none.
template <int D>
std::string flaw_of_link(const Complex<D>& complex, Half_facet f) {
  const Snapshot<D>& snapshot = complex.snapshot();
  const Half_facet g = complex.opposite(f);
  if (g == Half_facet::none) {
    if (snapshot.neighbour(f) != Cell::none)
      return "does not occur in the cell it is glued to: glue the cells again";
    return snapshot.is_impassable(f) ? "" : "lies on the boundary and is passable: mark it impassable";
  }
  if (complex.opposite(g) != f)
    return "is glued to a facet that is glued to another one: glue the cells again";
  const Cell_view<D> own = snapshot.view(snapshot.cell_of(f)), other = snapshot.view(snapshot.cell_of(g));
  const auto loop = own.loop(snapshot.facet_of(f)), reversed = other.loop(snapshot.facet_of(g));
  const std::size_t n = loop.size();
  std::size_t start = 0;
  while (start < reversed.size() && other.point_index(reversed[start]) != own.point_index(loop[0])) ++start;
  bool matches = reversed.size() == n && start < n;
  for (std::size_t i = 0; matches && i < n; ++i)
    matches = own.point_index(loop[i]) == other.point_index(reversed[(start + n - i) % n]);
  if (!matches) return "is glued to a facet with other vertices: glue the cells again";
  if (snapshot.is_impassable(f) != snapshot.is_impassable(g))
    return "is impassable from one side only: mark both";
  if (!snapshot.is_impassable(f) &&
      snapshot.is_solid(snapshot.cell_of(f)) != snapshot.is_solid(snapshot.cell_of(g)))
    return "is passable between a solid cell and a free one: mark it impassable";
  return "";
}

}  // namespace

template <int D>
void certify_cells(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  const std::uint32_t failure = complex.lowest_failure([&] {
    return [&, check = Cell_checker<D>()](Cell c) mutable {
      const Cell_view<D> view = snapshot.view(c);
      const bool is_sound =
          check(view).defect == Cell_defect::none && first_without_plane(view) == view.facet_count();
      return is_sound ? complex.no_failure : snapshot.index(c);
    };
  });
  if (failure == complex.no_failure) return;
  const Cell c = snapshot.cell(failure);
  const Cell_check check = check_cell(snapshot.view(c));
  if (check.defect == Cell_defect::none) {
    const Half_facet f = snapshot.half_facet(c, first_without_plane(snapshot.view(c)));
    refuse(full_name(snapshot, f) +
           " has its first three vertices on one line, so that no side of it can be told: "
           "move vertices through Environment only");
  }
  refuse(name(snapshot, c) + ": " +
         describe(check.defect, name(snapshot, snapshot.half_facet(c, check.facet))) +
         "; split or repair the cell");
}

template <int D>
void certify_links(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  const auto first_flaw = [&](Cell c) -> std::optional<Half_facet> {
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i)
      if (!flaw_of_link(complex, snapshot.half_facet(c, i)).empty()) return snapshot.half_facet(c, i);
    return {};
  };
  const std::uint32_t failure = complex.lowest_failure(
      [&] { return [&](Cell c) { return first_flaw(c) ? snapshot.index(c) : complex.no_failure; }; });
  if (failure == complex.no_failure) return;
  const Half_facet f = *first_flaw(snapshot.cell(failure));
  refuse(full_name(snapshot, f) + " " + flaw_of_link(complex, f));
}

template <int D>
void certify_distinct_vertices(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  std::vector<std::uint8_t> is_used(snapshot.points().size(), 0);
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none)
      for (const std::uint32_t v : snapshot.view(c).vertices) is_used[v] = 1;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) vertices.push_back(v);
  tbb::parallel_sort(vertices.begin(), vertices.end(), [&](std::uint32_t u, std::uint32_t v) {
    const Point<D>&p = snapshot.point(u), &q = snapshot.point(v);
    return p != q ? p < q : u < v;
  });
  std::uint32_t first = complex.no_failure, second = 0;
  for (std::size_t i = 1; i < vertices.size(); ++i)
    if (snapshot.point(vertices[i - 1]) == snapshot.point(vertices[i]) && vertices[i - 1] < first)
      first = vertices[i - 1], second = vertices[i];
  if (first == complex.no_failure) return;
  const auto cell_with = [&](std::uint32_t v) {
    for (std::size_t i = 0;; ++i) {
      if (snapshot.cell(i) == Cell::none) continue;
      const auto own = snapshot.view(snapshot.cell(i)).vertices;
      if (std::find(own.begin(), own.end(), v) != own.end()) return name(snapshot, snapshot.cell(i));
    }
  };
  refuse("vertices " + std::to_string(first) + " (of " + cell_with(first) + ") and " +
         std::to_string(second) + " (of " + cell_with(second) + ") lie in the same place " +
         describe_place(snapshot.point(first)) + ": merge them, or keep duplicate vertices");
}

}  // namespace detail

template <int D>
Certificate certify(const Snapshot<D>& snapshot, bool allow_duplicates, Facing_walls* facing) {
  const detail::Complex<D> complex(snapshot);
  detail::certify_cells(complex);
  detail::certify_links(complex);
  if (!allow_duplicates) detail::certify_distinct_vertices(complex);
  const std::size_t ridges = detail::certify_turns(complex);
  detail::certify_boundary(complex, facing);
  Certificate certificate = detail::count_cells(complex);
  certificate.ridges = ridges;
  return certificate;
}

template Certificate certify(const Snapshot<2>&, bool, Facing_walls*);
template Certificate certify(const Snapshot<3>&, bool, Facing_walls*);

}  // namespace cellwalk
