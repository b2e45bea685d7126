// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of cells, and the refusal of those at which meshing would not end.
#ifndef CELLWALK_MESHING_FILL_SIZES_H
#define CELLWALK_MESHING_FILL_SIZES_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace cellwalk::detail {

/// The volume of the regular tetrahedron of circumradius 1, the largest in that sphere: 8/(9 sqrt 3).
constexpr double largest_tetrahedron = 0.51320023;

/// The volume of the regular tetrahedron of a circumradius.
constexpr double largest_volume(double circumradius) {
  return largest_tetrahedron * circumradius * circumradius * circumradius;
}

/// Refuses a value that is too small.
/// \param mesher,what,why the message "MESHER: a WHAT of .. is too small for a surface WHY"
inline void check_least(const char* mesher, const char* what, double value, double least,
                        const std::string& why) {
  constexpr double room_to_round = 1.05;  // since two digits are shown
  if (value < least)
    throw Error(Error_code::usage, fmt::format("{}: a {} of {:g} is too small for a surface {}: give at "
                                               "least {:.2g}",
                                               mesher, what, value, why, room_to_round * least));
}

/// Refuses a cell size that fills a volume with no fewer than `most` tetrahedra.
inline void check_cell_size(const char* mesher, double size, double volume, double most) {
  check_least(mesher, "cell size", size, std::cbrt(volume / (largest_tetrahedron * most)),
              fmt::format("that holds a volume of {:g}", volume));
}

/// The volume inside a surface and outside its obstacles.
inline double free_volume(const Surface_report& surface, const std::vector<Surface_report>& obstacles) {
  double volume = surface.volume;
  for (const Surface_report& obstacle : obstacles) volume -= obstacle.volume;
  return volume;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_SIZES_H
