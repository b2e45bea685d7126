// SPDX-License-Identifier: LGPL-3.0-or-later
// The making, taking up, replacing and removing of OUT.part, in steps that survive a kill.
#include "working_folder.h"

#include <cellwalk/internal/io/durable.h>
#include <cellwalk/internal/io/own_files.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
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

/// Those of a run.
constexpr std::array<const char*, 2> folders{"checkpoints", "results"};

[[noreturn]] void fail_at(const fs::path& path, const char* what, const std::error_code& reason) {
  throw Error(Error_code::other, path.string() + ": " + what + ": " + reason.message());
}

void make_folder(const fs::path& path) {
  std::error_code failure;
  if (!fs::create_directory(path, failure)) fail_at(path, "cannot be made", failure);
}

/// Empty if there is no such file.
std::string content(const fs::path& file) {
  std::error_code failure;
  if (!fs::is_regular_file(file, failure)) return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The content that distinguishes the results of a run from those of others, also where they were copied to,
/// or are seen from another machine.
std::string identity(const fs::path& folder) { return content(folder / "run.json"); }

bool has_checkpoint(const fs::path& folder) {
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure))
    if (entry->path().extension() == ".checkpoint" && entry->is_regular_file(failure)) return true;
  return failure && failure != std::errc::no_such_file_or_directory;  // there may be one
}

/// True of a folder that a process made here, even if it was killed at once or while it removed the folder. A
/// link is none.
bool is_working_folder(const fs::path& folder) {
  std::error_code failure;
  if (!fs::is_directory(fs::symlink_status(folder, failure))) return false;
  if (fs::is_regular_file(fs::symlink_status(folder / "lock", failure))) return true;
  const fs::directory_iterator entries(folder, failure);
  return !failure && std::all_of(begin(entries), end(entries),
                                 [](const auto& entry) { return entry.path().filename() == "ended"; });
}

bool is_same_file(int descriptor, const fs::path& file) {
  struct stat opened, named;
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Does work that the next process would do otherwise, unless there is no memory even for names.
template <class Function>
void if_possible(Function&& function) noexcept {
  try {
    function();
  } catch (const std::exception&) {
  }
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
  if (!fs::exists(fs::symlink_status(folder->path_, ignored))) {
    const std::string path = folder->path_.string();
    folder->unfinished_.make(path, [&] {
      make_folder(path);
      folder->is_own_ = folder->is_new_ = true;
      folder->lock();  // before a signal may remove it: another process may be in it
      return true;
    });
  } else if (!is_working_folder(folder->path_)) {
    throw Error(Error_code::usage,
                folder->shown() + ": was not made by a run: remove it, or give another folder");
  } else {
    folder->lock();
  }
  folder->sort_out_earlier();
  if (!replace && has_checkpoint(folder->checkpoints()))
    throw Error(Error_code::usage,
                fmt::format("{}: holds a run that did not end: go on with it by `cellwalk run --resume {}`, "
                            "or remove it",
                            folder->shown(), destination.string()));
  return folder;
}

void Working_folder::begin() {
  std::error_code failure, ignored;
  if (has_checkpoint(checkpoints()) && !are_results_in_place())
    for (const char* name : folders) {
      fs::rename(path_ / name, earlier(name), failure);
      if (failure) fail_at(path_, "cannot be written", failure);
    }
  // A run that ended before its first checkpoint is of no use.
  for (const char* name : folders) fs::remove_all(path_ / name, ignored);
  fs::remove(path_ / "ended", ignored);
  is_own_ = true;
  make_folder(results());
  make_folder(checkpoints());
}

void Working_folder::forget_earlier() noexcept {
  unfinished_.release();
  is_new_ = false;
  if_possible([this] {
    for (const char* name : {folders[1], folders[0]}) io::remove_tree(earlier(name).c_str());
  });
}

/// The folder that was put aside first comes back last: until then a process that is killed leaves it to the
/// next one.
void Working_folder::bring_earlier_back() {
  std::error_code failure;
  for (const char* name : {folders[1], folders[0]}) {
    if (!fs::exists(earlier(name), failure)) continue;
    fs::remove_all(path_ / name, failure);
    if (!failure) fs::rename(earlier(name), path_ / name, failure);
    if (failure) return;
  }
}

/// After a process was killed that began anew.
void Working_folder::sort_out_earlier() {
  if (std::error_code ignored; !fs::exists(earlier(folders[0]), ignored)) return;
  if (has_checkpoint(checkpoints()))
    forget_earlier();
  else
    bring_earlier_back();
}

std::unique_ptr<Working_folder> Working_folder::take_up(const fs::path& destination) {
  std::unique_ptr<Working_folder> folder(new Working_folder(destination));
  if (!is_working_folder(folder->path_))
    throw Error(Error_code::usage,
                folder->shown() +
                    ": is no folder of a run that did not end: only one with --checkpoint-every leaves it");
  folder->lock();
  folder->sort_out_earlier();
  folder->is_done_ = folder->are_results_in_place();
  if (!folder->is_done_) remove_unfinished_files(folder->path_);
  return folder;
}

bool Working_folder::are_results_in_place() const {
  const std::string ended = content(path_ / "ended");
  // The results of an earlier run may be the same.
  return !ended.empty() && ended == identity(destination_) && ended != identity(results());
}

bool Working_folder::has_ended(const fs::path& destination) {
  const Working_folder folder(destination);
  std::error_code ignored;
  if (!fs::is_regular_file(folder.destination_ / "run.json", ignored)) return false;
  // An empty one was about to be removed.
  return rmdir(folder.path_.c_str()) == 0 || errno == ENOENT;
}

void Working_folder::allow_replacing(const std::string& name) {
  replaces_ = destination_.filename() == name;
  if (!Output_folder::is_replaceable(destination_, replaces_)) refuse_destination(Error_code::usage);
}

void Working_folder::refuse_destination(Error_code code) const {
  throw Error(code, fmt::format("{}: is there, and this run is not to replace it: move it away, and go on by "
                                "`cellwalk run --resume {}`",
                                name_.string(), name_.string()));
}

void Working_folder::lock() {
  io::check_own(path_, shown());
  const fs::path file = path_ / "lock";
  lock_ = io::open_own(file, O_RDWR | O_CREAT);
  if (lock_ < 0) fail_at(path_, "cannot be written", std::error_code(errno, std::generic_category()));
  // The other process may have removed the file that was opened.
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0 && is_same_file(lock_, file)) return;
  close(std::exchange(lock_, -1));  // the content belongs to the other one
  throw Error(Error_code::usage, shown() + ": another process runs there: wait until it ends");
}

/// Its name in the form in which the destination was given, for messages.
std::string Working_folder::shown() const {
  const fs::path given = name_.has_filename() ? name_ : name_.parent_path();
  const fs::path last = given.filename();
  return last == "." || last == ".." ? path_.string() : given.string() + ".part";
}

Working_folder::~Working_folder() {
  if (lock_ < 0 && is_own_)
    rmdir(path_.c_str());  // unless another process is in it by now
  else if (is_new_)
    io::remove_tree(path_.c_str());
  else if (is_own_ && !is_done_)
    if_possible([this] { leave(); });
  if (lock_ >= 0) close(lock_);
}

/// For a run that did not end; without a checkpoint it is of no use.
void Working_folder::leave() {
  std::error_code ignored;
  if (has_checkpoint(checkpoints())) return;
  if (fs::exists(earlier(folders[0]), ignored))
    bring_earlier_back();
  else
    clear();
}

/// Removes the files of runs here. The mark that one has ended goes last: a process that finds it removes the
/// rest.
void Working_folder::clear() {
  std::error_code failure;
  fs::remove(results() / "run.json", failure);  // half a folder is not taken for results
  for (const char* name : {folders[1], folders[0]})
    for (const fs::path& folder : {path_ / name, earlier(name)})
      if (!io::remove_tree(folder.c_str())) return;
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

/// The new names are on the device before the files are gone from which they could be made again.
void Working_folder::settle() noexcept {
  if_possible([this] {
    io::sync(destination_.parent_path());
    is_done_ = true;
    clear();
  });
}

}  // namespace cellwalk::cli
