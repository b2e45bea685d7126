// SPDX-License-Identifier: LGPL-3.0-or-later
// All that most programs need: environments from files and generators, particles, traces, edges, bodies,
// queries, walls that move, pictures. docs/start.md begins with this header, which includes nothing of CGAL.
// import_environment() is in the library cellwalk::loading, draw() in cellwalk::drawing, all else in
// cellwalk::core. Not included: the combinatorial map (environment/map.h), the walk for number types of your
// own (walk/walk_impl.h), compiled environments and parts by place or name (environment/compiled.h,
// selection.h), the methods of the paper (paper.h), and readers, writers and meshers with all their options
// (io/, loading/, meshing/).
#ifndef CELLWALK_CELLWALK_H
#define CELLWALK_CELLWALK_H

#include <cellwalk/body/body.h>
#include <cellwalk/drawing/draw.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/room.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/loading/import.h>
#include <cellwalk/query/query.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/tally.h>
#include <cellwalk/walk/trace.h>
#include <cellwalk/walk/walk.h>

#endif  // CELLWALK_CELLWALK_H
