// SPDX-License-Identifier: LGPL-3.0-or-later
// Lines of the log at the beginning and end of each stage, and at intervals by a thread.
#include "work_log.h"

#include <cellwalk/kernel/error.h>

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include "printable.h"

namespace cellwalk::cli {
namespace {

constexpr std::string_view beginning = R"({"at":")";  // of each line

std::atomic<Work_log*> the_log{nullptr};

/// Whether a log ends within a line, as one does whose writer was killed.
/// \throw Error(usage) if it is none
bool is_log_cut(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  if (none || size == 0) return false;
  std::ifstream file(path, std::ios::binary);
  std::string begins(std::min<std::uintmax_t>(size, beginning.size()), '\0');
  if (!file.read(begins.data(), static_cast<std::streamsize>(begins.size())) ||
      !beginning.starts_with(begins))
    throw Error(Error_code::usage, path + ": exists and is no log; give another file");
  return file.seekg(-1, std::ios::end) && file.get() != '\n';
}

}  // namespace

Stage_state state_of(const Stage& stage) {
  Stage_state state;
  state.seconds = std::chrono::duration<double>(Stage::Clock::now() - stage.start).count();
  state.done = stage.done;
  const auto done = static_cast<double>(state.done), total = static_cast<double>(stage.total);
  if (done > 0 && state.seconds > 0) {
    state.per_second = done / state.seconds;
    state.seconds_left = std::max(0.0, total - done) / state.per_second;
  }
  return state;
}

std::uint64_t memory_in_use() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0, resident = 0;
  if (!(file >> size >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

Work_log::Work_log(std::string path, std::chrono::duration<double> interval)
    : path_(std::move(path)), interval_(std::min(interval.count(), longest_log_interval)) {
  the_log = this;
  writer_ = std::thread([this] { repeat(); });
}

Work_log::~Work_log() {
  the_log = nullptr;
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  stopped_.notify_all();
  writer_.join();
}

std::string Work_log::name() {
  const Work_log* const log = the_log;
  return log == nullptr ? std::string{} : log->path_;
}

/// \pre mutex_ is held
void Work_log::open() {
  const bool is_cut = is_log_cut(path_);
  file_.open(path_, std::ios::app);
  if (!file_) throw Error(Error_code::other, path_ + ": cannot be written");
  if (is_cut) file_ << '\n';
}

void Work_log::begin(const Stage& stage) {
  Work_log* const log = the_log;
  if (log == nullptr) return;
  const std::lock_guard lock(log->mutex_);
  if (!log->file_.is_open()) log->open();
  log->running_.push_back(&stage);
}

void Work_log::end(const Stage& stage) {
  Work_log* const log = the_log;
  if (log == nullptr) return;
  const std::lock_guard lock(log->mutex_);
  if (std::erase(log->running_, &stage) > 0) log->write_if_possible(stage, true);
}

/// On its own thread, and at the end of a stage, errors have nowhere to go.
/// \pre mutex_ is held
void Work_log::write_if_possible(const Stage& stage, bool is_end) noexcept {
  try {
    write(stage, is_end);
  } catch (const std::bad_alloc&) {  // a line is missing
  }
}

/// \pre mutex_ is held
void Work_log::write(const Stage& stage, bool is_end) {
  const Stage_state state = state_of(stage);
  const std::time_t now = std::time(nullptr);
  nlohmann::ordered_json line{{"at", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
                              {"stage", stage.label}};
  if (stage.total > 0) {
    line["done"] = state.done;
    line["total"] = stage.total;
    line["per_second"] = state.per_second;
    if (!is_end && state.per_second > 0) line["seconds_left"] = state.seconds_left;
  }
  line["seconds"] = state.seconds;
  line["memory_bytes"] = memory_in_use();
  if (is_end) line["ended"] = true;
  if (!file_) return;
  file_ << line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
  // Work of days is not given up for its log.
  if (!file_)
    fmt::print(stderr, "cellwalk: {}: writing failed; the work goes on without a log\n", printable(path_));
}

void Work_log::repeat() {
  std::unique_lock lock(mutex_);
  while (!stopped_.wait_for(lock, interval_, [this] { return is_stopped_; }))
    if (!running_.empty()) write_if_possible(*running_.back(), false);
}

}  // namespace cellwalk::cli
