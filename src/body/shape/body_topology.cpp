// SPDX-License-Identifier: LGPL-3.0-or-later
// The checks of edges and faces, and the tables of those at each vertex.
#include "body_topology.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

constexpr const char* remedy = "sort the edges of a body with faces, each with its lower vertex first";

template <class Shapes>
void check_indices(const char* kind, const Shapes& shapes, std::size_t vertices) {
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (const std::uint32_t v : shapes[i])
      if (v >= vertices)
        throw Error(Error_code::usage,
                    fmt::format("{} {} of the body names vertex {} of {}", kind, i, v, vertices));
}

/// Sides of faces are looked up among the edges, by bisection.
void check_order(const std::vector<std::array<std::uint32_t, 2>>& edges) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [u, v] = edges[e];
    if (u >= v)
      throw Error(
          Error_code::usage,
          fmt::format("edge {} of the body, from vertex {} to {}, does not have its lower vertex first: {}",
                      e, u, v, remedy));
    if (e > 0 && edges[e - 1] >= edges[e])
      throw Error(Error_code::usage,
                  fmt::format("edge {} of the body, from vertex {} to {}, does not come after edge {}: {}", e,
                              u, v, e - 1, remedy));
  }
}

}  // namespace

Body_topology::Body_topology(std::size_t vertices, std::vector<std::array<std::uint32_t, 2>> edges,
                             std::vector<std::array<std::uint32_t, 3>> faces)
    : edges_(std::move(edges)), corner_begin_(vertices + 1), faces_(std::move(faces)) {
  check_indices("edge", edges_, vertices);
  check_indices("face", faces_, vertices);
  for (const auto& [u, v] : edges_) {
    ++corner_begin_[u + 1];
    ++corner_begin_[v + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    max_degree_ = std::max<std::size_t>(max_degree_, corner_begin_[v + 1]);
    corner_begin_[v + 1] += corner_begin_[v];
  }
  corners_.resize(2 * edges_.size());
  std::vector<std::uint32_t> next(corner_begin_.begin(), corner_begin_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const auto [u, v] = edges_[e];
    corners_[next[u]++] = {e, v, false};
    corners_[next[v]++] = {e, u, true};
  }
  if (!faces_.empty()) link_faces(vertices);
}

void Body_topology::link_faces(std::size_t vertices) {
  check_order(edges_);
  const auto edge_of = [this](std::uint32_t u, std::uint32_t v) {
    const std::array<std::uint32_t, 2> ends{std::min(u, v), std::max(u, v)};
    const auto edge = std::lower_bound(edges_.begin(), edges_.end(), ends);
    if (edge == edges_.end() || *edge != ends)
      throw Error(Error_code::usage,
                  fmt::format("face {} of the body has a side from vertex {} to {} that is "
                              "not among its edges: list each side",
                              sides_.size(), ends[0], ends[1]));
    return static_cast<std::uint32_t>(edge - edges_.begin());
  };
  face_corner_begin_.assign(vertices + 1, 0);
  for (const auto& [u, v, w] : faces_) {
    sides_.push_back({edge_of(u, v), edge_of(v, w), edge_of(w, u)});
    for (const std::uint32_t x : {u, v, w}) ++face_corner_begin_[x + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) face_corner_begin_[v + 1] += face_corner_begin_[v];
  face_corners_.resize(3 * faces_.size());
  std::vector<std::uint32_t> next(face_corner_begin_.begin(), face_corner_begin_.end() - 1);
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k) face_corners_[next[faces_[f][k]]++] = {f, k};
  for (std::uint32_t v = 0; v < vertices; ++v) is_joined_.push_back(edges_at_are_joined(v));
}

bool Body_topology::edges_at_are_joined(std::uint32_t vertex) const {
  std::vector<std::uint32_t> part;  // of each edge at the vertex
  for (const Corner& corner : corners_of(vertex)) part.push_back(corner.edge);
  std::size_t parts = part.size();
  const auto part_of = [&](std::uint32_t edge) {
    const auto corners = corners_of(vertex);
    return part[std::ranges::lower_bound(corners, edge, {}, &Corner::edge) - corners.begin()];
  };
  for (const auto& [f, k] : face_corners_of(vertex)) {
    const std::uint32_t one = part_of(sides_[f][k]), other = part_of(sides_[f][(k + 2) % 3]);
    if (one == other) continue;
    std::ranges::replace(part, other, one);
    --parts;
  }
  return parts < 2;
}

}  // namespace cellwalk::detail
