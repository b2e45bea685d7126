// SPDX-License-Identifier: LGPL-3.0-or-later
// The common parts of the passes of certification. Internal.
//
// Each pass runs over all cells in parallel. It fails with the failure of lowest input index, for any number
// of threads: a pass first finds the lowest cell that fails, and then its reason.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_COMPLEX_H
#define CELLWALK_ENVIRONMENT_CERTIFY_COMPLEX_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/kernel/exact.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk::detail {

/// A snapshot with the tables that several passes need.
template <int D>
class Complex {
 public:
  explicit Complex(const Snapshot<D>& snapshot);

  const Snapshot<D>& snapshot() const { return snapshot_; }
  Half_facet opposite(Half_facet f) const { return opposite_[to_index(f)]; }

  /// Number of the first corner of a cell. A corner is a vertex of a cell.
  std::uint32_t first_corner(Cell c) const { return first_corner_[to_index(c)]; }
  std::size_t corner_count() const { return corner_count_; }

  /// Calls body(cell) for all cells, in parallel; make_body() makes one for each task.
  template <class Make_body>
  void for_each_cell(const Make_body& make_body) const {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(is_cell_.size()), 2048),
                      [&](const auto& range) {
                        auto body = make_body();
                        for (std::uint32_t b = range.begin(); b != range.end(); ++b)
                          if (is_cell_[b]) body(Cell{b});
                      });
  }

  /// The lowest input index returned by any check(cell), which returns that of the failing cell or
  /// no_failure.
  template <class Make_check>
  std::uint32_t lowest_failure(const Make_check& make_check) const {
    std::atomic<std::uint32_t> lowest{no_failure};
    for_each_cell([&] {
      return [&, check = make_check()](Cell c) mutable {
        const std::uint32_t failure = check(c);
        std::uint32_t known = lowest.load(std::memory_order_relaxed);
        while (failure < known && !lowest.compare_exchange_weak(known, failure)) {
        }
      };
    });
    return lowest;
  }

  static constexpr std::uint32_t no_failure = 0xffffffffu;

 private:
  const Snapshot<D>& snapshot_;
  std::vector<std::uint8_t> is_cell_;        // per block: first block of a cell
  std::vector<std::uint32_t> first_corner_;  // per block
  std::vector<Half_facet> opposite_;         // per slot
  std::size_t corner_count_ = 0;
};

/// D points of a hyperplane, by index, with the positive side outwards.
template <int D>
using Plane_points = std::array<std::uint32_t, D>;

/// D affinely independent points of a facet, which span its plane (2D: line).
/// \pre the facet is sound (check_cell)
template <int D>
Plane_points<D> plane_of_facet(Predicate_counts& counts, const Cell_view<D>& cell, std::size_t facet);
template <>
Plane_points<2> plane_of_facet<2>(Predicate_counts& counts, const Cell_view<2>& cell, std::size_t facet);
template <>
Plane_points<3> plane_of_facet<3>(Predicate_counts& counts, const Cell_view<3>& cell, std::size_t facet);

/// The side of a point with respect to a plane: +1 outside. The points of the plane itself need no sign.
template <int D>
int side(Predicate_counts& counts, std::span<const Point<D>> points, const Plane_points<D>& plane,
         std::uint32_t v) {
  for (const std::uint32_t p : plane)
    if (p == v) return 0;
  if constexpr (D == 2)
    return -Exact::orientation(counts, points[plane[0]], points[plane[1]], points[v]);
  else
    return Exact::orientation(counts, points[plane[0]], points[plane[1]], points[plane[2]], points[v]);
}

/// "cell 5", by its input index.
template <int D>
std::string name(const Snapshot<D>& snapshot, Cell c);
/// "facet (7 3 4)", by its vertices, since a snapshot renumbers facets.
template <int D>
std::string name(const Snapshot<D>& snapshot, Half_facet f);
/// "facet (7 3 4) of cell 5".
template <int D>
std::string full_name(const Snapshot<D>& snapshot, Half_facet f);

[[noreturn]] void refuse(const std::string& what);

// --- the passes, in the order in which they run; each relies on those before it

/// Checks every cell by itself.
template <int D>
void certify_cells(const Complex<D>& complex);

/// Checks that the two sides of each facet match, that the boundary consists of walls, and that walls
/// separate solid cells from free ones.
template <int D>
void certify_links(const Complex<D>& complex);

/// Checks that no two vertices coincide.
template <int D>
void certify_distinct_vertices(const Complex<D>& complex);

/// Checks that cells turn once around each inner ridge and at most once around each boundary ridge. Returns
/// the number of fans, which is the number of ridges of the combinatorial map.
template <int D>
std::size_t certify_turns(const Complex<D>& complex);

/// Checks that no boundary facet has the interior of another cell on its inner side.
/// \param facing if not null, receives the facets that turn their outer sides to each other
template <int D>
void certify_boundary(const Complex<D>& complex, Facing_walls* facing);

/// The same for a certified snapshot after a vertex of the boundary has moved: `star` are the cells at the
/// vertex, each still sound, and `near` includes all boundary facets of other cells whose boxes meet the box
/// of the star. Only cells of the star are tested; docs/certification.md proves that this suffices.
/// Cost: a test of boxes a cell and facet, and an exact test if they meet.
template <int D>
void certify_boundary_of_star(const Snapshot<D>& snapshot, std::span<const Cell> star,
                              std::span<const Half_facet> near);

/// Counts everything but the ridges.
template <int D>
Certificate count_cells(const Complex<D>& complex);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_COMPLEX_H
