// SPDX-License-Identifier: LGPL-3.0-or-later
// The rows of a block in lanes: their segments, and the lengths of their pieces.
#ifndef CELLWALK_WALK_TRACE_ROW_LENGTHS_H
#define CELLWALK_WALK_TRACE_ROW_LENGTHS_H

#include <cellwalk/walk/trace.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "block_walk.h"
#include "lane_functions.h"

namespace cellwalk::detail {

/// The segments of a block.
class Block_segments {
 public:
  explicit Block_segments(double error) : kept_(14 * stride) {
    double* next = kept_.data();
    const auto take = [&next] { return std::exchange(next, next + stride); };
    for (int k = 0; k < 3; ++k) {
      lanes_.from[k] = take();
      lanes_.to[k] = take();
      lanes_.direction_high[k] = take();
      lanes_.direction_low[k] = take();
    }
    lanes_.length_high = take();
    lanes_.length_low = take();
    lanes_.error = error;
  }

  template <int D>
  void set(std::span<const Particle<D>> particles, std::span<const Point<D>> targets,
           const Lane_functions& functions) {
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t i = 0; i < particles.size(); ++i) {
        lanes_.from[k][i] = particles[i].position[k];
        lanes_.to[k][i] = targets[i][k];
      }
    functions.set_directions(lanes_, particles.size());
  }
  const Lane_segments& lanes() const { return lanes_; }

 private:
  static constexpr std::size_t stride = rows_of_block + lane_room;
  std::vector<double> kept_;
  Lane_segments lanes_{};
};

/// The lengths of the pieces of some rows, which are computed together.
class Row_lengths {
 public:
  Row_lengths(const Lane_functions& functions, const Lane_segments& segments)
      : functions_(functions), segments_(segments) {}

  void clear() { count_ = rows_ = 0; }
  /// \param segment that of the row
  /// \return where its lengths are after measure()
  std::size_t add(std::size_t segment, const Lane_crossings& crossings) {
    const std::size_t at = count_ + 2;
    reserve(at + crossings.count + 1);
    functions_.place(segments_, segment, crossings, places_, count_);
    ++rows_;
    return at;
  }
  void measure() {
    are_certain_ = functions_.measure(places_, count_, segments_.error, lengths_) == count_ - 2 * rows_;
  }
  /// Those that are not certain are 0.
  const double* at(std::size_t i) const { return lengths_ + i; }
  bool are_certain(std::size_t at, std::size_t pieces) const {
    return are_certain_ || std::all_of(lengths_ + at, lengths_ + at + pieces, [](double x) { return x > 0; });
  }

 private:
  void reserve(std::size_t count) {
    if (count + lane_room <= stride_) return;
    // Enough for most; were it a power of two, the arrays would be in each other's way in the cache.
    const std::size_t stride = std::max<std::size_t>(700, 2 * count + lane_room);
    std::unique_ptr<double[]> kept(new double[5 * stride]);
    double* next = kept.get();
    for (double** array :
         {&places_.height_high, &places_.height_low, &places_.slope_high, &places_.slope_low, &lengths_}) {
      std::copy_n(*array, count_, next);
      *array = std::exchange(next, next + stride);
    }
    kept_ = std::move(kept);
    stride_ = stride;
  }

  const Lane_functions& functions_;
  const Lane_segments& segments_;
  std::unique_ptr<double[]> kept_;
  std::size_t stride_ = 0, count_ = 0, rows_ = 0;
  bool are_certain_ = false;  ///< all of them
  Lane_places places_{};
  double* lengths_ = nullptr;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_ROW_LENGTHS_H
