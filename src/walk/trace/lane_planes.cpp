// SPDX-License-Identifier: LGPL-3.0-or-later
// The planes of facets, with the bounds that lane_lengths.h names.
#include "lane_planes.h"

#include <cellwalk/internal/kernel/twofold.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk::detail {
namespace {

/// The sizes between which no term overflows, or loses a bit that matters to underflow.
constexpr double least_size = 0x1p-150, largest_size = 0x1p150;

/// The sizes of the two terms of a component of a normal may exceed the largest component by this factor:
/// thin corners are not used, since their normals are less precise.
constexpr double largest_cancellation = 64;

template <int D>
struct Corner_normal {
  std::array<Twofold, static_cast<std::size_t>(D)> normal;
  double largest = 0;  ///< component
  double terms = 0;    ///< of the largest component, at most
};

Corner_normal<2> normal_at(const Point<2>&, const Point<2>& corner, const Point<2>& next) {
  const Twofold x = exact_difference(next[0], corner[0]), y = exact_difference(next[1], corner[1]);
  const double largest = std::max(std::abs(x.high), std::abs(y.high));
  return {{-y, x}, largest, largest};
}

Corner_normal<3> normal_at(const Point<3>& previous, const Point<3>& corner, const Point<3>& next) {
  std::array<Twofold, 3> d, e;
  double d_size = 0, e_size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = exact_difference(next[k], corner[k]);
    e[k] = exact_difference(previous[k], corner[k]);
    d_size = std::max(d_size, std::abs(d[k].high));
    e_size = std::max(e_size, std::abs(e[k].high));
  }
  Corner_normal<3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    result.normal[k] = d[i] * e[j] - d[j] * e[i];
    result.largest = std::max(result.largest, std::abs(result.normal[k].high));
  }
  const bool is_in_range =
      d_size > least_size && d_size < largest_size && e_size > least_size && e_size < largest_size;
  result.terms = is_in_range ? d_size * e_size : std::numeric_limits<double>::infinity();
  return result;
}

/// No position on a line has an error below infinity.
Lane_plane unknown_plane() { return {}; }

template <int D>
Lane_plane plane_at(const Cell_view<D>& cell, std::size_t facet) {
  const auto loop = cell.loop(facet);
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Point<D>& corner = cell.point(loop[k]);
    const auto at = normal_at(cell.point(loop[(k + n - 1) % n]), corner, cell.point(loop[(k + 1) % n]));
    if (!(at.largest > least_size * least_size && at.terms <= largest_cancellation * at.largest)) continue;
    const double scale =
        std::ldexp(1.0, -std::ilogb(at.largest) - 1);  // the largest component is in [1/2, 1)
    Lane_plane plane{};
    Twofold offset;
    for (std::size_t i = 0; i < D; ++i) {
      const Twofold component{scale * at.normal[i].high, scale * at.normal[i].low};
      plane.high[i] = component.high;
      plane.low[i] = component.low;
      offset = offset + component * corner[i];
    }
    plane.high[3] = offset.high;
    plane.low[3] = offset.low;
    return plane;
  }
  return unknown_plane();
}

}  // namespace

template <int D>
Lane_planes lane_planes(const Snapshot<D>& snapshot) {
  Lane_planes made;
  made.planes.assign(snapshot.half_facet_slots(), unknown_plane());
  for (std::size_t index = 0; index < snapshot.cell_slots(); ++index) {
    const Cell c = snapshot.cell(index);
    if (c == Cell::none) continue;
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i), other = snapshot.opposite(f);
      const bool is_known = other != Half_facet::none && snapshot.index(snapshot.cell_of(other)) < index;
      made.planes[to_index(f)] = is_known ? made.planes[to_index(other)] : plane_at(cell, i);
    }
  }
  const Plane_frame<D>& frame = snapshot.frame();
  for (const double x : frame.centre) made.size = std::max(made.size, std::abs(x));
  made.size += 1 / frame.scale;
  if (!(made.size > least_size && made.size < largest_size))
    std::fill(made.planes.begin(), made.planes.end(), unknown_plane());
  return made;
}

template Lane_planes lane_planes<2>(const Snapshot<2>&);
template Lane_planes lane_planes<3>(const Snapshot<3>&);

}  // namespace cellwalk::detail
