// SPDX-License-Identifier: LGPL-3.0-or-later
// A lock for many readers or one writer, in which readers do not keep a writer waiting for ever.
#ifndef CELLWALK_PYTHON_TURN_LOCK_H
#define CELLWALK_PYTHON_TURN_LOCK_H

#include <mutex>
#include <shared_mutex>

namespace cellwalk::python {

/// Readers share, a writer is alone. A writer that waits is not overtaken: who comes to read later waits for
/// it. (A std::shared_mutex may let readers pass, and with some of them always there a writer never gets its
/// turn.) So no thread may lock it a second time.
class Turn_lock {
 public:
  void lock() {
    const std::lock_guard turn(turn_);
    lock_.lock();
  }
  void unlock() { lock_.unlock(); }
  void lock_shared() {
    const std::lock_guard turn(turn_);
    lock_.lock_shared();
  }
  void unlock_shared() { lock_.unlock_shared(); }

 private:
  std::mutex turn_;
  std::shared_mutex lock_;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_TURN_LOCK_H
