// SPDX-License-Identifier: LGPL-3.0-or-later
// The box of a body in one step: of its vertices where they stand and of their targets. Every segment and
// every triangle that the step tests lies in it, whatever the answers are.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BODY_BOX_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BODY_BOX_H

#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/peers/box.h"
#include "peer.h"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace cellwalk::figure_8 {

using experiments::Box;
using experiments::box_of;

/// The box of the eight positions and the eight targets of a body.
inline Box body_box(const Point<3>* positions, const Point<3>* targets) {
  // Two points are six numbers: three lanes of two, whose minima and maxima are folded at the end.
  const double* const lists[2] = {positions->data(), targets->data()};
  std::array<double, 6> low, high;
#ifdef __SSE2__
  __m128d least[3], most[3];
  for (std::size_t k = 0; k < 3; ++k) least[k] = most[k] = _mm_loadu_pd(lists[0] + 2 * k);
  for (const double* x : lists)
    for (std::size_t i = 0; i < 3 * trace_vertices; i += 6)
      for (std::size_t k = 0; k < 3; ++k) {
        const __m128d pair = _mm_loadu_pd(x + i + 2 * k);
        least[k] = _mm_min_pd(least[k], pair);
        most[k] = _mm_max_pd(most[k], pair);
      }
  for (std::size_t k = 0; k < 3; ++k) {
    _mm_storeu_pd(low.data() + 2 * k, least[k]);
    _mm_storeu_pd(high.data() + 2 * k, most[k]);
  }
#else
  std::copy_n(lists[0], 6, low.begin());
  high = low;
  for (const double* x : lists)
    for (std::size_t i = 0; i < 3 * trace_vertices; i += 6)
      for (std::size_t k = 0; k < 6; ++k) {
        low[k] = std::min(low[k], x[i + k]);
        high[k] = std::max(high[k], x[i + k]);
      }
#endif
  Box b;
  for (std::size_t k = 0; k < 3; ++k) {
    b.low[k] = std::min(low[k], low[k + 3]);
    b.high[k] = std::max(high[k], high[k + 3]);
  }
  return b;
}

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BODY_BOX_H
