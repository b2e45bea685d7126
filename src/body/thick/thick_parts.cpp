// SPDX-License-Identifier: LGPL-3.0-or-later
// The moves of vertices whose edges have a radius: by lists of near walls, and by a flood where one is in the
// way.
#include "thick_parts.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "body/body_state.h"
#include "body/step/meets_before.h"

namespace cellwalk::detail {
namespace {

template <class Point>
std::string place(const Point& x) {
  return fmt::format("({})", fmt::join(x, ", "));
}

template <int D>
[[noreturn]] void refuse_close(const Body_state<D>& body, const std::string& what, const Contact<D>& nearest,
                               double radius, Error_code code) {
  throw Error(code,
              fmt::format("{} is at a distance of {} from a wall at {}, in cell {}: less than its radius {}",
                          what, nearest.distance, place(nearest.point),
                          body.snapshot->index(body.snapshot->cell_of(nearest.facet)), radius));
}

/// \param motion of a part of the body that stays where it is
/// \param what gives its name
template <int D>
void check_distance(const Body_state<D>& body, std::uint32_t vertex, const Thick_motion<D>& motion,
                    const auto& what, Error_code code) {
  if (motion.radius == 0) return;
  Edge_counts uncounted;
  const auto result = sweep_thick<D>(*body.snapshot, body.particles[vertex].cell, motion, uncounted);
  if (result.starts_close) refuse_close(body, what(), *result.contact, motion.radius, code);
}

/// The motion of a face at one of its corners.
Thick_motion<3> motion_of_face(const Body_state<3>& body, const Face_corner& at, const Point<3>& target,
                               double radius) {
  const auto& corners = body.topology.faces()[at.face];
  const auto corner = [&](std::size_t k) { return body.positions[corners[(at.place + k) % 3]]; };
  return {corner(0), target, corner(1), radius, corner(2)};
}

}  // namespace

template <int D>
Thick_parts<D>::Thick_parts(std::span<const double> radii, const Body_topology& topology,
                            std::size_t vertices) {
  const std::size_t edges = topology.edges().size();
  if (radii.size() > 1 && radii.size() != edges)
    throw Error(Error_code::input,
                fmt::format("{} radii are given for a body of {} edges: give one for each, or "
                            "one for all",
                            radii.size(), edges));
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (!(radii[i] >= 0 && std::isfinite(radii[i])))
      throw Error(
          Error_code::input,
          fmt::format("radius {} of the body takes a finite number of at least 0, not {}", i, radii[i]));
  if (std::ranges::all_of(radii, [](double r) { return r == 0; })) return;
  if (radii.size() == 1) of_vertices_ = radii[0];
  radii_.assign(edges, radii[0]);
  if (radii.size() > 1) radii_.assign(radii.begin(), radii.end());
  near_edges_.resize(edges);
  near_vertices_.resize(of_vertices_ > 0 ? vertices : 0);
}

template <int D>
double Thick_parts<D>::radius_of_face(const Body_topology& topology, std::uint32_t face) const {
  const auto& [a, b, c] = topology.sides(face);
  return std::min({radius(a), radius(b), radius(c)});
}

template <int D>
double Thick_parts<D>::largest() const {
  return radii_.empty() ? of_vertices_ : std::max(of_vertices_, std::ranges::max(radii_));
}

template <int D>
void Thick_parts<D>::forget(const Body_topology& topology, std::uint32_t edge) {
  if (are_none()) return;
  near_edges_[edge].forget();
  if (near_faces_.empty()) return;
  for (const Face_corner& at : topology.face_corners_of(topology.edges()[edge][0]))
    near_faces_[at.face].forget();
}

template <int D>
double Thick_parts<D>::radius_at(const Body_topology& topology, std::uint32_t vertex) const {
  const auto corners = topology.corners_of(vertex);
  if (corners.empty()) return of_vertices_;
  double largest = 0;
  for (const Corner& corner : corners) largest = std::max(largest, radius(corner.edge));
  return largest;
}

template <int D>
bool Thick_parts<D>::has_thin(const Body_topology& topology, std::uint32_t vertex, Sweep sweep) const {
  const auto corners = topology.corners_of(vertex);
  if (corners.empty()) return of_vertices_ == 0;
  if (std::ranges::any_of(corners, [&](const Corner& corner) { return radius(corner.edge) == 0; }))
    return true;
  return sweep == Sweep::faces && std::ranges::any_of(topology.face_corners_of(vertex), [&](const auto& of) {
           return radius_of_face(topology, of.face) == 0;
         });
}

template <int D>
bool Thick_parts<D>::is_edge_free(const Body_state<D>& body, std::uint32_t vertex, const Corner& corner,
                                  const Point<D>& target, Swept_part part) {
  const double r = radius(corner.edge);
  return r == 0 ||
         near_edges_[corner.edge].is_free(*body.snapshot, body.particles[vertex].cell,
                                          {body.positions[vertex], target, body.positions[corner.other], r},
                                          corner.is_reversed ? 1 : 0, part);
}

template <int D>
bool Thick_parts<D>::is_vertex_free(const Body_state<D>& body, std::uint32_t vertex, const Point<D>& target) {
  return of_vertices_ == 0 ||
         near_vertices_[vertex].is_free(*body.snapshot, body.particles[vertex].cell,
                                        {body.positions[vertex], target, {}, of_vertices_}, 0);
}

template <int D>
bool Thick_parts<D>::is_free(const Body_state<D>& body, std::uint32_t vertex, const Point<D>& target,
                             Sweep sweep) {
  const auto corners = body.topology.corners_of(vertex);
  if (corners.empty()) return is_vertex_free(body, vertex, target);
  const auto is_edge = [&](const Corner& corner) {
    return is_edge_free(body, vertex, corner, target, part_of(sweep));
  };
  if (!std::ranges::all_of(corners, is_edge)) return false;
  if constexpr (D == 3)
    if (sweep == Sweep::faces) return are_faces_free(body, vertex, target);
  return true;
}

template <int D>
bool Thick_parts<D>::are_faces_free(const Body_state<D>& body, std::uint32_t vertex,
                                    const Point<D>& target) requires(D == 3) {
  near_faces_.resize(body.topology.faces().size());
  return std::ranges::all_of(body.topology.face_corners_of(vertex), [&](const Face_corner& at) {
    const double r = radius_of_face(body.topology, at.face);
    return r == 0 || near_faces_[at.face].is_free(*body.snapshot, body.particles[vertex].cell,
                                                  motion_of_face(body, at, target, r), at.place);
  });
}

template <int D>
std::optional<Contact<D>> Thick_parts<D>::first_contact(const Body_state<D>& body, std::uint32_t vertex,
                                                        const Point<D>& target, Sweep sweep,
                                                        Edge_counts& counts) const {
  const Point<D>& p = body.positions[vertex];
  const Cell start = body.particles[vertex].cell;
  std::optional<Contact<D>> first;
  const auto look_at = [&](const Thick_motion<D>& motion, std::uint32_t part) {
    if (motion.radius == 0) return;
    auto met = sweep_thick<D>(*body.snapshot, start, motion, counts, part_of(sweep)).contact;
    if (!met || (first && !meets_before(*met, *first))) return;
    if (motion.third) met->body = Body_feature::face;  // else its vertex or edge would have met it as well
    first = met;
    first->vertex = vertex;
    first->feature = met->body == Body_feature::vertex ? vertex : part;
  };
  const auto corners = body.topology.corners_of(vertex);
  if (corners.empty()) look_at({p, target, {}, of_vertices_}, 0);
  for (const Corner& corner : corners)
    look_at({p, target, body.positions[corner.other], radius(corner.edge)}, corner.edge);
  if constexpr (D == 3)
    if (sweep == Sweep::faces)
      for (const Face_corner& at : body.topology.face_corners_of(vertex))
        look_at(motion_of_face(body, at, target, radius_of_face(body.topology, at.face)), at.face);
  return first;
}

template class Thick_parts<2>;
template class Thick_parts<3>;

template <int D>
void check_distances(const Body_state<D>& body, const Thick_parts<D>& thick, Error_code code) {
  if (thick.are_none()) return;
  const auto check = [&](std::uint32_t v, const std::optional<Point<D>>& q, double r, const auto& what) {
    const Point<D>& p = body.positions[v];
    check_distance<D>(body, v, {p, p, q, r}, what, code);
  };
  for (std::uint32_t e = 0; e < body.topology.edges().size(); ++e) {
    const auto [u, v] = body.topology.edges()[e];
    check(u, body.positions[v], thick.radius(e), [&, u = u, v = v] {
      return fmt::format("edge {} of the body, from vertex {} at {} to vertex {} at {},", e, u,
                         place(body.positions[u]), v, place(body.positions[v]));
    });
  }
  for (std::uint32_t v = 0; v < body.positions.size(); ++v)
    if (body.topology.corners_of(v).empty())
      check(v, {}, thick.radius_of_vertices(),
            [&] { return fmt::format("vertex {} of the body, at {},", v, place(body.positions[v])); });
  if constexpr (D == 3)
    if (body.are_faces_swept) check_face_distances(body, thick, code);
}

void check_face_distances(const Body_state<3>& body, const Thick_parts<3>& thick, Error_code code) {
  for (std::uint32_t f = 0; f < body.topology.faces().size(); ++f) {
    const Point<3>& p = body.positions[body.topology.faces()[f][0]];
    const auto what = [&] {
      const auto& [u, v, w] = body.topology.faces()[f];
      return fmt::format("face {} of the body, with vertices {} at {}, {} at {} and {} at {},", f, u,
                         place(body.positions[u]), v, place(body.positions[v]), w, place(body.positions[w]));
    };
    check_distance<3>(body, body.topology.faces()[f][0],
                      motion_of_face(body, {f, 0}, p, thick.radius_of_face(body.topology, f)), what, code);
  }
}

template void check_distances(const Body_state<2>&, const Thick_parts<2>&, Error_code);
template void check_distances(const Body_state<3>&, const Thick_parts<3>&, Error_code);

}  // namespace cellwalk::detail
