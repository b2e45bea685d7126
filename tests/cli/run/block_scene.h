// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene whose walls follow a table: a solid block of one cube goes far through a grid of split cubes.
#ifndef CELLWALK_TESTS_CLI_RUN_BLOCK_SCENE_H
#define CELLWALK_TESTS_CLI_RUN_BLOCK_SCENE_H

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace cellwalk::test {

inline constexpr int block_steps = 40;

/// Writes scene.json and moves.csv into a folder: the block goes from x = 2 to x = 6, among particles.
inline void write_block_scene(const std::filesystem::path& folder, int dimension) {
  using nlohmann::json;
  constexpr int length_of_grid = 9, width = 7;
  constexpr double way = 0.1;  // of a step
  const bool in_space = dimension == 3;
  std::ofstream table(folder / "moves.csv");
  table << (in_space ? "step,point,x,y,z\n" : "step,point,x,y\n");
  for (int step = 1; step <= block_steps; ++step)
    for (int corner = 0; corner < 1 << dimension; ++corner) {
      const int x = 2 + corner % 2, y = 3 + corner / 2 % 2, z = in_space ? 3 + corner / 4 : 0;
      table << step << ',' << x + (length_of_grid + 1) * (y + (width + 1) * z) << ',' << x + way * step << ','
            << y;
      if (in_space) table << ',' << z;
      table << '\n';
    }
  const json low = in_space ? json{2, 3, 3} : json{2, 3}, end = in_space ? json{3, 4, 4} : json{3, 4};
  json cells{length_of_grid, width}, particles = json::array();
  if (in_space) cells.push_back(width);
  for (int i = 0; i < 12; ++i) {
    json place{0.37 + 0.7 * i, 3.2 + 0.05 * i};
    if (in_space) place.push_back(3.45);
    if (i != 3) particles.push_back({{"position", place}});  // the block is there
  }
  const json scene{{"dimension", dimension},
                   {"environment", {{"generate", in_space ? "tets" : "triangles"}, {"cells", cells}}},
                   {"particles", particles},
                   {"changes", json::array({{{"step", 1}, {"fill", {{"box", {low, end}}}}}})},
                   {"walls", {{"motion", "moves.csv"}}},
                   {"time_step", 0.01},
                   {"steps", block_steps},
                   {"output", {{"frame_every", 10}}}};
  std::ofstream(folder / "scene.json") << scene.dump();
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_RUN_BLOCK_SCENE_H
