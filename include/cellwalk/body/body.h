// SPDX-License-Identifier: LGPL-3.0-or-later
// A body among walls: its vertices are particles, its edges carry chains of cells. Paper: section III. Theory: docs/sweep.md.
#ifndef CELLWALK_BODY_BODY_H
#define CELLWALK_BODY_BODY_H

#include <cellwalk/body/clearance.h>
#include <cellwalk/edge/face.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/walk/locate.h>

#include <array>
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

struct Body_options {
  Sweep_options sweep;
  bool clearance = true;  ///< keep a region that is free of walls, in which nothing needs a test
  /// A vertex that meets a wall goes on along it, at most so often in a step.
  int most_contacts = 4;
  /// A vertex that meets a wall stays where it is, and does not go on: the rule of traces.
  bool hold = false;
};

/// What the moves of bodies did. All counts are machine-independent.
struct Body_counts {
  std::uint64_t moves = 0;      ///< moves of vertices asked for
  std::uint64_t in_region = 0;  ///< made without a test, all positions being in a region free of walls
  std::uint64_t regions = 0;    ///< such regions found
  std::uint64_t no_region = 0;  ///< searches that found none
  std::uint64_t catch_ups = 0;  ///< vertices located anew when a body left its region
  std::uint64_t contacts = 0;
  std::uint64_t stop_tries = 0;  ///< moves tried to find a position to stop at
  std::uint64_t held = 0;        ///< contacts after which the vertex stayed where it was
  Edge_counts edges;
  Face_counts faces;

  Body_counts& operator+=(const Body_counts& other);
};

/// A registered body: every vertex in free space (I1), every edge with a chain (I2), always. As long as it is moved with
/// Sweep::faces, no wall pierces a face either (I3, 3D); other sweeps leave its faces alone.
/// Refers to the snapshot, which must outlive it. Copies are bodies of their own.
template <int D>
class Body {
 public:
  /// Registers a body where it stands. A vertex on a wall with free space on several sides gets one from which all its
  /// edges can be passed; which one, where several will do, is arbitrary but fixed.
  /// \throw Error(outside) naming the vertex that is not in free space, the edge that crosses a wall, or the face that a wall
  ///        pierces, and where
  /// Cost: a location a vertex, a walk an edge, some us a face near walls.
  Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup);

  std::size_t vertex_count() const { return positions_.size(); }
  std::span<const Point<D>> positions() const { return positions_; }
  std::span<const std::array<std::uint32_t, 2>> edges() const { return edges_; }
  std::span<const std::array<std::uint32_t, 3>> faces() const { return faces_; }

  /// Moves the vertices one after the other to their targets, as far as walls allow: a vertex that meets one, or has an edge
  /// that does, stops at a verified position just before, and its remaining motion is projected on the wall and tried again.
  /// Contacts are appended in the order met. \pre one finite target a vertex
  /// Cost: reading the coordinates while the body is in a region free of walls; else a walk a vertex and a sweep an edge.
  void step(std::span<const Point<D>> targets, const Body_options& options,
            std::vector<Body_contact<D>>& contacts, Body_counts& counts);

  /// Moves one vertex to a target, or leaves everything as it is and returns the first contact. Gives a region free of walls up.
  /// \pre the target is finite
  /// \throw Error(usage) for Sweep::faces after moves with another sweep that let a wall pierce a face
  std::optional<Body_contact<D>> move_vertex(std::uint32_t vertex, const Point<D>& target,
                                             const Body_options& options, Body_counts& counts);

  /// Registers what was moved without tests in a region free of walls.
  void catch_up(Body_counts& counts);
  /// Catches up and gives the region up. To be called before the environment is edited.
  void leave_region(Body_counts& counts) {
    catch_up(counts);
    region_.reset();
  }
  /// The particles and chains. \pre caught up
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
  struct Face_corner {  ///< a face as seen from one of its corners, the one at this place
    std::uint32_t face, place;
  };

  void link_edges();
  void link_faces();
  void register_faces(Error_code code, Face_counts& counts);
  Face_registration register_face_here(std::uint32_t face, Face_counts& counts) const;
  void sweep_faces(std::uint32_t vertex, const Way<D>& way, std::optional<Body_contact<D>>& first,
                   Body_counts& counts);
  /// As move_vertex, where there is no region. If `any` is set, any contact will do.
  std::optional<Body_contact<D>> try_move(std::uint32_t vertex, const Point<D>& target,
                                          const Body_options& options, Body_counts& counts, bool any = false);
  const Chain* moved_chain(std::uint32_t vertex, std::uint32_t edge) const;
  bool stays_in_region(std::span<const Point<D>> targets, const Body_options& options, Body_counts& counts);
  bool stop(std::uint32_t vertex, const Point<D>& target, const Body_contact<D>& met,
            const Body_options& options, Body_counts& counts);
  Chain seen_from(const Corner& corner) const;

  const Snapshot<D>* snapshot_;
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
  std::optional<Clear_region<D>> region_;
  bool is_behind_ = false;      ///< particles and chains have not been caught up
  std::uint32_t patience_ = 0;  ///< steps until a region is looked for again

  // Scratch space of move_vertex.
  std::vector<Cell> visited_;
  std::vector<Half_facet> crossed_;
  struct Moved_chain {
    Chain chain;
    bool is_free = false;
  };
  std::vector<Moved_chain> moved_chains_;  ///< of the edges of the vertex
  std::vector<std::pair<std::uint32_t, Face_rests>> moved_rests_;
};

extern template class Body<2>;
extern template class Body<3>;

}  // namespace cellwalk

#endif  // CELLWALK_BODY_BODY_H
