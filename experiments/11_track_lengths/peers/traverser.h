// SPDX-License-Identifier: LGPL-3.0-or-later
// The peer that visits the cells of a CGAL triangulation along a segment, by exact predicates, and computes
// the lengths in doubles.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_TRAVERSER_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_TRAVERSER_H

#include "peer.h"
#include "plain_walk.h"

namespace cellwalk::track_lengths {

class Traverser {
 public:
  /// \pre the world is a Delaunay triangulation
  explicit Traverser(const World& world);

  void run(const Rays& rays, Peer_rows& rows) const;

 private:
  const World& world_;
  std::vector<Plain_planes<double>> planes_;  // by name; plane i is opposite vertex i of CGAL's cell
};

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_TRAVERSER_H
