// SPDX-License-Identifier: LGPL-3.0-or-later
// Which vertices, edges and faces of a body are joined.
#ifndef CELLWALK_BODY_SHAPE_BODY_TOPOLOGY_H
#define CELLWALK_BODY_SHAPE_BODY_TOPOLOGY_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// An edge as seen from one of its ends.
struct Corner {
  std::uint32_t edge, other;
  bool is_reversed;
};

/// A face as seen from one of its corners, the one at this place.
struct Face_corner {
  std::uint32_t face, place;
};

class Body_topology {
 public:
  /// \throw Error(usage) naming the edge or face: a vertex that does not exist; of a body with faces, edges
  ///        that are not in the order of a Body_soup, or a side that is none of them
  Body_topology(std::size_t vertices, std::vector<std::array<std::uint32_t, 2>> edges,
                std::vector<std::array<std::uint32_t, 3>> faces);

  const std::vector<std::array<std::uint32_t, 2>>& edges() const { return edges_; }
  const std::vector<std::array<std::uint32_t, 3>>& faces() const { return faces_; }
  /// The edges of a face, from each corner to the next.
  const std::array<std::uint32_t, 3>& sides(std::uint32_t face) const { return sides_[face]; }
  /// In the order of their edges.
  std::span<const Corner> corners_of(std::uint32_t vertex) const {
    return {corners_.data() + corner_begin_[vertex], corners_.data() + corner_begin_[vertex + 1]};
  }
  /// The largest number of edges at one vertex.
  std::size_t max_degree() const { return max_degree_; }
  std::span<const Face_corner> face_corners_of(std::uint32_t vertex) const {
    if (faces_.empty()) return {};
    return {face_corners_.data() + face_corner_begin_[vertex],
            face_corners_.data() + face_corner_begin_[vertex + 1]};
  }
  /// True if one can come from each edge at a vertex to each other one by faces.
  /// \pre there are faces
  bool is_joined_at(std::uint32_t vertex) const { return is_joined_[vertex]; }

 private:
  void link_faces(std::size_t vertices);
  bool edges_at_are_joined(std::uint32_t vertex) const;

  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<Corner> corners_;              ///< of vertex after vertex
  std::vector<std::uint32_t> corner_begin_;  ///< corners of vertex v: [corner_begin_[v], corner_begin_[v+1])
  std::size_t max_degree_ = 0;
  std::vector<std::array<std::uint32_t, 3>> faces_, sides_;
  std::vector<Face_corner> face_corners_;  ///< of vertex after vertex
  std::vector<std::uint32_t> face_corner_begin_;
  std::vector<bool> is_joined_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_SHAPE_BODY_TOPOLOGY_H
