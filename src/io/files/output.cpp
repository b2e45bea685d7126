// SPDX-License-Identifier: LGPL-3.0-or-later
// Exchanges of names, and the table of unfinished files that a signal handler removes.
#include <cellwalk/internal/io/output.h>
#include <cellwalk/internal/io/own_files.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace cellwalk::io {
namespace {

/// The number of names that a signal handler can clean up.
constexpr std::size_t slot_count = 32;
constexpr std::size_t longest_path = 4096;  // PATH_MAX of Linux

/// Names of unfinished files where a signal handler can read them: fixed storage, no allocation.
struct Slot {
  std::atomic<int> state{0};  // 0 free, 1 being filled, 2 filled
  std::array<char, longest_path> path{};
};
std::array<Slot, slot_count> slots;

std::atomic<int> names_change = 0;      // the number of threads that change names now
std::atomic<bool> are_removed = false;  // files, or they will be and nothing else is to come
constexpr useconds_t nap = 100;         // microseconds
/// About ten seconds: a change of a name on a slow network is waited for, and not for ever.
constexpr int most_naps = 100'000;

/// Holds signals during its lifetime: on this thread they are blocked, on others the handler waits.
class Hold_signals {
 public:
  Hold_signals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
    for (++names_change; are_removed.load(); ++names_change) {
      --names_change;
      while (are_removed.load()) usleep(nap);
    }
  }
  ~Hold_signals() {
    --names_change;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  Hold_signals(const Hold_signals&) = delete;
  Hold_signals& operator=(const Hold_signals&) = delete;

 private:
  sigset_t before_;
};

bool exchange(const std::filesystem::path& a, const std::filesystem::path& b) noexcept {
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
  return (errno == EINVAL || errno == ENOSYS) && detail::exchange_in_steps(a, b);
}

bool move_to_free_name(const std::filesystem::path& from, const std::filesystem::path& to) noexcept {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  return (errno == EINVAL || errno == ENOSYS) && detail::move_in_steps(from, to);
}

}  // namespace

bool detail::exchange_in_steps(const std::filesystem::path& a, const std::filesystem::path& b) noexcept {
  const std::string aside = a.string() + ".old";
  const bool is_linked = link(b.c_str(), aside.c_str()) == 0;  // not possible for a directory
  if (!is_linked && std::rename(b.c_str(), aside.c_str()) != 0) return false;
  if (std::rename(a.c_str(), b.c_str()) == 0) return std::rename(aside.c_str(), a.c_str()) == 0;
  const int why = errno;
  if (is_linked)
    unlink(aside.c_str());
  else
    std::rename(aside.c_str(), b.c_str());
  errno = why;
  return false;
}

bool detail::move_in_steps(const std::filesystem::path& from, const std::filesystem::path& to) noexcept {
  struct stat status;
  if (lstat(to.c_str(), &status) != 0) return std::rename(from.c_str(), to.c_str()) == 0;
  errno = EEXIST;
  return false;
}

void put_in_place(std::span<Output* const> outputs, const std::function<void()>& finish) {
  for (Output* output : outputs)
    if (output->can_be_taken_back()) output->prepare();
  for (Output* output : outputs)
    if (!output->can_be_taken_back()) output->prepare();
  std::size_t done = 0;
  try {
    {
      const Hold_signals hold;
      for (; done < outputs.size(); ++done) outputs[done]->put();
    }
    if (finish) finish();
  } catch (...) {
    const Hold_signals hold;
    while (done > 0) outputs[--done]->take_back();
    throw;
  }
  const Hold_signals hold;  // an old file that is not needed any more is removed
  for (Output* output : outputs) output->settle();
}

std::filesystem::path target_of(const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  const auto canonical = [](const fs::path& path) {
    std::error_code failure;
    fs::path result = fs::weakly_canonical(path, failure);
    return failure ? path : result;
  };
  constexpr int most_links = 40;  // as in Linux
  fs::path target = canonical(name);
  std::error_code failure;
  // Only links that lead nowhere are left.
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(target, failure)); ++i)
    target = canonical(target.parent_path() / fs::read_symlink(target, failure));
  return target;
}

void Unfinished::hold(const std::string& path) {
  release();
  if (path.size() >= longest_path) return;
  for (std::size_t i = 0; i < slot_count; ++i) {
    int free = 0;
    if (!slots[i].state.compare_exchange_strong(free, 1)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].state.store(2);
    slot_ = static_cast<int>(i);
    return;
  }
}

bool Unfinished::make(const std::string& path, const std::function<bool()>& make) {
  const Hold_signals held;
  if (!make()) return false;
  hold(path);
  return true;
}

void Unfinished::release() noexcept {
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state.store(0);
  slot_ = -1;
}

bool Replacement::put(const std::filesystem::path& from, const std::filesystem::path& to, bool may_replace) {
  had_old_ = false;
  if (!may_replace) return move_to_free_name(from, to);
  struct stat status;
  had_old_ = lstat(to.c_str(), &status) == 0;
  return had_old_ ? exchange(from, to) : std::rename(from.c_str(), to.c_str()) == 0;
}

void Replacement::take_back(const std::filesystem::path& from,
                            const std::filesystem::path& to) const noexcept {
  if (had_old_)
    exchange(from, to);
  else
    std::rename(to.c_str(), from.c_str());
}

void discard_unfinished_files(bool for_good) noexcept {
  are_removed.store(true);
  for (int naps = 0; names_change.load() > 0 && naps < most_naps; ++naps) usleep(nap);
  for (Slot& slot : slots)
    if (slot.state.load() == 2) remove_tree(slot.path.data());
  if (!for_good) are_removed.store(false);
}

}  // namespace cellwalk::io
