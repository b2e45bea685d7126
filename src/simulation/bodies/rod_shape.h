// SPDX-License-Identifier: LGPL-3.0-or-later
// The shape of a rod without walls: pushed along where it lies, and relaxed.
#ifndef CELLWALK_SIMULATION_BODIES_ROD_SHAPE_H
#define CELLWALK_SIMULATION_BODIES_ROD_SHAPE_H

#include <cellwalk/kernel/point.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// A rod in its guide. Vertex i, the tip being 0, has `inside - i * spacing` of the rod between itself and
/// the entry. It leaves the entry once that is long enough to have a direction.
template <int D>
struct Rod_state {
  Point<D> entry{};
  Vector<D> direction{};  ///< of the guide, towards the inside; a unit vector
  double spacing = 1;
  double inside = 0;

  /// How many vertices have left the entry.
  std::size_t count(std::size_t vertices) const;
  double rest(std::size_t i) const { return inside - static_cast<double>(i) * spacing; }
  bool has_entered(std::size_t i) const { return rest(i) > spacing / 64; }
  /// The same of the vertex, or the entry, that lies behind it.
  double rest_before(std::size_t vertices, std::size_t i) const;
  /// The vertex, or the entry, that lies behind it.
  Point<D> before(std::span<const Point<D>> vertices, std::size_t i) const;
  /// The direction from there to the vertex; where it has not entered, the direction of the guide.
  Vector<D> tangent(std::span<const Point<D>> vertices, std::size_t i) const;
};

/// Moves the vertices that are inside along the chain, towards the tip, until they have as much rod behind
/// them as they should, but by no more than `most`. Beyond the tip the chain goes on along `heading`.
template <int D>
void push_along(const Rod_state<D>& state, const Vector<D>& heading, double most,
                std::span<Point<D>> vertices);

/// How a rod is bent when nothing holds it.
template <int D>
struct Natural_bend {
  double stiffness = 0;     ///< share of a bend that goes back in one pass, [0,1]
  double length = 0;        ///< of the curved part at the tip
  double angle_of_tip = 0;  ///< by which that is bent from end to end, in radians
  double twist = 0;         ///< of the base, in radians
  bool holds_tip = false;   ///< the tip is not moved

  /// The natural angle at a vertex. At the tip itself there is none.
  double angle(std::size_t i, double spacing) const {
    const double bends = std::floor(length / spacing);  // vertices that are bent
    return i > 0 && static_cast<double>(i) <= bends ? angle_of_tip / bends : 0;
  }
};

/// Takes the natural curve of the tip along with it, turned as the base is now: other bends of the rod stay
/// where they are, as walls do. `old` are the vertices as they were before they were pushed and turned.
template <int D>
void bend_tip(const Rod_state<D>& before, double twist_before, std::span<const Point<D>> old,
              const Rod_state<D>& state, const Natural_bend<D>& bend, std::span<Point<D>> vertices);

/// Lets links have their length, and bends their curvature, in some passes from the base to the tip.
template <int D>
void relax(const Rod_state<D>& state, const Natural_bend<D>& bend, std::span<Point<D>> vertices);

/// The direction in which the rod is curved at each vertex inside and at the entry, as the base is turned:
/// unit vectors across the rod, taken along it from the guide without a twist (in the plane: to the left,
/// longer or shorter as the turned curve is seen from above).
template <int D>
std::vector<Vector<D>> curve_directions(const Rod_state<D>& state, double twist,
                                        std::span<const Point<D>> vertices);

extern template struct Rod_state<2>;
extern template struct Rod_state<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_ROD_SHAPE_H
