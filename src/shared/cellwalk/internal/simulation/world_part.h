// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds of one scene in several processes, each of which advances a part of the particles and bodies.
#ifndef CELLWALK_INTERNAL_SIMULATION_WORLD_PART_H
#define CELLWALK_INTERNAL_SIMULATION_WORLD_PART_H

#include <cellwalk/internal/simulation/world.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace cellwalk {

/// The data of a part that other parts need.
struct State_request {
  bool contacts = false;  ///< of the last step
  bool states = false;    ///< where everything is, in which cells, and counts
};

/// The part of a world that is advanced here: contiguous blocks of particles and of bodies, in the order of
/// parts; the catheter is of the first part. All parts make the same steps, and nothing that moves meets
/// anything else that moves, so together they have the results of one world. Refers to the world, which must
/// outlive it, and of which nothing was advanced yet.
template <int D>
class World_part {
 public:
  /// Leaves all that is not in part `number` of `count` to other worlds of the same scene.
  /// \pre number < count; nobody moves or changes walls
  World_part(World<D>& world, std::size_t number, std::size_t count);

  /// The state of this part, as bytes for take_over().
  std::string state_of_part(const State_request& request) const;
  /// Takes over the state of another part: World::contacts(), positions() and the like include it. Call
  /// sort_contacts() after the last part.
  /// \throw Error if it is not of such a part
  void take_over(std::string_view state);
  /// Puts contacts in the order of one world.
  void sort_contacts();

 private:
  World<D>& world_;
  std::size_t number_;
};

extern template class World_part<2>;
extern template class World_part<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_WORLD_PART_H
