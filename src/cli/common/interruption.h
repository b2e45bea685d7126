// SPDX-License-Identifier: LGPL-3.0-or-later
// An interrupted program that first cleans up what it has begun.
#ifndef CELLWALK_CLI_COMMON_INTERRUPTION_H
#define CELLWALK_CLI_COMMON_INTERRUPTION_H

#include <csignal>

namespace cellwalk::cli {

/// Thrown by Interruption::check; whoever has cleaned up ends the program by the signal.
struct Interrupted {
  int signal;
};

/// While it lives, SIGINT, SIGTERM and SIGHUP only leave a note. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// \throw Interrupted if a signal has come
  void check() const;

 private:
  using Handler = void (*)(int);
  Handler before_[3];
};

/// Ends the program as the signal would have. Does not return.
[[noreturn]] void end_by(const Interrupted& interrupted);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_INTERRUPTION_H
