// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the bodies of a scene, and the keys that they share with its particles and catheters.
#ifndef CELLWALK_IO_SCENE_SCENE_BODIES_H
#define CELLWALK_IO_SCENE_SCENE_BODIES_H

#include <cellwalk/internal/records/scene.h>

#include "json_node.h"

namespace cellwalk::io::detail {

inline constexpr double largest_radius = 1e300;  // units of the environment

constexpr std::uint64_t most_particles = 10'000'000;

/// `count`, `seed` and `speed` of a random cloud; `node` has the first.
Particle_cloud cloud(const Json_node& node);

/// One entry of `bodies`.
/// \throw Error(input) naming the key
template <int D>
Body_start<D> body_start(const Json_node& node);

/// Waypoints, at least two, successive ones different.
/// \throw Error(input) naming the waypoint
template <int D>
std::vector<Point<D>> waypoints(const Json_node& node);

extern template Body_start<2> body_start(const Json_node&);
extern template Body_start<3> body_start(const Json_node&);
extern template std::vector<Point<2>> waypoints<2>(const Json_node&);
extern template std::vector<Point<3>> waypoints<3>(const Json_node&);

}  // namespace cellwalk::io::detail

#endif  // CELLWALK_IO_SCENE_SCENE_BODIES_H
