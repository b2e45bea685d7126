// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run --record: the motion of a run as a trace of its bodies.
#ifndef CELLWALK_CLI_RUN_TRACE_H
#define CELLWALK_CLI_RUN_TRACE_H

#include <cellwalk/internal/io/body_trace_file.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/world.h>

#include <memory>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// Refuses scenes that a trace cannot hold: those in 2D, with particles, or with nothing else.
/// \throw Error(input) naming the scene and its key
template <int D>
void check_recordable(const Scene<D>& scene, const std::string& scene_name);

/// Records a run: where its bodies stand before each step, where they are to go, and what walls answer to
/// that.
class Run_trace {
 public:
  /// \pre the scene is recordable, the world has made no step
  /// \throw Error(input) naming the body of which a vertex has too many edges
  Run_trace(io::Atomic_file& file, const std::string& scene_name, const World<3>& world);

  /// To be called before each step, and after it.
  void before_step(const World<3>& world);
  void after_step(const World<3>& world);
  /// 2D scenes are not recordable: never called.
  void before_step(const World<2>&) {}
  void after_step(const World<2>&) {}

  /// Completes the file, which the caller commits, after the last step.
  void write(const World<3>& world);
  void write(const World<2>&) {}

 private:
  io::Atomic_file& file_;
  Body_trace trace_;
  std::vector<std::vector<std::uint32_t>> degrees_;
  std::vector<Body<3>> copies_;  ///< of the bodies before the step: the answers are theirs
  Step_report<3> report_;
  Body_counts counts_;
};

/// A record into a file; none if it is null.
template <int D>
std::unique_ptr<Run_trace> start_trace(io::Atomic_file* file, const std::string& scene_name,
                                       const World<D>& world) {
  if constexpr (D == 3)
    if (file != nullptr) return std::make_unique<Run_trace>(*file, scene_name, world);
  return nullptr;
}

extern template void check_recordable(const Scene<2>&, const std::string&);
extern template void check_recordable(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_TRACE_H
