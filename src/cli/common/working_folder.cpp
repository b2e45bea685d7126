// SPDX-License-Identifier: LGPL-3.0-or-later
#include "working_folder.h"

#include <cellwalk/internal/io/durable.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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
    if (entry->path().extension() == ".checkpoint" && entry->is_regular_file(failure)) return true;
  return failure && failure != std::errc::no_such_file_or_directory;  // there may be one
}

/// True of what a process made here, even if it was killed at once, and of what one left that was killed
/// while it removed this.
bool is_of_a_run(const fs::path& folder) {
  std::error_code failure;
  if (fs::is_regular_file(folder / "lock", failure)) return true;
  const fs::directory_iterator entries(folder, failure);
  return !failure && std::all_of(begin(entries), end(entries),
                                 [](const auto& entry) { return entry.path().filename() == "ended"; });
}

bool is_same_file(int descriptor, const fs::path& file) {
  struct stat opened, named;
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
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
  folder->replaces_ = replace;
  std::error_code ignored;
  if (!fs::exists(folder->path_, ignored))
    make_folder(folder->path_);
  else if (!is_of_a_run(folder->path_))
    throw Error(Error_code::usage,
                destination.string() + ".part: was not made by a run: remove it, or give another folder");
  folder->lock();
  if (!replace && has_checkpoint(folder->checkpoints()))
    throw Error(
        Error_code::usage,
        fmt::format("{}.part: holds a run that did not end: go on with it by `cellwalk run --resume {}`, "
                    "or remove it",
                    destination.string(), destination.string()));
  // What ended before its first checkpoint is of no use, and so is a checkpoint without results.
  fs::remove_all(folder->checkpoints(), ignored);
  fs::remove_all(folder->results(), ignored);
  fs::remove(folder->path_ / "ended", ignored);
  make_folder(folder->results());
  make_folder(folder->checkpoints());
  return folder;
}

std::unique_ptr<Working_folder> Working_folder::take_up(const fs::path& destination) {
  std::unique_ptr<Working_folder> folder(new Working_folder(destination));
  if (!is_of_a_run(folder->path_))
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
  // An empty one was about to be removed.
  return (!fs::exists(folder.path_, ignored) || fs::is_empty(folder.path_, ignored)) &&
         fs::is_regular_file(folder.destination_ / "run.json", ignored);
}

void Working_folder::allow_replacing(bool replaces) {
  replaces_ = replaces;
  if (!Output_folder::is_replaceable(destination_, replaces_)) refuse_destination(Error_code::usage);
}

void Working_folder::refuse_destination(Error_code code) const {
  throw Error(code, fmt::format("{}: is there, and this run is not to replace it: move it away, and go on by "
                                "`cellwalk run --resume {}`",
                                name_.string(), name_.string()));
}

void Working_folder::lock() {
  constexpr mode_t permissions = 0666;
  const fs::path file = path_ / "lock";
  lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, permissions);
  if (lock_ < 0) fail_at(path_, "cannot be written", std::error_code(errno, std::generic_category()));
  // The other process may have removed the file that was opened.
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0 && is_same_file(lock_, file)) return;
  close(std::exchange(lock_, -1));  // what is here belongs to the other one
  throw Error(Error_code::usage,
              fmt::format("{}.part: another process runs there: wait until it ends", name_.string()));
}

Working_folder::~Working_folder() {
  if (!is_done_ && lock_ >= 0 && !has_checkpoint(checkpoints())) clear();
  if (lock_ >= 0) close(lock_);
}

/// Removes what runs leave here. What tells that one has ended goes last: whoever finds it removes the rest.
void Working_folder::clear() noexcept {
  std::error_code failure;
  for (const fs::path& folder : {results(), checkpoints()}) {
    fs::remove_all(folder, failure);
    if (failure) return;
  }
  for (const char* file : {"ended.tmp", "lock", "ended"}) fs::remove(path_ / file, failure);
  fs::remove(path_, failure);
}

void Working_folder::prepare() {
  const std::string which = identity(results());
  const std::array<std::span<const std::byte>, 1> pieces{std::as_bytes(std::span(which))};
  io::write_durably(path_ / "ended", pieces);
  io::sync_all(results());
}

void Working_folder::put() {
  if (!Output_folder::is_replaceable(destination_, replaces_)) refuse_destination(Error_code::other);
  if (replacement_.put(results(), destination_, replaces_)) return;
  if (errno == EEXIST) refuse_destination(Error_code::other);
  fail_at(name_, "cannot be put in place", std::error_code(errno, std::generic_category()));
}

void Working_folder::take_back() noexcept { replacement_.take_back(results(), destination_); }

/// The new names are on the device before what they could be made from is gone.
void Working_folder::settle() noexcept {
  try {
    io::sync(destination_.parent_path());
  } catch (const Error&) {
    return;  // all is there: a second try removes it
  }
  is_done_ = true;
  clear();
}

}  // namespace cellwalk::cli
