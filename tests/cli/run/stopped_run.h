// SPDX-License-Identifier: LGPL-3.0-or-later
// A run that is stopped again and again and goes on from its checkpoints, beside one that is not.
#ifndef CELLWALK_TESTS_CLI_RUN_STOPPED_RUN_H
#define CELLWALK_TESTS_CLI_RUN_STOPPED_RUN_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {

/// The count of a test of CI length times CELLWALK_TEST_LENGTH, at least 1.
inline int scaled(int count_in_ci) {
  const char* const length = std::getenv("CELLWALK_TEST_LENGTH");
  return std::max(1, static_cast<int>((length != nullptr ? std::atof(length) : 1) * count_in_ci));
}

/// The step of the newest checkpoint of a run; -1 if there is none.
inline std::int64_t newest_step(const std::filesystem::path& folder) {
  std::int64_t step = -1;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder / "out.part" / "checkpoints", failure), end;
       !failure && entry != end; entry.increment(failure))
    if (const std::string name = entry->path().filename().string(); name.ends_with(".checkpoint"))
      step = std::max<std::int64_t>(step, std::atoll(name.c_str() + 5));
  return step;
}

/// Names of all files below a folder, ascending.
inline std::vector<std::string> names_below(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.push_back(std::filesystem::relative(entry.path(), folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Everything below one folder is below another, byte by byte, and nothing else.
inline void expect_same_files(const std::filesystem::path& folder, const std::filesystem::path& expected) {
  const std::vector<std::string> names = names_below(expected);
  EXPECT_EQ(names_below(folder), names);
  for (const std::string& name : names) {
    if (!std::filesystem::is_regular_file(expected / name) || !std::filesystem::exists(folder / name))
      continue;
    EXPECT_TRUE(read_text(folder / name) == read_text(expected / name)) << name << " is another file";
  }
}

/// Two folders: `whole`, with a run that is not stopped, and `parts`, with the same run to be stopped.
class Stopped_run : public Program {
 protected:
  /// Runs `cellwalk run ARGUMENTS -o out` in `whole`.
  void run_whole(std::vector<std::string> arguments) {
    std::filesystem::create_directory(path("whole"));
    std::filesystem::create_directory(path("parts"));
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"-o", "out"});
    arguments_ = arguments;
    const Outcome whole = run_program(arguments, path("whole"));
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    said_ = whole.out;
  }
  /// The arguments that begin the same run with checkpoints.
  std::vector<std::string> begin(int every) const {
    std::vector<std::string> arguments = arguments_;
    arguments.insert(arguments.end(), {"--checkpoint-every", std::to_string(every)});
    return arguments;
  }
  static std::vector<std::string> resume() { return {"run", "--resume", "out"}; }
  std::filesystem::path parts() const { return path("parts"); }

  /// The run has ended, and left what the other one did.
  void expect_same(const Outcome& last) const {
    EXPECT_EQ(last.exit_code, 0) << last.err;
    EXPECT_EQ(last.out, said_);
    expect_same_files(parts(), path("whole"));
  }

 private:
  std::vector<std::string> arguments_;
  std::string said_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_RUN_STOPPED_RUN_H
