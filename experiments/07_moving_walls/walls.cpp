// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "common/peers/growing_box.h"

namespace cellwalk::moving_walls {
namespace {

constexpr std::uint32_t edges_of_group = 8;
constexpr double margin_ulps = 2048;

/// Six times the volume of a tetrahedron, rounded: those of an environment are not flat.
double volume(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  return dot(cross(b - a, c - a), d - a);
}

}  // namespace

Walls::Walls(const Snapshot<3>& snapshot) : vertex_of(snapshot.points().size(), nothing) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
      const Half_facet wall = Snapshot<3>::half_facet(c, f);
      if (!snapshot.is_impassable(wall)) continue;
      if (snapshot.neighbour(wall) != Cell::none)
        throw std::runtime_error("walls with cells on both sides are not for this experiment");
      const std::vector<std::uint32_t> loop = snapshot.loop(wall);
      std::array<std::uint32_t, 3> triangle{loop[0], loop[1], loop[2]};
      const auto cell = snapshot.view(c).vertices;
      const auto top = std::ranges::find_if(
          cell, [&](std::uint32_t p) { return std::ranges::find(loop, p) == loop.end(); });
      if (volume(snapshot.point(loop[0]), snapshot.point(loop[1]), snapshot.point(loop[2]),
                 snapshot.point(*top)) < 0)
        std::swap(triangle[1], triangle[2]);
      for (const std::uint32_t p : triangle) vertex_of[p] = 0;
      triangles.push_back(triangle);
    }
  }
  for (std::uint32_t p = 0; p < vertex_of.size(); ++p) {
    if (vertex_of[p] == nothing) continue;
    vertex_of[p] = static_cast<std::uint32_t>(points.size());
    points.push_back(p);
  }
  first_at.assign(points.size() + 1, 0);
  for (auto& triangle : triangles)
    for (std::uint32_t& p : triangle) ++first_at[(p = vertex_of[p]) + 1];
  for (std::size_t v = 0; v < points.size(); ++v) first_at[v + 1] += first_at[v];
  at.resize(first_at.back());
  std::vector<std::uint32_t> next = first_at;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) at[next[v]++] = t;
}

Body_edges::Body_edges(std::span<const std::unique_ptr<Body<3>>> bodies) {
  double largest = 0;
  for (const auto& body : bodies)
    for (const Point<3>& x : body->positions())
      for (const double c : x) largest = std::max(largest, std::abs(c));
  const double margin = margin_ulps * std::numeric_limits<double>::epsilon() * largest;
  for (const auto& body : bodies) {
    const auto edges = body->edges();
    const bool is_soft = !body->faces().empty() || edges.size() >= body->vertex_count();
    const std::size_t size = is_soft ? edges.size() : edges_of_group;
    for (std::size_t begin = 0; begin < edges.size(); begin += size) {
      const auto first = static_cast<std::uint32_t>(ends.size());
      experiments::Growing_box box(body->positions()[edges[begin][0]]);
      for (std::size_t e = begin; e < std::min(begin + size, edges.size()); ++e) {
        const Point<3>&p = body->positions()[edges[e][0]], &q = body->positions()[edges[e][1]];
        ends.push_back({p, q});
        boxes.push_back(experiments::box_of(p, q).enlarged(margin));
        box.add(p);
        box.add(q);
      }
      groups.push_back({first, static_cast<std::uint32_t>(ends.size()), box.box().enlarged(margin)});
    }
  }
}

}  // namespace cellwalk::moving_walls
