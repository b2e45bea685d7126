// SPDX-License-Identifier: LGPL-3.0-or-later
#include "interruption.h"

#include <cstdlib>

namespace cellwalk::cli {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t noted = 0;

void note(int signal) { noted = signal; }

}  // namespace

Signal_handler handle_unless_ignored(int signal, Signal_handler handler) {
  struct sigaction now;
  if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) return SIG_IGN;
  return std::signal(signal, handler);
}

Interruption::Interruption() {
  noted = 0;
  for (int i = 0; i < 3; ++i) before_[i] = handle_unless_ignored(signals[i], note);
}

Interruption::~Interruption() {
  for (int i = 0; i < 3; ++i) std::signal(signals[i], before_[i]);
}

bool Interruption::has_come() const { return noted != 0; }

void Interruption::check() const {
  if (noted) throw Interrupted{noted};
}

void end_by(const Interrupted& interrupted) {
  std::signal(interrupted.signal, SIG_DFL);
  std::raise(interrupted.signal);
  std::abort();  // only if the signal is blocked
}

}  // namespace cellwalk::cli
