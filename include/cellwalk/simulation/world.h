// SPDX-License-Identifier: LGPL-3.0-or-later
// The world of a scene: free particles and a catheter tip among walls, advanced step by step.
//
// Only particles are checked here: neighbours in the catheter are held together, but the straight edges between them
// may cut a wall that bends in between.
#ifndef CELLWALK_SIMULATION_WORLD_H
#define CELLWALK_SIMULATION_WORLD_H

#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/contact_record.h>
#include <cellwalk/simulation/verified_stop.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/particle.h>
#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk {

/// Everything that moves, and what it met. Deterministic: the same scene gives the same bits.
/// Refers to the snapshot, which must outlive it.
template <int D>
class World {
 public:
  /// Places the particles of a scene.
  /// \throw Error(outside) naming the scene's key where one starts outside free space, or where no way leads along the
  ///        catheter's path; Error(usage) if there is no free cell for random particles
  World(const Snapshot<D>& snapshot, const Scene<D>& scene);

  /// Advances every particle by one time step: free particles under gravity, in order, then the catheter.
  void step();

  std::uint32_t steps_done() const { return steps_done_; }
  /// Free particles in the order of the scene, then those of the catheter in the order they entered: the tip first.
  std::span<const Particle<D>> particles() const { return particles_; }
  std::size_t free_count() const { return free_count_; }
  /// Velocities; those of catheter particles are their displacement in the last step over the time step.
  std::span<const Vector<D>> velocities() const { return velocities_; }
  /// The contacts of the last step, by particle and time.
  std::span<const Contact_record<D>> contacts() const { return contacts_; }
  /// The catheter's way points, routes found included.
  std::span<const Point<D>> path() const { return path_; }
  /// The way point that the tip aims at; path().size() once it has arrived.
  std::size_t next_way_point() const { return next_way_point_; }
  /// The steps in which the tip waited because a neighbour was held back.
  std::uint32_t steps_waited() const { return steps_waited_; }
  const Walk_counts& counts() const { return counts_; }

  /// Checks I1 for every particle. \throw Error(other) naming the first one that violates it
  void validate() const;

 private:
  void place_cloud(const Particle_cloud& cloud, const std::string& key);
  void place_catheter(const Catheter<D>& catheter, const Locator<D>& locator);
  void step_free();
  void step_catheter(const Catheter<D>& catheter);
  Vector<D> steer(const Catheter<D>& catheter);
  void follow(const Catheter<D>& catheter, std::size_t i);
  void push(std::size_t particle, const Vector<D>& displacement);
  void enter();
  bool in_sight(const Particle<D>& from, const Point<D>& to);
  double link_length(std::size_t i) const;
  void report(std::size_t particle);

  const Snapshot<D>& snapshot_;
  Scene<D> scene_;
  std::vector<Particle<D>> particles_;
  std::vector<Vector<D>> velocities_;
  std::size_t free_count_ = 0;
  Particle<D> entry_;
  /// Per catheter particle: where its predecessor has been since it was last in sight.
  std::vector<std::vector<Point<D>>> trails_;
  std::vector<Point<D>> path_;
  std::size_t next_way_point_ = 1;
  std::uint32_t steps_done_ = 0, steps_waited_ = 0;
  std::vector<Contact_record<D>> contacts_;
  std::vector<Met_contact<D>> met_;
  Walk_counts counts_;
};

extern template class World<2>;
extern template class World<3>;

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_WORLD_H
