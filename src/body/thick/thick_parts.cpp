// SPDX-License-Identifier: LGPL-3.0-or-later
// The moves of vertices whose edges have a radius: by lists of near walls, and by a flood where one is in the
// way.
#include "thick_parts.h"

#include <cellwalk/kernel/error.h>

#include <boost/container/small_vector.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/body_state.h"
#include "body/step/meets_before.h"

namespace cellwalk::detail {
namespace {

/// The number of vertices of a group: one list of walls is made for all of them.
constexpr std::size_t vertices_of_group = 8;

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
  form_groups(topology, vertices);
}

template <int D>
void Thick_parts<D>::form_groups(const Body_topology& topology, std::size_t vertices) {
  group_of_.assign(vertices, no_group);
  for (std::uint32_t v = 0; v < vertices; ++v)
    if (group_of_[v] == no_group && radius_at(topology, v) > 0) join_neighbours(topology, v);
  for (std::uint32_t v = 0; v < vertices; ++v)
    if (topology.corners_of(v).empty() && of_vertices_ > 0) add_to_group(v, {&v, 1}, of_vertices_);
  for (std::uint32_t e = 0; e < topology.edges().size(); ++e)
    if (radius(e) > 0) add_to_group(topology.edges()[e][0], topology.edges()[e], radius(e));
  for (std::uint32_t f = 0; f < topology.faces().size(); ++f)
    if (const double r = radius_of_face(topology, f); r > 0)
      add_to_group(topology.faces()[f][0], topology.faces()[f], r);
  for (Group& group : groups_) {
    std::ranges::sort(group.corners);
    group.corners.erase(std::unique(group.corners.begin(), group.corners.end()), group.corners.end());
  }
}

/// A group of a vertex and of those near it that have none yet.
template <int D>
void Thick_parts<D>::join_neighbours(const Body_topology& topology, std::uint32_t first) {
  const auto number = static_cast<std::uint32_t>(groups_.size());
  groups_.emplace_back();
  std::vector<std::uint32_t> joined{first};
  group_of_[first] = number;
  for (std::size_t next = 0; next < joined.size(); ++next)
    for (const Corner& corner : topology.corners_of(joined[next])) {
      if (joined.size() == vertices_of_group) return;
      if (radius(corner.edge) == 0 || group_of_[corner.other] != no_group) continue;
      group_of_[corner.other] = number;
      joined.push_back(corner.other);
    }
}

/// \param first the vertex to whose group an edge or a face belongs
template <int D>
void Thick_parts<D>::add_to_group(std::uint32_t first, std::span<const std::uint32_t> corners, double r) {
  Group& group = groups_[group_of_[first]];
  group.corners.insert(group.corners.end(), corners.begin(), corners.end());
  group.radius = std::max(group.radius, r);
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
  const std::uint32_t first = topology.edges()[edge][0];
  if (radius(edge) > 0) groups_[group_of_[first]].near_walls.forget();
  for (const Face_corner& at : topology.face_corners_of(first))
    if (radius_of_face(topology, at.face) > 0)
      groups_[group_of_[topology.faces()[at.face][0]]].near_walls.forget();
}

template <int D>
void Thick_parts<D>::forget_faces() {
  for (Group& group : groups_) group.near_walls.forget();
}

/// The largest radius of its edges, or that of a vertex without edges.
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
bool Thick_parts<D>::are_free(const Body_state<D>& body, std::uint32_t vertex, std::uint32_t group,
                              std::span<const Thick_motion<D>> motions, Swept_part part) {
  auto& [corners, largest_radius, near_walls] = groups_[group];
  if (!near_walls.holds(*body.snapshot, motions)) {
    Box<D> box;
    for (const std::uint32_t v : corners) box.extend(body.positions[v]);
    near_walls.make(*body.snapshot, body.particles[vertex].cell, box, largest_radius, motions);
  }
  return near_walls.are_free(*body.snapshot, motions, part);
}

template <int D>
bool Thick_parts<D>::is_edge_free(const Body_state<D>& body, std::uint32_t vertex, const Corner& corner,
                                  const Point<D>& target, Swept_part part) {
  const double r = radius(corner.edge);
  const Thick_motion<D> motion{body.positions[vertex], target, body.positions[corner.other], r};
  return r == 0 ||
         are_free(body, vertex, group_of_[body.topology.edges()[corner.edge][0]], {&motion, 1}, part);
}

template <int D>
bool Thick_parts<D>::is_free(const Body_state<D>& body, std::uint32_t vertex, const Point<D>& target,
                             Sweep sweep) {
  const Point<D>& p = body.positions[vertex];
  // The parts at the vertex, group by group: in most bodies there are one or two.
  boost::container::small_vector<std::pair<std::uint32_t, Thick_motion<D>>, 8> parts;
  const auto add = [&](std::uint32_t first, const Thick_motion<D>& motion) {
    if (motion.radius > 0) parts.emplace_back(group_of_[first], motion);
  };
  const auto corners = body.topology.corners_of(vertex);
  if (corners.empty()) add(vertex, {p, target, {}, of_vertices_});
  for (const Corner& corner : corners)
    add(body.topology.edges()[corner.edge][0],
        {p, target, body.positions[corner.other], radius(corner.edge)});
  if constexpr (D == 3)
    if (sweep == Sweep::faces)
      for (const Face_corner& at : body.topology.face_corners_of(vertex))
        add(body.topology.faces()[at.face][0],
            motion_of_face(body, at, target, radius_of_face(body.topology, at.face)));
  boost::container::small_vector<Thick_motion<D>, 8> motions;
  while (!parts.empty()) {
    const std::uint32_t group = parts.back().first;
    motions.clear();
    for (const auto& [of_part, motion] : parts)
      if (of_part == group) motions.push_back(motion);
    if (!are_free(body, vertex, group, {motions.data(), motions.size()}, part_of(sweep))) return false;
    const auto is_done = [group](const auto& part) { return part.first == group; };
    parts.erase(std::remove_if(parts.begin(), parts.end(), is_done), parts.end());
  }
  return true;
}

/// Nothing is counted: whether there is a list depends on what was done before.
template <int D>
std::optional<Contact<D>> Thick_parts<D>::contact(const Body_state<D>& body, Cell start, std::uint32_t first,
                                                  const Thick_motion<D>& motion, Swept_part part) {
  const Snapshot<D>& snapshot = *body.snapshot;
  Group& group = groups_[group_of_[first]];
  if (motion.radius <= group.radius && group.near_walls.holds(snapshot, {&motion, 1}))
    if (auto met = contact_without_flood<D>(snapshot, start, motion,
                                            group.near_walls.walls_near(snapshot, motion), part))
      return met;
  Edge_counts uncounted;
  return sweep_thick<D>(snapshot, start, motion, uncounted, part).contact;
}

/// By the list of an edge, which its moves have tested in any case; that of the vertex may be one of faces.
template <int D>
std::optional<Contact<D>> Thick_parts<D>::contact_on_way(const Body_state<D>& body, std::uint32_t vertex,
                                                         const Point<D>& target) {
  const Thick_motion<D> way{body.positions[vertex], target, {}, radius_at(body.topology, vertex)};
  const auto corners = body.topology.corners_of(vertex);
  const auto widest =
      std::ranges::max_element(corners, {}, [&](const Corner& corner) { return radius(corner.edge); });
  return contact(body, body.particles[vertex].cell,
                 corners.empty() ? vertex : body.topology.edges()[widest->edge][0], way, Swept_part::all);
}

template <int D>
std::optional<Contact<D>> Thick_parts<D>::first_contact(const Body_state<D>& body, std::uint32_t vertex,
                                                        const Point<D>& target, Sweep sweep) {
  const Point<D>& p = body.positions[vertex];
  const Cell start = body.particles[vertex].cell;
  std::optional<Contact<D>> first;
  const auto look_at = [&](const Thick_motion<D>& motion, std::uint32_t first_vertex, std::uint32_t part) {
    if (motion.radius == 0) return;
    const auto met = contact(body, start, first_vertex, motion, part_of(sweep));
    if (!met || (first && !meets_before(*met, *first))) return;
    first = met;
    if (motion.third) first->body = Body_feature::face;  // else its vertex or edge would have met it as well
    first->vertex = vertex;
    first->feature = met->body == Body_feature::vertex ? vertex : part;
  };
  const auto corners = body.topology.corners_of(vertex);
  if (corners.empty()) look_at({p, target, {}, of_vertices_}, vertex, 0);
  for (const Corner& corner : corners)
    look_at({p, target, body.positions[corner.other], radius(corner.edge)},
            body.topology.edges()[corner.edge][0], corner.edge);
  if constexpr (D == 3)
    if (sweep == Sweep::faces)
      for (const Face_corner& at : body.topology.face_corners_of(vertex))
        look_at(motion_of_face(body, at, target, radius_of_face(body.topology, at.face)),
                body.topology.faces()[at.face][0], at.face);
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
