// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies and particles that are listed where walls move.
#ifndef CELLWALK_PYTHON_LISTED_H
#define CELLWALK_PYTHON_LISTED_H

#include <cellwalk/reshape/move.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <span>
#include <vector>

#include "any_body.h"
#include "particles.h"

namespace cellwalk::python {

/// The objects that a call lists. Made with the interpreter, and keeps them alive.
struct Listed {
  std::vector<py::object> objects;
  std::vector<Any_body*> bodies;
  std::vector<Particles*> particles;
};

/// \throw TypeError for objects that are no bodies, or no particles, UsageError for those that are listed
///        twice, or lie in another environment
Listed listed_of(const std::shared_ptr<Any_world>& world, const py::object& bodies,
                 const py::object& particles);

/// Particles for a Reshaping, which needs all of them in free space: those in no cell are left out. In the
/// end all are as the walls left them, and have the new epoch.
template <int D>
class Located_particles {
 public:
  /// \pre all.check_epoch() does not throw
  Located_particles(Particles& all, const Snapshot<D>& snapshot) : all_(all), snapshot_(snapshot) {
    std::vector<Particle<D>>& particles = all.all<D>();
    const auto has_cell = [](const Particle<D>& particle) { return particle.cell != Cell::none; };
    if (std::all_of(particles.begin(), particles.end(), has_cell)) return;
    for (std::uint32_t i = 0; i < particles.size(); ++i)
      if (has_cell(particles[i])) {
        numbers_.push_back(i);
        copies_.push_back(particles[i]);
      }
    is_part_ = true;
  }
  Located_particles(const Located_particles&) = delete;
  Located_particles& operator=(const Located_particles&) = delete;
  ~Located_particles() {
    for (std::size_t i = 0; i < numbers_.size(); ++i) all_.all<D>()[numbers_[i]] = copies_[i];
    all_.follow_epoch(snapshot_);
  }

  std::span<Particle<D>> span() { return is_part_ ? std::span(copies_) : std::span(all_.all<D>()); }
  /// The number of a particle of the span among all.
  std::uint32_t number(std::uint32_t in_span) const { return is_part_ ? numbers_[in_span] : in_span; }

 private:
  Particles& all_;
  const Snapshot<D>& snapshot_;
  bool is_part_ = false;
  std::vector<std::uint32_t> numbers_;  ///< of the copies
  std::vector<Particle<D>> copies_;
};

/// All that is listed, as a Reshaping takes it.
template <int D>
class Listed_residents {
 public:
  /// \throw Error(usage) for particles that were not listed in a move of walls
  Listed_residents(const Listed& listed, const Snapshot<D>& snapshot) {
    for (const Particles* particles : listed.particles) particles->check_epoch(snapshot);
    for (Any_body* body : listed.bodies) residents_.bodies.push_back(&body->body<D>());
    for (Particles* particles : listed.particles)
      residents_.particles.push_back(particles_.emplace_back(*particles, snapshot).span());
    for (const Located_particles<D>& of : particles_) numbering_.push_back(&of);
  }

  const Residents<D>& residents() const { return residents_; }
  /// Numbers a particle as its owner does.
  void number(Resident& resident) const {
    if (resident.is_particle) resident.number = numbering_[resident.owner]->number(resident.number);
  }

 private:
  std::list<Located_particles<D>> particles_;  // stay where they are
  std::vector<const Located_particles<D>*> numbering_;
  Residents<D> residents_;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_LISTED_H
