// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk run --record: the motion of a run as a trace of its bodies.
#ifndef CELLWALK_CLI_RUN_TRACE_H
#define CELLWALK_CLI_RUN_TRACE_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/body_trace_recorder.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "result_files.h"

namespace cellwalk::cli {

/// Refuses scenes that a trace cannot hold: those in 2D, and those with particles.
/// \throw Error(input) naming the scene and its key
template <int D>
void check_recordable(const Scene<D>& scene, const std::string& scene_name);

/// Records the bodies of a world.
/// \pre the scene is recordable
/// \throw Error(input) naming the scene and the body of which a vertex has too many edges
std::unique_ptr<Body_trace_recorder> start_trace(const std::string& scene_name, const World<3>& world);
/// 2D scenes are not recordable.
std::unique_ptr<Body_trace_recorder> start_trace(const std::string& scene_name, const World<2>& world);
/// The same, going on with the trace that a run recorded before.
std::unique_ptr<Body_trace_recorder> go_on_with_trace(const World<3>& world, Body_trace trace);
std::unique_ptr<Body_trace_recorder> go_on_with_trace(const World<2>& world, Body_trace trace);

/// Where among the results a trace is that may not be written elsewhere.
inline constexpr const char* kept_trace_name = "record.trace";

/// Writes it to a file, or among the results if there is none.
void write_trace(const Body_trace& trace, io::Atomic_file* file, const std::filesystem::path& results);

/// A growing trace, in a file from which it can be read again.
class Kept_trace {
 public:
  explicit Kept_trace(Result_files& place);

  /// Appends the steps that were recorded since the last call.
  void append(const Body_trace& trace);
  /// All that was appended.
  /// \throw Error(input) if the file was changed
  Body_trace read();

 private:
  std::filesystem::path path_;
  std::unique_ptr<io::Byte_sink> file_;
  std::size_t before_ = 0, targets_ = 0, answers_ = 0;
};

extern template void check_recordable(const Scene<2>&, const std::string&);
extern template void check_recordable(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_TRACE_H
