// SPDX-License-Identifier: LGPL-3.0-or-later
// The peer that has no walk: a tree of all facets gives those that a ray meets; their positions are sorted,
// and the cell of each piece is the one in which its midpoint is located.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_MIDPOINTS_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_MIDPOINTS_H

#include <memory>

#include "peer.h"

namespace cellwalk::track_lengths {

/// CGAL's AABB_tree in doubles; points are located by the library's tree of cells, which is exact.
class Midpoints {
 public:
  explicit Midpoints(const World& world);
  ~Midpoints();

  void run(const Rays& rays, Peer_rows& rows) const;

 private:
  struct Facets;
  const World& world_;
  std::unique_ptr<Facets> facets_;
};

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_MIDPOINTS_H
