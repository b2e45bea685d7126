// SPDX-License-Identifier: LGPL-3.0-or-later
// A locked temporary folder, which is renamed at the end, and the removal of abandoned ones.
#include "output_folder.h"

#include <cellwalk/internal/io/own_files.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, const std::error_code& reason) {
  throw Error(Error_code::other, path.string() + ": " + what + ": " + reason.message());
}

/// A descriptor that holds a lock of a folder, or -1 if another process holds it, or folders have none here.
int lock_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  close(descriptor);
  return -1;
}

/// True of the name of a process that has ended, or of this one, which has written nothing yet.
bool has_ended(const char* begin, const char* end) {
  pid_t process = 0;
  const auto [after, wrong] = std::from_chars(begin, end, process);
  return wrong == std::errc{} && after == end && process > 0 &&
         (process == getpid() || (kill(process, 0) != 0 && errno == ESRCH));
}

/// True of the name of a file or folder that a run writes, or of an unfinished file.
bool is_result_name(const fs::path& name) {
  static constexpr std::array<std::string_view, 11> names{
      "changes.csv",  "contacts.csv", "forces.csv", "frames",    "motion.gz", "picture.png",
      "record.trace", "run.json",     "run.pvd",    "walls.csv", "walls.vtu"};
  const std::string text = name.string();
  return std::find(names.begin(), names.end(), text) != names.end() ||
         (text.starts_with('.') && text.ends_with(".tmp"));
}

/// A file in a folder of results that no run writes; empty if there is none.
fs::path stranger_in(const fs::path& folder) {
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure))
    if (!is_result_name(entry->path().filename())) return entry->path();
  for (fs::directory_iterator entry(folder / "frames", failure);
       !failure && entry != fs::directory_iterator(); entry.increment(failure))
    if (entry->path().extension() != ".vtu" && !is_result_name(entry->path().filename()))
      return entry->path();
  return {};
}

/// Removes the folders that killed processes left. Where processes do not see each other, as in containers,
/// the lock distinguishes those that run.
void remove_abandoned(const fs::path& destination) {
  const std::string prefix = destination.filename().string() + ".tmp-";
  std::vector<fs::path> abandoned;
  std::error_code failure;
  for (fs::directory_iterator entry(destination.parent_path(), failure);
       !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(prefix) && has_ended(name.data() + prefix.size(), name.data() + name.size()) &&
        stranger_in(entry->path()).empty())
      abandoned.push_back(entry->path());
  }
  for (const fs::path& folder : abandoned) {
    const int lock = lock_folder(folder);
    if (lock < 0) continue;
    fs::remove_all(folder, failure);
    close(lock);
  }
}

/// True also of a link that leads nowhere.
bool is_there(const fs::path& name) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(name, ignored));
}

}  // namespace

fs::path Output_folder::place_of(const fs::path& name) {
  std::error_code failure;
  fs::path place = fs::weakly_canonical(fs::absolute(name, failure), failure);
  if (failure) place = name;
  return place.has_filename() ? place : place.parent_path();
}

bool Output_folder::is_replaceable(const fs::path& destination, bool replace) {
  std::error_code ignored;
  return !is_there(destination) || (replace && fs::is_regular_file(destination / "run.json", ignored) &&
                                    stranger_in(destination).empty());
}

void Output_folder::check_destination(const fs::path& destination, bool replace) {
  if (is_replaceable(destination, replace)) return;
  if (!replace)
    throw Error(Error_code::usage,
                destination.string() + ": exists already; give another folder, or --force to replace it");
  if (std::error_code ignored; fs::is_regular_file(destination / "run.json", ignored))
    throw Error(Error_code::usage,
                fmt::format("{}: holds {}, which no run writes, and would be replaced; move it "
                            "away, or give another folder",
                            destination.string(), stranger_in(destination).string()));
  throw Error(Error_code::usage,
              destination.string() + ": holds no run.json, so it is no earlier run; give another folder");
}

Output_folder::Output_folder(const fs::path& destination, bool replace)
    : name_(destination), destination_(place_of(destination)), replaces_(replace) {
  check_destination(name_, replace);
  remove_abandoned(destination_);
  temporary_ = destination_;
  temporary_ += fmt::format(".tmp-{}", getpid());  // a name that no other process of this system uses
  std::error_code failure;
  if (!unfinished_.make(temporary_.string(), [&] { return fs::create_directory(temporary_, failure); }))
    fail(name_, "cannot be made", failure ? failure : std::make_error_code(std::errc::file_exists));
  lock_ = lock_folder(temporary_);
}

Output_folder::~Output_folder() {
  settle();
  if (lock_ >= 0) close(lock_);
}

void Output_folder::put() {
  const bool is_free = is_replaceable(destination_, replaces_);
  if (is_free && replacement_.put(temporary_, destination_, replaces_)) return;
  const int why = is_free ? errno : EEXIST;
  if (why == EEXIST) keep_beside();
  fail(name_, "cannot be put in place", std::error_code(why, std::generic_category()));
}

/// A folder that took the name while the program ran stays, and so do the results, which may have taken long.
void Output_folder::keep_beside() {
  fs::path kept = destination_;
  kept += fmt::format(".ended-{}", getpid());
  if (!replacement_.put(temporary_, kept, false)) return;
  throw Error(Error_code::other, fmt::format("{}: was made by another program while this one ran, and stays; "
                                             "the results are in {}",
                                             name_.string(), kept.string()));
}

void Output_folder::take_back() noexcept { replacement_.take_back(temporary_, destination_); }

void Output_folder::settle() noexcept {
  io::remove_tree(temporary_.c_str());  // the new folder before put(), the old one after it
}

}  // namespace cellwalk::cli
