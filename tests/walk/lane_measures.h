// SPDX-License-Identifier: LGPL-3.0-or-later
// Segments measured in lanes, and piece by piece.
#ifndef CELLWALK_TESTS_WALK_LANE_MEASURES_H
#define CELLWALK_TESTS_WALK_LANE_MEASURES_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/walk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "walk/trace/lane_functions.h"
#include "walk/trace/lane_planes.h"
#include "walk/trace/piece_lengths.h"

namespace cellwalk {

/// The lengths of all pieces of a motion, each by itself.
inline std::vector<double> lengths_of_pieces(const Snapshot<3>& snapshot, const Point<3>& from,
                                             const Point<3>& to, const std::vector<Cell_exit>& exits,
                                             std::size_t pieces) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < pieces; ++i)
    lengths.push_back(detail::length_of_piece<3>(snapshot, from, to, exits, i));
  return lengths;
}

/// A segment in lanes, and the pieces that it was divided into.
class Measured {
 public:
  Measured(const Point<3>& from, const Point<3>& to, const detail::Lane_planes& planes,
           const std::vector<unsigned>& met, double error, const detail::Lane_functions& functions) {
    const std::size_t stride = 3, room = met.size() + 3 + detail::lane_room;
    std::vector<double> kept(14 * detail::lane_room), kept_places(4 * room), lengths(room);
    std::vector<unsigned> strided(stride * (met.size() + detail::lane_room));
    for (std::size_t i = 0; i < met.size(); ++i) strided[stride * i] = met[i];
    detail::Lane_segments segments{};
    double* next = kept.data();
    const auto take = [&next](std::size_t size) { return std::exchange(next, next + size); };
    for (int k = 0; k < 3; ++k)
      for (double** array :
           {&segments.from[k], &segments.to[k], &segments.direction_high[k], &segments.direction_low[k]})
        *array = take(detail::lane_room);
    segments.length_high = take(detail::lane_room);
    segments.length_low = take(detail::lane_room);
    segments.error = error;
    for (std::size_t k = 0; k < 3; ++k) {
      *segments.from[k] = from[k];
      *segments.to[k] = to[k];
    }
    functions.set_directions(segments, 1);
    next = kept_places.data();
    const detail::Lane_places places{take(room), take(room), take(room), take(room)};
    unsigned long count = 0;
    functions.place(segments, 0, {planes.planes.data(), strided.data(), stride, met.size(), false}, places,
                    count);
    EXPECT_EQ(count, met.size() + 3);
    const unsigned long certain = functions.measure(places, count, error, lengths.data());
    length.assign(lengths.begin() + 2, lengths.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_EQ(certain, std::count_if(length.begin(), length.end(), [](double x) { return x > 0; }));
    is_certain = certain == length.size();
  }

  std::vector<double> length;
  bool is_certain = false;
};

}  // namespace cellwalk

#endif  // CELLWALK_TESTS_WALK_LANE_MEASURES_H
