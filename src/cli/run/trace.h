// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run --record: the motion of a run as a trace of its bodies.
#ifndef CELLWALK_CLI_RUN_TRACE_H
#define CELLWALK_CLI_RUN_TRACE_H

#include <cellwalk/internal/simulation/body_trace_recorder.h>
#include <cellwalk/io/atomic_file.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/world.h>

#include <memory>
#include <string>

namespace cellwalk::cli {

/// Refuses scenes that a trace cannot hold: those in 2D, and those with particles.
/// \throw Error(input) naming the scene and its key
template <int D>
void check_recordable(const Scene<D>& scene, const std::string& scene_name);

/// Records the bodies of a world; null if there is no file to write.
/// \pre the scene is recordable
/// \throw Error(input) naming the scene and the body of which a vertex has too many edges
std::unique_ptr<Body_trace_recorder> start_trace(const io::Atomic_file* file, const std::string& scene_name,
                                                 const World<3>& world);
/// 2D scenes are not recordable.
std::unique_ptr<Body_trace_recorder> start_trace(const io::Atomic_file* file, const std::string& scene_name,
                                                 const World<2>& world);

extern template void check_recordable(const Scene<2>&, const std::string&);
extern template void check_recordable(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_TRACE_H
