// SPDX-License-Identifier: LGPL-3.0-or-later
// What the passes of certification share. Internal.
//
// Each pass runs over all cells in parallel. It fails with the failure of lowest input index, whatever the
// number of threads: a pass looks for the lowest cell that fails, and only then says why.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_COMPLEX_H
#define CELLWALK_ENVIRONMENT_CERTIFY_COMPLEX_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/kernel/policies.h>

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

  /// body(cell) for all cells, in parallel; make_body() makes one for each task.
  template <class Make_body>
  void for_each_cell(const Make_body& make_body) const {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(is_cell_.size()), 2048),
                      [&](const auto& range) {
                        auto body = make_body();
                        for (std::uint32_t b = range.begin(); b != range.end(); ++b)
                          if (is_cell_[b]) body(Cell{b});
                      });
  }

  /// The lowest input index reported by any check(cell), or no_failure: check returns the index to blame.
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

/// D points of a hyperplane, by index, positive side outwards.
template <int D>
using Plane_points = std::array<std::uint32_t, D>;

/// Points of a facet that are not in one (D-2)-space.
/// \pre the facet is sound (check_cell)
template <int D>
Plane_points<D> plane_of_facet(Predicate_counts& counts, const Cell_view<D>& cell, std::size_t facet);
template <>
Plane_points<2> plane_of_facet<2>(Predicate_counts& counts, const Cell_view<2>& cell, std::size_t facet);
template <>
Plane_points<3> plane_of_facet<3>(Predicate_counts& counts, const Cell_view<3>& cell, std::size_t facet);

/// The side of a point of a plane: +1 outside. The plane's own points need no sign.
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
/// "facet (7 3 4)", by its vertices: a snapshot numbers facets in its own way.
template <int D>
std::string name(const Snapshot<D>& snapshot, Half_facet f);
/// "facet (7 3 4) of cell 5".
template <int D>
std::string full_name(const Snapshot<D>& snapshot, Half_facet f);

[[noreturn]] void refuse(const std::string& what);

// --- the passes, in the order in which they run. Each refuses what it finds, and relies on those before it.

/// Every cell by itself.
template <int D>
void certify_cells(const Complex<D>& complex);

/// The two sides of each facet match, the boundary is wall, and walls part solid cells from free ones.
template <int D>
void certify_links(const Complex<D>& complex);

/// No two vertices in the same place.
template <int D>
void certify_distinct_vertices(const Complex<D>& complex);

/// Cells turn once round each inner ridge and at most once round each boundary ridge. Returns the number of
/// fans: the ridges as the combinatorial map counts them.
template <int D>
std::size_t certify_turns(const Complex<D>& complex);

/// No boundary facet has the interior of another cell on its inner side.
template <int D>
void certify_boundary(const Complex<D>& complex);

/// The same for a certified snapshot in which a vertex of the boundary has moved since: `star` are the cells
/// that have it, each still sound, and `near` at least those boundary facets of other cells whose boxes meet
/// the box of the star. Only cells of the star are tried: docs/certification.md says why that suffices.
/// Cost: a test of boxes a cell and facet, and an exact test where they meet.
template <int D>
void certify_boundary_of_star(const Snapshot<D>& snapshot, std::span<const Cell> star,
                              std::span<const Half_facet> near);

/// Counts everything but the ridges.
template <int D>
Certificate count_cells(const Complex<D>& complex);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_COMPLEX_H
