// SPDX-License-Identifier: LGPL-3.0-or-later
// Questions about motions of points and edges whose cells are not known, and their answers.
#ifndef CELLWALK_QUERY_QUERY_H
#define CELLWALK_QUERY_QUERY_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/contact.h>
#include <cellwalk/walk/locate.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cellwalk {

enum class Motion_status : std::uint8_t {
  free,     ///< the motion arrives
  contact,  ///< a wall blocks it
  outside,  ///< it starts outside free space, or across a wall
  invalid,  ///< a coordinate is missing or not finite
  lost,     ///< inexact kernels only: the walk found no exit from a cell
  close     ///< it starts nearer to a wall than its radius
};

/// Their names in tables and reports.
inline constexpr const char* motion_status_names[] = {"free",    "contact", "outside",
                                                      "invalid", "lost",    "close"};

template <int D>
struct Answer {
  Motion_status status = Motion_status::invalid;
  std::uint32_t cells = 0;  ///< number of cells visited by the moving point
  Cell cell = Cell::none;   ///< in which the motion ends, or its contact is; none if outside or invalid
  /// If status is contact; if it is close, the nearest point of walls and its distance, at the time 0.
  std::optional<Contact<D>> contact;
  /// The side of walls from which a point starts: its number in Locator::particles_at().
  std::uint32_t side = 0;
};

/// Answers a motion from one point to another. A start on a wall with free space on several sides may belong
/// to each of them: the side on which the motion gets furthest is chosen, in ties the one with the cell of
/// lowest index. The time of a contact is exact.
/// \param snapshot of the environment
/// \param locator finds the cells of the start
/// \param from,to the ends of the motion, finite
/// \param touch the touch policy
/// \param counts raised by the query
/// \param radius of the point: it keeps at least this distance from every wall (docs/radius.md). Sides do not
///        matter then. 0: it may touch walls
/// \pre the locator is that of the snapshot
/// \throw Error(input) for a point that is not finite, and a radius that is not a finite number of at least
///        0; Error(usage) as Locator::locate(), and for a radius with Touch::stop
/// Cost: that of locating the start and of the walk, for each side; with a radius, about 30 ns for each facet
/// of the cells that are nearer, and 30 to 100 us for a contact. Thread-safe, if each thread has its own
/// counts.
template <int D>
Answer<D> answer_move(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                      const Point<D>& to, Touch touch, Edge_counts& counts, double radius = 0);

/// A motion of an edge: its end p moves to a target while its end q stands still.
template <int D>
struct Edge_motion {
  Point<D> p, target, q;
  double radius = 0;  ///< the edge keeps at least this distance from every wall; 0: it may touch walls
};

/// Answers a motion of an edge. The status is `outside` if an end is not in free space, or if the edge
/// crosses a wall before it moves. Sweep::faces is the same as Sweep::triangle, since an edge has no faces.
///
/// An end on a wall with free space on several sides may belong to each of them, and the edge may pass walls
/// in its line on several sides. Those are chosen with which the motion gets furthest, by exact times; in
/// ties those with the lowest index of the cell of p, then of the cell of q. With a radius, sides do not
/// matter; the status is `close` if the edge starts nearer to a wall, or on both sides of one.
/// \param snapshot of the environment
/// \param locator finds the cells of both ends
/// \param motion of finite points
/// \param options the sweep
/// \param counts raised by the query
/// \pre the locator is that of the snapshot
/// \throw Error(input) for a point that is not finite, and a radius that is not a finite number of at least
///        0; Error(usage) as Locator::locate(), for a search of a tolerance not in (0,1], and for a radius
///        with Touch::stop or a search
/// Cost: that of locating two points, finding a chain and sweep_edge(), for each combination of sides.
/// Thread-safe, if each thread has its own counts.
template <int D>
Answer<D> answer_sweep(const Snapshot<D>& snapshot, const Locator<D>& locator, const Edge_motion<D>& motion,
                       const Sweep_options& options, Edge_counts& counts);

struct Edge_cells_options {
  /// Of the edges; 0: a tenth of the mean distance between walls.
  double length = 0;
  std::size_t edges = 4096;  ///< random edges to walk along
  std::uint64_t seed = 1;
};

struct Edge_cells {
  double length = 0;  ///< of the edges
  /// The mean length of the segments in which random lines meet free space: 4 V / A for the volume V of free
  /// space and the area A of its walls, pi V / A for area and length in 2D (Cauchy and Crofton).
  double wall_distance = 0;
  std::size_t edges = 0;      ///< that lie in free space
  std::size_t blocked = 0;    ///< others that met a wall, and are left out
  double cells = 0;           ///< mean number of cells of an edge; 0 if there is no edge
  double standard_error = 0;  ///< of this mean
};

/// Walks exactly along random edges of a length that lie in free space, and counts their cells. Each has one
/// end at a random point of free space, uniformly distributed, and a random direction. Edges that meet a wall
/// are left out. If most edges do, it gives up after eight times as many as requested.
///
/// In cells whose facets have an area of F in the volume V, an edge of length L far from walls lies in
/// 1 + L F / (2 V) cells on average, in 2D in 1 + 2 L F / (pi V).
/// \throw Error(usage) unless options.length is finite and at least 0
/// Degenerate cases: no edge, and a wall distance of 0, if there is no free space, or if its volume or the
/// area of its walls is not a positive finite double. The cells are those that a walk visits: an edge through
/// a ridge or vertex does not lie in all of the cells there.
/// Cost: linear in the number of cells, about 0.3 us each, and 4096 walks. The same geometry, in the same
/// order of cells, gives the same numbers.
template <int D>
Edge_cells count_edge_cells(const Snapshot<D>& snapshot, const Edge_cells_options& options = {});

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_QUERY_H
