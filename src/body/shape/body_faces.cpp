// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweeps of the faces at a vertex: those with a volume, flat ones, and the wedges between them.
#include "body_faces.h"

#include <cellwalk/internal/edge/closing_face.h>
#include <cellwalk/internal/edge/flat_faces.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/edge/wedge.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/sides_taken.h>

#include <boost/container/small_vector.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace cellwalk::detail {
namespace {

/// The place of an edge among those of a vertex.
std::size_t place_of(std::span<const Corner> edges, std::uint32_t edge) {
  return static_cast<std::size_t>(std::ranges::lower_bound(edges, edge, {}, &Corner::edge) - edges.begin());
}

/// The chain of an edge of the vertex after its move, from the vertex; null if the edge is blocked.
const Chain* moved_chain(const Body_state<3>& body, const Move_scratch<3>& scratch, std::uint32_t vertex,
                         std::uint32_t edge) {
  const Moved_chain<3>& moved = scratch.chains[place_of(body.topology.corners_of(vertex), edge)];
  return moved.is_free ? &moved.chain : nullptr;
}

/// Where the faces at an edge lie that moves in a plane.
struct Wedge {
  bool is_above = false, is_below = false;
};

/// The walls that come between faces that share an edge of a vertex. The edge may pass a wall in the plane of
/// its motion on either side, but if there are faces on both sides of the plane, one of them passes it on the
/// other one.
void sweep_wedges(const Body_state<3>& body, std::uint32_t vertex, const Vertex_path<3>& path,
                  std::optional<Contact<3>>& first, Face_counts& counts) {
  const auto edges = body.topology.corners_of(vertex);
  boost::container::small_vector<Wedge, 16> wedges(edges.size());
  const auto note = [&](std::uint32_t edge, int side) {
    Wedge& wedge = wedges[place_of(edges, edge)];
    wedge.is_above |= side > 0;
    wedge.is_below |= side < 0;
  };
  for (const auto& [f, k] : body.topology.face_corners_of(vertex)) {
    const auto& corners = body.topology.faces()[f];
    const auto& sides = body.topology.sides(f);
    const int side =
        Exact::orientation(counts.walk.predicates, path.from.position, path.to.position,
                           body.positions[corners[(k + 1) % 3]], body.positions[corners[(k + 2) % 3]]);
    note(sides[k], side);
    note(sides[(k + 2) % 3], -side);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!wedges[i].is_above || !wedges[i].is_below) continue;
    auto contact = wall_in_wedge(*body.snapshot, path, body.positions[edges[i].other], counts);
    if (!contact) continue;
    contact->vertex = vertex;
    contact->feature = edges[i].edge;
    if (!first || is_before(*contact, *first)) first = *contact;
  }
}

/// The edges and faces that a vertex takes along.
struct Star_of_vertex {
  std::vector<Edge_at_vertex> edges;
  std::vector<Face_at_vertex> faces;
  std::vector<std::uint32_t> names;  ///< the numbers of the faces
};

Star_of_vertex star_of(const Body_state<3>& body, const Move_scratch<3>& scratch, std::uint32_t vertex) {
  const auto corners = body.topology.corners_of(vertex);
  Star_of_vertex star;
  for (std::size_t i = 0; i < corners.size(); ++i)
    star.edges.push_back(
        {body.particles[corners[i].other], body.seen_from(corners[i]), &scratch.chains[i].chain});
  for (const auto& [f, k] : body.topology.face_corners_of(vertex)) {
    const auto& sides = body.topology.sides(f);
    const std::uint32_t q = body.topology.faces()[f][(k + 1) % 3], r = body.topology.faces()[f][(k + 2) % 3];
    star.faces.push_back({place_of(corners, sides[k]),
                          place_of(corners, sides[(k + 2) % 3]),
                          {&body.chains[sides[(k + 1) % 3]], q > r},
                          &body.supporting_walls[f]});
    star.names.push_back(f);
  }
  return star;
}

/// The walls that come between parts of the body that have the vertex alone in common.
void sweep_parts(const Body_state<3>& body, const Move_scratch<3>& scratch, std::uint32_t vertex,
                 const Vertex_path<3>& path, std::optional<Contact<3>>& first, Face_counts& counts) {
  if (body.topology.is_joined_at(vertex)) return;
  const Star_of_vertex star = star_of(body, scratch, vertex);
  auto contact = wall_between_parts(*body.snapshot, path, star.edges, star.faces, counts);
  if (!contact) return;
  contact->vertex = vertex;
  contact->feature = vertex;
  if (!first || is_before(*contact, *first)) first = *contact;
}

/// The supporting walls of faces that moved in their planes, as agreed with all that is joined to them; or a
/// contact, if they cannot agree.
/// \pre all else is free
void settle_flat_faces(const Body_state<3>& body, Move_scratch<3>& scratch, std::uint32_t vertex,
                       const Vertex_path<3>& path, std::optional<Contact<3>>& first, Face_counts& counts) {
  const Star_of_vertex star = star_of(body, scratch, vertex);
  const Flat_faces found = find_flat_faces(*body.snapshot, path, star.edges, star.faces,
                                           body.topology.is_joined_at(vertex), counts);
  if (found.contact) {
    first = found.contact;
    first->vertex = vertex;
    first->body = Body_feature::face;
    first->feature = star.names[found.face];
    return;
  }
  for (const auto& [number, supporting_walls] : found.supporting_walls) {
    const auto face = star.names[number];
    std::erase_if(scratch.supporting_walls, [&](const auto& entry) { return entry.first == face; });
    if (!supporting_walls.empty() || !body.supporting_walls[face].empty())
      scratch.supporting_walls.emplace_back(face, supporting_walls);
  }
}

}  // namespace

Face_registration registered_face(const Body_state<3>& body, std::uint32_t face, Face_counts& counts) {
  const auto [u, v, w] = body.topology.faces()[face];
  const auto side = [&](std::size_t k, std::uint32_t from, std::uint32_t to) {
    return Side_chain{&body.chains[body.topology.sides(face)[k]], from > to};
  };
  const auto& particles = body.particles;
  return register_face(*body.snapshot, particles[u], particles[v], particles[w],
                       {side(0, u, v), side(1, v, w), side(2, w, u)}, counts, body.supporting_walls[face]);
}

std::vector<Pierced_face> register_faces(Body_state<3>& body, Face_counts& counts) {
  std::vector<Pierced_face> pierced;
  for (std::uint32_t f = 0; f < body.supporting_walls.size(); ++f) {
    const Face_registration found = registered_face(body, f, counts);
    body.supporting_walls[f] = found.supporting_walls;
    body.may_have_supporting_walls |= !found.supporting_walls.empty();
    if (found.piercing != Half_facet::none) pierced.push_back({f, found.piercing});
  }
  if (pierced.empty()) body.are_faces_swept = true;
  return pierced;
}

bool is_pierced_on_all_sides(const Body_state<3>& body, const Pierced_face& pierced) {
  const auto [u, v, w] = body.topology.faces()[pierced.face];
  const auto& x = body.positions;
  Walk_counts uncounted;
  return place_of_face(*body.snapshot, pierced.wall, {x[u], x[v], x[w]}, uncounted) == Face_at_facet::pierced;
}

void refuse_pierced(const Body_state<3>& body, const Pierced_face& pierced, Error_code code,
                    bool has_search_ended) {
  const auto& [u, v, w] = body.topology.faces()[pierced.face];
  const auto place = [&](std::uint32_t x) { return fmt::format("({})", fmt::join(body.positions[x], ", ")); };
  const Snapshot<3>& snapshot = *body.snapshot;
  throw Error(
      code,
      fmt::format(
          "face {} of the body, with vertices {} at {}, {} at {} and {} at {}, is pierced by "
          "a wall of cell {}{}: move the body into free space",
          pierced.face, u, place(u), v, place(v), w, place(w), snapshot.index(snapshot.cell_of(pierced.wall)),
          has_search_ended ? ", and the search for other sides of walls ended without a result" : ""));
}

void take_up_faces(Body_state<3>& body, Body_counts& counts) {
  if (body.are_faces_swept || body.supporting_walls.empty()) return;
  body.check_epoch();
  body.refresh_all(counts);
  body.thick.forget_faces();
  if (!body.thick.are_none()) check_face_distances(body, body.thick, Error_code::usage);
  const auto pierced = register_faces(body, counts.faces);
  if (!pierced.empty()) refuse_pierced(body, pierced.front(), Error_code::usage);
}

namespace {

/// As sweep_faces(), with edges on their sides of walls. True if there is no contact but one that is due to
/// these sides.
bool is_blocked_by_sides(const Body_state<3>& body, Move_scratch<3>& scratch, std::uint32_t vertex,
                         const Vertex_path<3>& path, std::optional<Contact<3>>& first, Face_counts& counts) {
  bool are_walls_near = false;
  std::optional<Contact<3>> marked;  // of an edge on the other side: the move is real until another contact
  const std::uint64_t flat_before = counts.flat;
  for (const auto& [f, k] : body.topology.face_corners_of(vertex)) {
    const auto& corners = body.topology.faces()[f];
    const auto& sides = body.topology.sides(f);
    const std::uint32_t q = corners[(k + 1) % 3], r = corners[(k + 2) % 3];
    // The edge across, of the corners that stand still, may be stale. Then it lies in a region free of walls,
    // where it was when its ends last moved: a chain is looked into where a wall meets its edge only, and
    // none meets this one.
    const Chain& across = body.chains[sides[(k + 1) % 3]];
    const Face_chains chains{{moved_chain(body, scratch, vertex, sides[k]), false},
                             {&across, q > r},
                             {moved_chain(body, scratch, vertex, sides[(k + 2) % 3]), true}};
    const Face_result swept = sweep_face(*body.snapshot, path, body.particles[q], body.particles[r],
                                         body.supporting_walls[f], chains, counts);
    are_walls_near |= swept.are_walls_near;
    if (swept.contact) {
      Contact<3> contact = *swept.contact;
      contact.body = Body_feature::face;
      contact.vertex = vertex;
      contact.feature = f;
      std::optional<Contact<3>>& kept = swept.is_edge_on_other_side ? marked : first;
      if (!kept || is_before(contact, *kept)) kept = contact;
    } else if (!first && (!swept.supporting_walls.empty() || !body.supporting_walls[f].empty())) {
      scratch.supporting_walls.emplace_back(f, swept.supporting_walls);
    }
  }
  if (!are_walls_near) return false;
  sweep_wedges(body, vertex, path, first, counts);
  sweep_parts(body, scratch, vertex, path, first, counts);
  if (first) return false;
  first = marked;
  if (!first && counts.flat > flat_before) settle_flat_faces(body, scratch, vertex, path, first, counts);
  return first.has_value();
}

}  // namespace

void sweep_faces(const Body_state<3>& body, Move_scratch<3>& scratch, std::uint32_t vertex,
                 const Vertex_path<3>& path, std::optional<Contact<3>>& first, Face_counts& counts) {
  if (!is_blocked_by_sides(body, scratch, vertex, path, first, counts)) return;
  // Edges that pass walls in the plane of their motion may do so on the sides of their faces.
  const auto corners = body.topology.corners_of(vertex);
  std::vector<std::vector<Chain>> chains;
  for (const Corner& corner : corners)
    chains.push_back(all_swept_chains(*body.snapshot, path, body.particles[corner.other],
                                      body.seen_from(corner), counts.walk));
  const std::optional<Contact<3>> preferred = first;
  std::vector<std::size_t> taken(corners.size());
  for (int tries = 1; tries < most_side_tries; ++tries) {
    std::size_t i = 0;
    for (; i < taken.size() && taken[i] + 1 >= chains[i].size(); ++i) taken[i] = 0;
    if (i == taken.size()) break;
    ++taken[i];
    for (std::size_t e = 0; e <= i; ++e)
      if (!chains[e].empty()) {
        scratch.chains[e].chain = chains[e][taken[e]];
        scratch.chains[e].is_in_place = false;
      }
    first.reset();
    scratch.supporting_walls.clear();
    is_blocked_by_sides(body, scratch, vertex, path, first, counts);
    if (!first) return;
  }
  first = preferred;
}

}  // namespace cellwalk::detail
