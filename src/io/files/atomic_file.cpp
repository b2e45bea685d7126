// SPDX-License-Identifier: LGPL-3.0-or-later
// Temporary names, links and descriptors, and the rename at the commit.
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <system_error>

namespace cellwalk::io {
namespace {

/// The size of the buffer of bytes before they are written.
constexpr std::size_t buffer_size = std::size_t{1} << 18;
/// The bytes of a name that its temporary name repeats; names have at most 255 bytes.
constexpr std::size_t repeated_length = 200;
/// The largest number of links followed from one name to the next, as in Linux.
constexpr int most_links = 40;

/// The descriptor of this process to which a path such as /dev/stdout or /proc/self/fd/3 refers. A file
/// opened by that path would be written from its beginning; a file that replaced it would not be the one that
/// the shell opened.
std::optional<int> own_descriptor(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(
      path.has_parent_path() ? path.parent_path() : std::filesystem::path("."), error);
  if (error) return std::nullopt;
  std::filesystem::path entry = folder / path.filename();
  const std::filesystem::path own = std::filesystem::canonical("/proc/self/fd", error);
  // /dev/stdout leads to /proc/self/fd/1, which itself leads to a file and must not be followed.
  for (int i = 0; i < most_links && entry.parent_path() != own && std::filesystem::is_symlink(entry, error);
       ++i) {
    entry = entry.parent_path() / std::filesystem::read_symlink(entry, error);
    entry = std::filesystem::canonical(entry.parent_path(), error) / entry.filename();
  }
  if (error || own.empty() || entry.parent_path() != own) return std::nullopt;
  const std::string digits = entry.filename().string();
  int number = 0;
  const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return wrong == std::errc{} && end == digits.data() + digits.size() ? std::optional(number) : std::nullopt;
}

/// Writes all of a text; false, with errno, if the system refuses.
bool put_out(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

Atomic_file::Atomic_file(std::filesystem::path destination) : destination_(std::move(destination)) {
  if (destination_.empty()) throw Error(Error_code::usage, "an output file without a name: give one");
  constexpr mode_t permissions = 0666;  // without the umask of the user
  struct stat old;
  const bool exists = stat(destination_.c_str(), &old) == 0;
  // The temporary name is shorter, and a link of a loop is no file to replace.
  if (!exists && (errno == ENAMETOOLONG || errno == ELOOP)) fail("cannot be written");
  const auto own = own_descriptor(destination_);
  is_direct_ = own || (exists && !S_ISREG(old.st_mode));
  if (is_direct_) {
    descriptor_ = own ? fcntl(*own, F_DUPFD_CLOEXEC, 0) : open(destination_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be written");
    return;
  }
  // A rename would replace a file that its owner has write-protected.
  if (exists && access(destination_.c_str(), W_OK) != 0) fail("cannot be written");
  target_ = target_of(destination_);
  const std::string stem =
      fmt::format(".{}.{}", target_.filename().string().substr(0, repeated_length), getpid());
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = (target_.parent_path() / fmt::format("{}.{}.tmp", stem, attempt)).string();
    const bool is_made = unfinished_.make(temporary_, [&] {
      descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
      return descriptor_ >= 0;
    });
    if (!is_made && errno != EEXIST) {
      temporary_.clear();
      fail("cannot be written: check that its directory exists and may be written");
    }
  }
  constexpr mode_t permission_bits = 0777;
  if (exists) fchmod(descriptor_, old.st_mode & permission_bits);
}

Atomic_file::~Atomic_file() { discard(); }

void Atomic_file::write(std::string_view text) {
  if (!is_direct_ && text.size() >= buffer_size) {  // a copy of it would take longer
    flush();
    if (!put_out(descriptor_, text)) fail("writing failed");
    return;
  }
  buffer_.append(text);
  if (!is_direct_ && buffer_.size() >= buffer_size) flush();
}

void Atomic_file::flush() {
  if (!put_out(descriptor_, buffer_)) fail("writing failed");
  buffer_.clear();
}

void Atomic_file::prepare() {
  flush();
  if (is_durable_ && !is_direct_ && fsync(descriptor_) != 0) fail("writing failed");
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0) fail("writing failed");
}

void Atomic_file::put() {
  if (is_direct_) return;
  struct stat now;
  const bool is_directory = stat(target_.c_str(), &now) == 0 && S_ISDIR(now.st_mode);
  if (is_directory) errno = EISDIR;  // an exchange of names would replace a directory by the file
  if (is_directory || !replacement_.put(temporary_, target_)) fail("cannot be put in place");
  if (is_durable_) sync_name();
}

void Atomic_file::sync_name() {
  const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may not be read: its name follows in time
  fsync(descriptor);
  close(descriptor);
}

void Atomic_file::take_back() noexcept {
  if (!is_direct_) replacement_.take_back(temporary_, target_);
  discard();
}

void Atomic_file::settle() noexcept { discard(); }

void Atomic_file::commit() {
  Output* const alone[] = {this};
  put_in_place(alone);
}

void Atomic_file::discard() noexcept {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
  unfinished_.release();
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

}  // namespace cellwalk::io
