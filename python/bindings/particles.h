// SPDX-License-Identifier: LGPL-3.0-or-later
// The class Particles of Python.
#ifndef CELLWALK_PYTHON_PARTICLES_H
#define CELLWALK_PYTHON_PARTICLES_H

#include <cellwalk/walk/locate.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "motions.h"
#include "world.h"

namespace cellwalk::python {

/// Which particles move to targets: the numbers of those in `rows`, or none if all do.
/// \param rows None, integers or a mask
/// \throw as distinct_numbers_of(); InputError that names both shapes unless there are as many targets
template <int D>
std::vector<std::uint32_t> chosen_rows(const py::object& rows, const Points<D>& targets,
                                       std::size_t particles) {
  std::vector<std::uint32_t> chosen;
  if (!rows.is_none()) chosen = distinct_numbers_of(rows, "rows", particles, "particles");
  need_rows(targets, "targets", rows.is_none() ? particles : chosen.size(),
            rows.is_none() ? "the particles" : "rows");
  return chosen;
}

/// The particles of an environment of either dimension. They follow the moves of its walls in which they are
/// listed; after others they refuse to move, instead of missing a wall.
class Particles {
 public:
  Particles(Held_world environment, const py::object& points, int threads);

  std::size_t size() const;
  py::array positions(const py::object& self) const;
  py::array_t<std::int32_t> cells() const;
  /// \param rows the particles that move, or None for all
  Motions move(const py::object& targets, const py::object& rows, const std::string& at_contact, int threads);
  /// Finds their cells anew where they are. One that is on a wall keeps its side if its cell still holds it.
  void locate_again(int threads);

  const Held_world& environment() const { return environment_; }
  std::shared_ptr<const Any_world> world() const { return environment_->world; }
  /// Held while they move.
  std::mutex& moving() const { return *moving_; }
  /// For pickles: the environment, the positions, and where they are located.
  py::tuple state() const;
  /// \throw py::value_error if it is none, or a particle does not lie in its cell
  static Particles of_state(const py::tuple& state);

  // For reshape(), which is alone in the world.
  template <int D>
  std::vector<Particle<D>>& all() {
    return std::get<std::vector<Particle<D>>>(particles_);
  }
  /// \throw Error(usage) if walls moved since they were located
  template <int D>
  void check_epoch(const Snapshot<D>& snapshot) const {
    snapshot.check_epoch(epoch_,
                         "these particles were located: call Particles.locate_again(), and list them "
                         "where walls move");
  }
  /// They are located in the environment as it is now.
  template <int D>
  void follow_epoch(const Snapshot<D>& snapshot) {
    epoch_ = snapshot.epoch();
  }

 private:
  template <bool stops, int D, class Rows>
  Motions move_rows(std::vector<Particle<D>>& particles, const Points<D>& targets, const Rows& rows,
                    int threads);

  explicit Particles(Held_world environment) : environment_(std::move(environment)) {}

  Held_world environment_;
  std::variant<std::vector<Particle<2>>, std::vector<Particle<3>>> particles_;
  std::uint64_t epoch_ = 0;  ///< of the environment in which they are located
  std::unique_ptr<std::mutex> moving_ = std::make_unique<std::mutex>();
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_PARTICLES_H
