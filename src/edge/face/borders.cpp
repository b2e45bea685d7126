// SPDX-License-Identifier: LGPL-3.0-or-later
// The comparison of the chain of each edge with the side on which its face begins.
#include "borders.h"

#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <vector>

#include "edge/chain/chain_side.h"

namespace cellwalk::detail {
namespace {

/// An edge of a face and the corner opposite to it, towards which the face extends from the edge.
class Border {
 public:
  Border(const Snapshot<3>& snapshot, const Face_side& side, const Point<3>& opposite,
         const Supporting_walls& supporting_walls, Walk_counts& counts)
      : snapshot_(snapshot),
        side_(side),
        opposite_(opposite),
        supporting_walls_(supporting_walls),
        counts_(counts) {}

  Half_facet wall_between(const Candidate_walls& candidates) {
    boost::container::small_vector<Half_facet, 4> holding;
    for (const Half_facet wall : candidates.walls)
      if (side(wall, side_.from) == 0 && side(wall, side_.to) == 0 && side(wall, opposite_) != 0)
        holding.push_back(wall);  // contains the edge, but not the face
    if (holding.empty()) return Half_facet::none;
    edge_.emplace(snapshot_, side_.from, side_.to);
    // Between the ends of the parts of the edge in walls, the middle decides for all points.
    std::vector<Fraction> ends;
    for (const Half_facet wall : candidates.walls) {
      const std::optional<Span> met = edge_->in_facet(wall);
      if (met) ends.insert(ends.end(), {met->low, met->high});
    }
    std::sort(ends.begin(), ends.end());
    for (const Half_facet wall : holding) {
      const std::optional<Span> met = edge_->in_facet(wall);
      for (std::size_t k = 0; met && k + 1 < ends.size(); ++k) {
        if (!(ends[k] < ends[k + 1]) || ends[k] < met->low || ends[k + 1] > met->high) continue;
        if (!begins_at(middle(ends[k], ends[k + 1]))) return towards_face(wall);
      }
    }
    return Half_facet::none;
  }

 private:
  int side(Half_facet f, const Point<3>& x) const {
    return detail::side<Exact>(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f), x, counts_);
  }

  /// True if the face begins in one of the cells that are linked with the chain at the point at t.
  bool begins_at(const Fraction& t) const {
    for (const Cell c : linked_cells(*edge_, side_.start, *side_.chain.chain, t)) {
      bool holds_face = true;
      for (std::size_t i = 0; i < snapshot_.facet_count(c) && holds_face; ++i) {
        const Half_facet f = Snapshot<3>::half_facet(c, i);
        const std::optional<Span> met = edge_->in_facet(f);
        if (!met || t < met->low || met->high < t) continue;
        // The point lies in the plane of f: the face is on the side of the opposite corner. If the face lies
        // in a wall, its supporting walls determine the side. A wall across the edge from it does not.
        const int of_face = side(f, opposite_);
        holds_face =
            of_face < 0 ||
            (of_face == 0 && (!snapshot_.is_impassable(f) || is_supporting(f) || !extends_to_face(f)));
      }
      if (holds_face) return true;
    }
    return false;
  }

  /// Whether a facet in the plane of the face has points on the side of the edge on which the face is.
  bool extends_to_face(Half_facet f) const {
    const Cell_view<3> cell = snapshot_.view(snapshot_.cell_of(f));
    const auto loop = cell.loop(snapshot_.facet_of(f));
    std::size_t off = 0;  // a corner of the cell that is not in the plane
    while (side(f, cell.point(off)) == 0) ++off;
    const auto turn = [&](const Point<3>& x) {
      return Exact::orientation(counts_.predicates, side_.from, side_.to, cell.point(off), x);
    };
    const int of_face = turn(opposite_);
    return std::any_of(loop.begin(), loop.end(),
                       [&](std::uint16_t v) { return turn(cell.point(v)) * of_face > 0; });
  }

  bool is_supporting(Half_facet f) const {
    return std::find(supporting_walls_.begin(), supporting_walls_.end(), f) != supporting_walls_.end();
  }

  /// The side of a wall on which the face lies.
  Half_facet towards_face(Half_facet wall) const {
    const Half_facet other = snapshot_.opposite(wall);
    return side(wall, opposite_) > 0 && other != Half_facet::none ? other : wall;
  }

  const Snapshot<3>& snapshot_;
  const Face_side& side_;
  const Point<3>& opposite_;
  const Supporting_walls& supporting_walls_;
  std::optional<Exact_edge> edge_;  ///< made only if a wall contains it, which is rare
  Walk_counts& counts_;
};

}  // namespace

Half_facet wall_at_border(const Snapshot<3>& snapshot, const std::array<Face_side, 3>& sides,
                          const Candidate_walls& candidates, const Supporting_walls& supporting_walls,
                          Walk_counts& counts) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Face_side& next = sides[(k + 1) % 3];
    const Point<3>& opposite = next.chain.is_reversed ? next.from : next.to;
    const Half_facet wall =
        Border(snapshot, sides[k], opposite, supporting_walls, counts).wall_between(candidates);
    if (wall != Half_facet::none) return wall;
  }
  return Half_facet::none;
}

Contact<3> contact_at_start(const Snapshot<3>& snapshot, Half_facet wall, const Point<3>& start) {
  Contact<3> contact;
  contact.point = start;
  contact.body = Body_feature::edge;
  contact.facet = wall;
  contact.cell = snapshot.cell_of(wall);
  contact.normal = inner_normal(snapshot.view(contact.cell), snapshot.facet_of(wall));
  return contact;
}

}  // namespace cellwalk::detail
