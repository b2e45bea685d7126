// SPDX-License-Identifier: LGPL-3.0-or-later
// A step of a body: its options and its results. Paper: section III. Theory: docs/bodies.md.
#ifndef CELLWALK_BODY_STEP_H
#define CELLWALK_BODY_STEP_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/sweep.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cellwalk {

/// The parts of a body that walls block in the move of a vertex. Bit i of a set is for its i-th neighbour,
/// see Body::neighbours().
template <int D>
struct Rejected_move {
  std::uint32_t vertex = 0;
  bool is_vertex_blocked = false;  ///< a wall is in the way of the vertex: then nothing else is looked at
  std::uint64_t edges = 0;         ///< where it would be, a wall is in the way of these edges
  /// Of these while they sweep their triangles; none for Sweep::three_segments.
  std::uint64_t swept_edges = 0;
  /// That wall, if the vertex stays: where it is in the way of the vertex, or of the first of the edges where
  /// the vertex would be. Then time and point are along the edge, from that vertex on. The time is exact
  /// where a closed wall is touched, else that of a walk, see Contact.
  std::optional<Contact<D>> contact;
  bool stays() const { return is_vertex_blocked || edges != 0; }
};

/// A vertex meets a wall on its own path, or by one of its edges or faces. The rule of a step defines where
/// edges are tested, and how the vertex reacts.
enum class Step_rule {
  /// Edges and faces are tested while they sweep, by Sweep_options::sweep. The vertex stops at a verified
  /// position just before the contact; its remaining motion is projected on the wall and tried again.
  slide,
  /// Edges and faces are tested as above. The vertex stays where it was.
  reject,
  /// The rule of the paper, and of traces: edges are tested at the target of the vertex, which stays where it
  /// was. Unless Sweep::three_segments is chosen, edges that meet a wall on their way are reported, too, but
  /// do not hold the vertex back; faces are left alone. With Touch::stop any closed wall is in the way that
  /// meets the closed way of the vertex, or an edge at its end, or a closed triangle. This includes walls
  /// that are touched at the start: a vertex or an edge at a wall stays. Vertices have at most 64 edges.
  reject_at_target
};

struct Body_options {
  Sweep_options sweep;
  /// Keep a region that is free of walls, in which nothing needs a test. All is decided as without it, sides
  /// of walls included; only, a vertex that comes to lie on a border between cells may be registered in
  /// another one of those that are linked there, and a contact may name its wall from another one. Times,
  /// places and normals are the same, to the bit.
  bool clearance = true;
  Step_rule rule = Step_rule::slide;
  /// By Step_rule::reject_at_target, report the blocked parts instead of contacts. This costs less, since the
  /// contact of an edge on its way is not located. Without effect by other rules.
  bool reports_blocked = false;
  /// A vertex that slides goes on along walls until it met this many in a step. Values below 1 count as 1: it
  /// stops at the first.
  int most_contacts = 4;
};

/// The contacts of a step, or the parts that were blocked.
template <int D>
struct Step_report {
  /// In the order met. By Step_rule::reject_at_target the first of each vertex that stays, as
  /// Sweep::three_segments finds it, or the first touch if there is none.
  std::vector<Contact<D>> contacts;
  /// If Body_options::reports_blocked, vertex by vertex: a vertex without an entry moved and met nothing.
  std::vector<Rejected_move<D>> blocked;

  void clear() {
    contacts.clear();
    blocked.clear();
  }
};

/// Counts of the moves of bodies. All of them are machine-independent.
struct Body_counts {
  std::uint64_t moves = 0;         ///< moves of vertices requested
  std::uint64_t in_region = 0;     ///< made without a test, with all their edges in a region free of walls
  std::uint64_t regions = 0;       ///< such regions found
  std::uint64_t no_region = 0;     ///< searches that found none
  std::uint64_t region_cells = 0;  ///< cells, or clusters of cells, looked at by these searches
  std::uint64_t region_walls = 0;  ///< walls met by searches among clusters
  std::uint64_t catch_ups = 0;     ///< vertices registered anew after moves in a region
  std::uint64_t contacts = 0;
  std::uint64_t stop_tries = 0;  ///< moves tried to find a position to stop at
  std::uint64_t held = 0;        ///< contacts after which the vertex stayed where it was
  Edge_counts edges;
  Face_counts faces;

  static constexpr std::array<std::string_view, 10> names{
      "moves",        "in_region", "regions",  "no_region",  "region_cells",
      "region_walls", "catch_ups", "contacts", "stop_tries", "held"};
};
static_assert(names_all_before<Body_counts>(offsetof(Body_counts, edges)));

}  // namespace cellwalk

#endif  // CELLWALK_BODY_STEP_H
