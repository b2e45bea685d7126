// SPDX-License-Identifier: LGPL-3.0-or-later
// The methods on Bullet's structures, in single or in double precision.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BULLET_WORLD_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BULLET_WORLD_H

#include "body_box.h"
#include "common/peers/bullet_walls.h"
#include "world.h"

namespace cellwalk::figure_8 {

using experiments::Bullet_mesh;
using experiments::bullet_point;

/// The name of a method in this precision. A macro: the two plug-ins must share no variable.
#ifdef BT_USE_DOUBLE_PRECISION
#define CELLWALK_BULLET_NAME(name) (name "_double")
#else
#define CELLWALK_BULLET_NAME(name) (name)
#endif

/// Adds the methods on Bullet's triangle hierarchy.
void add_bullet_peers(const Grid_world& world, Peers& peers);
/// Adds GIMPACT's.
void add_gimpact_peers(const Grid_world& world, Peers& peers);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_BULLET_WORLD_H
