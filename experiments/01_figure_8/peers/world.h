// SPDX-License-Identifier: LGPL-3.0-or-later
// A world in the two forms that peers are built from: its cells, and the triangles of its walls.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_WORLD_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_WORLD_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/point.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/peers/wall_mesh.h"
#include "hexahedra_trace.h"

namespace cellwalk::figure_8 {

using experiments::Wall_mesh;

struct Grid_world {
  const Trace* trace = nullptr;
  Cell_soup<3> soup;
  Gluing gluing;
  Wall_mesh walls;

  std::size_t cell_count() const { return soup.cell_count(); }
  /// The cell that a point lies in.
  /// \pre the point lies in the grid and in no facet
  std::uint32_t cell_at(const Point<3>& p) const {
    std::array<std::uint32_t, 3> i;
    for (std::size_t k = 0; k < 3; ++k) i[k] = static_cast<std::uint32_t>(p[k]);
    return i[0] + trace->nx * (i[1] + trace->ny * i[2]);
  }
};

/// The grid of a trace, which must outlive it.
Grid_world grid_world(const Trace& trace);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_WORLD_H
