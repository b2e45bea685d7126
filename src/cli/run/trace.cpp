// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include "cli/common/environment_file.h"

namespace cellwalk::cli {

template <int D>
void check_recordable(const Scene<D>& scene, const std::string& scene_name) {
  const auto refuse = [&](const char* key, const char* what) {
    throw Error(Error_code::input, fmt::format("{}: {}: {}", scene_name, key, what));
  };
  if (D == 2) refuse("dimension", "a trace holds 3D bodies: record a scene of dimension 3");
  if (scene.walls) refuse("walls", "a trace has walls that stand still: leave them out");
  if (!scene.changes.list.empty())
    refuse("changes", "a trace has walls that stay as they are: leave them out");
  if (!scene.particles.empty()) refuse("particles", "a trace holds bodies only: leave them out");
}

std::unique_ptr<Body_trace_recorder> start_trace(const io::Atomic_file* file, const std::string& scene_name,
                                                 const World<3>& world) {
  if (file == nullptr) return nullptr;
  return naming(scene_name, [&] { return std::make_unique<Body_trace_recorder>(world); });
}

std::unique_ptr<Body_trace_recorder> start_trace(const io::Atomic_file*, const std::string&,
                                                 const World<2>&) {
  return nullptr;
}

template void check_recordable(const Scene<2>&, const std::string&);
template void check_recordable(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli
