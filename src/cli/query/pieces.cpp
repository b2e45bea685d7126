// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions traced by several threads; written and summed up in order.
#include "pieces.h"

#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace cellwalk::cli {
namespace {

constexpr std::size_t rows_of_part = 1024;

}  // namespace

template <int D>
double largest_value(const Snapshot<D>& snapshot, double largest_weight) {
  // Free space lies in the box of the points; the sum of its sides is at least its diagonal.
  double size = 0;
  for (std::size_t k = 0; k < D; ++k) {
    const auto [low, high] =
        std::ranges::minmax(snapshot.points(), {}, [k](const Point<D>& p) { return p[k]; });
    size += high[k] - low[k];
  }
  const double largest = 2 * size * largest_weight;
  if (!std::isfinite(largest))
    throw Error(Error_code::input, largest_weight > 1
                                       ? "weight: products with lengths overflow; give smaller weights"
                                       : "a sum of lengths may overflow; scale the environment");
  return largest > 0 ? largest : 1;
}

template <int D>
Piece_tables<D>::Piece_tables(const Snapshot<D>& snapshot, const Locator<D>& locator, io::Csv_writer* table,
                              std::optional<double> largest)
    : locator_(locator), snapshot_(snapshot), tracer_(snapshot), table_(table) {
  if (largest) tally_.emplace(snapshot.cell_slots(), *largest);
}

template <int D>
void Piece_tables<D>::add(std::size_t first, std::span<const Query_row<D, 2>> rows,
                          const std::vector<Answer<D>>& answers) {
  std::vector<Traces> parts((rows.size() + rows_of_part - 1) / rows_of_part);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts.size(), 1), [&](const auto& range) {
    for (std::size_t part = range.begin(); part != range.end(); ++part) {
      const std::size_t begin = part * rows_of_part, end = std::min(begin + rows_of_part, rows.size());
      std::vector<Particle<D>> particles(end - begin);
      std::vector<Point<D>> targets(end - begin);
      for (std::size_t i = begin; i < end; ++i) {
        const Answer<D>& answer = answers[i];
        if (answer.status != Motion_status::free && answer.status != Motion_status::contact) continue;
        particles[i - begin] = locator_.particles_at(rows[i].points[0])[answer.side];
        targets[i - begin] = rows[i].points[1];
      }
      Walk_counts not_counted;
      tracer_.trace(particles, targets, parts[part], not_counted);
    }
  });
  std::size_t row = 0;
  for (const Traces& traces : parts)
    for (std::size_t i = 0; i < traces.size(); ++i, ++row)
      for (std::size_t piece = traces.offsets[i]; piece < traces.offsets[i + 1]; ++piece) {
        const std::uint32_t cell = snapshot_.index(traces.cells[piece]);
        const double length = traces.lengths[piece];
        if (table_) table_->row(first + row, cell, length);
        if (tally_) tally_->add(cell, rows[row].weight * length);
      }
}

template double largest_value(const Snapshot<2>&, double);
template double largest_value(const Snapshot<3>&, double);
template class Piece_tables<2>;
template class Piece_tables<3>;

}  // namespace cellwalk::cli
