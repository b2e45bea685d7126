// SPDX-License-Identifier: LGPL-3.0-or-later
// A lock for many readers or one writer, in which readers do not keep a writer waiting for ever.
#ifndef CELLWALK_PYTHON_TURN_LOCK_H
#define CELLWALK_PYTHON_TURN_LOCK_H

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace cellwalk::python {

/// Readers share, a writer is alone. A writer that waits is not overtaken: readers that come later wait for
/// it. (A std::shared_mutex may let readers pass, and with some of them always there a writer never gets its
/// turn.) So no thread may lock it a second time. Any thread may unlock it, since the last reference to its
/// holder may be dropped in any.
class Turn_lock {
 public:
  void lock() {
    const std::lock_guard turn(turn_);
    std::unique_lock state(state_);
    is_free_.wait(state, [this] { return readers_ == 0 && !is_written_; });
    is_written_ = true;
  }
  void unlock() {
    const std::lock_guard state(state_);
    is_written_ = false;
    is_free_.notify_one();
  }
  void lock_shared() {
    const std::lock_guard turn(turn_);
    std::unique_lock state(state_);
    is_free_.wait(state, [this] { return !is_written_; });
    ++readers_;
  }
  void unlock_shared() {
    const std::lock_guard state(state_);
    if (--readers_ == 0) is_free_.notify_one();
  }

 private:
  std::mutex turn_;   ///< of the one thread that may wait for the state; the others wait for their turn
  std::mutex state_;  ///< guards the members below
  std::condition_variable is_free_;
  std::size_t readers_ = 0;
  bool is_written_ = false;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_TURN_LOCK_H
