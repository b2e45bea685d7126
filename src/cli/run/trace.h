// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run --record: the motion of a run as a trace.
#ifndef CELLWALK_CLI_RUN_TRACE_H
#define CELLWALK_CLI_RUN_TRACE_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/internal/simulation/trace_rule.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/world.h>

#include <memory>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// Refuses scenes that a trace cannot hold: its environment is a grid of unit cubes (generator hexes, neither
/// scaled nor rotated nor sheared), and all that moves are bodies with the 8 vertices and 12 edges of the
/// hexahedron.
/// \throw Error(input) naming the scene and its key
template <int D>
void check_recordable(const Scene<D>& scene, const std::vector<Body_soup<D>>& shapes,
                      const std::string& scene_name);

/// How bodies are to move that are recorded: by the rule of traces. What meets a wall is reported as contacts
/// too.
Body_options recorded_options();

/// Records a run whose bodies move by recorded_options().
class Run_trace {
 public:
  /// \pre the scene is recordable, the world has made no step
  /// \throw Error as check_trace_start(), with the name of the scene
  Run_trace(io::Atomic_file& file, const std::string& scene_name, const Environment<3>& environment,
            const World<3>& world, const Scene<3>& scene);

  /// To be called after each step.
  void record(const World<3>& world);
  /// Scenes of the plane are not recordable: never called.
  void record(const World<2>&) {}

  /// Completes the file, which the caller commits.
  void write() { io::write_trace(file_, trace_); }

 private:
  io::Atomic_file& file_;
  Trace trace_;
};

/// A record into a file; none if it is null.
template <int D>
std::unique_ptr<Run_trace> start_trace(io::Atomic_file* file, const std::string& scene_name,
                                       const Environment<D>& environment, const World<D>& world,
                                       const Scene<D>& scene) {
  if constexpr (D == 3)
    if (file != nullptr) return std::make_unique<Run_trace>(*file, scene_name, environment, world, scene);
  return nullptr;
}

extern template void check_recordable(const Scene<2>&, const std::vector<Body_soup<2>>&, const std::string&);
extern template void check_recordable(const Scene<3>&, const std::vector<Body_soup<3>>&, const std::string&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_TRACE_H
