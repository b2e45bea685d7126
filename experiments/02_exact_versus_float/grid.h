// SPDX-License-Identifier: LGPL-3.0-or-later
// What is varied, and the values it takes.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_GRID_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_GRID_H

#include <cmath>
#include <string>
#include <vector>

#include "worlds.h"

namespace cellwalk::exact_float {

/// One value of one variable.
struct Grid_point {
  std::string variable;
  double value;  ///< as tables show it
  Setting setting;
};

/// Distances from a degeneracy: 0, then powers of 16 from 1 to 2^40 ulp.
inline std::vector<Grid_point> degeneracy_points() {
  std::vector<Grid_point> points{{"degeneracy", 0, {.on_degeneracy = true}}};
  for (int ulps = 0; ulps <= 40; ulps += 4)
    points.push_back({"degeneracy", std::ldexp(1.0, ulps), {.ulps = ulps}});
  return points;
}

inline std::vector<Grid_point> all_points() {
  std::vector<Grid_point> points = degeneracy_points();
  for (int e = -20; e <= 20; e += 5) points.push_back({"scale", std::ldexp(1.0, e), {.scale = e}});
  points.push_back({"offset", 0, {}});
  for (int e = 0; e <= 24; e += 4) points.push_back({"offset", std::ldexp(1.0, e), {.offset = e}});
  for (int e = 0; e <= 16; e += 2) points.push_back({"aspect", std::ldexp(1.0, e), {.aspect = e}});
  for (const double turn : {0.0, 0x1p-12, 0x1p-8, 0x1p-5, 0x1p-3, 0x1p-2, 0x1p-1})
    points.push_back({"rotation", turn, {.turn = turn}});
  for (const double turn : {0x1p-12, 0x1p-5, 0x1p-2, 0x1p-1})
    points.push_back({"rounded", turn, {.turn = turn, .is_rounded = true}});
  for (int e = -6; e <= 4; e += 2)
    points.push_back({"length", std::ldexp(1.0, e), {.length = std::ldexp(1.0, e), .is_wide = true}});
  return points;
}

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_GRID_H
