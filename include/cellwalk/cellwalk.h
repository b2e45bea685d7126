// SPDX-License-Identifier: LGPL-3.0-or-later
// All of the core in one header: environments and their generators, particles, edges, bodies, questions. Light: it includes no CGAL.
// Not in it: the map (environment/map.h), the walk for kernels of one's own (walk/walk_impl.h), scenes (simulation/), and the
// other components (io/, meshing/, loading/).
#ifndef CELLWALK_CELLWALK_H
#define CELLWALK_CELLWALK_H

#include <cellwalk/body/body.h>
#include <cellwalk/body/generate.h>
#include <cellwalk/body/transform.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/generate/grid.h>
#include <cellwalk/environment/generate/room.h>
#include <cellwalk/environment/generate/vessel.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/query/move.h>
#include <cellwalk/query/sweep.h>
#include <cellwalk/records/make_body.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#endif  // CELLWALK_CELLWALK_H
