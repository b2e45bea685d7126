// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangles moved corner by corner through many worlds, each move judged.
#ifndef CELLWALK_TESTS_EDGE_FACE_TRIAL_H
#define CELLWALK_TESTS_EDGE_FACE_TRIAL_H

#include <gtest/gtest.h>

#include <iostream>

#include "edge/face_judge.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {

inline void report(const char* what, const Face_seen& seen) {
  const Face_counts& c = seen.counts;
  std::cout << what << ": " << seen.sweeps << " sweeps, " << seen.hits << " met by a wall (" << seen.face_only
            << " by no edge, " << seen.through_vertex << " at a vertex, " << seen.inside_hits
            << " inside the face, " << seen.at_once << " at 0); " << seen.flat << " flat, " << seen.landed
            << " walls landed on, " << seen.on_one_sided << " of them one-sided, " << seen.leaves_through
            << " times left through one, " << seen.chosen << " sides chosen; " << seen.registered
            << " registered, " << seen.pierced << " pierced, " << seen.pierced_together
            << " by walls together; p blocked " << seen.blocked << ", the face before " << seen.before_blocked
            << ", an edge astray " << seen.edge_on_other_side << "; clear " << c.clear << " of " << c.faces
            << ", walls " << c.walls << ", clipped " << c.clipped << "; missed " << seen.misses
            << ", false blocks " << seen.false_blocks << " and " << seen.unjudged
            << " by sides chosen, wrong times " << seen.wrong_times << ", wrong rests "
            << seen.wrong_supporting_walls << "\n";
}

inline void expect_no_fault(const Face_seen& seen) {
  EXPECT_EQ(seen.misses + seen.false_blocks + seen.wrong_times + seen.wrong_supporting_walls, 0);
}

/// Places faces in a world and moves them.
inline void sweep_faces(Edge_world<3>& w, bool generic, Face_seen& seen) {
  for (int k = 0; k < 40; ++k) {
    const Particle<3> p = w.start();
    if (p.cell == Cell::none) continue;
    const Particle<3> q = w.end(p), r = w.end(p);
    if (q.cell == Cell::none || r.cell == Cell::none) continue;
    Face_body body(w.snapshot);
    const bool is_valid = body.place({p, q, r});
    if (body.counts.faces == 0) continue;  // an edge crosses a wall
    check_piercing(w.walls, body, is_valid, generic, seen);
    if (is_valid) {
      Judge judge(w.snapshot, w.world.name, w.walls, body, generic, seen);
      for (std::size_t step = 0; step < 9; ++step) {
        w.choose_kind();
        judge.move(step % 3, w.target(body.corner(step % 3)));
      }
    }
    seen.counts += body.counts;
  }
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_FACE_TRIAL_H
