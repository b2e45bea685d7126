// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the program as a user does, in a folder of its own.
#ifndef CELLWALK_TESTS_CLI_PROGRAM_H
#define CELLWALK_TESTS_CLI_PROGRAM_H

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cellwalk::test {

struct Outcome {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out, err;
  int signal = 0;  ///< by which it ended
};

/// Runs `cellwalk ARGUMENTS` in a folder and waits for it. Output goes to files, never to a terminal.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// Starts the program, interrupts it with SIGTERM after some milliseconds, and waits for it.
void interrupt_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                       int milliseconds);

/// Starts the program, sends it a signal once is_time() is true, and waits for it: it may have ended before.
/// \param largest_file no file may grow beyond so many bytes, as on a full device; 0: any may
/// \param is_ignored it is started with the signal ignored; otherwise that is not handed on
Outcome stop_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                     int signal, const std::function<bool()>& is_time, std::size_t largest_file = 0,
                     bool is_ignored = false);

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// Rows of a comma-separated table, the header first.
std::vector<std::vector<std::string>> read_table(const std::filesystem::path& path);

/// The certificates of two JSON reports agree: counts exactly, volumes up to the order of summation.
void expect_same_certificate(const std::filesystem::path& report, const std::filesystem::path& other);

/// A test in an empty folder, removed afterwards.
class Program : public testing::Test {
 protected:
  Program();
  ~Program() override;

  Outcome run(const std::vector<std::string>& arguments) const { return run_program(arguments, folder_); }
  /// Runs the program and expects success, with nothing on stderr.
  std::string succeed(const std::vector<std::string>& arguments) const;
  /// Runs the program and expects the exit code, one line `cellwalk: ...` on stderr that holds every text,
  /// nothing on stdout, and no file that was not there before.
  void expect_failure(int exit_code, const std::vector<std::string>& arguments,
                      const std::vector<std::string>& texts) const;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string text(const std::string& name) const { return read_text(path(name)); }
  void write(const std::string& name, const std::string& text) const { write_text(path(name), text); }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::vector<std::string> files() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_PROGRAM_H
