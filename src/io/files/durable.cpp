// SPDX-License-Identifier: LGPL-3.0-or-later
// Writing with fsync of files and folders, and files that grow up to a known length.
#include <cellwalk/internal/io/durable.h>
#include <cellwalk/internal/io/own_files.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

/// The size of the buffer of bytes before they are written.
constexpr std::size_t growing_buffer_size = std::size_t{1} << 18;

[[noreturn]] void fail_of(const fs::path& path, const char* what) {
  const std::string reason = std::strerror(errno);
  throw Error(Error_code::other, fmt::format("{}: {} ({})", path.string(), what, reason));
}

/// A descriptor that is closed in any case.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  /// False if the device reports an error that came late.
  bool close_now() { return close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// False with errno set if not all could be written.
bool write_all(int descriptor, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(descriptor, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

void sync(const fs::path& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  // Some file systems refuse to sync a folder, and need not.
  if (file.number() < 0 || (fsync(file.number()) != 0 && errno != EINVAL))
    fail_of(path, "cannot be written to the device");
}

void sync_all(const fs::path& folder) {
  std::error_code failure;
  fs::recursive_directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
    sync(entry->path());
  if (failure) throw Error(Error_code::other, folder.string() + ": cannot be read: " + failure.message());
  sync(folder);
  sync(folder.has_parent_path() ? folder.parent_path() : fs::path("."));
}

void write_durably(const fs::path& destination, std::span<const std::span<const std::byte>> pieces) {
  fs::path temporary = destination;
  temporary += ".tmp";
  unlink(temporary.c_str());  // of a process that was killed; and no link is written through
  Descriptor file(open_own(temporary, O_WRONLY | O_CREAT | O_EXCL));
  if (file.number() < 0) fail_of(destination, "cannot be written");
  bool is_good = true;
  for (const auto piece : pieces)
    is_good = is_good && write_all(file.number(), reinterpret_cast<const char*>(piece.data()), piece.size());
  is_good = is_good && fsync(file.number()) == 0 && file.close_now() &&
            std::rename(temporary.c_str(), destination.c_str()) == 0;
  if (!is_good) {
    const int why = errno;
    unlink(temporary.c_str());
    errno = why;
    fail_of(destination, "writing failed");
  }
  sync(destination.has_parent_path() ? destination.parent_path() : fs::path("."));
}

void remove_abandoned(const fs::path& destination) {
  std::error_code failure;
  // Absolute: the canonical name of a file that is not there yet may be without its folder.
  const fs::path target = fs::weakly_canonical(fs::absolute(destination, failure), failure);
  if (failure || !target.has_filename()) return;
  // As Atomic_file names them: .NAME.PROCESS.NUMBER.tmp
  constexpr std::size_t repeated_length = 200;
  const std::string prefix = "." + target.filename().string().substr(0, repeated_length) + ".";
  std::vector<fs::path> abandoned;
  for (fs::directory_iterator entry(target.parent_path(), failure);
       !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(".tmp")) continue;
    pid_t process = 0;
    const char* const end = name.data() + name.size();
    const auto [after, wrong] = std::from_chars(name.data() + prefix.size(), end, process);
    if (wrong == std::errc{} && after != end && *after == '.' && process > 0 && kill(process, 0) != 0 &&
        errno == ESRCH)
      abandoned.push_back(entry->path());
  }
  for (const fs::path& file : abandoned) fs::remove(file, failure);
}

Growing_file::Growing_file(fs::path path, std::uint64_t length) : path_(std::move(path)), length_(length) {
  descriptor_ = open_own(path_, O_WRONLY | (length == 0 ? O_CREAT : 0));
  if (descriptor_ < 0 && length > 0 && errno == ENOENT)
    throw Error(Error_code::input,
                path_.string() + ": is missing, and was there at the checkpoint: begin the run again");
  if (descriptor_ < 0) fail("cannot be written");
  struct stat status;
  if (fstat(descriptor_, &status) == 0 && static_cast<std::uint64_t>(status.st_size) < length) {
    close(std::exchange(descriptor_, -1));
    throw Error(Error_code::input,
                path_.string() + ": is shorter than it was at the checkpoint: it was changed");
  }
  const auto end = static_cast<off_t>(length);
  if (ftruncate(descriptor_, end) == 0 && lseek(descriptor_, end, SEEK_SET) == end) return;
  const int why = errno;
  close(std::exchange(descriptor_, -1));
  errno = why;
  fail("cannot be written");
}

Growing_file::~Growing_file() {
  if (descriptor_ >= 0) close(descriptor_);
}

void Growing_file::write(std::string_view bytes) {
  buffer_.append(bytes);
  if (buffer_.size() >= growing_buffer_size) flush();
}

void Growing_file::flush() {
  if (!write_all(descriptor_, buffer_.data(), buffer_.size())) fail("writing failed");
  length_ += buffer_.size();
  buffer_.clear();
}

std::uint64_t Growing_file::sync() {
  flush();
  if (fsync(descriptor_) != 0) fail("writing failed");
  return length_;
}

void Growing_file::commit() {
  sync();
  if (close(std::exchange(descriptor_, -1)) != 0) fail("writing failed");
}

void Growing_file::fail(const char* what) const { fail_of(path_, what); }

}  // namespace cellwalk::io
