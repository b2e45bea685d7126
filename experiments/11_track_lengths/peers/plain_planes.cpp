// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "plain_walk.h"

namespace cellwalk::track_lengths {
namespace {

/// The plane of a facet, the same for any order of its points, up to its sign.
std::array<long double, 4> plane(const Snapshot<3>& snapshot, std::vector<std::uint32_t> facet) {
  std::ranges::sort(facet);
  const Point<3>&p = snapshot.point(facet[0]), &q = snapshot.point(facet[1]), &r = snapshot.point(facet[2]);
  std::array<long double, 3> a{}, b{};
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = static_cast<long double>(q[k]) - p[k];
    b[k] = static_cast<long double>(r[k]) - p[k];
  }
  std::array<long double, 4> n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                               a[0] * b[1] - a[1] * b[0]};
  const long double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    n[k] /= length;
    n[3] += n[k] * p[k];
  }
  return n;
}

/// True if the normal points to the inside of a cell, whose facet this is.
bool points_inside(const std::array<long double, 4>& n, const Cell_view<3>& cell,
                   const std::vector<std::uint32_t>& facet) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (std::ranges::find(facet, cell.point_index(i)) != facet.end()) continue;
    const Point<3>& p = cell.point(i);
    return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] > n[3];
  }
  return false;
}

}  // namespace

template <class Real>
Plain_tables<Real>::Plain_tables(const Snapshot<3>& snapshot)
    : planes(snapshot.half_facet_slots() / 4), neighbours(planes.size()) {
  for (std::size_t index = 0; index < snapshot.cell_count(); ++index) {
    const Cell cell = snapshot.cell(index);
    for (std::size_t i = 0; i < 4; ++i) {
      const Half_facet f = Snapshot<3>::half_facet(cell, i);
      const std::vector<std::uint32_t> facet = snapshot.loop(f);
      std::array<long double, 4> n = plane(snapshot, facet);
      if (points_inside(n, snapshot.view(cell), facet))
        for (long double& x : n) x = -x;
      Plain_planes<Real>& of_cell = planes[to_index(cell)];
      for (std::size_t k = 0; k < 3; ++k) of_cell.normal[k][i] = static_cast<Real>(n[k]);
      of_cell.offset[i] = static_cast<Real>(n[3]);
      neighbours[to_index(cell)][i] =
          snapshot.is_impassable(f) ? plain_outside : to_index(snapshot.neighbour(f));
    }
  }
}

template struct Plain_tables<double>;
template struct Plain_tables<float>;

}  // namespace cellwalk::track_lengths
