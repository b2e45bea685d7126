// SPDX-License-Identifier: GPL-3.0-or-later
// The checks of bounds before a call of TetGen, and of its tetrahedra after it.
#include "tetgen_bounds.h"

#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>

#include "scale.h"
#include "sizes.h"

namespace cellwalk::detail {
namespace {

/// A refined mesh has 6 to 7 tetrahedra for each point.
constexpr double most_cells_a_point = 10;

}  // namespace

void check_bounds(const Tetrahedralize_options& options) {
  if (!(options.quality == 0 || (options.quality >= 1.1 && options.quality <= 1e6)))
    throw Error(Error_code::usage, "tetrahedralize: the quality bound must be 0 (none) or lie in [1.1, 1e6]");
  if (!(options.cell_size >= 0))
    throw Error(Error_code::usage, "tetrahedralize: the cell size must not be negative");
}

void check_size(const Tetrahedralize_options& options, double volume) {
  if (!std::isfinite(volume)) return;  // then the size is a part of it whatever it is
  check_cell_size("TetGen", options.cell_size, volume,
                  most_cells_a_point * static_cast<double>(options.most_added_points));
}

bool is_out_of_bounds(const Tetgen_result& mesh, const std::array<std::uint32_t, 4>& t,
                      const Tetrahedralize_options& options) {
  constexpr double rounding = 1 + 1e-9;
  // In TetGen's size, in which no product is out of range.
  const auto p = [&](int i) { return scaled(mesh.points[t[i]], mesh.scale); };
  const double cell_size = std::ldexp(options.cell_size, mesh.scale);
  const std::array<Vector<3>, 3> side{p(1) - p(0), p(2) - p(0), p(3) - p(0)};
  const double volume = std::abs(dot(side[0], cross(side[1], side[2]))) / 6;
  if (options.cell_size > 0 && volume > rounding * largest_volume(cell_size)) return true;
  if (options.quality == 0) return false;
  // From the first point, the centre of the circumsphere is `centre` / (12 volume).
  Vector<3> centre{};
  double shortest = length(side[0]);
  for (int i = 0; i < 3; ++i) {
    const Vector<3>&u = side[(i + 1) % 3], &v = side[(i + 2) % 3];
    centre = centre + dot(side[i], side[i]) * cross(u, v);
    shortest = std::min({shortest, length(side[i]), length(v - u)});
  }
  return length(centre) > rounding * 12 * volume * options.quality * shortest;
}

}  // namespace cellwalk::detail
