// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies and particles among walls that move, and the outcomes of moves.
#ifndef CELLWALK_RESHAPE_MOVE_H
#define CELLWALK_RESHAPE_MOVE_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/kernel/counts.h>
#include <cellwalk/walk/contact.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk {

/// The bodies and particles in an environment. They must outlive the object that they are given to, and stay
/// where they are in memory.
template <int D>
struct Residents {
  std::vector<Body<D>*> bodies;
  std::vector<std::span<Particle<D>>> particles;
};

/// A vertex, edge or face of a body, or a particle.
struct Resident {
  bool is_particle = false;
  std::uint32_t owner = 0;  ///< position of the body in Residents::bodies, or of the span in its particles
  Body_feature feature = Body_feature::vertex;  ///< the kind of part; a particle is a vertex
  std::uint32_t number = 0;                     ///< of the vertex, edge, face or particle

  auto operator<=>(const Resident&) const = default;
};

/// The outcome of a change of an environment among them.
struct Outcome {
  bool is_made = false;           ///< also if nothing had to be changed
  std::string reason;             ///< why not, empty if made: one sentence without a full stop
  std::vector<Resident> held_by;  ///< every vertex, edge and face that forbids it, sorted
  /// If they forbid it only by their radii: the least distance between one of them and a new wall, rounded
  /// down; 0 inside of a cell that would be filled.
  double distance = 0;
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

/// The first contact of a moving wall with a resident through which it would pass. `time` is the free share
/// of the move of the wall's vertex; it is exact, except for faces that another wall touches before.
/// `vertex` is that vertex of the environment; if `kind` is a vertex, it is this one. `normal` leads from the
/// wall to the resident, and `facet` is the wall seen from that side. `cell` and `corner` are not set. Of a
/// resident with a radius it is where the wall is at that distance and would come nearer; `point` is on the
/// wall.
template <int D>
struct Wall_hit : Contact<D> {
  /// Weights of the corners of the wall at the point, rounded, of sum 1: first the vertex that moves, then
  /// the others in the order of the loop of the facet.
  std::array<double, static_cast<std::size_t>(D)> weights{};
  Resident resident;
  /// Weights of the vertices of the resident's feature at the point, rounded, of sum 1, in their order there;
  /// those that it does not have are 0.
  std::array<double, 3> resident_weights{};
};

/// The outcome of the move of a vertex.
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

/// The outcome of the moves of many vertices.
template <int D>
struct Move_report {
  std::vector<Vertex_result<D>> short_of_target;  ///< the last result of each vertex that did not arrive
  std::vector<Wall_hit<D>> hits;                  ///< all, in the order met, those before pushes too
  std::uint32_t rounds = 0;                       ///< in which moves were tried
};

/// The counts of moves. They are machine-independent. Each attempt counts all it looks at anew: at candidates
/// to stop at, after pushes, in each round, and for each choice of sides. Only `near` and `certified` are
/// those of first attempts: each pair of a vertex moved or tested and a feature of a resident near it counts
/// once.
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
  /// Vertices, edges and faces looked at when a vertex was tried for the first time by a call of move() or
  /// test_move(), before anything was pushed.
  std::uint64_t near = 0;
  std::uint64_t certified = 0;  ///< of these, decided by their cell, their chain, or as apart from all walls
  Walk_counts walk;             ///< of all signs

  static constexpr std::array<std::string_view, 20> names{
      "moves",    "made",       "cells",  "walls",  "opened", "vertices", "same_cell",
      "edges",    "same_chain", "faces",  "apart",  "left",   "hits",     "touches",
      "relinked", "followed",   "rested", "pushes", "near",   "certified"};
};
static_assert(names_all_before<Reshape_counts>(offsetof(Reshape_counts, walk)));

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_MOVE_H
