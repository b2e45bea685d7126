// SPDX-License-Identifier: LGPL-3.0-or-later
// The log of long work (--log): where it is, as lines of JSON, for programs that run without a terminal.
#ifndef CELLWALK_CLI_COMMON_WORK_LOG_H
#define CELLWALK_CLI_COMMON_WORK_LOG_H

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cellwalk::cli {

/// A stage of long work: its label, and the part of it that is done.
struct Stage {
  using Clock = std::chrono::steady_clock;

  std::string label;
  std::uint64_t total = 0;  ///< units; 0: not known
  std::atomic<std::uint64_t> done{0};
  Clock::time_point start = Clock::now();
};

/// The progress of a stage.
struct Stage_state {
  double seconds = 0;       ///< since it began
  std::uint64_t done = 0;   ///< at that time
  double per_second = 0;    ///< units done
  double seconds_left = 0;  ///< if it goes on like that; 0 as long as nothing is done
};
Stage_state state_of(const Stage& stage);

/// Bytes of main memory that this process uses; 0 if the system does not report it.
std::uint64_t memory_in_use();

/// Seconds: some eleven days. Clocks cannot wait for as long as a double can express.
inline constexpr double longest_log_interval = 1e6;

/// While it lives, the stage that runs is written every so often, and each stage once more when it ends. A
/// process has one at most. Any thread may begin and end stages.
class Work_log {
 public:
  /// Nothing is opened before the first stage begins: until then the command may refuse the name, and must
  /// find its inputs as they were.
  Work_log(std::string path, std::chrono::duration<double> interval);
  ~Work_log();
  Work_log(const Work_log&) = delete;
  Work_log& operator=(const Work_log&) = delete;

  /// The name of the log; empty if there is none.
  static std::string name();

  // Without effect if there is no log.
  /// Goes on with a log that is there already.
  /// \throw Error(usage) if the file holds something else, Error(other) if it cannot be opened
  static void begin(const Stage& stage);
  static void end(const Stage& stage);

 private:
  void open();
  void write(const Stage& stage, bool is_end);
  void write_if_possible(const Stage& stage, bool is_end) noexcept;
  void repeat();

  std::string path_;
  std::ofstream file_;
  std::chrono::duration<double> interval_;
  std::mutex mutex_;  ///< guards the members below and the file
  std::condition_variable stopped_;
  bool is_stopped_ = false;
  std::vector<const Stage*> running_;  ///< the innermost one last
  std::thread writer_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_WORK_LOG_H
