// SPDX-License-Identifier: LGPL-3.0-or-later
// The peer that walks in floating point, as plain as can be.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_WALK_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_WALK_H

#include <array>
#include <vector>

#include "peer.h"
#include "plain_planes.h"

namespace cellwalk::track_lengths {

/// The planes of a snapshot of tetrahedra, and its neighbours behind passable facets. Facet i of a cell is
/// that of the snapshot.
template <class Real>
struct Plain_tables {
  explicit Plain_tables(const Snapshot<3>& snapshot);

  std::vector<Plain_planes<Real>> planes;  // by name
  std::vector<std::array<unsigned, 4>> neighbours;
};

template <class Real>
class Plain_walker {
 public:
  /// \param together rays followed at a time: 1 or 4
  Plain_walker(const World& world, unsigned together) : tables_(world.snapshot()), together_(together) {}

  /// Takes over the rays, in the form that the walk reads best.
  void take(const Rays& rays);
  void run(Peer_rows& rows) const;

 private:
  Plain_tables<Real> tables_;
  unsigned together_;
  std::vector<Plain_ray> rays_;
};

extern template struct Plain_tables<double>;
extern template struct Plain_tables<float>;
extern template class Plain_walker<double>;
extern template class Plain_walker<float>;

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_WALK_H
