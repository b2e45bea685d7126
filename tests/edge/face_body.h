// SPDX-License-Identifier: LGPL-3.0-or-later
// One triangle that is moved corner by corner through a world, with the chains of its edges and the rests of
// its face.
#ifndef CELLWALK_TESTS_EDGE_FACE_BODY_H
#define CELLWALK_TESTS_EDGE_FACE_BODY_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>

#include <array>
#include <vector>

#include "edge/rational_face.h"

namespace cellwalk::test {

class Face_body {
 public:
  /// What came of a move. It is made if nothing is in its way.
  struct Outcome {
    std::optional<Contact<3>> vertex;  ///< of p
    std::optional<Contact<3>> edge;    ///< of an edge, if p is free
    Face_result face;
    bool is_made() const { return !vertex && !edge && !face.contact; }
    bool is_face_only() const { return !vertex && !edge && face.contact; }
  };

  explicit Face_body(const Snapshot<3>& snapshot) : snapshot_(snapshot) {}

  /// Puts the corners where they are; false if an edge crosses a wall, or a wall pierces the face.
  bool place(const std::array<Particle<3>, 3>& corners) {
    corners_ = corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Chain_result<3> edge = find_chain(snapshot_, corners[k], corners[(k + 1) % 3], edge_counts.walk);
      if (edge.contact) return false;
      chains_[k] = edge.chain;
    }
    const Face_registration face = registered();
    supporting_walls_ = face.supporting_walls;
    return face.piercing == Half_facet::none;
  }

  /// What registering the face where it is says.
  Face_registration registered() {
    return register_face(snapshot_, corners_[0], corners_[1], corners_[2],
                         {{&chains_[0]}, {&chains_[1]}, {&chains_[2]}}, counts, supporting_walls_);
  }

  /// Moves corner k.
  Outcome move_corner(std::size_t k, const Point<3>& target) {
    const std::size_t j = (k + 1) % 3, i = (k + 2) % 3;
    Particle<3> p = corners_[k];
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    Outcome outcome;
    outcome.vertex = move(snapshot_, p, target, edge_counts.walk, {&visited, &crossed}).contact;
    p.position = target;
    const Vertex_path<3> path{corners_[k], p, visited, crossed, outcome.vertex.has_value()};
    Chain next = chains_[k], last = reversed(snapshot_, chains_[i]);  // from p to the others
    if (!outcome.vertex) {
      const Sweep_result<3> to_next = sweep_triangle<3>(snapshot_, path, corners_[j], next, edge_counts);
      const Sweep_result<3> to_last = sweep_triangle<3>(snapshot_, path, corners_[i], last, edge_counts);
      outcome.edge = to_next.contact ? to_next.contact : to_last.contact;
      next = to_next.chain;
      last = to_last.chain;
    }
    const bool is_free = !outcome.vertex && !outcome.edge;
    outcome.face =
        sweep_face(snapshot_, path, corners_[j], corners_[i], supporting_walls_,
                   {{is_free ? &next : nullptr}, {&chains_[j]}, {is_free ? &last : nullptr, true}}, counts);
    if (outcome.is_made()) {
      corners_[k] = p;
      chains_[k] = next;
      chains_[i] = reversed(snapshot_, last);
      supporting_walls_ = outcome.face.supporting_walls;
    }
    return outcome;
  }

  const Particle<3>& corner(std::size_t k) const { return corners_[k]; }
  Triangle triangle() const { return {corners_[0].position, corners_[1].position, corners_[2].position}; }
  const Supporting_walls& supporting_walls() const { return supporting_walls_; }

  Edge_counts edge_counts;
  Face_counts counts;

 private:
  const Snapshot<3>& snapshot_;
  std::array<Particle<3>, 3> corners_;
  std::array<Chain, 3> chains_;  ///< from corner k to the next
  Supporting_walls supporting_walls_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_FACE_BODY_H
