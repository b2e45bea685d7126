// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles at random places of free space, and where they fly.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_RANDOM_FLIGHTS_H
#define CELLWALK_EXPERIMENTS_ABLATION_RANDOM_FLIGHTS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <cstddef>
#include <vector>

namespace cellwalk::ablation {

/// The mean length of the edges of the cells of some particles.
double edge_length(const Snapshot<3>& snapshot, const std::vector<Particle<3>>& particles);

/// Particles at random places. In other cells with the same free space they are at the same places.
std::vector<Particle<3>> random_starts(const Snapshot<3>& snapshot, std::size_t count, Random& random);

/// Moves of one length in random directions.
std::vector<Vector<3>> random_moves(double length, std::size_t count, Random& random);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_RANDOM_FLIGHTS_H
