// SPDX-License-Identifier: LGPL-3.0-or-later
// The simplex that a wall sweeps while one of its corners moves, and its meetings with sets that stand still.
// Theory: docs/moving.md. Includes CGAL; users link CGAL::CGAL.
#ifndef CELLWALK_INTERNAL_KERNEL_SWEPT_SIMPLEX_H
#define CELLWALK_INTERNAL_KERNEL_SWEPT_SIMPLEX_H

#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/kernel/exact.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// How a closed convex set meets a swept simplex.
enum class Encounter : std::uint8_t {
  apart,  ///< it has no point in common with the closed simplex
  touch,  ///< only with its boundary
  hit     ///< with the open simplex
};

/// The collision of a wall with a set that it hits: where and when they meet first, in exact numbers. Weights
/// are of points and not negative; each set of them may have a common factor.
struct Collision {
  Fraction time;
  std::vector<Ring> wall_weights;     ///< of its corners: first the one that moves, then the others
  std::vector<Ring> feature_weights;  ///< of the points that span the set
  // Numbers by which a caller with several walls or sets finds them again.
  std::size_t wall = 0;
  std::uint32_t group = 0, feature = 0;
};

/// How many points have weights that are not 0: they span the lowest face that holds the place.
std::size_t corners_used(const std::vector<Ring>& weights);

/// Of collisions the first is kept: by time, then by the lowest face of the set, then by that of the wall.
void keep_first(std::optional<Collision>& first, Collision next);

/// The simplex K that a wall sweeps while its corner moves from one point to another and its other corners
/// stand still (2D: a triangle that an edge sweeps; 3D: a tetrahedron that a triangle sweeps). Sets are given
/// by the points that span them: a point, a segment, or a convex polygon with its vertices in order.
template <int D>
class Swept_simplex {
 public:
  static constexpr std::size_t dimension = static_cast<std::size_t>(D);
  using Corners = std::array<Point<D>, dimension - 1>;

  /// \param still the corners of the wall that stand still
  /// \pre from != to; the wall is not degenerate before it moves
  Swept_simplex(const Point<D>& from, const Point<D>& to, const Corners& still, Predicate_counts& counts);

  /// True if K has no volume: the wall moves in its own plane.
  bool is_flat() const { return sense_ == 0; }
  const Box<D>& box() const { return box_; }
  /// The corners of K: where the moving corner starts, where it ends, then the others.
  const std::array<Point<D>, dimension + 1>& corners() const { return corners_; }

  /// Exact in every position. A set that meets a flat K touches it.
  /// \pre there is at least one point; polygons are convex, and only in 3D
  /// Cost: a comparison of boxes; up to some 20 signs near K; exact numbers, some 10 us, for touches and for
  /// polygons that no plane of theirs or of K parts from it.
  Encounter meet(std::span<const Point<D>> feature, Predicate_counts& counts) const;

  /// The infimum of the times at which the wall passes a point of the set in K, and the first such point in
  /// the order of keep_first().
  /// \pre meet(feature) is Encounter::hit
  Collision first_hit(std::span<const Point<D>> feature) const;

  /// True if the wall meets the set only where it starts, and off the hull of its still corners: it leaves
  /// the set at once.
  /// \pre meet(feature) is Encounter::touch
  /// Cost: exact numbers.
  bool leaves(std::span<const Point<D>> feature) const;

  /// True if the wall meets the set after it has begun to move, elsewhere than in the hull of its still
  /// corners. A wall that moves off a set that it touched does not.
  /// Cost: some 20 signs; exact numbers if no plane of a facet of K, nor that of the set, decides.
  bool reaches(std::span<const Point<D>> feature, Predicate_counts& counts) const;

 private:
  Encounter by_signs(std::span<const Point<D>> feature, Predicate_counts& counts, bool& is_certain) const;
  bool is_surely_left(std::span<const Point<D>> feature, Predicate_counts& counts) const;
  bool passes_beside(std::span<const Point<D>> feature, bool& is_strict, Predicate_counts& counts) const;
  int side(std::size_t corner, const Point<D>& x, Predicate_counts& counts) const;

  std::array<Point<D>, dimension + 1> corners_;
  Box<D> box_;
  int sense_;  ///< orientation of the corners
};

extern template class Swept_simplex<2>;
extern template class Swept_simplex<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_SWEPT_SIMPLEX_H
