// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment in a picture: walls in 3D; cells and walls in the plane.
#ifndef CELLWALK_INTERNAL_DRAWING_WALLS_H
#define CELLWALK_INTERNAL_DRAWING_WALLS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/drawing/drawing.h>

#include <cstddef>
#include <cstdint>
#include <unordered_set>

namespace cellwalk::drawing {

/// The appearance of an environment.
struct Wall_materials {
  std::uint32_t wall, free_cell, solid_cell, inner_edge;
};

/// True for a share of all numbers, evenly spread.
bool is_among(double share, std::size_t number);

/// The lines of draw_walls(): the walls in the plane, and inner edges if there are few cells.
Round_shapes lines_of_walls(const Snapshot<2>& snapshot);
Round_shapes lines_of_walls(const Snapshot<3>& snapshot);

/// Adds the walls at free space, each once; in the plane all cells, too. Of facets and cells beyond a fixed
/// number of triangles only a share is drawn, as many times more opaque or larger as it is smaller: where
/// there are so many, each is about as small as a pixel.
/// \param lines the share of the lines to draw
/// \param unit the diagonal of the environment's box
void draw_walls(Drawing& drawing, const Snapshot<2>& snapshot, const Wall_materials& materials, double lines,
                double unit);
void draw_walls(Drawing& drawing, const Snapshot<3>& snapshot, const Wall_materials& materials, double lines,
                double unit);

/// The same in 3D without some walls.
/// \param left_out seen from either side
void draw_walls_but(Drawing& drawing, const Snapshot<3>& snapshot, const Wall_materials& materials,
                    const std::unordered_set<Half_facet>& left_out);

}  // namespace cellwalk::drawing

#endif  // CELLWALK_INTERNAL_DRAWING_WALLS_H
