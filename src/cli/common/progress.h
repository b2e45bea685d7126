// SPDX-License-Identifier: LGPL-3.0-or-later
// Progress on a terminal: one line on stderr that is redrawn and finally erased. Nothing is printed to a
// pipe.
#ifndef CELLWALK_CLI_COMMON_PROGRESS_H
#define CELLWALK_CLI_COMMON_PROGRESS_H

#include <chrono>
#include <cstdint>
#include <string>

namespace cellwalk::cli {

/// A stage of long work. Without a total it shows only the label; with one, also a bar, the share done and
/// the time left. The line appears at once, is redrawn at most ten times a second, and is erased at the end
/// of the stage.
class Progress {
 public:
  explicit Progress(std::string label, std::uint64_t total = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of `total` units are finished.
  void update(std::uint64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::uint64_t done, Clock::time_point now);

  std::string label_;
  std::uint64_t total_;
  bool on_terminal_;
  Clock::time_point start_, drawn_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_PROGRESS_H
