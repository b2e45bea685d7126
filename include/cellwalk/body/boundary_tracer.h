// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks with lengths that go on where they meet walls: reflected, or from a corresponding wall.
#ifndef CELLWALK_BODY_BOUNDARY_TRACER_H
#define CELLWALK_BODY_BOUNDARY_TRACER_H

#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/trace.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace cellwalk {

/// Traces motions like a Tracer, but some walls reflect what meets them, and others move it to a
/// corresponding wall. It refers to the snapshot, tracer and locator, which must outlive it, and is valid as
/// long as these are.
template <int D>
class Boundary_tracer {
 public:
  /// \pre tracer and locator are those of the snapshot
  Boundary_tracer(const Snapshot<D>& snapshot, const Tracer<D>& tracer, const Locator<D>& locator)
      : snapshot_(snapshot), tracer_(tracer), locator_(locator) {}

  /// Walls that reflect, on both sides. Facets that are open are passed as ever.
  /// \throw Error(input) for a facet that was given before
  void reflect(std::span<const Half_facet> walls);

  /// Walls that correspond: what meets one of a set goes on from the other set. A translation must take one
  /// set to the other; facets need not correspond. Returns it, from `left` to `right`.
  /// \throw Error(input) if no translation does, for a facet that was given before or is open, and for walls
  ///        with free space on both sides, or on none
  /// Cost: two walks and locations a facet.
  Vector<D> join(std::span<const Half_facet> left, std::span<const Half_facet> right);

  /// Moves particles and appends a row for each, as Tracer::trace(). Where a row meets a wall that reflects,
  /// the particle stops near it (stop_at_contact), the rest of its motion is mirrored in the plane of the
  /// wall, and it goes on; at a joined wall it goes on from a point near the other, in free space by exact
  /// location. Each leg is an exact walk, and its pieces have correctly rounded lengths; the legs follow each
  /// other up to rounding, some ulp of the coordinates a leg. Walls where a row went on are among its
  /// crossings.
  /// \param particles moved if they arrive; others stay where they are
  /// \param targets as many; where they would arrive without walls
  /// \param most_bounces walls at which a row goes on; the next one blocks it
  /// \param headings none, or a vector for each motion, such as its velocity: those of particles that arrive
  ///        are mirrored in the walls that reflected them
  /// \throw Error as Tracer::trace(), and Error(usage) for a negative number of bounces, with nothing changed
  /// Degenerate cases: at an edge or vertex the wall that blocks the motion (Contact::facet) reflects it; if
  /// that leads into another wall there, the next leg has no length. A joined wall blocks a motion if none of
  /// the points near the other wall is in free space, and every wall does if the rest of the motion
  /// overflows: targets within 2^1000 leave room for that.
  /// Cost: that of the walks, of each leg on its own, and for each bounce that of a stop at a contact.
  void trace(std::span<Particle<D>> particles, std::span<const Point<D>> targets, int most_bounces,
             Traces& traces, Walk_counts& counts, std::span<Vector<D>> headings = {}) const;

 private:
  /// One direction of a joined pair.
  struct Passage {
    Vector<D> translation;
    double reach;  ///< by how much points are shifted off these walls, which may be rounded, at most
    std::unordered_set<std::uint32_t> cells;  ///< at the walls that are reached
  };
  static constexpr std::size_t reflects = static_cast<std::size_t>(-1);

  void answer(Half_facet wall, std::size_t how);
  bool goes_on(Half_facet wall, Particle<D>& particle, Point<D>& target, Vector<D>& heading,
               Walk_counts& counts) const;
  bool passes(const Passage& passage, Particle<D>& particle, const Vector<D>& normal) const;

  const Snapshot<D>& snapshot_;
  const Tracer<D>& tracer_;
  const Locator<D>& locator_;
  std::unordered_map<std::uint32_t, std::size_t> answers_;  ///< by half-facet: a passage, or that it reflects
  std::vector<Passage> passages_;
};

extern template class Boundary_tracer<2>;
extern template class Boundary_tracer<3>;

}  // namespace cellwalk

#endif  // CELLWALK_BODY_BOUNDARY_TRACER_H
