// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/program.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

void redirect(int descriptor, const fs::path& file) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

pid_t start(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& out,
            const fs::path& err, std::size_t largest_file = 0, int ignored = 0) {
  std::vector<char*> argv{const_cast<char*>("cellwalk")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    redirect(STDOUT_FILENO, out);
    redirect(STDERR_FILENO, err);
    if (chdir(folder.c_str()) != 0) _exit(126);
    // Whatever is ignored here, as where tests run in the background.
    for (const int signal : {SIGINT, SIGHUP, SIGQUIT})
      std::signal(signal, signal == ignored ? SIG_IGN : SIG_DFL);
    if (largest_file != 0) {
      const rlimit limit{largest_file, largest_file};
      if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
      std::signal(SIGXFSZ, SIG_IGN);
    }
    execv(CELLWALK_PROGRAM, argv.data());
    _exit(127);
  }
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Where the output of a run goes: beside the folder, which holds only what the program writes.
fs::path beside(const fs::path& folder, const char* suffix) { return folder.string() + suffix; }

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const fs::path& folder) {
  const fs::path out = beside(folder, ".out"), err = beside(folder, ".err");
  Outcome outcome;
  outcome.exit_code = wait_for(start(arguments, folder, out, err));
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

void interrupt_program(const std::vector<std::string>& arguments, const fs::path& folder, int milliseconds) {
  const fs::path out = beside(folder, ".out"), err = beside(folder, ".err");
  const pid_t child = start(arguments, folder, out, err);
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  kill(child, SIGTERM);
  wait_for(child);
  fs::remove(out);
  fs::remove(err);
}

Outcome stop_program(const std::vector<std::string>& arguments, const fs::path& folder, int signal,
                     const std::function<bool()>& is_time, std::size_t largest_file, bool is_ignored) {
  const fs::path out = beside(folder, ".out"), err = beside(folder, ".err");
  for (const fs::path& file : {out, err}) write_text(file, "");  // it may be stopped before it opens them
  const pid_t child = start(arguments, folder, out, err, largest_file, is_ignored ? signal : 0);
  Outcome outcome;
  int status = 0;
  for (bool is_sent = false;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    if (ended < 0) throw std::runtime_error("waitpid failed");
    if (!is_sent && is_time()) is_sent = kill(child, signal) == 0;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + " cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + " cannot be written");
}

std::vector<std::vector<std::string>> read_table(const fs::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_text(path));
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back(1);
    for (const char c : line) {
      if (c == ',')
        rows.back().emplace_back();
      else
        rows.back().back() += c;
    }
  }
  return rows;
}

void expect_same_certificate(const fs::path& report, const fs::path& other) {
  auto a = nlohmann::json::parse(read_text(report)).at("certificate");
  auto b = nlohmann::json::parse(read_text(other)).at("certificate");
  for (const char* volume : {"volume", "free_volume"}) {
    const double expected = b.at(volume);
    EXPECT_NEAR(a.at(volume).get<double>(), expected, 1e-9 * expected);
    a.erase(volume);
    b.erase(volume);
  }
  EXPECT_EQ(a, b);
}

Program::Program() {
  std::string name = (fs::temp_directory_path() / "cellwalk-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

Program::~Program() { fs::remove_all(folder_); }

std::string Program::succeed(const std::vector<std::string>& arguments) const {
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

void Program::expect_failure(int exit_code, const std::vector<std::string>& arguments,
                             const std::vector<std::string>& texts) const {
  const auto before = files();
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("cellwalk: ")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& text : texts) EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), before) << "the failed command left something behind";
}

std::vector<std::string> Program::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    names.push_back(fs::relative(entry.path(), folder_).string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace cellwalk::test
