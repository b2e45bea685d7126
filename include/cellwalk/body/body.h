// SPDX-License-Identifier: LGPL-3.0-or-later
// A body among walls: its vertices are particles, its edges carry chains of cells. Paper: section III.
// Theory: docs/bodies.md.
#ifndef CELLWALK_BODY_BODY_H
#define CELLWALK_BODY_BODY_H

#include <cellwalk/body/step.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/walk/locate.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk {

namespace detail {
template <int D>
struct Body_state;
template <int D>
class Body_access;
}  // namespace detail

/// A registered body: every vertex in free space (I1), every edge with a chain (I2) and at least at the
/// distance of its radius from every wall (I4), always. As long as it is moved with Sweep::faces, no wall
/// pierces a face either (I3, 3D), and faces keep the least radius of their sides; other sweeps leave faces
/// alone. Refers to the snapshot, which must outlive it. Copies are bodies of their own.
///
/// A body is registered in the environment as it is then. After an edit (Snapshot::epoch()) all that moves,
/// registers or checks it throws Error(usage), until register_again(); its parts and positions can still be
/// read. A Reshaping in which the body is listed keeps it registered instead.
template <int D>
class Body {
 public:
  /// Registers a body where it stands. A vertex on a wall with free space on several sides gets one from
  /// which all its edges can be passed; which one, where several will do, is arbitrary but fixed. So is the
  /// way of an edge that may pass walls on several sides: if one of its faces lies on another side of them,
  /// the body is refused, although another way would do. Faces in the plane are not looked at.
  /// \throw Error(outside) naming the vertex that is not in free space, the edge that crosses a wall, the
  ///        face that a wall pierces, or what is nearer to a wall than its radius, and where; Error(usage)
  ///        naming an edge or a face that no Body_soup has; Error(input) naming a vertex that is not finite,
  ///        or a radius that is not a finite number of at least 0
  /// Cost: one point location per vertex, one walk per edge, some us per face near walls.
  Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup);
  Body(const Snapshot<D>&& snapshot, const Locator<D>& locator, const Body_soup<D>& soup) = delete;
  /// The same, with a locator of its own. For many bodies, share one: it is made from all cells.
  Body(const Environment<D>& environment, const Body_soup<D>& soup);
  Body(const Environment<D>&& environment, const Body_soup<D>& soup) = delete;
  Body(const Body& other);
  Body(Body&& other) noexcept;
  Body& operator=(const Body& other);
  Body& operator=(Body&& other) noexcept;
  ~Body();

  /// Registers the body anew where it stands, after edits: vertices, chains, rests of faces. All stay on
  /// their sides of the walls that stood before; among several ways, cells and chains that still hold are
  /// kept. Faces are registered if they were swept in the last move, or never moved. Where cells were
  /// replaced, vertices and edges may choose as in the constructor, but for a vertex whose cell alone was
  /// split, with no compaction since. Gives a region free of walls up.
  /// \throw Error(outside) as the constructor, where a wall now lies in the way of a vertex or an edge that
  ///        keeps its side, or this side was filled: then the body is as it was, and may be tried again after
  ///        another edit. Error(usage) for a locator that is out of date, or if the edits since are forgotten
  /// Cost: that of the constructor, and reading the edits since; up to three times that if a face is pierced.
  void register_again(const Locator<D>& locator);

  std::size_t vertex_count() const { return positions().size(); }
  std::span<const Point<D>> positions() const;
  std::span<const std::array<std::uint32_t, 2>> edges() const;
  std::span<const std::array<std::uint32_t, 3>> faces() const;
  /// How far an edge keeps from every wall; 0: it may touch walls.
  /// \throw Error(usage) if there is no such edge
  double radius(std::size_t edge) const;
  /// For each edge a lower bound of its distance to all walls, or `up_to` where it is farther from them: for
  /// solvers that place barriers or penalties (docs/radius.md). It is at least the radius of the edge, and
  /// below the distance by less than 2^-40 of the largest difference of coordinates.
  /// \param up_to finite, at least 0: walls farther away are not looked at
  /// \throw Error(usage) if something is stale, see refresh(), or if `up_to` is negative or not finite
  /// Cost: for each edge a flood through the cells nearer than that, about 30 ns a facet, and 0.3 to 0.7 us a
  /// wall.
  std::vector<double> clearances(double up_to) const;
  /// Changes the radii, in the form of Body_soup::radii. Gives a region free of walls up.
  /// \throw Error(outside) naming the first edge, vertex or, if faces are swept, face that is nearer to a
  ///        wall than its new radius; Error(input) for a wrong number of them, or one that is not a finite
  ///        number of at least 0. Then nothing has changed
  /// Cost: a flood for each edge through the cells nearer than its radius.
  void set_radii(std::span<const double> radii);
  /// The other ends of the edges of a vertex, ascending.
  /// \throw Error(usage) if there is no such vertex
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const;

  /// Moves the vertices one after the other to their targets, as far as walls allow, by options.rule.
  /// Appends to the report.
  ///
  /// Edges with a radius keep their distance, with Sweep::faces also faces, whose radius is the least of
  /// their sides'; a contact is where one would come nearer. By Step_rule::reject_at_target and
  /// Sweep::three_segments only the way of the vertex and its edges at the end count.
  /// \throw Error(usage) unless there is one target a vertex, for Step_rule::reject_at_target if a vertex
  ///        has more than 64 edges, a search of a tolerance not in (0,1] off regions, for a body with a
  ///        radius Touch::stop and a search, and Sweep::faces after moves that left the faces alone and let a
  ///        wall pierce one, or come nearer than its radius; Error(input) naming a target that is not finite.
  ///        Then nothing has moved.
  /// Cost: reading the coordinates while the body is in a region free of walls; else a walk a vertex and a
  /// sweep an edge, and locating the contacts that are reported or slid along. The first time faces are swept
  /// after moves that left them alone, all are registered. By Step_rule::reject_at_target with Touch::stop
  /// rational arithmetic for walls near a move that planes alone do not prove free, and once for those near a
  /// body that was moved otherwise.
  void step(std::span<const Point<D>> targets, const Body_options& options, Step_report<D>& report,
            Body_counts& counts);

  /// The same by Step_rule::slide, and returns the contacts.
  std::vector<Contact<D>> step(std::span<const Point<D>> targets);

  /// Moves one vertex to a target, or leaves everything as it is and returns the first contact: as a step by
  /// Step_rule::reject, of the options but the sweep nothing counts. Gives a region
  /// free of walls up.
  /// \throw Error(usage) if there is no such vertex, and for Sweep::faces after moves with another sweep that
  ///        let a wall pierce a face; Error(input) if the target is not finite. Then nothing has changed.
  std::optional<Contact<D>> move_vertex(std::uint32_t vertex, const Point<D>& target,
                                        const Body_options& options, Body_counts& counts);

  /// Registers the vertices that were moved without tests in a region free of walls, and their edges.
  void refresh(Body_counts& counts);
  /// Registers the stale vertices and edges, and gives the region up.
  void leave_region(Body_counts& counts);
  /// The particles and chains.
  /// \pre nothing is stale, see refresh(), and no edit since
  std::span<const Particle<D>> particles() const;
  /// \throw Error(usage) if there is no such edge
  const Chain& chain(std::size_t edge) const;

  /// The cell of a vertex, which may be stale: then it is found by a walk in the region, which is not
  /// counted, and the body stays stale.
  /// \pre no edit since the body was registered
  /// \throw Error(usage) if there is no such vertex
  /// Cost: nothing unless it is stale; else that of a walk.
  Cell cell_of(std::uint32_t vertex) const;

  /// Checks I1, I2, I4 and, if faces are swept, I3 by exact predicates: each vertex lies in its cell, each
  /// edge has a valid chain from cell to cell, no wall pierces a face, or is nearer to an edge or a face
  /// than its radius.
  /// \throw Error(usage) if something is stale, see refresh(); Error(other) naming the first vertex, edge or
  ///        face that violates them
  void validate() const;

 private:
  explicit Body(std::unique_ptr<detail::Body_state<D>> state);

  std::unique_ptr<detail::Body_state<D>> state_;

  friend detail::Body_access<D>;
};

extern template class Body<2>;
extern template class Body<3>;

/// All parts of a body and of its registration: positions, edges, faces, particles, chains, the walls that
/// faces rest on, the regions free of walls and the vertices and edges that are stale in them. The same body
/// gives the same bytes. They are for the same version of the program on machines of the same byte order, and
/// carry a checksum.
/// \pre no edit since the body was registered
/// \throw Error(usage) if there was one
/// Cost: about that of a copy.
template <int D>
std::vector<std::byte> save(const Body<D>& body);

/// The body that was saved, in the same environment: the one in which it was, with no edit since, or a
/// compiled copy of that (compile_to_bytes()). From then on it does exactly what the saved body would have
/// done. So are its counts; but in a copy of an environment whose facets were opened or closed, those of
/// regions may be others.
/// \throw Error(input) for bytes that are no saved body, are damaged, or of another version or dimension, or
///        that do not fit the environment: a vertex is not in its cell, or an edge has no valid chain
/// Cost: that of Body::validate(), some 0.2 us a vertex and an edge; no point is located.
template <int D>
Body<D> restore_body(const Snapshot<D>& snapshot, std::span<const std::byte> bytes);

extern template std::vector<std::byte> save(const Body<2>&);
extern template std::vector<std::byte> save(const Body<3>&);
extern template Body<2> restore_body(const Snapshot<2>&, std::span<const std::byte>);
extern template Body<3> restore_body(const Snapshot<3>&, std::span<const std::byte>);

}  // namespace cellwalk

#endif  // CELLWALK_BODY_BODY_H
