// SPDX-License-Identifier: LGPL-3.0-or-later
// The test that coordinates of a lattice are computed without rounding, or keep their planes flat.
#include <cellwalk/generators/lattice_map.h>
#include <cellwalk/internal/generators/placement.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <cmath>

namespace cellwalk {
namespace {

/// Exponent of the lowest bit set in x.
/// \pre x is finite and not 0
int lowest_bit(double x) {
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  for (; mantissa % 2 == 0; mantissa /= 2) ++exponent;
  return exponent;
}

/// A bound of coordinate `row` over the lattice.
template <int D>
double largest_coordinate(const Lattice_map<D>& map, const std::array<std::uint32_t, D>& extent, int row) {
  double bound = std::abs(map.origin[row]);
  for (int i = 0; i < D; ++i) bound += std::abs(map.columns[i][row]) * extent[i];
  return bound;
}

/// True if no partial sum of coordinate `row` is rounded: all are multiples of one power of two, and below
/// 2^52 times it.
template <int D>
bool is_exact(const Lattice_map<D>& map, const std::array<std::uint32_t, D>& extent, int binary_places,
              int row) {
  int unit = 1024;
  if (map.origin[row] != 0) unit = std::min(unit, lowest_bit(map.origin[row]));
  for (int i = 0; i < D; ++i)
    if (map.columns[i][row] != 0) unit = std::min(unit, lowest_bit(map.columns[i][row]) - binary_places);
  return unit >= -1022 && largest_coordinate<D>(map, extent, row) <= std::ldexp(1.0, unit + 52);
}

/// The axis on which coordinate `row` depends, or -1 if there are several or none.
template <int D>
int only_axis(const Lattice_map<D>& map, int row) {
  int axis = -1;
  for (int i = 0; i < D; ++i)
    if (map.columns[i][row] != 0) axis = axis == -1 ? i : D;
  return axis == D ? -1 : axis;
}

template <int D>
bool is_planar(const Lattice_map<D>& map, const std::array<std::uint32_t, D>& extent, int binary_places) {
  bool exact = true, aligned = true;
  for (int row = 0; row < D; ++row) {
    exact = exact && is_exact<D>(map, extent, binary_places, row);
    const int axis = only_axis(map, row);
    // Neighbouring planes must differ by far more than the rounding of their coordinates, which is below
    // 2^-52 of it.
    aligned = aligned && axis >= 0 &&
              std::ldexp(std::abs(map.columns[axis][row]), -binary_places) >=
                  largest_coordinate<D>(map, extent, row) * 0x1p-48;
  }
  return exact || aligned;
}

/// Sign of the determinant of the columns.
template <int D>
int handedness(const Lattice_map<D>& map) {
  Predicate_counts counts;
  const Point<D> o{};
  const auto& c = map.columns;
  if constexpr (D == 2)
    return Exact::orientation(counts, o, c[0], c[1]);
  else
    return Exact::orientation(counts, o, c[0], c[1], c[2]);
}

}  // namespace

template <int D>
Lattice_map<D> scaled(double scale) {
  Lattice_map<D> map;
  for (auto& column : map.columns) column = scale * column;
  return map;
}

template <int D>
Lattice_map<D> rotated(double scale) {
  Lattice_map<D> map;
  if constexpr (D == 2)
    map.columns = {{{3, 4}, {-4, 3}}};
  else
    map.columns = {{{1, 2, 2}, {2, -2, 1}, {2, 1, -2}}};
  for (auto& column : map.columns) column = scale * column;
  return map;
}

template <int D>
Lattice_map<D> sheared(double scale) {
  Lattice_map<D> map;
  for (int i = 1; i < D; ++i) map.columns[i][i - 1] = 0.5;
  for (auto& column : map.columns) column = scale * column;
  return map;
}

template <int D>
void check_placement(const Lattice_map<D>& map, const std::array<std::uint32_t, D>& extent, int binary_places,
                     Placement placement) {
  bool finite = is_finite(map.origin);
  for (const auto& column : map.columns) finite = finite && is_finite(column);
  for (int row = 0; row < D; ++row) finite = finite && std::isfinite(largest_coordinate<D>(map, extent, row));
  if (!finite)
    throw Error(Error_code::usage, "lattice map: coordinates are not finite; give a smaller scale");
  const int sign = handedness(map);
  if (sign == 0)
    throw Error(Error_code::usage, "lattice map: its columns are linearly dependent; cells would be flat");
  if (sign < 0)
    throw Error(Error_code::usage, "lattice map: it mirrors; swap two columns or change the sign of one");
  if (placement == Placement::planar && !is_planar<D>(map, extent, binary_places))
    throw Error(
        Error_code::usage,
        "lattice map: coordinates would be rounded and facets no longer exactly planar; use entries with few "
        "binary digits (integers, multiples of a power of two) or an axis-aligned map");
}

#define CELLWALK_INSTANTIATE(D)                                                                     \
  template Lattice_map<D> scaled<D>(double);                                                        \
  template Lattice_map<D> rotated<D>(double);                                                       \
  template Lattice_map<D> sheared<D>(double);                                                       \
  template void check_placement<D>(const Lattice_map<D>&, const std::array<std::uint32_t, D>&, int, \
                                   Placement);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
