// SPDX-License-Identifier: LGPL-3.0-or-later
// A body among walls: its vertices are particles, its edges carry chains of cells. Paper: section III. Theory: docs/sweep.md.
#ifndef CELLWALK_BODY_BODY_H
#define CELLWALK_BODY_BODY_H

#include <cellwalk/body/clear_region.h>
#include <cellwalk/edge/face.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/walk/locate.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {

/// A contact of a body: which vertex was moving, and the number of the vertex, edge or face that met the wall.
template <int D>
struct Body_contact {
  Contact<D> contact;
  std::uint32_t vertex = 0;
  std::uint32_t feature = 0;
};

/// What blocks the move of a vertex. Bit i of a set is for its i-th neighbour, see Body::neighbours().
template <int D>
struct Blocked_move {
  std::uint32_t vertex = 0;
  bool is_vertex_blocked = false;  ///< a wall is in the way of the vertex: then nothing else is looked at
  std::uint64_t edges = 0;         ///< where it would be, a wall is in the way of these edges
  std::uint64_t swept_edges =
      0;  ///< of these while they sweep their triangles; unless Sweep::three_segments is asked for
  /// That wall, if the vertex stays: where it is in the way of the vertex, or of the first of the edges where the vertex would be
  /// (time and point are along the edge then).
  std::optional<Wall_contact<D>> contact;
  bool stays() const { return is_vertex_blocked || edges != 0; }
};

struct Body_options {
  Sweep_options sweep;
  /// Keep a region that is free of walls, in which nothing needs a test. All is decided as without it; only, a vertex that comes to
  /// lie on a border between cells may be registered in another of them, and where walls leave a choice, of the side on which a
  /// motion in their plane goes on or of the one to report, that may be taken otherwise.
  bool clearance = true;
  /// A vertex that meets a wall goes on along it, until it met so many in a step. Less than 1 is 1: it stays at the first.
  int most_contacts = 4;
  /// A vertex that meets a wall stays where it is, and does not go on: the rule of traces.
  bool hold = false;
};

/// What the moves of bodies did. All counts are machine-independent.
struct Body_counts {
  std::uint64_t moves = 0;         ///< moves of vertices asked for
  std::uint64_t in_region = 0;     ///< made without a test, with all their edges in a region free of walls
  std::uint64_t regions = 0;       ///< such regions found
  std::uint64_t no_region = 0;     ///< searches that found none
  std::uint64_t region_cells = 0;  ///< cells looked at by these searches
  std::uint64_t catch_ups = 0;     ///< vertices registered anew after moves in a region
  std::uint64_t contacts = 0;
  std::uint64_t stop_tries = 0;  ///< moves tried to find a position to stop at
  std::uint64_t held = 0;        ///< contacts after which the vertex stayed where it was
  Edge_counts edges;
  Face_counts faces;

  static constexpr std::array<std::string_view, 9> names{"moves",     "in_region",    "regions",
                                                         "no_region", "region_cells", "catch_ups",
                                                         "contacts",  "stop_tries",   "held"};
};
static_assert(names_all_before<Body_counts>(offsetof(Body_counts, edges)));

/// A registered body: every vertex in free space (I1), every edge with a chain (I2), always. As long as it is moved with
/// Sweep::faces, no wall pierces a face either (I3, 3D); other sweeps leave its faces alone.
/// Refers to the snapshot, which must outlive it. Copies are bodies of their own.
///
/// A body is registered in the environment as it is then. After an edit (Snapshot::epoch()) all that moves, registers or checks it
/// throws Error(usage), until register_again(); what it is made of and where it stands can be asked still.
template <int D>
class Body {
 public:
  /// Registers a body where it stands. A vertex on a wall with free space on several sides gets one from which all its
  /// edges can be passed; which one, where several will do, is arbitrary but fixed. Faces in the plane are not looked at.
  /// \throw Error(outside) naming the vertex that is not in free space, the edge that crosses a wall, or the face that a wall
  ///        pierces, and where
  /// Cost: a location a vertex, a walk an edge, some us a face near walls.
  Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup);

  /// Registers the body anew where it stands, after edits: vertices, chains, rests of faces. A vertex in a wall keeps the side
  /// on which it was, if the cell that it was registered in is there still and holds it, and all its edges can be passed from there; else
  /// any side will do, as in the constructor. Faces in the plane of a wall take their sides anew. Gives a region free of walls up.
  /// \throw Error(outside) as the constructor, where a wall came to lie in the way: then the body is as it was, and may
  /// be tried again after another edit. Error(usage) for a locator made before points were moved or cells replaced
  /// Cost: that of the constructor.
  void register_again(const Locator<D>& locator);

  std::size_t vertex_count() const { return positions_.size(); }
  std::span<const Point<D>> positions() const { return positions_; }
  std::span<const std::array<std::uint32_t, 2>> edges() const { return edges_; }
  std::span<const std::array<std::uint32_t, 3>> faces() const { return faces_; }
  /// The other ends of the edges of a vertex, ascending.
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const;

  /// Moves the vertices one after the other to their targets, as far as walls allow: a vertex that meets one, or has an edge
  /// that does, stops at a verified position just before, and its remaining motion is projected on the wall and tried again.
  /// Contacts are appended in the order met. \pre one finite target a vertex
  /// \throw Error(usage) for Sweep::faces after moves with another sweep that let a wall pierce a face
  /// Cost: reading the coordinates while the body is in a region free of walls; else a walk a vertex and a sweep an edge. The first
  /// time faces are swept after moves that left them alone, all are registered.
  void step(std::span<const Point<D>> targets, const Body_options& options,
            std::vector<Body_contact<D>>& contacts, Body_counts& counts);

  /// Moves the vertices one after the other, by the rule of the paper: a vertex that meets a wall, or would have an edge that does
  /// where it goes, stays where it is. Whatever the sweep, only the way of the vertex and the edges at its end decide; the
  /// swept triangles are looked at if options.sweep.sweep is not three_segments, and reported. No contact is located. With Touch::pass
  /// touching is free. With Touch::stop whatever closed wall the closed way, an edge at its end or a closed triangle meets is in the
  /// way, where the vertex or the edge starts too: one that is at a wall stays. Appends what blocks, vertex by vertex; a vertex
  /// without an entry moved, and nothing was met.
  /// \pre one finite target a vertex; no vertex has more than 64 edges
  /// Cost: that of step(), less that of locating contacts; with Touch::stop rational arithmetic for walls near a move that planes
  /// alone do not prove free, and once for those near a body that was moved otherwise.
  void step_or_stay(std::span<const Point<D>> targets, const Body_options& options,
                    std::vector<Blocked_move<D>>& blocked, Body_counts& counts);

  /// Moves one vertex to a target, or leaves everything as it is and returns the first contact. Gives a region free of walls up.
  /// \pre the target is finite
  /// \throw Error(usage) for Sweep::faces after moves with another sweep that let a wall pierce a face
  std::optional<Body_contact<D>> move_vertex(std::uint32_t vertex, const Point<D>& target,
                                             const Body_options& options, Body_counts& counts);

  /// Registers what was moved without tests in a region free of walls.
  void catch_up(Body_counts& counts);
  /// Catches up and gives the region up.
  void leave_region(Body_counts& counts);
  /// The particles and chains. \pre caught up, and no edit since
  std::span<const Particle<D>> particles() const { return particles_; }
  const Chain& chain(std::size_t edge) const { return chains_[edge]; }

  /// Checks I1, I2 and, if faces are swept, I3 by exact predicates: each vertex lies in its cell, each edge has a valid chain
  /// from cell to cell, no wall pierces a face.
  /// \pre caught up \throw Error(other) naming the first vertex, edge or face that violates them
  void validate() const;

 private:
  struct Corner {  ///< an edge as seen from one of its ends
    std::uint32_t edge, other;
    bool is_reversed;
  };
  struct Moved_chain {
    Chain chain;
    bool is_free = false;
    bool is_behind = false;  ///< it is not known, but there is one
  };
  struct Face_corner {  ///< a face as seen from one of its corners, the one at this place
    std::uint32_t face, place;
  };

  Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
       std::span<const Particle<D>> before);
  /// \throw Error(usage) if the environment was edited since the body was registered
  void check_epoch() const {
    snapshot_->check_epoch(epoch_, "this body was registered: call Body::register_again(), or make it anew");
  }
  void link_edges();
  void link_faces();
  void register_faces(Error_code code, Face_counts& counts);
  void take_up_faces(Body_counts& counts);
  Face_registration register_face_here(std::uint32_t face, Face_counts& counts) const;
  void sweep_faces(std::uint32_t vertex, const Way<D>& way, std::optional<Body_contact<D>>& first,
                   Body_counts& counts);
  /// As move_vertex, where there is no region. If `any` is set, any contact will do.
  std::optional<Body_contact<D>> try_move(std::uint32_t vertex, const Point<D>& target,
                                          const Body_options& options, Body_counts& counts, bool any = false);
  bool moves_plainly(std::uint32_t vertex, const Point<D>& target, const Sweep_options& options,
                     Body_counts& counts);
  bool is_free_at_end(const Particle<D>& p, const Particle<D>& q, const Sweep_options& options,
                      Edge_counts& counts) const;
  bool keeps_chain(const Particle<D>& from, const Particle<D>& to, const Corner& corner,
                   const Sweep_options& options, Edge_counts& counts);
  void move_each_or_stay(std::span<const Point<D>> targets, const Body_options& options,
                         std::vector<Blocked_move<D>>& blocked, Body_counts& counts);
  Blocked_move<D> move_or_stay(std::uint32_t vertex, const Point<D>& target, const Body_options& options,
                               Body_counts& counts);
  bool meets_at_end(const Way<D>& way, std::uint32_t corner_number, const Sweep_options& options,
                    Blocked_move<D>& answer, Body_counts& counts);
  bool sweep_meets_at_end(const Way<D>& way, std::uint32_t corner_number, const Sweep_options& options,
                          Moved_chain& moved, Blocked_move<D>& answer, Body_counts& counts);
  void note_apart(const Body_options& options, Body_counts& counts);
  bool touches_wall(Body_counts& counts);
  bool is_plainly_free(const Particle<D>& from, const Particle<D>& to, const Particle<D>& q,
                       const Sweep_options& options, Edge_counts& counts) const;
  void commit(std::uint32_t vertex, const Particle<D>& particle);
  const Chain* moved_chain(std::uint32_t vertex, std::uint32_t edge) const;
  bool moves_at_once(std::span<const Point<D>> targets, const Body_options& options, Body_counts& counts);
  void take_all(std::span<const Point<D>> targets, Body_counts& counts);
  bool moves_in_new_region(std::span<const Point<D>> targets, const Body_options& options,
                           Body_counts& counts);
  bool moves_in_region(std::uint32_t vertex, const Point<D>& target, Body_counts& counts);
  bool renew_region(std::span<const Point<D>> targets, Body_counts& counts);
  void note_all_behind();
  void catch_up_vertex(std::uint32_t vertex, Body_counts& counts);
  void catch_up_edge(std::uint32_t edge, Body_counts& counts);
  void place(std::uint32_t vertex, const Point<D>& position);
  void set_outside(std::uint32_t vertex, bool is_outside);
  bool stop(std::uint32_t vertex, const Point<D>& target, const Body_contact<D>& met,
            const Body_options& options, Body_counts& counts);
  Chain seen_from(const Corner& corner) const;

  const Snapshot<D>* snapshot_;
  std::uint64_t epoch_;  ///< of the snapshot, when the body was registered
  std::vector<Point<D>> positions_;
  std::vector<Particle<D>> particles_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<Chain> chains_;                ///< from edges_[e][0] to edges_[e][1]
  std::vector<Corner> corners_;              ///< of vertex after vertex
  std::vector<std::uint32_t> corner_begin_;  ///< corners of vertex v: [corner_begin_[v], corner_begin_[v+1])
  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<std::array<std::uint32_t, 3>> sides_;  ///< of each face: the edges from each corner to the next
  std::vector<Face_rests> rests_;                    ///< of each face
  std::vector<Face_corner> face_corners_;            ///< of vertex after vertex
  std::vector<std::uint32_t> face_corner_begin_;
  bool are_faces_swept_ = true;
  bool is_apart_ = false;  ///< it is known that no vertex and no edge touches a wall

  // A region free of walls, and what was moved in it without registering it.
  std::optional<Clear_region<D>> region_;
  std::uint32_t outside_ = 0;                ///< vertices not in it
  std::vector<char> is_outside_;             ///< of each vertex
  std::vector<std::uint32_t> outside_near_;  ///< of each vertex: how many of its neighbours are
  bool are_all_behind_ = false;              ///< all vertices
  std::vector<char> vertex_behind_;          ///< its particle is where it was; it is in the region
  std::vector<char> edge_behind_;            ///< its chain is not known, nor is it where an end is behind
  std::uint32_t patience_ = 0;               ///< steps until a region is looked for that holds all positions
  std::uint32_t target_patience_ = 0;        ///< the same for targets, while all positions are held
  std::uint32_t next_patience_ = 4;          ///< if that finds none
  double steps_ahead_ = Region_request<D>{}.steps_ahead;  ///< that the next one is asked to hold
  std::uint32_t anchor_vertex_ = 0;                       ///< about which it is looked for

  // Scratch space of move_vertex.
  std::vector<Cell> visited_;
  std::vector<Half_facet> crossed_;
  std::vector<Moved_chain> moved_chains_;  ///< of the edges of the vertex
  std::vector<std::pair<std::uint32_t, Face_rests>> moved_rests_;
};

extern template class Body<2>;
extern template class Body<3>;

}  // namespace cellwalk

#endif  // CELLWALK_BODY_BODY_H
