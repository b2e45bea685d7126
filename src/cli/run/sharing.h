// SPDX-License-Identifier: LGPL-3.0-or-later
// A run whose particles and bodies ranks share: each advances a part, and the first writes the results of
// all.
#ifndef CELLWALK_CLI_RUN_SHARING_H
#define CELLWALK_CLI_RUN_SHARING_H

#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/internal/simulation/world_part.h>

#include <cstdint>
#include <optional>
#include <string>

namespace cellwalk::cli {

/// Why ranks cannot share a run; empty if they can.
template <int D>
std::string why_not_shared(const Scene<D>& scene, bool is_recorded, bool is_kept);

/// The steps after which the first rank needs all positions: the last one, and as follows.
struct State_times {
  std::uint32_t steps = 0;
  std::uint32_t frames = 0, motion = 0;  ///< steps from one to the next; 0: never
  bool trails = false;                   ///< of particles, in every step
};

template <int D>
class Run_sharing {
 public:
  /// Alone, all stays in the world, and nothing is done.
  Run_sharing(Ranks& ranks, World<D>& world, const State_times& times);

  /// To be called after each step of the world. Afterwards the world of the first rank has the contacts of
  /// all.
  /// \throw Error on the first rank if another one failed
  void step();
  /// To be called after World::validate(): the world of the first rank then has all states.
  /// \throw Error as step()
  void finish();

 private:
  bool needs_states() const;
  void exchange(const State_request& request);

  Ranks& ranks_;
  World<D>& world_;
  State_times times_;
  std::optional<World_part<D>> part_;
};

extern template std::string why_not_shared(const Scene<2>&, bool, bool);
extern template std::string why_not_shared(const Scene<3>&, bool, bool);
extern template class Run_sharing<2>;
extern template class Run_sharing<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_SHARING_H
