// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move among bodies and particles, which stand still meanwhile: an exact answer for each vertex of
// the environment that moves. Theory: docs/moving.md.
#ifndef CELLWALK_RESHAPE_RESHAPING_H
#define CELLWALK_RESHAPE_RESHAPING_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/reshape/cut.h>
#include <cellwalk/reshape/move.h>
#include <cellwalk/reshape/replacement.h>

#include <cstdint>
#include <memory>
#include <span>

namespace cellwalk {
namespace detail {
template <int D>
struct Reshaping_state;
}

/// The reaction of a vertex of the environment whose walls meet a resident.
enum class At_contact : std::uint8_t {
  stop,  ///< it stops at a verified position, there or just before
  hold,  ///< it stays where it was
  /// The resident that it meets is moved out of its way, by moves that are tested and stopped like any
  /// others; then it tries again, and stops if that did not help.
  push
};

/// A vertex of the environment and where it is to go.
template <int D>
struct Vertex_move {
  std::uint32_t point;
  Point<D> target;
};

struct Reshape_options {
  At_contact at_contact = At_contact::stop;
  /// The number of rounds in which moves of many vertices are tried: a vertex that would make a cell flat
  /// goes half of the way to that, and has its next turn when the others moved.
  int most_rounds = 8;
  /// By At_contact::push, the number of times in a move that a vertex tries to push residents out of its way.
  int most_pushes = 16;
  /// The checks of bodies that are pushed, and their reaction at other walls: by default they slide.
  /// Faces are swept as well if the body was last moved so.
  Body_options body{};
};

/// An environment that is open for moves of its vertices, with all that lies in it. Vertices move one after
/// the other along straight lines, and the bodies and particles listed stand still meanwhile, or are pushed
/// out of the way before; after each move they are registered as if the environment had always been so.
/// Nothing else reads or changes the environment until finish(), and bodies are not moved. Once a move was
/// made, a body that is not listed throws Error(usage) at its next use instead of missing a wall, and
/// particles that are not listed must be located again. Tests, and moves that are not made, change nothing
/// for them.
///
/// A move is made whole or not at all: an exact test of each wall at the vertex against each vertex, edge and
/// face near it. Faces are looked at if the body was last moved with Sweep::faces (3D). Of edges with a
/// radius each wall keeps that distance, while it moves and where one appears; docs/radius.md.
///
/// Between moves facets can be opened and closed, and cells filled and excavated, of any shape;
/// docs/cutting.md has the theory. Each such change is made whole or not at all, and decided exactly: free
/// space that grows is never refused, and free space that shrinks is refused with all that is in the way.
template <int D>
class Reshaping {
 public:
  /// \param environment its certificates near vertices that move are withdrawn until finish()
  /// \throw Error(usage) for a body of another environment, or one registered before an edit, for a null one,
  ///        and for a particle without a cell or a finite position
  /// Cost: reading the positions of all residents.
  Reshaping(Environment<D>& environment, const Residents<D>& residents, const Reshape_options& options = {});
  /// As finish().
  ~Reshaping();
  Reshaping(Reshaping&&) noexcept;
  Reshaping& operator=(Reshaping&&) noexcept;

  /// Moves a vertex to a target, or as far as options.at_contact allows. An obstacle to a move is a result,
  /// not an error. An error changes nothing.
  /// \throw Error(usage) if there is no such point, if a cell around it is not a simplex (see
  ///        Build_options::simplicial), for a particle that is not in its cell, and after finish();
  ///        Error(input) for a target that is not finite
  /// Degenerate cases: all are decided; where a rim passes a vertex or edge exactly, it may end on either
  /// side, see docs/moving.md, touches. A target equal to the position is reached.
  /// Cost: about 1 us with nothing near, 2 us in 10^6 cells that are not in the cache; some 20 signs more a
  /// wall that is near something; exact numbers for touches; on the boundary of the environment up to a few
  /// us more, and some 50 us near other parts of it. The first move in an environment takes 1 us for each of
  /// its points.
  Vertex_result<D> move(std::uint32_t point, const Point<D>& target);

  /// Moves many vertices, in order and backwards in turn, in rounds until all have arrived or none gets on.
  /// Each may appear once.
  /// \throw Error as above, for a point that does not exist or a target that is not finite before any move;
  ///        otherwise the moves before that are made
  Move_report<D> move(std::span<const Vertex_move<D>> moves);

  /// Returns the result that move() would have by At_contact::hold, with the position that the vertex would
  /// have; nothing moves. For solvers that shorten a step to the first contact themselves.
  /// \throw Error as move()
  /// Cost: that of move().
  Vertex_result<D> test_move(std::uint32_t point, const Point<D>& target);

  /// Makes a wall between two free cells, or two solid ones, passable. Nothing that lies there can forbid it.
  /// A facet of the boundary, or between a solid and a free cell, is not opened: that is a result with its
  /// reason. One that is passable already stays so.
  /// \throw Error(usage) if there is no such facet, if the environment is frozen, and after finish()
  /// Cost: about 1 us, and certificates as finish() if vertices were moved before.
  Outcome open(Half_facet facet);

  /// Makes a facet a wall, seen from either side.
  /// Refused if a vertex, an edge or a face would then be on both sides of it, as an edge that passes through
  /// its inside, or nearer to it than its radius. A vertex or an edge that only touches the facet is
  /// registered on a side of it on which the rest of its body can be as well. Faces count if the body was
  /// last moved with Sweep::faces (3D); walls may appear inside of a closed surface, and of a body in the
  /// plane, which has no faces. A facet that is a wall already stays so.
  /// \throw Error as open(), and Error(usage) for a particle near that is not in its cell
  /// Degenerate cases: all are decided; see docs/cutting.md.
  /// Cost: about 1 us with nothing near; some signs an edge that passes it inside; exact numbers, up to a
  /// millisecond, for an edge or face that touches it otherwise.
  Outcome close(Half_facet facet);

  /// Makes a solid cell free: its facets to free cells become passable, those to solid ones and on the
  /// boundary stay walls or become such. Nothing can forbid it. A cell that is free already stays so.
  /// \throw Error(usage) if there is no such cell, if the environment is frozen, and after finish()
  /// Cost: about 2 us.
  Outcome excavate(Cell cell);

  /// Makes a free cell solid: all its facets to free cells become walls. Refused if something lies in its
  /// inside, or on its border with no free space beside it that it could be in as well, or is nearer to it
  /// than its radius. A cell that is solid already stays so.
  /// \throw Error as excavate(), and Error(usage) for a particle near that is not in its cell
  /// Degenerate cases and cost: as close(), of all its facets.
  Outcome fill(Cell cell);

  // Replacements of cells, all simplices, by others over the same region, between which there is no wall. No
  // body can be in the way of one: all that lies in the old cells is registered in the new ones, on the same
  // side of all walls. A replacement that the shape of the environment forbids is a result with a reason, and
  // changes nothing. The names of the old cells and of their half-facets are gone, those in contacts too, and
  // later ones may be equal. Each throws Error(usage) for a name that does not exist, for a cell that is not
  // a simplex, in a frozen environment, for a particle that is not in its cell, and after finish();
  // Error(input) for a position that is not finite.
  // Cost: 3 to 4 us a new cell, whatever the size of the environment; more where edges there pass ridges or
  // vertices of cells exactly.

  /// Replaces a cell by the cells of a new point strictly inside it.
  Replacement insert_point(Cell cell, const Point<D>& position);

  /// Replaces the cells around an edge by those that a new point joined to both ends makes of them. The
  /// position need not be on the edge. If a wall has the edge, it must lie on it exactly, and nothing may
  /// have to lie in these cells, nor rest on their walls: then walls stay where they are. Refused otherwise,
  /// and if the boundary has the edge.
  /// Degenerate cases: a resident on the border of these cells may be on their side of it, or be beside them.
  Replacement split_edge(std::uint32_t u, std::uint32_t v, const Point<D>& position);

  /// Replaces the two cells of a facet by three around the edge that joins their other vertices (2D: by two
  /// on both sides of it).
  Replacement flip(Half_facet facet);

  /// Replaces the cells around an edge by those on the triangles of a triangulation of the points around it:
  /// that with the best least quality of those whose cells are positive (3D). Refused if a wall or the
  /// boundary has the edge, and for more than 7 cells.
  Replacement remove_edge(std::uint32_t u, std::uint32_t v);

  /// Removes a point by moving it along an edge into the other end. Refused if a wall or the boundary has it.
  /// Later new points may get its index; Snapshot::is_point() tests whether one is in use.
  Replacement collapse(std::uint32_t u, std::uint32_t onto);

  /// Makes cells around some points better, worst first: flips and removals of edges, moves of vertices that
  /// have no wall, and where edges are very short or long, collapses and splits, each if it raises the least
  /// quality of the cells that it touches. Deterministic. Walls stay where they are, and so do points that
  /// the options name.
  /// \throw Error(usage) for a point that does not exist or a cell around one that is not a simplex, and as
  ///        the replacements above
  /// Cost: that of the operations, and some us for each that is only considered.
  Relax_report relax(std::span<const std::uint32_t> points, const Relax_options& options = {});

  /// Takes solid cells around a vertex back from it: they get a new vertex in their inside instead, and free
  /// cells fill the gap between them and all others. Bodies cannot be in the way of solid that retreats.
  /// Refused if a cell would be flat or inverted, also one of the gap: the target lies strictly inside of all
  /// facets at the vertex between these cells and others.
  /// \param solid simplices around the vertex, joined through facets at it
  /// \throw Error(usage) for a cell that is no such simplex or named twice, if frozen, and after finish();
  ///        Error(input) for a target that is not finite
  /// Cost: some 20 us.
  Replacement split_vertex(std::uint32_t vertex, std::span<const Cell> solid, const Point<D>& target);

  /// Merges a point of the walls of a gap with one across it, a stitch of a suture: the free cells that
  /// have both vanish, and the others around the point get the other one instead. Where a free cell vanishes
  /// between two solid ones, the facet that they then share is passable: tissue heals. Between two free ones
  /// it is a wall if one was on either side of the cell that vanished. A cut is closed by merging the points
  /// that it made with those that they were taken back from: Cut_report::points. Refused if a cell would be
  /// flat or inverted, if a solid cell has both points or no free one, if the boundary has the point, and if
  /// anything has to lie in the free cells around it, or a face of a body lies near; held_by has all that.
  /// Later new points may get the index of the point; those before keep theirs.
  /// \throw Error(usage) if there is no such point, for a point and itself, for a cell around one that is not
  ///        a simplex, if frozen, for a particle near that is not in its cell, and after finish()
  /// Degenerate cases: as split_edge().
  /// Cost: 3 to 5 us a new cell, whatever the size of the environment.
  Replacement merge_vertices(std::uint32_t point, std::uint32_t onto);

  /// Cuts solid simplices along a blade. Edges that it passes are split near it, and the vertices of the
  /// facets that then lie along it are parted: the cells in front of the blade are taken back, and free ones
  /// fill the gap. At its rim inside solid cells the cut ends at facets, up to a cell before or beyond the
  /// blade, and on the boundary of the environment it stays closed. Membranes of triangles (2D: segments) are
  /// slit as wide as the opening, but where something has to lie beside them. Solid only retreats. All else
  /// is never refused; where something could not be split or parted, the cut is incomplete, and the report
  /// counts the parts.
  /// \throw Error(input) for a blade that is none or lies far off, or an opening that is no positive length;
  ///        Error(usage) if frozen or closed, and for a particle near not in its cell; before any change
  /// Cost: some 40 us a cell that the blade passes, and at the first time 0.5 us a cell of the environment.
  Cut_report cut(const Blade<D>& blade, const Cut_options<D>& options = {});

  /// Makes certificates anew, and lets the bodies listed go on. Nothing can be moved or changed after that.
  /// Cost: about 0.3 us a cell around vertices that moved.
  void finish();

  const Reshape_counts& counts() const;

 private:
  std::unique_ptr<detail::Reshaping_state<D>> state_;
};

extern template class Reshaping<2>;
extern template class Reshaping<3>;

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_RESHAPING_H
