// SPDX-License-Identifier: LGPL-3.0-or-later
// A triangular face comes down on an obstacle, its edges swept completely: how deep does what meets no edge
// come in?
// Paper: figure 6. The bound by an inverted pyramid is ours (README.md).
#ifndef CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_FACE_TRIALS_H
#define CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_FACE_TRIALS_H

#include <concepts>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace cellwalk::small_obstacles {

/// The radius of the greatest circle in each face.
inline constexpr double face_inradius = 0.5;

/// How faces are drawn.
enum class Aim {
  random,  ///< any shape, tilt and direction; the obstacle below any point of the face
  worst    ///< level, straight down, the tip below the centre of the greatest circle
};

struct Spike_setting {
  double sharpness = 1;  ///< height of the spike over the radius of its base
  Aim aim = Aim::random;
  std::uint64_t seed = 1;
  std::uint64_t faces = 0;
};

/// What became of one face.
struct Penetration {
  double depth = 0;  ///< of the tip beyond the plane of the face, when the sweeps of the edges stop it
  double share = 0;  ///< of the bound: of the face as it is then
};

struct Spike_tally {
  /// Of the depth behind a face as it is drawn: its inradius times the sharpness of the cone in the spike.
  double bound = 0;
  std::vector<Penetration> by_edges;     ///< faces that the spike was in, when their edges met it
  std::uint64_t not_pierced = 0;         ///< faces stopped by their edges or corners before the tip came in
  std::uint64_t not_stopped = 0;         ///< faces that never met anything
  std::uint64_t pierced_with_faces = 0;  ///< with faces swept: the spike in the face; none
  std::uint64_t stopped_by_face = 0;     ///< with faces swept: by the face itself
};

/// All members, for experiments::shared_trials().
template <class Archive, class Tally>
void members(Archive& archive, Tally& tally) requires std::same_as<std::remove_const_t<Tally>, Spike_tally> {
  archive(tally.bound);
  archive(tally.by_edges);
  archive(tally.not_pierced);
  archive(tally.not_stopped);
  archive(tally.pierced_with_faces);
  archive(tally.stopped_by_face);
}

/// Cost: some ms a face.
Spike_tally run_spikes(const Spike_setting& setting);

struct Floating_setting {
  double size_over_inradius = 1;  ///< side of a cube that floats
  std::uint64_t seed = 1;
  std::uint64_t faces = 0;
};

struct Floating_tally {
  std::uint64_t passed = 0;             ///< the cube went through the face, and no edge met it
  std::uint64_t stopped = 0;            ///< an edge or a corner met it
  std::uint64_t passed_with_faces = 0;  ///< with faces swept; none
};

/// Cost: some ms a face.
Floating_tally run_floating(const Floating_setting& setting);

}  // namespace cellwalk::small_obstacles

#endif  // CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_FACE_TRIALS_H
