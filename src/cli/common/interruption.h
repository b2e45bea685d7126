// SPDX-License-Identifier: LGPL-3.0-or-later
// Signals by which others end the program, and programs that first have to clean up.
#ifndef CELLWALK_CLI_COMMON_INTERRUPTION_H
#define CELLWALK_CLI_COMMON_INTERRUPTION_H

#include <array>
#include <csignal>
#include <cstddef>

namespace cellwalk::cli {

/// Signals are numbered from 1.
inline constexpr std::size_t signal_count = NSIG;

/// True if a signal from outside ends a program that does not handle it, and may be handled: those of a
/// terminal, of batch systems before a limit (SIGXCPU, SIGUSR1, SIGUSR2), of timers, and any without a
/// meaning. Not a closed pipe and the limit of file sizes, which are errors of writing.
bool ends_programs(int signal);

/// True if a signal reports a defect.
bool is_crash(int signal);

/// Thrown by Interruption::check(); the handler cleans up and ends the program by the signal.
struct Interrupted {
  int signal;
};

using Signal_handler = void (*)(int);

/// Installs a handler of a signal, unless whoever started the program has it ignored: nohup(1) does that with
/// SIGHUP, and a shell with SIGINT for work in the background. Returns the previous handler.
Signal_handler handle_unless_ignored(int signal, Signal_handler handler);

/// Records signals that end programs during its lifetime, instead of ending the program, but for those that
/// are ignored. A signal after the last check() acts when its lifetime ends. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// True if a signal has arrived.
  bool has_come() const;
  /// \throw Interrupted if a signal has arrived
  void check() const;

 private:
  std::array<Signal_handler, signal_count> before_{};
};

/// Ends the program as the signal would have, without a dump of its memory where others end it. Safe in a
/// signal handler, after which it ends.
void raise_at_last(int signal);

/// The same elsewhere. Does not return.
[[noreturn]] void end_by(const Interrupted& interrupted);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_INTERRUPTION_H
