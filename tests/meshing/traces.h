// SPDX-License-Identifier: LGPL-3.0-or-later
// What meshers might leave behind.
#ifndef CELLWALK_TESTS_MESHING_TRACES_H
#define CELLWALK_TESTS_MESHING_TRACES_H

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>

namespace cellwalk::test {

/// Files in the current folder, which meanwhile is one of its own, dumps in the folder for temporary ones,
/// beside which other tests may run, descriptors, and processes.
class Traces {
 public:
  Traces() {
    std::string name = (std::filesystem::temp_directory_path() / "cellwalk-traces-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::filesystem::current_path(folder_);
  }
  ~Traces() {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(folder_);
  }
  Traces(const Traces&) = delete;
  Traces& operator=(const Traces&) = delete;

  void expect_unchanged() const {
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
    EXPECT_EQ(entries(std::filesystem::temp_directory_path(), "dump-bug"), dumps_);
    EXPECT_EQ(entries("/proc/self/fd", ""), descriptors_);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a process is left";
    EXPECT_EQ(errno, ECHILD);
  }

 private:
  static std::size_t entries(const std::filesystem::path& folder, const std::string& prefix) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      count += entry.path().filename().string().starts_with(prefix);
    return count;
  }

  std::filesystem::path before_ = std::filesystem::current_path(), folder_;
  std::size_t dumps_ = entries(std::filesystem::temp_directory_path(), "dump-bug");
  std::size_t descriptors_ = entries("/proc/self/fd", "");
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_MESHING_TRACES_H
