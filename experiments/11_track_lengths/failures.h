// SPDX-License-Identifier: LGPL-3.0-or-later
// What peers get wrong, beside the rows of the library, and by how much.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_FAILURES_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_FAILURES_H

#include <cellwalk/walk/trace.h>

#include <cstdint>
#include <vector>

#include "peers/peer.h"
#include "peers/plain_planes.h"

namespace cellwalk::track_lengths {

/// Rays by the first fault that they have. Peers are granted a ten-thousandth of a side: so far a piece may
/// lie beside its cell, and a sum be off.
struct Failures {
  std::uint64_t rays = 0;
  std::uint64_t endless = 0;      ///< the walk had no end
  std::uint64_t lost = 0;         ///< it left where the motion arrives, or arrived where a wall blocks it
  std::uint64_t wrong_cells = 0;  ///< the middle of a piece is outside its cell
  std::uint64_t wrong_sums = 0;   ///< a length is negative, or their sum is not that of the row
  /// Of rays with the same cells as the row: pieces, those whose length is not the nearest double, and the
  /// greatest error of a length relative to itself.
  std::uint64_t compared = 0, not_nearest = 0;
  double greatest_error = 0;
};

/// \param planes of the cells by name, in double precision
Failures failures(const World& world, const std::vector<Plain_planes<double>>& planes, const Rays& rays,
                  const Traces& traces, const Peer_rows& rows);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_FAILURES_H
