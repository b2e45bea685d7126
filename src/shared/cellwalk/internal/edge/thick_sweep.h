// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of an edge or a point with a radius. Theory: docs/radius.md.
#ifndef CELLWALK_INTERNAL_EDGE_THICK_SWEEP_H
#define CELLWALK_INTERNAL_EDGE_THICK_SWEEP_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/walk/contact.h>

#include <boost/container/static_vector.hpp>

#include <optional>
#include <span>

namespace cellwalk::detail {

/// The motion of a vertex from p to a target: alone, with an edge to a point q that stands still, or with a
/// face.
template <int D>
struct Thick_motion {
  Point<D> p, target;
  std::optional<Point<D>> q;
  double radius = 0;                ///< finite, greater than 0
  std::optional<Point<D>> third{};  ///< of a face (3D): its third corner, which stands still as q does
};

/// The number of corners of what moves.
template <int D>
std::size_t corner_count(const Thick_motion<D>& motion) {
  return 1 + static_cast<std::size_t>(motion.q.has_value()) +
         static_cast<std::size_t>(motion.third.has_value());
}

/// The part of a motion that has to keep the distance.
enum class Swept_part {
  all,       ///< what the edge or face sweeps
  way,       ///< the way of p
  end,       ///< the edge at the end of the motion
  segments,  ///< both of the last, see Sweep::three_segments
};

inline Swept_part part_of(Sweep sweep) {
  return sweep == Sweep::three_segments ? Swept_part::segments : Swept_part::all;
}

template <int D>
using Swept_hull = boost::container::static_vector<Point<D>, 4>;

/// Its corners: p, the target, and those that stand still; what is not in the part is repeated by another
/// one.
/// \param part a hull: not `segments`
template <int D>
Swept_hull<D> swept_hull(const Thick_motion<D>& motion, Swept_part part) {
  const bool is_way = part == Swept_part::way;
  Swept_hull<D> hull{part == Swept_part::end ? motion.target : motion.p, motion.target};
  for (const auto& corner : {motion.q, motion.third})
    if (corner) hull.push_back(is_way ? motion.p : *corner);
  return hull;
}

/// The first time at which the vertex, the edge or the face is at the distance r from a wall and comes
/// nearer.
template <int D>
struct Thick_result {
  std::optional<Contact<D>> contact;  ///< none: the motion is free
  /// The motion starts nearer than r to a wall: its contact is the nearest point of walls, at the time 0,
  /// without a normal.
  bool starts_close = false;
};

/// Exact in every position: the motion is free if and only if the hull of p, its target and the corners that
/// stand still has a distance of at least r from every wall.
/// \param snapshot in which the motion takes place
/// \param start a free cell in whose closure p lies
/// \param motion of finite points; the target and q may lie anywhere
/// \param counts raised by the flood
/// \param part walls that are near others only do not count
/// Degenerate cases: q may be p, the target may be p, p may pass q, and all may be collinear. A start at the
/// distance r is free. Contact::point is the nearest point of the wall, Contact::normal the direction from
/// there to the vertex, edge or face; Contact::cell is the start. Faces may have no area.
/// Cost: that of a flood through the cells nearer than r, about 30 ns a facet; is_apart() for each wall
/// found; 30 to 100 us where walls are in the way.
template <int D>
Thick_result<D> sweep_thick(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion,
                            Edge_counts& counts, Swept_part part = Swept_part::all);

/// The contact that sweep_thick() finds, without its flood. The interior of a facet is met from the side on
/// which the vertex is, and any flood comes there; an edge or a vertex belongs to several walls, of which a
/// flood finds all that are linked at it.
/// \param walls all that are nearer to the motion than its radius and found by the flood, in any order;
///        others may be among them
/// \pre the motion starts free, and is not
/// \return none if the walls are not linked: then the flood has to decide which of them are named
template <int D>
std::optional<Contact<D>> contact_without_flood(const Snapshot<D>& snapshot, Cell start,
                                                const Thick_motion<D>& motion,
                                                std::span<const Half_facet> walls,
                                                Swept_part part = Swept_part::all);

/// \throw Error(usage) for what edges with a radius cannot do
void check_thick_sweep(const Sweep_options& options);

/// A lower bound of the distance of an edge to all walls, or a larger one, if it is that far from them.
/// \param start a free cell in whose closure p lies
/// \param p,q the ends of the edge; a point has q = p
/// \param up_to at least 0: walls farther away are not looked at
/// Cost: that of a flood through the cells nearer than that, and 0.3 to 0.7 us for each wall found.
template <int D>
double clearance(const Snapshot<D>& snapshot, Cell start, const Point<D>& p, const Point<D>& q, double up_to);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_THICK_SWEEP_H
