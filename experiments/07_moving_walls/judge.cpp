// SPDX-License-Identifier: LGPL-3.0-or-later
#include "judge.h"

#include "kernel/rational_meeting.h"

namespace cellwalk::moving_walls {
namespace {

using Tetrahedron = std::array<Point<3>, 4>;

/// True if the plane of a facet of the tetrahedron parts it strictly from the edge.
bool are_parted(const Tetrahedron& k, const Edge& edge) {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto sign_with = [&](const Point<3>& x) {
      Tetrahedron replaced = k;
      replaced[i] = x;
      return test::volume_sign<3>(replaced);
    };
    const int own = test::volume_sign<3>(k);
    if (own != 0 && sign_with(edge[0]) == -own && sign_with(edge[1]) == -own) return true;
  }
  return false;
}

}  // namespace

bool passes_by_fractions(const Moving_wall& wall, const Edge& edge, Judgement& counts) {
  const Tetrahedron k{wall.from, wall.to, wall.still[0], wall.still[1]};
  if (!meet(experiments::box_of(k[0], k[1], k[2], k[3]), experiments::box_of(edge[0], edge[1]))) return false;
  ++counts.pairs;
  if (are_parted(k, edge)) return false;
  if (test::first_time<3>(k, edge)) return true;
  if (test::relation<3>(k, edge) == test::Relation::apart) return false;
  ++counts.touches;
  const Tetrahedron seen{wall.from, wall.still[0], wall.still[1], wall.to};
  const int way = test::volume_sign<3>(seen);
  if (way == 0) return false;  // the wall moves in its plane, and passes nothing that lies on one side
  const Tetrahedron back{wall.to, wall.from, wall.still[0], wall.still[1]};
  if (!test::meets_off_start<3>(k, edge)) return way > 0 && test::meets_off_start<3>(back, edge);
  return test::meets_off_start<3>(back, edge);
}

Judgement judge(const Swept_walls& walls, const Body_edges& edges) {
  Judgement result;
  const auto moves = walls.moves();
  result.blocked.assign(moves.size(), 0);
  for (std::uint32_t i = 0; i < moves.size(); ++i) {
    const Wall_move& move = moves[i];
    for (const std::uint32_t t : walls.walls().triangles_at(move.vertex)) {
      const Moving_wall wall = moving_wall(walls, t, i);
      // Not the boxes of the step: the judge finds their mistakes, too.
      const Box swept = experiments::box_of(wall.from, wall.to, wall.still[0], wall.still[1]);
      for (const Body_edges::Group& group : edges.groups) {
        if (!meet(swept, group.box)) continue;
        for (std::uint32_t e = group.begin; e < group.end; ++e) {
          if (!result.blocked[i]) result.blocked[i] = passes_by_fractions(wall, edges.ends[e], result);
          if (move.after == move.to || move.after == move.from) continue;
          Moving_wall to_stop = wall;
          to_stop.to = move.after;
          result.bad_stops += passes_by_fractions(to_stop, edges.ends[e], result);
        }
      }
    }
  }
  return result;
}

}  // namespace cellwalk::moving_walls
