// SPDX-License-Identifier: LGPL-3.0-or-later
// The quality of a simplex, in doubles: it chooses, and never decides.
#ifndef CELLWALK_RESHAPE_REPLACE_QUALITY_H
#define CELLWALK_RESHAPE_REPLACE_QUALITY_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cmath>

namespace cellwalk::detail {

template <int D>
using Corners_of_simplex = std::array<Point<D>, static_cast<std::size_t>(D) + 1>;

/// 1 for a regular simplex, 0 for a flat one, negative for an inverted one. See Relax_options.
template <int D>
double quality(const Corners_of_simplex<D>& x) {
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 1; j < x.size(); ++j) squares += dot(x[j] - x[i], x[j] - x[i]);
  if (!(squares > 0)) return 0;
  const Vector<D> a = x[1] - x[0], b = x[2] - x[0];
  if constexpr (D == 2) {
    const double four_roots_of_3 = 6.928203230275509;
    return four_roots_of_3 * 0.5 * (a[0] * b[1] - a[1] * b[0]) / squares;
  } else {
    const double six_roots_of_2 = 8.48528137423857, edges = 6;
    const double length = std::sqrt(squares / edges);
    return six_roots_of_2 * (dot(cross(a, b), x[3] - x[0]) / 6) / (length * length * length);
  }
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_QUALITY_H
