// SPDX-License-Identifier: LGPL-3.0-or-later
// The wedges into which walls part the space around the way of a vertex, and the edges and faces that the
// vertex takes along in them. Theory: docs/sweep.md, faces. All signs are exact.
#ifndef CELLWALK_EDGE_FACE_RIDGE_WEDGES_H
#define CELLWALK_EDGE_FACE_RIDGE_WEDGES_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/fraction.h>

#include <optional>
#include <vector>

#include "edge/exact/half_space.h"

namespace cellwalk::detail {

/// Walls that hold a piece of the way from a to b have half-planes on the line ab, which part the space
/// around the piece into wedges, one from each half-plane to the next. The edges and faces at p are in one of
/// them on each piece, and all of them in the same.
class Ridge_wedges {
 public:
  /// Cost: a flood along the way, and exact fractions for each wall near it.
  Ridge_wedges(const Snapshot<3>& snapshot, const Vertex_path<3>& path, Face_counts& counts);

  /// True if on no piece there is more than one wedge.
  bool is_empty() const { return pieces_.empty(); }

  /// Holds an edge from p to q: in a half-plane of walls it may be in either of the wedges beside it.
  void hold_edge(const Point<3>& q);
  /// Holds a face pqr that moves off its plane.
  void hold_face(const Point<3>& q, const Point<3>& r);
  /// Holds an edge without a face, which is where p itself passes, since its chain was followed from there.
  void hold_path(const Vertex_path<3>& path);
  /// Holds an edge or a face that moves in the plane of a wall, on one side of it.
  void hold_side(Half_facet half);
  /// True if, on some piece, an edge or a face that moves in the plane of a wall cannot be on the other side
  /// of it.
  bool needs(Half_facet half) const;
  /// A wall that comes between the edges and faces held: at the start of the first piece on which no wedge is
  /// left.
  std::optional<Contact<3>> conflict() const;

 private:
  /// A half-plane on the line ab.
  struct Half_plane {
    Point<3> point;         ///< a point of it
    Ring_vector<3> normal;  ///< towards the side that follows counterclockwise about the way
    Half_facet wall;        ///< one that lies in it
  };
  struct Wall_on_way {
    Half_facet wall;
    Fraction low, high;
  };
  /// A piece of the way, with its half-planes counterclockwise; wedge k is the one after half-plane k.
  struct Piece {
    Fraction low;
    std::vector<Half_plane> half_planes{};
    std::vector<bool> may_be_in{};
  };

  Half_plane half_plane(const Point<3>& x, Half_facet wall = Half_facet::none) const;
  /// > 0 if y is counterclockwise of a half-plane, by less than half a turn.
  int turn(const Half_plane& from, const Point<3>& y) const;
  /// True if the first of two comes before the second, counterclockwise from a third one.
  bool is_before(const Half_plane& from, const Half_plane& x, const Half_plane& y) const;
  static bool are_equal(const Half_plane& x, const Half_plane& y);

  void add_wall(Piece& piece, Half_facet wall) const;
  /// The last half-plane that is not after x.
  std::size_t wedge_of(const Piece& piece, const Half_plane& x) const;
  /// The wedge between two points less than half a turn apart, with no wall between them.
  std::size_t wedge_of_angle(const Piece& piece, const Point<3>& q, const Point<3>& r) const;
  /// The cell in which p is just after a time, or one in the same wedge.
  Cell cell_after(const Vertex_path<3>& path, const Fraction& time) const;
  /// True if the way is in the border of a cell just after a time.
  bool is_in_border(const Cell_view<3>& cell, const Fraction& time) const;
  /// Leaves no wedges of a piece but these two, as far as they were left.
  static void hold(Piece& piece, std::size_t one, std::size_t other);
  /// Calls f with each piece that lies in a half-facet, the wedge on its side, and the one beyond.
  template <class Pieces, class F>
  void for_each_place(Pieces& pieces, Half_facet half, const F& f) const;

  const Snapshot<3>& snapshot_;
  Point<3> a_, b_;
  std::vector<Piece> pieces_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_RIDGE_WEDGES_H
