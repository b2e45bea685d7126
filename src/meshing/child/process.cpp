// SPDX-License-Identifier: GPL-3.0-or-later
// The start by posix_spawn() with given descriptors and signals, and the wait for the end.
#include "process.h"

#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "meshing/child/protocol.h"

namespace cellwalk::detail {
namespace {

/// The interval at which a process is tested where the system does not report its end.
constexpr int longest_unwatched = 5;  // milliseconds

/// The files and signals that a process begins with.
class Start {
 public:
  Start(const Memory_file& in, const Memory_file& out, const Memory_file& complaints) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, complaints.descriptor(), STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&files_, out.descriptor(), output_descriptor);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_init(&attributes_);
    // In a group of its own an interruption from the terminal does not reach it: whoever waits decides.
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Start() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  /// Returns an error number, or 0.
  int run(pid_t& id, const std::string& program, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    return posix_spawn(&id, program.c_str(), &files_, &attributes_, words.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

}  // namespace

Process::Process(const std::string& program, const std::vector<std::string>& arguments, const Memory_file& in,
                 const Memory_file& out, const Memory_file& complaints) {
  if (const int problem = Start(in, out, complaints).run(id_, program, arguments); problem != 0)
    throw Error(Error_code::other, fmt::format("{}: cannot be started: {}", program, std::strerror(problem)));
  watch_ = static_cast<int>(syscall(SYS_pidfd_open, id_, 0));
}

Process::~Process() {
  if (!has_ended_) {
    kill();
    while (!end(0)) continue;
  }
  if (watch_ >= 0) ::close(watch_);
}

std::optional<Process::End> Process::wait(std::chrono::milliseconds longest) {
  pollfd watched{watch_, POLLIN, 0};
  const int milliseconds = static_cast<int>(longest.count());
  if (watch_ >= 0)
    ::poll(&watched, 1, milliseconds);
  else
    ::poll(nullptr, 0, std::min(longest_unwatched, milliseconds));
  return end(WNOHANG);
}

std::optional<Process::End> Process::end(int options) {
  int status = 0;
  const pid_t found = ::waitpid(id_, &status, options);
  if (found == 0 || (found < 0 && errno == EINTR)) return std::nullopt;
  has_ended_ = true;
  // A program that ignores the ends of its children does not get their status: the output must show it.
  if (found < 0) return End{};
  if (WIFSIGNALED(status)) return End{0, WTERMSIG(status)};
  return End{WEXITSTATUS(status), 0};
}

void Process::kill() const {
  ::kill(-id_, SIGKILL);  // its group: processes that it may have started itself
  if (watch_ >= 0)
    syscall(SYS_pidfd_send_signal, watch_, SIGKILL, nullptr, 0);
  else
    ::kill(id_, SIGKILL);
}

}  // namespace cellwalk::detail
