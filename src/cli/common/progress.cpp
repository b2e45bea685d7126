// SPDX-License-Identifier: LGPL-3.0-or-later
// The progress line with its rate and remaining time, redrawn at intervals.
#include "progress.h"

#include <cellwalk/internal/ranks/ranks.h>

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace cellwalk::cli {
namespace {

constexpr int bar_width = 30;                              // characters
constexpr std::chrono::milliseconds redraw_interval{100};  // short enough to look continuous
constexpr const char* erase_line = "\r\033[K";

/// A number with three digits: 1.23M.
std::string brief(double value) {
  constexpr std::array<const char*, 4> units{"", "k", "M", "G"};
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < units.size(); ++unit) value /= 1000;
  const int digits = value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f}{}", value, digits, units[unit]);
}

std::string duration(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::llround(std::min(seconds, 1e12)));
  constexpr std::uint64_t minute = 60, hour = 3600;
  if (whole < minute) return fmt::format("{} s", whole);
  if (whole < hour) return fmt::format("{} min {} s", whole / minute, whole % minute);
  return fmt::format("{} h {} min", whole / hour, whole % hour / minute);
}

}  // namespace

Progress::Progress(std::string label, std::uint64_t total)
    : on_terminal_(isatty(STDERR_FILENO) == 1 && !is_later_rank()) {
  stage_.label = std::move(label);
  stage_.total = total;
  Work_log::begin(stage_);
  if (on_terminal_) draw(stage_.start);
}

Progress::~Progress() {
  Work_log::end(stage_);
  if (on_terminal_) std::fputs(erase_line, stderr);
}

void Progress::update(std::uint64_t done) {
  stage_.done = done;
  if (!on_terminal_) return;
  const auto now = Stage::Clock::now();
  if (now - drawn_ >= redraw_interval) draw(now);
}

void Progress::draw(Stage::Clock::time_point now) {
  drawn_ = now;
  if (stage_.total == 0) {
    fmt::print(stderr, "{}{} ...", erase_line, stage_.label);
  } else {
    const double share = std::min(1.0, static_cast<double>(stage_.done) / static_cast<double>(stage_.total));
    const int filled = static_cast<int>(share * bar_width);
    std::string more;
    if (const Stage_state state = state_of(stage_); state.per_second > 0)
      more = fmt::format(", {}/s, {} left, {}B", brief(state.per_second), duration(state.seconds_left),
                         brief(static_cast<double>(memory_in_use())));
    fmt::print(stderr, "{}{} [{:=<{}}{: <{}}] {:3.0f} %{}", erase_line, stage_.label, "", filled, "",
               bar_width - filled, 100 * share, more);
  }
  std::fflush(stderr);
}

}  // namespace cellwalk::cli
