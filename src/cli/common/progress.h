// SPDX-License-Identifier: LGPL-3.0-or-later
// Progress of long work: on a terminal one line on stderr that is redrawn and finally erased, and lines of
// the log if there is one (--log). Nothing is printed to a pipe.
#ifndef CELLWALK_CLI_COMMON_PROGRESS_H
#define CELLWALK_CLI_COMMON_PROGRESS_H

#include <chrono>
#include <cstdint>
#include <string>

#include "work_log.h"

namespace cellwalk::cli {

/// A stage of long work. Without a total it shows only the label; with one, also a bar, the share done, the
/// rate, the time left, and the memory in use. The line appears at once, is redrawn at most ten times a
/// second, and is erased at the end of the stage.
class Progress {
 public:
  explicit Progress(std::string label, std::uint64_t total = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of `total` units are finished.
  void update(std::uint64_t done);

 private:
  void draw(Stage::Clock::time_point now);

  Stage stage_;
  bool on_terminal_;
  Stage::Clock::time_point drawn_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_PROGRESS_H
