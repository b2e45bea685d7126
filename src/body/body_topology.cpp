// SPDX-License-Identifier: LGPL-3.0-or-later
#include "body_topology.h"

#include <algorithm>

namespace cellwalk::detail {

Body_topology::Body_topology(std::size_t vertices, std::vector<std::array<std::uint32_t, 2>> edges,
                             std::vector<std::array<std::uint32_t, 3>> faces)
    : edges_(std::move(edges)), corner_begin_(vertices + 1), faces_(std::move(faces)) {
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
  const auto edge_of = [this](std::uint32_t u, std::uint32_t v) {
    const std::array<std::uint32_t, 2> ends{std::min(u, v), std::max(u, v)};
    return static_cast<std::uint32_t>(std::lower_bound(edges_.begin(), edges_.end(), ends) - edges_.begin());
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
}

}  // namespace cellwalk::detail
