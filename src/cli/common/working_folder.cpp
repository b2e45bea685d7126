// SPDX-License-Identifier: LGPL-3.0-or-later
#include "working_folder.h"

#include <cellwalk/internal/io/durable.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "output_folder.h"

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_at(const fs::path& path, const char* what, const std::error_code& reason) {
  throw Error(Error_code::other, path.string() + ": " + what + ": " + reason.message());
}

void make_folder(const fs::path& path) {
  std::error_code failure;
  if (!fs::create_directory(path, failure)) fail_at(path, "cannot be made", failure);
}

/// What tells a folder from all others of its file system, whatever its name.
std::string identity(const fs::path& folder) {
  struct stat status;
  if (stat(folder.c_str(), &status) != 0) return {};
  return fmt::format("{} {}\n", status.st_dev, status.st_ino);
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool has_checkpoint(const fs::path& folder) {
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure))
    if (entry->path().extension() == ".checkpoint") return true;
  return static_cast<bool>(failure);  // there may be one
}

void remove_unfinished_files(const fs::path& folder) {
  std::vector<fs::path> unfinished;
  std::error_code failure;
  for (fs::recursive_directory_iterator entry(folder, failure);
       !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
    if (entry->path().extension() == ".tmp") unfinished.push_back(entry->path());
  for (const fs::path& file : unfinished) fs::remove(file, failure);
}

}  // namespace

Working_folder::Working_folder(const fs::path& destination)
    : name_(destination), destination_(Output_folder::place_of(destination)), path_(destination_) {
  path_ += ".part";
}

std::unique_ptr<Working_folder> Working_folder::make(const fs::path& destination, bool replace) {
  Output_folder::check_destination(destination, replace);
  std::unique_ptr<Working_folder> folder(new Working_folder(destination));
  std::error_code ignored;
  if (fs::exists(folder->path_, ignored)) {
    // What ended before its first checkpoint is of no use.
    const bool is_ours = fs::is_directory(folder->checkpoints(), ignored);
    if (!is_ours || (!replace && has_checkpoint(folder->checkpoints())))
      throw Error(
          Error_code::usage,
          fmt::format("{}.part: holds a run that did not end: go on with it by `cellwalk run --resume {}`, "
                      "or remove it",
                      destination.string(), destination.string()));
    folder->lock();
    fs::remove_all(folder->results(), ignored);
    fs::remove_all(folder->checkpoints(), ignored);
    fs::remove(folder->path_ / "ended", ignored);
  } else {
    make_folder(folder->path_);
    folder->lock();
  }
  make_folder(folder->results());
  make_folder(folder->checkpoints());
  return folder;
}

std::unique_ptr<Working_folder> Working_folder::take_up(const fs::path& destination) {
  std::unique_ptr<Working_folder> folder(new Working_folder(destination));
  std::error_code ignored;
  if (!fs::is_directory(folder->checkpoints(), ignored))
    throw Error(Error_code::usage,
                fmt::format("{}.part: is no folder of a run that did not end: only one with "
                            "--checkpoint-every leaves it",
                            destination.string()));
  folder->lock();
  const std::string ended = content(folder->path_ / "ended");
  folder->is_done_ = !ended.empty() && ended == identity(folder->destination_);
  if (!folder->is_done_) remove_unfinished_files(folder->path_);
  return folder;
}

bool Working_folder::has_ended(const fs::path& destination) {
  const Working_folder folder(destination);
  std::error_code ignored;
  return !fs::exists(folder.path_, ignored) && fs::is_regular_file(folder.destination_ / "run.json", ignored);
}

void Working_folder::lock() {
  constexpr mode_t permissions = 0666;
  lock_ = open((path_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, permissions);
  if (lock_ < 0) fail_at(path_, "cannot be written", std::error_code(errno, std::generic_category()));
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  throw Error(Error_code::usage,
              fmt::format("{}.part: another process runs there: wait until it ends", name_.string()));
}

Working_folder::~Working_folder() {
  std::error_code ignored;
  if (!is_done_ && lock_ >= 0 && !has_checkpoint(checkpoints())) fs::remove_all(path_, ignored);
  if (lock_ >= 0) close(lock_);
}

void Working_folder::prepare() {
  const std::string which = identity(results());
  const std::array<std::span<const std::byte>, 1> pieces{std::as_bytes(std::span(which))};
  io::write_durably(path_ / "ended", pieces);
  io::sync_all(results());
}

void Working_folder::put() {
  if (!replacement_.put(results(), destination_))
    fail_at(name_, "cannot be put in place", std::error_code(errno, std::generic_category()));
}

void Working_folder::take_back() noexcept { replacement_.take_back(results(), destination_); }

/// The new names are on the device before what they could be made from is gone.
void Working_folder::settle() noexcept {
  std::error_code ignored;
  try {
    io::sync(destination_.parent_path());
  } catch (const Error&) {
    return;  // all is there: a second try removes it
  }
  is_done_ = true;
  fs::remove_all(path_, ignored);
}

}  // namespace cellwalk::cli
