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
bool Thick_parts<D>::has_thin(const Body_topology& topology, std::uint32_t vertex) const {
  const auto corners = topology.corners_of(vertex);
  if (corners.empty()) return of_vertices_ == 0;
  return std::ranges::any_of(corners, [&](const Corner& corner) { return radii_[corner.edge] == 0; });
}

template <int D>
bool Thick_parts<D>::is_free(const Body_state<D>& body, std::uint32_t vertex, const Point<D>& target) {
  const Point<D>& p = body.positions[vertex];
  const Cell start = body.particles[vertex].cell;
  const auto corners = body.topology.corners_of(vertex);
  if (corners.empty())
    return of_vertices_ == 0 ||
           near_vertices_[vertex].is_free(*body.snapshot, start, {p, target, p, of_vertices_});
  return std::ranges::all_of(corners, [&](const Corner& corner) {
    const double r = radii_[corner.edge];
    return r == 0 || near_edges_[corner.edge].is_free(*body.snapshot, start,
                                                      {p, target, body.positions[corner.other], r});
  });
}

template <int D>
std::optional<Contact<D>> Thick_parts<D>::first_contact(const Body_state<D>& body, std::uint32_t vertex,
                                                        const Point<D>& target, Edge_counts& counts) const {
  const Point<D>& p = body.positions[vertex];
  const Cell start = body.particles[vertex].cell;
  std::optional<Contact<D>> first;
  const auto look_at = [&](const std::optional<Point<D>>& q, double r, std::uint32_t edge) {
    auto met = sweep_thick<D>(*body.snapshot, start, {p, target, q, r}, counts).contact;
    if (!met || (first && !meets_before(*met, *first))) return;
    first = met;
    first->vertex = vertex;
    first->feature = met->body == Body_feature::edge ? edge : vertex;
  };
  const auto corners = body.topology.corners_of(vertex);
  if (corners.empty() && of_vertices_ > 0) look_at({}, of_vertices_, 0);
  for (const Corner& corner : corners)
    if (const double r = radii_[corner.edge]; r > 0) look_at(body.positions[corner.other], r, corner.edge);
  return first;
}

template class Thick_parts<2>;
template class Thick_parts<3>;

template <int D>
void check_distances(const Body_state<D>& body, const Thick_parts<D>& thick, Error_code code) {
  if (thick.are_none()) return;
  Edge_counts uncounted;
  const auto check = [&](std::uint32_t v, const std::optional<Point<D>>& q, double r, const auto& what) {
    if (r == 0) return;
    const Point<D>& p = body.positions[v];
    const auto result = sweep_thick<D>(*body.snapshot, body.particles[v].cell, {p, p, q, r}, uncounted);
    if (result.starts_close) refuse_close(body, what(), *result.contact, r, code);
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
}

template void check_distances(const Body_state<2>&, const Thick_parts<2>&, Error_code);
template void check_distances(const Body_state<3>&, const Thick_parts<3>&, Error_code);

void check_thick_step(const Sweep_options& sweep, Step_rule rule) {
  if (rule == Step_rule::reject_at_target)
    throw Error(Error_code::usage,
                "the rule reject_at_target: not for bodies with a radius; take slide or reject");
  if (sweep.sweep == Sweep::faces)
    throw Error(Error_code::usage, "sweep faces: not for bodies with a radius; take triangle");
  check_thick_sweep(sweep);
}

}  // namespace cellwalk::detail
