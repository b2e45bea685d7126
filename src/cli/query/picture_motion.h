// SPDX-License-Identifier: LGPL-3.0-or-later
// Parts of pictures of motions in the plane and in space.
#ifndef CELLWALK_CLI_QUERY_PICTURE_MOTION_H
#define CELLWALK_CLI_QUERY_PICTURE_MOTION_H

#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/records/queries.h>
#include <cellwalk/query/query.h>

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

#include "cli/common/contact_kind_names.h"

namespace cellwalk::cli {

/// The answer in words.
/// \param mover the name of the point that moves
template <int D>
std::string title_of(std::size_t row, const Answer<D>& answer, const char* mover) {
  if (answer.cell == Cell::none) return fmt::format("row {}: does not start in free space", row);
  const char* const article = answer.contact && answer.contact->kind == Contact_kind::edge ? "an" : "a";
  const char* const kind =
      answer.contact ? contact_kind_names[static_cast<std::size_t>(answer.contact->kind)] : "";
  if (answer.status == Motion_status::close)
    return fmt::format("row {}: starts at a distance of {:.4g} from {} {}", row, answer.contact->distance,
                       article, kind);
  const std::string cells =
      fmt::format("{} visits {} {}", mover, answer.cells, answer.cells == 1 ? "cell" : "cells");
  if (!answer.contact) return fmt::format("row {}: free; {}", row, cells);
  return fmt::format("row {}: contact with {} {} at time {:.4g}; {}", row, article, kind,
                     answer.contact->time, cells);
}

/// A point or an edge that moves, for a picture.
template <int D>
struct Pictured_motion {
  template <std::size_t N>
  Pictured_motion(const Query_row<D, N>& motion, const Answer<D>& answer)
      : points(motion.points.begin(), motion.points.end()),
        radius(motion.radius),
        end(answer.contact ? point_on<D>(points[0], points[1], answer.contact->time) : points[1]) {}

  bool is_edge() const { return points.size() == 3; }
  const char* name(std::size_t point) const {
    constexpr const char *of_edge[] = {"p", "t", "q"}, *of_point[] = {"a", "b"};
    return is_edge() ? of_edge[point] : of_point[point];
  }
  /// The point alone or with the end that stands still.
  std::vector<Point<D>> at(const Point<D>& place) const {
    return is_edge() ? std::vector{place, points[2]} : std::vector{place};
  }
  /// The corners of all that it sweeps until it ends.
  std::vector<Point<D>> swept() const {
    std::vector<Point<D>> corners = at(points[0]);
    corners.push_back(end);
    return corners;
  }

  std::vector<Point<D>> points;  ///< from where to where, and of an edge the end that stands still
  double radius;
  Point<D> end;  ///< of the motion: its target, or where it stops
};

/// The corner of a hull that is furthest in a direction.
template <int D>
Point<D> furthest(const std::vector<Point<D>>& corners, const Vector<D>& direction) {
  Point<D> best = corners.front();
  for (const Point<D>& x : corners)
    if (dot(direction, x - best) > 0) best = x;
  return best;
}

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_PICTURE_MOTION_H
