// SPDX-License-Identifier: LGPL-3.0-or-later
// The world of a scene: free particles, bodies and a catheter among walls, advanced step by step.
//
// Of bodies and of the catheter, vertices and edges are checked. Nothing that moves meets anything else that moves.
#ifndef CELLWALK_SIMULATION_WORLD_H
#define CELLWALK_SIMULATION_WORLD_H

#include <cellwalk/body/verified_stop.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/contact_record.h>
#include <cellwalk/simulation/moving_body.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/particle.h>
#include <cellwalk/walk/walk.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk {

/// Everything that moves, and what it met. Deterministic: the same scene gives the same bits.
/// Refers to the snapshot, which must outlive it, and is not to be edited meanwhile: a world is made for the environment as it is.
template <int D>
class World {
 public:
  /// Places the particles and bodies of a scene. shapes[i] is the body of scene.bodies[i], before its placement.
  ///
  /// Copies of a body (Body_start::cloud) are put at random places, uniform in free space, again and again until the whole
  /// body fits, at most `most_tries` times each.
  /// \pre every shape has vertices
  /// \throw Error(outside) naming the scene's key where something starts outside free space, a body's edge crosses a wall, a copy
  ///        finds no room, or no way leads along the catheter's path; Error(usage) where there are not as many shapes as
  ///        bodies, no free cell for what is random, or a placement is not finite
  World(const Snapshot<D>& snapshot, const Scene<D>& scene, std::vector<Body_soup<D>> shapes = {},
        const Body_options& options = {});

  /// Places tried for each copy of a body.
  static constexpr int most_tries = 1000;

  /// Advances everything by one time step: free particles under gravity, in order, then the bodies in order.
  /// \throw Error(usage) if the environment was edited since the world was made
  void step();

  std::uint32_t steps_done() const { return steps_done_; }
  /// Free particles in the order of the scene.
  std::span<const Particle<D>> particles() const { return particles_; }
  std::span<const Vector<D>> velocities() const { return velocities_; }
  /// Bodies in the order of the scene, copies in the order they were drawn; the catheter is the last.
  std::span<const Moving_body<D>> bodies() const { return bodies_; }
  /// The scene's entry that a body is of. \pre it is not the catheter
  std::size_t entry_of(std::size_t body) const { return entry_of_[body]; }
  /// Nothing if the scene has none.
  const Rod<D>* catheter() const;
  /// The contacts of the last step: those of particles by number and time, then those of bodies in the order met.
  std::span<const Contact_record<D>> contacts() const { return contacts_; }
  /// What particles walked.
  const Walk_counts& counts() const { return counts_; }
  /// What the moves of bodies did.
  Body_counts body_counts() const;
  /// Those of one body.
  Body_counts body_counts(std::size_t body) const;

  /// Checks I1 for every particle, and I1, I2 and (if faces are swept) I3 for every body, by exact predicates. Bodies are caught up first (see
  /// Body::catch_up), which moves nothing and shows in the counts only.
  /// \throw Error(other) naming the first particle or body that violates them; Error(usage) as step()
  void validate();

 private:
  void place_cloud(const Particle_cloud& cloud, const std::string& key);
  void place_catheter(const Catheter<D>& catheter, const Locator<D>& locator);
  void place_bodies(const Locator<D>& locator);
  void place_body(const Body_start<D>& start, const Body_soup<D>& shape, const Locator<D>& locator);
  void place_copies(const Body_start<D>& start, const Body_soup<D>& shape, const Locator<D>& locator);
  void step_free();
  void step_bodies();
  void report(std::size_t particle);

  void check_epoch() const;

  const Snapshot<D>& snapshot_;
  std::uint64_t epoch_;  ///< of the snapshot, when the world was made
  Scene<D> scene_;
  std::vector<Particle<D>> particles_;
  std::vector<Vector<D>> velocities_;
  std::uint32_t steps_done_ = 0;
  std::vector<Body_soup<D>> shapes_;
  std::vector<Moving_body<D>> bodies_;
  std::vector<std::size_t> entry_of_;
  Flight_conditions<D> conditions_;
  std::vector<Contact_record<D>> contacts_;
  struct Body_step {
    std::vector<Body_contact<D>> contacts;  ///< in the latest step
    Body_counts counts;                     ///< of all steps
  };
  std::vector<Body_step> body_steps_;  ///< of each body: they move at the same time
  std::vector<Contact<D>> met_;
  Walk_counts counts_;
};

extern template class World<2>;
extern template class World<3>;

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_WORLD_H
