// SPDX-License-Identifier: LGPL-3.0-or-later
// The start of the search for supporting walls from the chains of the three sides.
#include "find_supporting_walls.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>

#include "supporting_wall_search.h"

namespace cellwalk::detail {
namespace {

Face_side side_of(const Side_chain& chain, const Particle<3>& first, const Particle<3>& second) {
  if (chain.is_reversed) return {chain, second.position, first.position, second.cell};
  return {chain, first.position, second.position, first.cell};
}

}  // namespace

void sort(Supporting_walls& supporting_walls) { std::sort(supporting_walls.begin(), supporting_walls.end()); }

std::array<Face_side, 3> sides_of(const Face_chains& chains, const Particle<3>& p, const Particle<3>& q,
                                  const Particle<3>& r) {
  return {side_of(chains.pq, p, q), side_of(chains.qr, q, r), side_of(chains.rp, r, p)};
}

Swept_in_plane swept_in_plane(const Corners& corners, Walk_counts& counts) {
  Swept_in_plane triangles;
  // All triangles of the points: those on either side of one diagonal miss sets that lie along it.
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<Point<3>, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = corners[k + (k >= left_out)];
    if (!are_collinear(triangle[0], triangle[1], triangle[2])) triangles.emplace_back(triangle, counts);
  }
  return triangles;
}

Face_registration find_supporting_walls(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                                        const Swept_in_plane& swept, const std::array<Face_side, 3>& sides,
                                        const Candidate_walls& candidates, const Supporting_walls& known,
                                        Known use) {
  Supporting_wall_search search(snapshot, triangle, swept, candidates);
  if (use == Known::binding) search.keep(known);
  for (const Face_side& side : sides) search.follow(side);
  if (use == Known::preferred) search.keep(known);
  return {search.under_face(), search.piercing()};
}

}  // namespace cellwalk::detail
