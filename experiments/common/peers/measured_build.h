// SPDX-License-Identifier: LGPL-3.0-or-later
// Time and memory of building a peer's structures.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_MEASURED_BUILD_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_MEASURED_BUILD_H

#include <malloc.h>

#include <chrono>
#include <cstddef>
#include <utility>

namespace cellwalk::experiments {

/// What a peer cost to build.
struct Build {
  double milliseconds = 0;
  std::size_t bytes = 0;     ///< held after the build; 0 where the peer holds nothing of its own
  const char* per = "wall";  ///< what the bytes grow with: "wall" (triangle) or "cell"
};

/// What two processes can tell each other of a build, for experiments::shared_trials().
template <class Archive, class Measured>
void members_of_build(Archive& archive, Measured& build) {
  archive(build.milliseconds);
  archive(build.bytes);
}

/// Bytes that the program holds from the C library, in all arenas and in mapped blocks.
inline std::size_t held_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Calls `make` and returns what it made. `build` receives the time, and how much more memory is held after
/// it.
template <class Make>
auto measured_build(Build& build, const char* per, const Make& make) {
  const std::size_t before = held_bytes();
  const auto start = std::chrono::steady_clock::now();
  auto made = make();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const std::size_t after = held_bytes();
  build = {time.count(), after > before ? after - before : 0, per};
  return made;
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_MEASURED_BUILD_H
