// SPDX-License-Identifier: LGPL-3.0-or-later
// Goal positions of a deformed body: its rest shape, moved and deformed to match the positions of its
// vertices.
// Paper: Mueller, Heidelberger, Teschner, Gross, "Meshless deformations based on shape matching", 2005.
#ifndef CELLWALK_INTERNAL_SIMULATION_SHAPE_MATCHING_H
#define CELLWALK_INTERNAL_SIMULATION_SHAPE_MATCHING_H

#include <cellwalk/internal/records/material.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/kernel/point.h>

#include <array>
#include <span>
#include <vector>

namespace cellwalk {

/// The rest shape of a body, prepared for matching. It keeps no state between calls: equal positions give
/// equal goals, with the same bits for every compiler.
///
/// Degenerate cases: a rest shape that is flat, straight or a single point is deformed within its plane or
/// line only, and rotates with it. Positions that are flat, straight or a single point do not determine the
/// rotation; one of the possible rotations is chosen, arbitrary but fixed, and never a reflection. Inverted
/// positions are matched by the nearest rotation as well.
template <int D>
class Shape_matching {
 public:
  /// \param masses of the vertices; empty: all equal
  /// \pre rest has a vertex, all coordinates are finite; masses are none, or one positive number a vertex
  /// Cost: 1 us a vertex; in quadratic mode some 50 us more.
  Shape_matching(std::span<const Point<D>> rest, const Shape_material& material,
                 std::span<const double> masses = {});

  const Shape_material& material() const { return material_; }

  /// The goals of vertices at the given positions. They have the same centre of mass.
  /// \pre as many positions and goals as the rest shape has vertices, finite
  /// Cost: about 1 us, and 10 to 60 ns a vertex.
  void goals(std::span<const Point<D>> positions, std::span<Point<D>> result) const;

 private:
  /// Monomials of a vertex: its coordinates, then (quadratic mode) their squares and products minus the means
  /// of these.
  static constexpr int most_monomials = D + D * (D + 1) / 2;
  using Monomials = std::array<double, most_monomials>;

  Shape_material material_;
  double radius_ = 1;  ///< of the rest shape; the following members are in units of it
  double total_mass_ = 0;
  std::vector<double> masses_;
  std::vector<Vector<D>> rest_;                ///< from the centre of mass
  std::vector<Monomials> monomials_;           ///< quadratic mode
  std::array<Vector<D>, D> linear_inverse_{};  ///< of the moments of the rest shape, or their pseudo-inverse
  std::array<Monomials, most_monomials> inverse_{};  ///< the same of the monomials
  bool is_full_ = false;                             ///< the rest shape has a volume

  friend detail::State_access<D>;
};

/// The rotation nearest to a matrix (rows first), in the least-squares sense: its polar factor, corrected to
/// a rotation if it is a reflection. The identity for a zero matrix or one that is not finite.
template <int D>
std::array<Vector<D>, D> nearest_rotation(const std::array<Vector<D>, D>& matrix);

extern template class Shape_matching<2>;
extern template class Shape_matching<3>;
extern template std::array<Vector<2>, 2> nearest_rotation<2>(const std::array<Vector<2>, 2>&);
extern template std::array<Vector<3>, 3> nearest_rotation<3>(const std::array<Vector<3>, 3>&);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_SHAPE_MATCHING_H
