// SPDX-License-Identifier: LGPL-3.0-or-later
// The frames of a run as grids for ParaView.
#ifndef CELLWALK_CLI_RUN_GRIDS_H
#define CELLWALK_CLI_RUN_GRIDS_H

#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/internal/simulation/world.h>

#include <vector>

namespace cellwalk::cli {

/// Particles as vertices. `contacts` are those since the frame before.
template <int D>
io::Vtu_grid particles_grid(const World<D>& world, const std::vector<Run_contact<D>>& contacts);

/// Bodies: each with its vertices, then its edges, then its faces. Cells have the number of their contacts;
/// points have their velocity, which is their displacement since `before` over the time step, or, where
/// `before` is empty, that of the body.
template <int D>
io::Vtu_grid bodies_grid(const World<D>& world, const std::vector<Run_contact<D>>& contacts,
                         const std::vector<Point<D>>& before, double time_step);

/// Contacts as vertices with their normals.
template <int D>
io::Vtu_grid contacts_grid(const std::vector<Run_contact<D>>& contacts);

/// Where all vertices of bodies are.
template <int D>
std::vector<Point<D>> body_positions(const World<D>& world);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_GRIDS_H
