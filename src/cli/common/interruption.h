// SPDX-License-Identifier: LGPL-3.0-or-later
// The interruption of a program that first has to clean up.
#ifndef CELLWALK_CLI_COMMON_INTERRUPTION_H
#define CELLWALK_CLI_COMMON_INTERRUPTION_H

#include <csignal>

namespace cellwalk::cli {

/// Thrown by Interruption::check(); the handler cleans up and ends the program by the signal.
struct Interrupted {
  int signal;
};

using Signal_handler = void (*)(int);

/// Has a signal handled, unless whoever started the program has it ignored: nohup(1) does that with SIGHUP,
/// and a shell with SIGINT for work in the background. Returns what handled it before.
Signal_handler handle_unless_ignored(int signal, Signal_handler handler);

/// Records SIGINT, SIGTERM and SIGHUP during its lifetime instead of ending the program, but for
/// those that are ignored. One at a time.
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
  Signal_handler before_[3];
};

/// Ends the program as the signal would have. Does not return.
[[noreturn]] void end_by(const Interrupted& interrupted);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_INTERRUPTION_H
