// SPDX-License-Identifier: LGPL-3.0-or-later
// The handlers of signals, and the end of the program by the signal that came.
#include "interruption.h"

#include <sys/prctl.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

namespace cellwalk::cli {
namespace {

constexpr std::array crashes{SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};
/// Those that end nothing, cannot be handled, or are errors of writing.
constexpr std::array not_ending{SIGCHLD, SIGCONT, SIGKILL, SIGPIPE,  SIGSTOP, SIGTSTP,
                                SIGTTIN, SIGTTOU, SIGURG,  SIGWINCH, SIGXFSZ};

volatile std::sig_atomic_t noted = 0;

void note(int signal) { noted = signal; }

}  // namespace

bool is_crash(int signal) { return std::ranges::count(crashes, signal) > 0; }

bool ends_programs(int signal) {
  if (signal >= __SIGRTMIN && signal < SIGRTMIN) return false;  // those of the C library
  return signal > 0 && signal <= SIGRTMAX && !is_crash(signal) && std::ranges::count(not_ending, signal) == 0;
}

Signal_handler handle_unless_ignored(int signal, Signal_handler handler) {
  struct sigaction now;
  if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) return SIG_IGN;
  return std::signal(signal, handler);
}

Interruption::Interruption() {
  noted = 0;
  for (int signal = 1; signal < NSIG; ++signal)
    if (ends_programs(signal))
      before_[static_cast<std::size_t>(signal)] = handle_unless_ignored(signal, note);
}

Interruption::~Interruption() {
  for (int signal = 1; signal < NSIG; ++signal)
    if (ends_programs(signal)) std::signal(signal, before_[static_cast<std::size_t>(signal)]);
  if (noted && std::uncaught_exceptions() == 0) std::raise(noted);
}

bool Interruption::has_come() const { return noted != 0; }

void Interruption::check() const {
  if (noted) throw Interrupted{noted};
}

void raise_at_last(int signal) {
  if (!is_crash(signal)) prctl(PR_SET_DUMPABLE, 0);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void end_by(const Interrupted& interrupted) {
  raise_at_last(interrupted.signal);
  std::abort();  // only if the signal is blocked
}

}  // namespace cellwalk::cli
