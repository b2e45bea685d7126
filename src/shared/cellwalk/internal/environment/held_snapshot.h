// SPDX-License-Identifier: LGPL-3.0-or-later
// The snapshot of an environment, which stays where it is in memory when the environment is moved.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_HELD_SNAPSHOT_H
#define CELLWALK_INTERNAL_ENVIRONMENT_HELD_SNAPSHOT_H

#include <cellwalk/environment/snapshot.h>

#include <memory>

namespace cellwalk::detail {

/// \throw Error(usage) for an environment that was moved from
[[noreturn]] void refuse_moved_from();

template <int D>
class Held_snapshot {
 public:
  Snapshot<D>& operator*() { return *checked(); }
  const Snapshot<D>& operator*() const { return *checked(); }
  Snapshot<D>* operator->() { return checked(); }
  const Snapshot<D>* operator->() const { return checked(); }

 private:
  Snapshot<D>* checked() const {
    if (!snapshot_) [[unlikely]]
      refuse_moved_from();
    return snapshot_.get();
  }

  std::unique_ptr<Snapshot<D>> snapshot_ = std::make_unique<Snapshot<D>>();
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_HELD_SNAPSHOT_H
