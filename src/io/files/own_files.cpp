// SPDX-License-Identifier: LGPL-3.0-or-later
// Folders opened without following links, and removed from the inside out.
#include <cellwalk/internal/io/own_files.h>
#include <cellwalk/kernel/error.h>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

/// The kind of an entry that is neither a folder nor a file with one name, and the remedy; empty for these.
std::string_view foreign_kind(const struct stat& status) {
  if (S_ISLNK(status.st_mode)) return "a symbolic link: remove it";
  if (S_ISDIR(status.st_mode)) return {};
  if (!S_ISREG(status.st_mode)) return "a pipe, a socket or a device: remove it";
  if (status.st_nlink > 1) return "a file with another name (a hard link): go on with a copy of the folder";
  return {};
}

constexpr int deepest_folder = 16;         // folders within each other; a run makes three
constexpr int most_removals = 3;           // where others write at the same moment
constexpr std::size_t listed_size = 2048;  // bytes of names read at a time, at each depth: 16 of them are
                                           // half the stack of a signal handler

bool remove_at(int folder, const char* name, int depth) noexcept;

/// Removes the content of a folder.
void empty_out(int folder, int depth) noexcept {
  alignas(dirent64) char buffer[listed_size];
  for (ssize_t size = 0; (size = getdents64(folder, buffer, sizeof buffer)) > 0;)
    for (ssize_t at = 0; at < size;) {
      const auto* const entry = reinterpret_cast<const dirent64*>(buffer + at);
      at += entry->d_reclen;
      const std::string_view name = entry->d_name;
      if (name != "." && name != "..") remove_at(folder, entry->d_name, depth);
    }
}

bool remove_at(int folder, const char* name, int depth) noexcept {
  if (unlinkat(folder, name, 0) == 0 || errno == ENOENT) return true;
  if ((errno != EISDIR && errno != EPERM) || depth == deepest_folder) return false;
  const int inner = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (inner < 0) return false;
  bool is_gone = false;
  for (int tries = 0; !is_gone && tries < most_removals; ++tries) {
    lseek(inner, 0, SEEK_SET);
    empty_out(inner, depth + 1);
    is_gone = unlinkat(folder, name, AT_REMOVEDIR) == 0 || errno == ENOENT;
  }
  close(inner);
  return is_gone;
}

}  // namespace

void check_own(const fs::path& folder, const std::string& shown) {
  std::error_code failure;
  fs::recursive_directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure)) {
    struct stat status;
    if (lstat(entry->path().c_str(), &status) != 0) continue;  // it is gone
    if (const std::string_view what = foreign_kind(status); !what.empty())
      throw Error(Error_code::input, fmt::format("{}: holds {}, {}", shown,
                                                 entry->path().lexically_relative(folder).string(), what));
  }
  // Whoever works there removes files.
  if (failure && failure != std::errc::no_such_file_or_directory)
    throw Error(Error_code::other, shown + ": cannot be read: " + failure.message());
}

int open_own(const fs::path& file, int flags) {
  constexpr mode_t permissions = 0666;  // without the umask of the user
  const int descriptor = open(file.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, permissions);
  struct stat status;
  if (descriptor < 0) return descriptor;
  if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink <= 1) return descriptor;
  const int why = S_ISREG(status.st_mode) ? EMLINK : ELOOP;
  close(descriptor);
  errno = why;
  return -1;
}

bool remove_tree(const char* path) noexcept { return remove_at(AT_FDCWD, path, 0); }

}  // namespace cellwalk::io
