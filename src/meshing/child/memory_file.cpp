// SPDX-License-Identifier: GPL-3.0-or-later
// The system calls for files in memory, or for an unlinked one where there are none.
#include "memory_file.h"

#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace cellwalk::detail {
namespace {

/// The descriptors below this one are those that a helper is given.
constexpr int first_descriptor = 4;

[[noreturn]] void refuse(const char* what) {
  throw Error(Error_code::other, fmt::format("meshing: {}: {}", what, std::strerror(errno)));
}

/// Where the kernel has no files in memory, it is one that no folder lists.
int open_nameless() {
  const int in_memory = memfd_create("cellwalk", MFD_CLOEXEC);
  if (in_memory >= 0) return in_memory;
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
  return ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR);
}

}  // namespace

Memory_file::Memory_file() {
  const int lowest = open_nameless();
  if (lowest < 0) refuse("no file in memory can be made");
  descriptor_ = ::fcntl(lowest, F_DUPFD_CLOEXEC, first_descriptor);
  const int problem = errno;
  ::close(lowest);
  errno = problem;
  if (descriptor_ < 0) refuse("no file in memory can be made");
}

Memory_file::~Memory_file() { ::close(descriptor_); }

void Memory_file::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) refuse("a file in memory cannot be written");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void Memory_file::rewind() { ::lseek(descriptor_, 0, SEEK_SET); }

std::vector<std::byte> Memory_file::read(std::size_t most) const {
  struct stat status;
  if (::fstat(descriptor_, &status) != 0) refuse("a file in memory cannot be read");
  std::vector<std::byte> bytes(std::min(most, static_cast<std::size_t>(status.st_size)));
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) refuse("a file in memory cannot be read");
    at += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace cellwalk::detail
