// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/atomic_file.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace cellwalk::io {
namespace {

/// Bytes gathered before they are handed to the system.
constexpr std::size_t buffer_size = std::size_t{1} << 18;
/// Files a signal handler can clean up at a time; further ones are written all the same.
constexpr std::size_t slot_count = 32;
constexpr std::size_t longest_path = 4096;  // PATH_MAX of Linux

/// Names of unfinished files where a signal handler can read them: fixed storage, no allocation.
struct Slot {
  std::atomic<int> state{0};  // 0 free, 1 being filled, 2 filled
  std::array<char, longest_path> path{};
};
std::array<Slot, slot_count> slots;

int occupy(const std::string& path) {
  if (path.size() >= longest_path) return -1;
  for (std::size_t i = 0; i < slot_count; ++i) {
    int free = 0;
    if (!slots[i].state.compare_exchange_strong(free, 1)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].state.store(2);
    return static_cast<int>(i);
  }
  return -1;
}

void vacate(int slot) noexcept {
  if (slot >= 0) slots[static_cast<std::size_t>(slot)].state.store(0);
}

bool is_regular_or_new(const std::filesystem::path& path) {
  struct stat status;
  return stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
}

}  // namespace

Atomic_file::Atomic_file(std::filesystem::path destination) : destination_(std::move(destination)) {
  if (destination_.empty()) throw Error(Error_code::usage, "an output file without a name: give one");
  constexpr mode_t permissions = 0666;  // less the umask of the user
  if (!is_regular_or_new(destination_)) {
    descriptor_ = open(destination_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be written");
    return;
  }
  // A link keeps pointing where it points: the file behind it is replaced.
  std::error_code error;
  std::filesystem::path target = std::filesystem::weakly_canonical(destination_, error);
  if (error) target = destination_;
  const std::string stem = fmt::format(".{}.{}", target.filename().string(), getpid());
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = (target.parent_path() / fmt::format("{}.{}.tmp", stem, attempt)).string();
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
    if (descriptor_ < 0 && errno != EEXIST) {
      temporary_.clear();
      fail("cannot be written: check that its directory exists and may be written");
    }
  }
  slot_ = occupy(temporary_);
}

Atomic_file::~Atomic_file() { discard(); }

void Atomic_file::write(std::string_view text) {
  buffer_.append(text);
  if (buffer_.size() >= buffer_size) flush();
}

void Atomic_file::flush() {
  const char* p = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t n = ::write(descriptor_, p, left);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("writing failed");
    p += n;
    left -= static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void Atomic_file::commit() {
  flush();
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0) fail("writing failed");
  if (temporary_.empty()) return;
  std::error_code error;
  std::filesystem::path target = std::filesystem::weakly_canonical(destination_, error);
  if (error) target = destination_;
  if (std::rename(temporary_.c_str(), target.c_str()) != 0) fail("cannot be replaced");
  temporary_.clear();
  vacate(slot_);
  slot_ = -1;
}

void Atomic_file::discard() noexcept {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
  vacate(slot_);
  slot_ = -1;
}

void Atomic_file::fail(const char* what) {
  const std::string reason = std::strerror(errno);
  discard();
  throw Error(Error_code::other, fmt::format("{}: {} ({})", destination_.string(), what, reason));
}

void write_file(const std::filesystem::path& destination, std::string_view text) {
  Atomic_file file(destination);
  file.write(text);
  file.commit();
}

void discard_unfinished_files() noexcept {
  for (Slot& slot : slots)
    if (slot.state.load() == 2) unlink(slot.path.data());
}

}  // namespace cellwalk::io
