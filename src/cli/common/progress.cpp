// SPDX-License-Identifier: LGPL-3.0-or-later
#include "progress.h"

#include <cellwalk/internal/ranks/ranks.h>

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace cellwalk::cli {
namespace {

constexpr int bar_width = 30;                              // characters
constexpr std::chrono::milliseconds redraw_interval{100};  // short enough to look continuous
constexpr const char* erase_line = "\r\033[K";

}  // namespace

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)),
      total_(total),
      on_terminal_(isatty(STDERR_FILENO) == 1 && !is_later_rank()),
      start_(Clock::now()) {
  if (on_terminal_) draw(0, start_);
}

Progress::~Progress() {
  if (on_terminal_) std::fputs(erase_line, stderr);
}

void Progress::update(std::uint64_t done) {
  if (!on_terminal_) return;
  const auto now = Clock::now();
  if (now - drawn_ >= redraw_interval) draw(done, now);
}

void Progress::draw(std::uint64_t done, Clock::time_point now) {
  drawn_ = now;
  if (total_ == 0) {
    fmt::print(stderr, "{}{} ...", erase_line, label_);
  } else {
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
    const int filled = static_cast<int>(share * bar_width);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const std::string left = share > 0 ? fmt::format(", {:.0f} s left", elapsed * (1 - share) / share) : "";
    fmt::print(stderr, "{}{} [{:=<{}}{: <{}}] {:3.0f} %{}", erase_line, label_, "", filled, "",
               bar_width - filled, 100 * share, left);
  }
  std::fflush(stderr);
}

}  // namespace cellwalk::cli
