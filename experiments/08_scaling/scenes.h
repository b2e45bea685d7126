// SPDX-License-Identifier: LGPL-3.0-or-later
// The scenes whose hand-overs are counted: those that ship with the project, larger.
#ifndef CELLWALK_EXPERIMENTS_SCALING_SCENES_H
#define CELLWALK_EXPERIMENTS_SCALING_SCENES_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::scaling {

/// A scene of data/ with changes, as `cellwalk run --set` makes them.
struct Scene_entry {
  std::string name, file;
  std::vector<std::string> changes;
  std::uint32_t steps = 0;
};

std::vector<Scene_entry> all_scenes(bool quick);

/// A scene in its environment, which stays where it is.
class Running_scene {
 public:
  explicit Running_scene(const Scene_entry& entry);
  Running_scene(const Running_scene&) = delete;
  Running_scene& operator=(const Running_scene&) = delete;

  const Snapshot<3>& snapshot() const { return environment_.snapshot(); }
  World<3>& world() { return world_; }

 private:
  Scene<3> scene_;
  Environment<3> environment_;
  World<3> world_;
};

}  // namespace cellwalk::scaling

#endif  // CELLWALK_EXPERIMENTS_SCALING_SCENES_H
