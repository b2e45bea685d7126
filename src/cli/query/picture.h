// SPDX-License-Identifier: LGPL-3.0-or-later
// Pictures of single motions, for `cellwalk query --picture`.
#ifndef CELLWALK_CLI_QUERY_PICTURE_H
#define CELLWALK_CLI_QUERY_PICTURE_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/query/query.h>
#include <cellwalk/walk/locate.h>

#include <array>

#include "picture_motion.h"

namespace cellwalk::cli {

/// Draws the motion of a point from the first point to the second one: the cells visited with their numbers,
/// the facets and vertices passed, and the facet at which it aims at the end, or its contact.
/// \pre the answer is that of the exact kernel with Touch::pass
void write_picture(io::Atomic_file& file, const Snapshot<2>& snapshot, const Locator<2>& locator,
                   std::size_t row, const std::array<Point<2>, 2>& points, const Answer<2>& answer);

/// Draws the motion of an edge: p moves from the first point to the second one while q stands still at the
/// third one. Shows the cells that p visits, those of the temporary particle that then walks along the edge,
/// and the chains of the edge.
/// \pre as above
void write_picture(io::Atomic_file& file, const Snapshot<2>& snapshot, const Locator<2>& locator,
                   std::size_t row, const std::array<Point<2>, 3>& points, const Answer<2>& answer);

/// Draws the motion of a point or an edge with a radius: all that is within its radius before the motion, on
/// the way and where it ends, the cells that its axis visits, and the contact or the nearest point of walls.
/// \pre the radius is not 0
void write_thick_picture(io::Atomic_file& file, const Snapshot<2>& snapshot, const Locator<2>& locator,
                         std::size_t row, const Pictured_motion<2>& shown, const Answer<2>& answer);

/// Draws a motion in space, with or without a radius, and the walls near it, cut off at a box.
/// \pre as above, for motions without a radius
void write_picture(io::Atomic_file& file, const Snapshot<3>& snapshot, std::size_t row,
                   const Pictured_motion<3>& shown, const Answer<3>& answer);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_PICTURE_H
