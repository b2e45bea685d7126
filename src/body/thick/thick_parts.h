// SPDX-License-Identifier: LGPL-3.0-or-later
// The edges and faces of a body that have a radius, and its vertices without edges. Theory: docs/radius.md.
#ifndef CELLWALK_BODY_THICK_THICK_PARTS_H
#define CELLWALK_BODY_THICK_THICK_PARTS_H

#include <cellwalk/body/step.h>
#include <cellwalk/internal/edge/near_wall_list.h>
#include <cellwalk/kernel/error.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/shape/body_topology.h"

namespace cellwalk::detail {

template <int D>
struct Body_state;

/// The radii of a body, and the walls near what has one.
template <int D>
class Thick_parts {
 public:
  /// A body without a radius.
  Thick_parts() = default;
  /// \param radii none, one for all edges and vertices, or one for each edge
  /// \throw Error(input) for another number of them, and naming one that is not a finite number of at least 0
  Thick_parts(std::span<const double> radii, const Body_topology& topology, std::size_t vertices);

  /// True if nothing has a radius.
  bool are_none() const { return radii_.empty() && of_vertices_ == 0; }
  double radius(std::uint32_t edge) const { return radii_.empty() ? 0 : radii_[edge]; }
  /// Of vertices without edges.
  double radius_of_vertices() const { return of_vertices_; }
  std::span<const double> radii() const { return radii_; }
  double largest() const;

  /// The least of its sides, see Body_topology::sides().
  double radius_of_face(const Body_topology& topology, std::uint32_t face) const;

  /// Whether a vertex can move to a target, with all its edges that have a radius and, for Sweep::faces, its
  /// faces; or alone, if it has no edges.
  /// \pre nothing is stale; where they are, they are at least at that distance from every wall
  bool is_free(const Body_state<D>& body, std::uint32_t vertex, const Point<D>& target, Sweep sweep);
  /// Their first contact; none if the vertex can move.
  std::optional<Contact<D>> first_contact(const Body_state<D>& body, std::uint32_t vertex,
                                          const Point<D>& target, Sweep sweep);
  /// Whether an edge of a vertex, if it has a radius, can do a part of such a move.
  /// \pre as is_free()
  bool is_edge_free(const Body_state<D>& body, std::uint32_t vertex, const Corner& corner,
                    const Point<D>& target, Swept_part part);
  /// The contact of a motion at an edge, or of a vertex without edges, as sweep_thick() finds it.
  /// \param first the first vertex of the edge, or that vertex
  /// \pre the motion starts free, in that cell
  std::optional<Contact<D>> contact(const Body_state<D>& body, Cell start, std::uint32_t first,
                                    const Thick_motion<D>& motion, Swept_part part);
  /// That of the way of a vertex, by the largest radius at it.
  std::optional<Contact<D>> contact_on_way(const Body_state<D>& body, std::uint32_t vertex,
                                           const Point<D>& target);
  /// True if some edge or, for Sweep::faces, face of a vertex has no radius, or the vertex has neither.
  bool has_thin(const Body_topology& topology, std::uint32_t vertex, Sweep sweep) const;
  /// Moves without a test make lists of walls void: of an edge and the faces at it, of a vertex without
  /// edges, or of all faces.
  void forget(const Body_topology& topology, std::uint32_t edge);
  void forget_vertex(const Body_topology& topology, std::uint32_t vertex) {
    if (of_vertices_ > 0 && topology.corners_of(vertex).empty())
      groups_[group_of_[vertex]].near_walls.forget();
  }
  void forget_faces();

 private:
  double radius_at(const Body_topology& topology, std::uint32_t vertex) const;
  /// Vertices joined by edges with a radius, the edges and faces whose first vertex is one of them, and the
  /// walls near all that.
  struct Group {
    std::vector<std::uint32_t> corners;
    double radius = 0;  ///< the largest
    Near_wall_list<D> near_walls;
  };
  static constexpr std::uint32_t no_group = 0xffffffff;

  void form_groups(const Body_topology& topology, std::size_t vertices);
  void join_neighbours(const Body_topology& topology, std::uint32_t first);
  void add_to_group(std::uint32_t first, std::span<const std::uint32_t> corners, double r);
  bool are_free(const Body_state<D>& body, std::uint32_t vertex, std::uint32_t group,
                std::span<const Thick_motion<D>> motions, Swept_part part);

  std::vector<double> radii_;  ///< of edges; empty if all are 0
  double of_vertices_ = 0;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_;  ///< of vertices; no_group if it has nothing with a radius
};

extern template class Thick_parts<2>;
extern template class Thick_parts<3>;

/// Tests that each edge and vertex with a radius, and each face if faces are swept, is at least at that
/// distance from every wall: invariant I4.
/// \throw Error(code) naming the first that is not, and its distance
template <int D>
void check_distances(const Body_state<D>& body, const Thick_parts<D>& thick, Error_code code);

/// The same for faces.
void check_face_distances(const Body_state<3>& body, const Thick_parts<3>& thick, Error_code code);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_THICK_THICK_PARTS_H
