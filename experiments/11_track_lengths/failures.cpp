// SPDX-License-Identifier: LGPL-3.0-or-later
#include "failures.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "judge.h"

namespace cellwalk::track_lengths {
namespace {

constexpr double granted = 1e-4;  // sides

/// A ray and its row of a peer.
struct Peer_ray {
  Point<3> from{}, direction{};
  std::span<const std::uint32_t> cells;
  std::span<const double> lengths;
};

Peer_ray peer_ray(const Rays& rays, std::size_t i, const Peer_rows& rows) {
  const Peer_row& row = rows.rows[i];
  const Peer_rows::List& list = rows.lists[row.list];
  Peer_ray ray{rays.starts[i].position,
               {},
               std::span(list.cells).subspan(row.begin, row.end - row.begin),
               std::span(list.lengths).subspan(row.begin, row.end - row.begin)};
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.direction[k] = rays.targets[i][k] - ray.from[k];
    square += ray.direction[k] * ray.direction[k];
  }
  for (double& x : ray.direction) x /= std::sqrt(square);
  return ray;
}

/// True if the middles of all pieces are in their cells.
bool is_in_cells(const Peer_ray& ray, const std::vector<Plain_planes<double>>& planes, double beside) {
  double position = 0;
  for (std::size_t i = 0; i < ray.cells.size(); ++i) {
    const double middle = position + ray.lengths[i] / 2;
    position += ray.lengths[i];
    const Plain_planes<double>& of_cell = planes[ray.cells[i]];
    for (std::size_t f = 0; f < 4; ++f) {
      double height = -of_cell.offset[f];
      for (std::size_t k = 0; k < 3; ++k)
        height += of_cell.normal[k][f] * (ray.from[k] + middle * ray.direction[k]);
      if (!(height <= beside)) return false;
    }
  }
  return true;
}

bool has_sum(const Peer_ray& ray, const Row& row, double beside) {
  double difference = 0;
  for (const double length : ray.lengths) {
    if (!(length >= -beside)) return false;
    difference += length;
  }
  for (const double length : row.lengths) difference -= length;
  return std::abs(difference) <= beside;
}

void compare(const Peer_ray& ray, const Row& row, Failures& failures) {
  if (!std::ranges::equal(ray.cells, row.cells, {}, {}, [](Cell cell) { return to_index(cell); })) return;
  for (std::size_t i = 0; i < row.lengths.size(); ++i) {
    ++failures.compared;
    failures.not_nearest += ray.lengths[i] != row.lengths[i];
    if (row.lengths[i] > 0)
      failures.greatest_error =
          std::max(failures.greatest_error, std::abs(ray.lengths[i] - row.lengths[i]) / row.lengths[i]);
  }
}

}  // namespace

Failures failures(const World& world, const std::vector<Plain_planes<double>>& planes, const Rays& rays,
                  const Traces& traces, const Peer_rows& rows) {
  Failures sum;
  const double beside = granted * world.side;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ++sum.rays;
    const Row row = row_of(traces, i);
    const Peer_ray ray = peer_ray(rays, i, rows);
    const bool arrives = row.end.status == Walk_status::arrived;
    const Peer_row::End how = rows.rows[i].how;
    if (how == Peer_row::endless)
      ++sum.endless;
    else if (arrives != (how == Peer_row::arrived))
      ++sum.lost;
    else if (!is_in_cells(ray, planes, beside))
      ++sum.wrong_cells;
    else if (!has_sum(ray, row, beside))
      ++sum.wrong_sums;
    compare(ray, row, sum);
  }
  return sum;
}

}  // namespace cellwalk::track_lengths
