// SPDX-License-Identifier: LGPL-3.0-or-later
// An environment as Python holds it: never edited, so that any number of particles, bodies and threads can
// share it.
#ifndef CELLWALK_PYTHON_WORLD_H
#define CELLWALK_PYTHON_WORLD_H

#include <cellwalk/loading/environment_file.h>
#include <cellwalk/walk/locate.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace cellwalk::python {

/// An environment that can be asked where points are. It stays where it is: the locator refers to the
/// snapshot.
template <int D>
struct World {
  static constexpr int dimension = D;

  explicit World(Environment<D> built) : environment(std::move(built)), locator(environment.snapshot()) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Snapshot<D>& snapshot() const { return environment.snapshot(); }

  Environment<D> environment;
  Locator<D> locator;
};

using Any_world = std::variant<World<2>, World<3>>;

/// What Python calls Environment.
struct Shared_world {
  std::shared_ptr<const Any_world> world;
  Certificate certificate;
  std::string report;  ///< JSON

  int dimension() const { return world->index() == 0 ? 2 : 3; }
};

/// Takes an environment over, and frees its map.
Shared_world share(Any_environment environment, const Certificate& certificate, std::string report);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_WORLD_H
