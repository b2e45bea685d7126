// SPDX-License-Identifier: LGPL-3.0-or-later
// The world of a scene: free particles, bodies and a catheter among walls, advanced step by step.
//
// The vertices and edges of bodies and of the catheter are checked against walls. Moving objects do not meet
// each other.
#ifndef CELLWALK_INTERNAL_SIMULATION_WORLD_H
#define CELLWALK_INTERNAL_SIMULATION_WORLD_H

#include <cellwalk/body/verified_stop.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/change_schedule.h>
#include <cellwalk/internal/simulation/moving_body.h>
#include <cellwalk/internal/simulation/run_contact.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk {

template <int D>
class World_part;  // <cellwalk/internal/simulation/world_part.h>

/// All moving objects, and their contacts. Deterministic: the same scene gives the same bits. Refers to the
/// snapshot, which must outlive it and is edited by move_walls(), relax() and change() only.
template <int D>
class World {
 public:
  /// Places the particles and bodies of a scene. shapes[i] is the body of scene.bodies[i], before its
  /// placement.
  ///
  /// Copies of a body (Body_start::cloud) are placed at random positions, uniformly distributed in free
  /// space, until the whole body fits, with at most `most_tries` attempts for each.
  /// \pre every shape has vertices
  /// \throw Error(outside) naming the scene's key if an object starts outside free space, a body's edge
  ///        crosses a wall, a copy does not fit, or no route follows the catheter's path; Error(usage) if
  ///        there are not as many shapes as bodies, there is no free cell for random objects, or a placement
  ///        is not finite
  World(const Snapshot<D>& snapshot, const Scene<D>& scene, std::vector<Body_soup<D>> shapes = {},
        const Body_options& options = {});
  World(const Snapshot<D>&& snapshot, const Scene<D>& scene, std::vector<Body_soup<D>> shapes = {},
        const Body_options& options = {}) = delete;

  /// The maximum number of positions tried for each copy of a body.
  static constexpr int most_tries = 1000;

  /// Advances everything by one time step: free particles under gravity, in order, then the bodies in order.
  /// \throw Error(usage) if the environment was edited since the world was made; Error(input) naming the
  ///        step and the first particle or body whose motion is not finite, or if the time is not. Some have
  ///        moved then, and the world throws Error(usage) from then on.
  void step();

  /// Moves points of the environment with everything in it, one after the other; a body or particle that they
  /// meet stays where it is or is pushed out of the way, by the options. Bodies that are pushed are checked
  /// as in steps.
  /// \pre `environment` is that of the snapshot
  /// \throw Error(usage) if it is not, or was edited since the world was made; and as Reshaping::move()
  /// Cost: that of Reshaping::move().
  Move_report<D> move_walls(Environment<D>& environment, std::span<const Vertex_move<D>> moves,
                            Reshape_options options, Reshape_counts& counts);

  /// Makes cells around some points better, with everything that lies in them, as Reshaping::relax() does.
  /// \pre `environment` is that of the snapshot
  /// \throw Error(usage) if it is not, or was edited since the world was made; and as Reshaping::relax()
  /// Cost: that of Reshaping::relax().
  Relax_report relax(Environment<D>& environment, std::span<const std::uint32_t> points,
                     const Relax_options& options, Reshape_counts& counts);

  /// Makes the changes of facets and cells that are due before the step that is next, with everything that
  /// moves in the environment; facets and cells that are held stay as they are.
  /// \pre `environment` is that of the snapshot and of the schedule
  /// \throw Error(usage) if it is not, is frozen, or was edited since the world was made
  /// Cost: reading all positions if something is due, and that of Reshaping::open() and the like.
  std::vector<Change_outcome> change(Environment<D>& environment, Change_schedule<D>& schedule,
                                     Reshape_counts& counts);

  std::uint32_t steps_done() const { return steps_done_; }
  /// Free particles in the order of the scene.
  std::span<const Particle<D>> particles() const { return particles_; }
  std::span<const Vector<D>> velocities() const { return velocities_; }
  /// Bodies in the order of the scene, copies in the order they were drawn; the catheter is the last.
  std::span<const Moving_body<D>> bodies() const { return bodies_; }
  /// The index of a body in Scene::bodies; none for the catheter.
  std::optional<std::size_t> entry_of(std::size_t body) const { return entry_of_[body]; }
  /// Where the vertices of a body are.
  std::span<const Point<D>> positions(std::size_t body) const {
    return is_remote(body) ? std::span<const Point<D>>(remote_bodies_[body]->positions)
                           : bodies_[body].body().positions();
  }
  /// The input index of the cell in which a vertex of a body is.
  /// Cost: that of Body::cell_of().
  std::uint32_t cell_of(std::size_t body, std::uint32_t vertex) const {
    return is_remote(body) ? remote_bodies_[body]->cells[vertex]
                           : snapshot_->index(bodies_[body].body().cell_of(vertex));
  }
  /// True for a body at the end of its path.
  bool has_arrived(std::size_t body) const {
    return is_remote(body) ? remote_bodies_[body]->has_arrived : bodies_[body].has_arrived();
  }
  /// The catheter; null if the scene has none.
  const Rod<D>* catheter() const;
  /// The contacts of the last step: those of particles by number and time, then those of bodies in the order
  /// met. Once cells were replaced, as by a cut, they name no facet and no cell any more.
  std::span<const Run_contact<D>> contacts() const { return contacts_; }
  /// The counts of the walks of particles.
  Walk_counts counts() const;
  /// The counts of the moves of all bodies.
  Body_counts body_counts() const;
  /// The counts of one body.
  Body_counts body_counts(std::size_t body) const;

  /// Checks I1 for every particle, and I1, I2 and (if faces are swept) I3 for every body, by exact
  /// predicates. Bodies are refreshed first (see Body::refresh), which affects the counts only.
  /// \throw Error(other) naming the first particle or body that violates them; Error(usage) as step()
  void validate();

 private:
  struct Empty {};
  /// Without anything that moves.
  World(const Snapshot<D>& snapshot, const Scene<D>& scene, const Body_options& options, Empty);
  void place_cloud(const Particle_cloud& cloud, const std::string& key);
  void place_catheter(const Catheter<D>& catheter, const Locator<D>& locator);
  void place_bodies(const Locator<D>& locator);
  void place_body(const Body_start<D>& start, const Body_soup<D>& shape, const Locator<D>& locator);
  void place_copies(const Body_start<D>& start, const Body_soup<D>& shape, const Locator<D>& locator);
  void step_free();
  void step_bodies();
  void record_contacts(std::size_t particle);

  bool is_remote(std::size_t body) const {
    return !remote_bodies_.empty() && remote_bodies_[body].has_value();
  }
  /// All particles and bodies are advanced here.
  void own_all();
  void check_epoch() const;
  void forget_cells();
  template <class Use>
  auto reshape(Environment<D>& environment, Reshape_options options, Reshape_counts& counts, const Use& use);

  const Snapshot<D>* snapshot_;
  std::uint64_t epoch_;  ///< of the snapshot, when the world was made
  Scene<D> scene_;
  std::vector<Particle<D>> particles_;
  std::vector<Vector<D>> velocities_;
  std::uint32_t steps_done_ = 0;
  bool is_stepping_ = false;  ///< and so after a step that failed
  std::vector<Body_soup<D>> shapes_;
  std::vector<Moving_body<D>> bodies_;
  std::vector<std::optional<std::size_t>> entry_of_;  ///< of each body
  Dynamics_options<D> conditions_;
  std::vector<Run_contact<D>> contacts_;
  struct Body_step {
    Step_report<D> report;           ///< of the latest step
    Body_counts counts;              ///< of all steps
    std::optional<Error> refusal{};  ///< if the latest step failed
  };
  std::vector<Body_step> body_steps_;  ///< of each body; bodies move in parallel
  std::vector<Contact<D>> timed_contacts_;
  Walk_counts counts_;

  /// The particles and bodies that are advanced here, by World_part: all, unless other processes advance the
  /// rest.
  std::pair<std::uint32_t, std::uint32_t> own_particles_;  ///< the first, and the one after the last
  std::vector<std::uint32_t> own_bodies_;
  /// A body that another process advances: its state in the last message of that process.
  struct Remote_body {
    std::vector<Point<D>> positions;
    std::vector<std::uint32_t> cells;
    Body_counts counts;
    bool has_arrived = false;
  };
  std::vector<std::optional<Remote_body>> remote_bodies_;  ///< of each body; empty: all are advanced here
  std::vector<Walk_counts> remote_counts_;                 ///< of each other part
  friend class World_part<D>;
  friend detail::State_access<D>;
};

extern template class World<2>;
extern template class World<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_WORLD_H
