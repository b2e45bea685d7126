// SPDX-License-Identifier: LGPL-3.0-or-later
// An environment as Python holds it: any number of particles, bodies and threads share it. They query it at
// the same time, or one of them moves its walls or edits it while the others wait.
#ifndef CELLWALK_PYTHON_WORLD_H
#define CELLWALK_PYTHON_WORLD_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/walk/locate.h>

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "tracing.h"
#include "turn_lock.h"

namespace cellwalk::python {

/// An environment in which points can be located. It stays where it is: the locator refers to the snapshot.
///
/// Anything that edits change is reached through Reading, Looking, Changing and Opened only. Each sets the
/// interpreter free before it waits for a lock, so that none that has the interpreter waits for one. All take
/// the locks in one order (that of a body or of particles, that of the world, that of its locator), and all
/// but Opened give them back before they wait for the interpreter again. An Opened lives on while its thread
/// runs Python; that thread takes no other lock of this world meanwhile, but is refused. So no threads wait
/// for each other.
template <int D>
class World {
 public:
  static constexpr int dimension = D;

  World(Environment<D> built, const Certificate& certificate, const Groups<D>& groups)
      : environment_(std::move(built)),
        groups_(environment_.snapshot(), groups),
        certificate_(certificate),
        certified_(environment_.snapshot().epoch()),
        locator_(environment_.snapshot()),
        located_(environment_.snapshot().geometry_epoch()) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Called before any lock is waited for that a thread may hold while it waits for this world.
  /// \throw Error(usage) if this thread has the world open for edits
  void need_not_open_here() const {
    if (is_open_here())
      throw Error(Error_code::usage,
                  "this thread has the environment open for edits: leave the with statement before");
  }

  /// The world as it is while this lives: nothing moves its walls.
  /// \throw Error(usage) if this thread has it open for edits
  class Reading {
   public:
    explicit Reading(const World& world) : world_(checked(world)), lock_(world.lock_) {}
    /// \param owner the lock of a body or of particles that are used meanwhile
    Reading(const World& world, std::mutex& owner)
        : world_(checked(world)), owner_(owner), lock_(world.lock_) {}

    const Environment<D>& environment() const { return world_.environment_; }
    const Snapshot<D>& snapshot() const { return environment().snapshot(); }
    /// The rest of the groups of the file after edits.
    Groups<D> groups() const { return world_.groups_.now(snapshot()); }
    /// Made anew if points moved since the last one. Not to be called from tasks of oneTBB.
    const Locator<D>& locator() const { return world_.current_locator(); }
    /// Made at the first trace, and anew if points moved since the last one. Not to be called from tasks of
    /// oneTBB.
    const Tracing<D>& tracing() const { return world_.current_tracing(); }
    /// Of the environment as it is: certified again if points moved.
    const Certificate& certificate() const { return world_.current_certificate(); }

   private:
    const World& world_;
    pybind11::gil_scoped_release released_;  // before the locks, and until they are given back
    std::unique_lock<std::mutex> owner_;
    std::shared_lock<Turn_lock> lock_;
  };

  /// The cells and points as they are while this lives, also for the thread that has the world open for
  /// edits.
  class Looking {
   public:
    explicit Looking(const World& world) : world_(world) {
      if (!world.is_open_here()) lock_ = std::shared_lock(world.lock_);
    }
    const Snapshot<D>& snapshot() const { return world_.environment_.snapshot(); }
    Cell_soup<D> soup() const { return world_.environment_.soup(); }
    /// The rest of the groups of the file after edits.
    Groups<D> groups() const { return world_.groups_.now(snapshot()); }
    /// The points for arrays. They are kept like the environment as long as points are not added.
    std::shared_ptr<const std::vector<Point<D>>> points() const {
      const std::lock_guard making(world_.making_);
      world_.show_points();
      return world_.shown_;
    }

   private:
    const World& world_;
    pybind11::gil_scoped_release released_;
    std::shared_lock<Turn_lock> lock_;
  };

  /// The world for one thread alone. Bodies and particles in it are used by no other thread meanwhile, as
  /// each use has a Reading.
  /// \throw Error(usage) if this thread has it open for edits
  class Changing {
   public:
    explicit Changing(World& world) : world_(checked(world)), lock_(world.lock_) {}
    ~Changing() { world_.follow(moving_); }
    Changing(const Changing&) = delete;
    Changing& operator=(const Changing&) = delete;

    Environment<D>& environment() { return world_.environment_; }
    const Snapshot<D>& snapshot() const { return world_.environment_.snapshot(); }
    /// Arrays show where these points are then.
    void will_move(std::vector<std::uint32_t> points) { moving_ = std::move(points); }

   private:
    World& world_;
    pybind11::gil_scoped_release released_;
    std::unique_lock<Turn_lock> lock_;
    std::vector<std::uint32_t> moving_;
  };

  /// The world for one thread alone, which runs Python meanwhile. May be destroyed in any thread.
  /// \pre the interpreter is free
  class Opened {
   public:
    /// \throw Error(usage) if this thread has opened it before
    explicit Opened(World& world) : world_(checked(world)), lock_(world.lock_) {
      world_.opened_by_ = std::this_thread::get_id();
    }
    ~Opened() {
      world_.follow_all();
      world_.opened_by_ = std::thread::id();
    }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

    Environment<D>& environment() const { return world_.environment_; }

   private:
    World& world_;
    std::unique_lock<Turn_lock> lock_;
  };

  std::vector<std::string> group_names() const { return groups_.names(); }

 private:
  bool is_open_here() const { return opened_by_ == std::this_thread::get_id(); }

  template <class Any>
  static Any& checked(Any& world) {
    world.need_not_open_here();
    return world;
  }

  /// Makes the shown points those of the environment. Where points were added, arrays that were made before
  /// stay as they are.
  /// \pre making_ is held
  void show_points() const {
    const Snapshot<D>& snapshot = environment_.snapshot();
    if (shown_ && shown_at_ == snapshot.geometry_epoch()) return;
    const auto now = snapshot.points();
    if (shown_ && shown_->size() == now.size())
      std::copy(now.begin(), now.end(), shown_->begin());
    else
      shown_ = std::make_shared<std::vector<Point<D>>>(now.begin(), now.end());
    shown_at_ = snapshot.geometry_epoch();
  }

  /// After edits by which only these points moved.
  /// \pre the world is locked for this thread alone
  void follow(const std::vector<std::uint32_t>& moved) const {
    if (!shown_) return;
    const Snapshot<D>& snapshot = environment_.snapshot();
    for (const std::uint32_t p : moved) (*shown_)[p] = snapshot.point(p);
    shown_at_ = snapshot.geometry_epoch();
  }

  /// After any edits.
  /// \pre as above
  void follow_all() const {
    if (shown_ && shown_->size() != environment_.snapshot().points().size()) shown_.reset();
    if (shown_) show_points();
  }

  const Locator<D>& current_locator() const {
    const std::lock_guard making(making_);
    const std::uint64_t now = environment_.snapshot().geometry_epoch();
    if (!locator_ || located_ != now) {
      locator_.reset();
      locator_.emplace(environment_.snapshot());
      located_ = now;
    }
    return *locator_;
  }

  const Tracing<D>& current_tracing() const {
    const std::lock_guard making(making_);
    const std::uint64_t now = environment_.snapshot().geometry_epoch();
    if (!tracing_ || traced_ != now) {
      tracing_.reset();
      tracing_.emplace(environment_.snapshot());
      traced_ = now;
    }
    return *tracing_;
  }

  const Certificate& current_certificate() const {
    const std::lock_guard making(making_);
    const std::uint64_t now = environment_.snapshot().epoch();
    if (certified_ != now) {
      certificate_ = environment_.certify();
      certified_ = now;
    }
    return certificate_;
  }

  mutable Turn_lock lock_;
  Environment<D> environment_;
  Lasting_groups<D> groups_;
  std::atomic<std::thread::id> opened_by_{};
  mutable std::mutex making_;  ///< guards the members below
  mutable Certificate certificate_;
  mutable std::uint64_t certified_;  ///< the epoch of the certificate
  mutable std::optional<Locator<D>> locator_;
  mutable std::uint64_t located_;  ///< the geometry epoch of the locator
  mutable std::optional<Tracing<D>> tracing_;
  mutable std::uint64_t traced_ = 0;  ///< its geometry epoch
  /// The points that Python sees, once requested: edits may move those of the environment in memory.
  mutable std::shared_ptr<std::vector<Point<D>>> shown_;
  mutable std::uint64_t shown_at_ = 0;  ///< their geometry epoch
};

using Any_world = std::variant<World<2>, World<3>>;

/// The class Environment of Python.
struct Shared_world {
  std::shared_ptr<Any_world> world;
  std::string report;  ///< JSON

  int dimension() const { return world->index() == 0 ? 2 : 3; }
};
/// Bodies and particles hold their environment like this, so that Python finds the same object again.
using Held_world = std::shared_ptr<const Shared_world>;
using Environment_class = pybind11::class_<Shared_world, std::shared_ptr<Shared_world>>;

/// Takes an environment over, and frees its map.
/// \param groups of the same dimension
Shared_world share(Any_environment environment, const Certificate& certificate, std::string report,
                   const Any_groups& groups);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_WORLD_H
