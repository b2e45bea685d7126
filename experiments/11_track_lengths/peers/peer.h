// SPDX-License-Identifier: LGPL-3.0-or-later
// What all peers are given, and what they answer.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PEER_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PEER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rays.h"

namespace cellwalk::track_lengths {

/// The row of a ray: its pieces are [begin, end) of a list.
struct Peer_row {
  enum End : std::uint8_t { arrived, left, endless } how = arrived;  ///< left: it met the boundary
  std::uint8_t list = 0;
  std::size_t begin = 0, end = 0;
};

/// Pieces in several lists, so that rays that are followed together each write to one. Lists may be longer
/// than what the rows use.
struct Peer_rows {
  struct List {
    std::vector<std::uint32_t> cells;  ///< names
    std::vector<double> lengths;
  };
  static constexpr std::size_t most_lists = 4;
  std::array<List, most_lists> lists;
  std::vector<Peer_row> rows;
};

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PEER_H
