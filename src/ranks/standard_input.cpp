// SPDX-License-Identifier: LGPL-3.0-or-later
// The standard input of the first rank, sent to all others.
#include <cellwalk/internal/ranks/ranks.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <string>
#include <string_view>

namespace cellwalk {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw Error(Error_code::input, std::string("/dev/stdin: ") + what);
}

std::string read_all() {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::string bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + piece);
    const ssize_t count = read(STDIN_FILENO, bytes.data() + before, piece);
    bytes.resize(before + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0) return bytes;
    if (count < 0 && errno != EINTR) refuse("reading failed");
  }
}

void become_standard_input(std::string_view bytes) {
  const int copy = memfd_create("standard input", MFD_CLOEXEC);
  if (copy < 0) refuse("cannot be kept for all ranks");
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t count = write(copy, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse("cannot be kept for all ranks");
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  lseek(copy, 0, SEEK_SET);
  if (dup2(copy, STDIN_FILENO) < 0) refuse("cannot be kept for all ranks");
  close(copy);
}

}  // namespace

bool names_standard_input(std::string_view word) {
  constexpr std::array<std::string_view, 3> names{"/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"};
  return std::ranges::count(names, word) > 0;
}

void share_standard_input(Ranks& ranks) {
  if (ranks.is_alone()) return;
  become_standard_input(ranks.broadcast(ranks.is_first() ? read_all() : std::string{}));
}

}  // namespace cellwalk
