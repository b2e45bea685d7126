// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move among bodies and particles, which stand still meanwhile: an exact answer for each vertex of
// the environment that moves. Theory: docs/moving.md.
#ifndef CELLWALK_RESHAPE_RESHAPING_H
#define CELLWALK_RESHAPE_RESHAPING_H

#include <cellwalk/edge/contact.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/reshape/residents.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cellwalk {

/// What a vertex of the environment does whose walls meet a resident.
enum class At_contact : std::uint8_t {
  stop,  ///< it stops at a verified position, there or just before
  hold,  ///< it stays where it was
  /// What it meets is moved out of its way, by moves that are tested and stopped like any others; then it
  /// tries again, and stops if that did not help.
  push
};

/// How the move of a vertex ended.
enum class Move_end : std::uint8_t {
  reached,  ///< the target
  contact,  ///< a wall would pass through a resident
  /// Walls pass through nothing, but touch a body, so that its vertices, edges and faces would end on
  /// different sides of a wall.
  touch,
  cell,     ///< a cell around the vertex would be flat or inverted
  boundary  ///< the boundary of the environment would run into itself, or into another point
};

/// The first meeting of a moving wall and a resident that it would pass through.
template <int D>
struct Wall_hit {
  /// The share of the move of the vertex that is free; exact, but for faces that another wall touches before.
  Exact_time time;
  Point<D> point{};                         ///< where they meet, rounded
  Vector<D> normal{};                       ///< unit, from the wall to the resident, rounded
  Contact_kind kind = Contact_kind::facet;  ///< what of the wall meets it; `vertex` is the one that moves
  Half_facet facet = Half_facet::none;      ///< the wall, seen from the side of the resident
  /// Weights of the corners of the wall at the point, rounded, of sum 1: first the vertex that moves, then
  /// the others in the order of the loop of the facet.
  std::array<double, static_cast<std::size_t>(D)> weights{};
  std::uint32_t vertex = 0;  ///< of the environment, which moves
  Resident resident;
  /// Weights of the vertices of the resident's feature at the point, rounded, of sum 1, in their order there;
  /// those that it does not have are 0.
  std::array<double, 3> resident_weights{};
};

/// What came of the move of a vertex.
template <int D>
struct Vertex_result {
  std::uint32_t point = 0;
  Point<D> position{};  ///< where the vertex is now
  Move_end end = Move_end::reached;
  std::optional<Wall_hit<D>> hit;  ///< if it ended at a contact
  /// If a cell would be flat: that cell, and the share of the move, rounded, at which it would be.
  Cell cell = Cell::none;
  double share = 1;
};

/// A vertex of the environment and where it is to go.
template <int D>
struct Vertex_move {
  std::uint32_t point;
  Point<D> target;
};

/// What came of the moves of many vertices.
template <int D>
struct Move_report {
  std::vector<Vertex_result<D>> short_of_target;  ///< the last result of each vertex that did not arrive
  std::vector<Wall_hit<D>> hits;                  ///< all, in the order met, those before pushes too
  std::uint32_t rounds = 0;                       ///< in which moves were tried
};

struct Reshape_options {
  At_contact at_contact = At_contact::stop;
  /// Moves of many vertices are tried in so many rounds: a vertex that would make a cell flat goes half of
  /// the way to that, and has its next turn when the others moved.
  int most_rounds = 8;
  /// By At_contact::push, a vertex tries to push what it meets out of its way so many times a move.
  int most_pushes = 16;
  /// What is checked of bodies that are pushed, and what they do at other walls: by default they slide.
  /// Faces are swept as well if the body was last moved so.
  Body_options body{};
};

/// The counts of moves. They are machine-independent.
struct Reshape_counts {
  std::uint64_t moves = 0;  ///< of vertices of the environment tried, those of candidates to stop at included
  std::uint64_t made = 0;
  std::uint64_t cells = 0;       ///< cells around these vertices
  std::uint64_t walls = 0;       ///< walls at those that have residents near
  std::uint64_t opened = 0;      ///< bodies and spans of particles that were near
  std::uint64_t vertices = 0;    ///< of residents in cells around a vertex
  std::uint64_t same_cell = 0;   ///< of these, proved free by their cell
  std::uint64_t edges = 0;       ///< of residents through such cells
  std::uint64_t same_chain = 0;  ///< of these, proved free by their chain
  std::uint64_t faces = 0;       ///< of residents whose box meets that of the moving walls
  std::uint64_t apart = 0;       ///< vertices, edges and faces that no wall touches on its way
  std::uint64_t left = 0;        ///< vertices and edges that walls touch where they start, and leave at once
  std::uint64_t hits = 0;        ///< vertices, edges and faces that a wall would pass through
  std::uint64_t touches = 0;     ///< those that walls only touch, but on sides that do not fit
  std::uint64_t relinked = 0;    ///< edges that got a new chain
  std::uint64_t followed = 0;    ///< vertices and edges that walls touch, followed by definition
  std::uint64_t rested = 0;      ///< faces that walls touch, and may
  std::uint64_t pushes = 0;      ///< residents' features pushed out of the way
  Walk_counts walk;              ///< of all signs

  static constexpr std::array<std::string_view, 18> names{
      "moves", "made",  "cells", "walls", "opened",  "vertices", "same_cell", "edges",  "same_chain",
      "faces", "apart", "left",  "hits",  "touches", "relinked", "followed",  "rested", "pushes"};
};
static_assert(names_all_before<Reshape_counts>(offsetof(Reshape_counts, walk)));

/// An environment that is open for moves of its vertices, with all that lies in it. Vertices move one after
/// the other along straight lines, and the bodies and particles listed stand still meanwhile, or are pushed
/// out of the way before; after each move they are registered as if the environment had always been so.
/// Nothing else reads or changes the environment until close(), and bodies are not moved. A body that is not
/// listed throws Error(usage) at its next use instead of missing a wall; particles that are not listed must
/// be located again.
///
/// A move is made whole or not at all: an exact test of each wall at the vertex against each vertex, edge and
/// face near it. Faces are looked at if the body was last moved with Sweep::faces (3D).
template <int D>
class Reshaping {
 public:
  /// \param environment its certificates near vertices that move are withdrawn until close()
  /// \throw Error(usage) for a body of another environment, or one registered before an edit
  /// Cost: reading the positions of all residents.
  Reshaping(Environment<D>& environment, const Residents<D>& residents, const Reshape_options& options = {});
  /// Closes it.
  ~Reshaping();
  Reshaping(Reshaping&&) noexcept;
  Reshaping& operator=(Reshaping&&) noexcept;

  /// Moves a vertex to a target, or as far as options.at_contact says. What forbids a move is a result, not
  /// an error. An error changes nothing.
  /// \throw Error(usage) if there is no such point, if a cell around it is not a simplex (see
  ///        Build_options::simplicial), for a particle that is not in its cell, and after close();
  ///        Error(input) for a target that is not finite
  /// Degenerate cases: all are decided; where a rim passes a vertex or edge exactly, it may end on either
  /// side, see docs/moving.md, touches. A target equal to the position is reached.
  /// Cost: about 1 us with nothing near, 2 us in 10^6 cells that are not in the cache; some 20 signs more a
  /// wall that is near something; exact numbers for what is touched; on the boundary of the environment up to
  /// a few us more, and some 50 us near other parts of it. The first move in an environment takes 1 us for
  /// each of its points.
  Vertex_result<D> move(std::uint32_t point, const Point<D>& target);

  /// Moves many vertices, in order and backwards in turn, in rounds until all have arrived or none gets on.
  /// Each may appear once.
  /// \throw Error as above; the moves before that are made
  Move_report<D> move(std::span<const Vertex_move<D>> moves);

  /// Says what move() would do by At_contact::hold, and where the vertex would be then; nothing moves. For
  /// solvers that shorten a step to the first contact themselves.
  /// \throw Error as move()
  /// Cost: that of move().
  Vertex_result<D> ask(std::uint32_t point, const Point<D>& target);

  /// Makes certificates anew, and lets the bodies listed go on. Nothing can be moved after that.
  /// Cost: about 0.3 us a cell around vertices that moved.
  void close();

  const Reshape_counts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class Reshaping<2>;
extern template class Reshaping<3>;

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_RESHAPING_H
