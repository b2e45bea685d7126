// SPDX-License-Identifier: LGPL-3.0-or-later
// The list of scenes to measure, which make_scenes.py writes, and what its files hold.
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_SCENES_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_SCENES_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "motion.h"

namespace cellwalk::real_scenes {

/// An entry of the list.
struct Scene_entry {
  std::string name;
  std::filesystem::path scene;        ///< as `cellwalk run` takes it
  std::filesystem::path environment;  ///< other cells with the same walls; empty: those of the scene
  std::filesystem::path trace;        ///< what the run recorded
  std::uint32_t first_step = 0;       ///< earlier ones are not measured
  double least_blocked = 0;  ///< share of the moves: with fewer contacts it is not the scene that is meant
};

/// Reads a list: JSON, an array of objects with these keys, of which `environment` and `least_blocked` may be
/// missing; names of files are relative to its folder.
/// \throw std::runtime_error if it is no such list
std::vector<Scene_entry> read_scene_list(const std::filesystem::path& path);

struct Loaded_scene {
  Cell_soup<3> soup;
  Gluing gluing;
  Motion motion;
};

/// \throw Error as the readers do; Error(input) if the scene is 2D, the trace does not suit, or fewer moves
///        are blocked than the entry demands
Loaded_scene load_scene(const Scene_entry& entry);

/// The cells of the environment of an entry.
Cell_soup<3> load_cells(const Scene_entry& entry);

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_SCENES_H
