// SPDX-License-Identifier: LGPL-3.0-or-later
// An environment as Python holds it: any number of particles, bodies and threads share it. They ask it at the
// same time, or one of them moves its walls while the others wait.
#ifndef CELLWALK_PYTHON_WORLD_H
#define CELLWALK_PYTHON_WORLD_H

#include <cellwalk/loading/environment_file.h>
#include <cellwalk/walk/locate.h>

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "turn_lock.h"

namespace cellwalk::python {

/// An environment that can be asked where points are. It stays where it is: the locator refers to the
/// snapshot.
///
/// What walls that move change is reached through Reading and Changing only; a thread has one of them at a
/// time. Each sets the interpreter free, takes its locks, and gives them back before it waits for the
/// interpreter again. So no thread that holds a lock waits for the interpreter, and none that has the
/// interpreter waits for a lock. As all take the locks in one order (that of a body or of particles, that of
/// the world, that of its locator), no threads wait for each other.
template <int D>
class World {
 public:
  static constexpr int dimension = D;

  World(Environment<D> built, const Certificate& certificate)
      : environment_(std::move(built)),
        wall_count_(certificate.walls),
        certificate_(certificate),
        certified_(environment_.snapshot().epoch()),
        locator_(environment_.snapshot()),
        located_(environment_.snapshot().geometry_epoch()) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// The world as it is while this lives: nothing moves its walls.
  class Reading {
   public:
    explicit Reading(const World& world) : lock_(world.lock_), world_(world) {}
    /// \param owner what guards a body or particles that are used meanwhile
    Reading(const World& world, std::mutex& owner) : owner_(owner), lock_(world.lock_), world_(world) {}

    const Environment<D>& environment() const { return world_.environment_; }
    const Snapshot<D>& snapshot() const { return environment().snapshot(); }
    /// Made anew if points moved since the last one. Not to be called from tasks of oneTBB.
    const Locator<D>& locator() const { return world_.current_locator(); }
    /// Of the environment as it is: certified again if points moved.
    const Certificate& certificate() const { return world_.current_certificate(); }

   private:
    pybind11::gil_scoped_release released_;  // before the locks, and until they are given back
    std::unique_lock<std::mutex> owner_;
    std::shared_lock<Turn_lock> lock_;
    const World& world_;
  };

  /// The world for one thread alone. Bodies and particles in it are used by no other thread meanwhile, as
  /// each use has a Reading.
  class Changing {
   public:
    explicit Changing(World& world) : lock_(world.lock_), environment_(world.environment_) {}
    Environment<D>& environment() { return environment_; }
    const Snapshot<D>& snapshot() const { return environment_.snapshot(); }

   private:
    pybind11::gil_scoped_release released_;
    std::unique_lock<Turn_lock> lock_;
    Environment<D>& environment_;
  };

  // What walls that move keep: numbers of cells and walls; of the points, their number and place in memory.
  std::size_t cell_count() const { return environment_.snapshot().cell_count(); }
  std::size_t wall_count() const { return wall_count_; }
  std::span<const Point<D>> points() const { return environment_.snapshot().points(); }

 private:
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
  std::size_t wall_count_;
  mutable std::mutex making_;  ///< of what follows
  mutable Certificate certificate_;
  mutable std::uint64_t certified_;  ///< the epoch of the certificate
  mutable std::optional<Locator<D>> locator_;
  mutable std::uint64_t located_;  ///< the geometry epoch of the locator
};

using Any_world = std::variant<World<2>, World<3>>;

/// What Python calls Environment.
struct Shared_world {
  std::shared_ptr<Any_world> world;
  std::string report;  ///< JSON

  int dimension() const { return world->index() == 0 ? 2 : 3; }
};

/// Takes an environment over, and frees its map.
Shared_world share(Any_environment environment, const Certificate& certificate, std::string report);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_WORLD_H
