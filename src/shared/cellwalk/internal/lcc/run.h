// SPDX-License-Identifier: LGPL-3.0-or-later
// One walk on a map, from dart to dart. Theory: docs/walk.md.
#ifndef CELLWALK_INTERNAL_LCC_RUN_H
#define CELLWALK_INTERNAL_LCC_RUN_H

#include <cellwalk/internal/lcc/choices.h>
#include <cellwalk/internal/lcc/exit.h>
#include <cellwalk/internal/lcc/star.h>
#include <cellwalk/internal/lcc/types.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cellwalk::lcc::detail {

/// Facets that no motion passes: those on the boundary, and those that the user names.
template <class Lcc, class Is_wall>
struct Blocks {
  const Cells<Lcc>& cells;
  const Is_wall& is_wall;

  bool operator()(Dart<Lcc> facet) const { return cells.is_on_boundary(facet) || is_wall(facet); }
};

/// \tparam Blocks_of facets that no motion passes
template <class Lcc, class Blocks_of>
class Run {
 public:
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;
  using Exit_of = Exit<Lcc>;
  using Choices_of = Choices<Dart_of>;

  Run(const Signs<Lcc>& signs, const Blocks_of& blocks, const Particle<Lcc>& from, const Point& target)
      : signs_(signs),
        cells_(signs.cells()),
        blocks_(blocks),
        a_(from.position),
        b_(target),
        exits_(signs, a_, b_),
        places_(signs, a_, b_),
        dart_(from.dart) {}

  /// \param choices the sides to take; others taken are added
  /// \param visited if not null, receives a dart of each cell visited
  Walk<Lcc> run(Choices_of& choices, std::vector<Dart_of>* visited = nullptr) {
    choices_ = &choices;
    visited_ = visited;
    ++signs_.counts().walks;
    if (visited_) visited_->push_back(dart_);
    // Each cell and place accepted holds a further piece of the motion, if signs are exact.
    const std::size_t limit = 4 * cells_.map().number_of_darts() + 64;
    for (std::size_t steps = 0; step(); ++steps)
      if (steps == limit) {
        result_.status = Status::lost;
        break;
      }
    result_.dart = dart_;
    return result_;
  }

 private:
  /// Leaves the cell or ends the walk; true if the walk continues.
  bool step() {
    Dart_of aimed = dart_;
    if (const auto exit = exits_.by_simplex(aimed)) {
      dart_ = aimed;
      return exit->kind == Exit_of::facet ? pass(aimed) : false;
    }
    ++signs_.counts().rules;
    return step_by_rule();
  }

  bool step_by_rule() {
    const auto facets = cells_.facets(dart_);
    boost::container::small_vector<std::int8_t, 16> sides;
    bool is_on_planes = false;
    for (const Dart_of facet : facets) {
      sides.push_back(static_cast<std::int8_t>(signs_.side(facet, b_)));
      is_on_planes |= sides.back() == 0;
    }
    const Exit_of exit = exits_.by_rule(facets, sides);
    // Where the motion runs in the boundary of the cell, walls may begin on it before it leaves.
    if (may_be_in_boundary_ && is_on_planes) {
      const Exit_of place = places_.next(facets, sides, passed_time(), exit.kind == Exit_of::arrived);
      if (place.kind != Exit_of::none) return pass_star(place);
      may_be_in_boundary_ = false;
    }
    switch (exit.kind) {
      case Exit_of::facet:
        return pass(exit.dart);
      case Exit_of::ridge:
      case Exit_of::vertex:
        return pass_star(exit);
      case Exit_of::none:
        result_.status = Status::lost;
        return false;
      default:
        return false;
    }
  }

  /// When the ridge or vertex passed last was passed.
  std::optional<Rational> passed_time() const {
    if (!passed_ || passed_->time) return passed_ ? passed_->time : std::nullopt;
    if constexpr (Cells<Lcc>::D == 3)
      if (passed_->kind == Exit_of::ridge)
        return signs_.time_at(cells_.point(passed_->dart), cells_.end(passed_->dart), a_, b_);
    return signs_.time_at(cells_.point(passed_->dart), a_, b_);
  }

  /// Passes the interior of a facet; false if the walk ends there.
  bool pass(Dart_of facet) {
    if (blocks_(facet)) return block(facet, facet, Lcc::dimension - 1);
    const Dart_of behind = cells_.opposite(facet);
    // The motion does not leave where it enters.
    enter(Cells<Lcc>::D == 3 ? cells_.across_edge(behind) : cells_.next(behind));
    may_be_in_boundary_ = false;
    return true;
  }

  /// Continues at a ridge or vertex of the cell; false if the walk ends there.
  bool pass_star(const Exit_of& place) {
    const Star<Lcc, Blocks_of> star(signs_, blocks_, place.feature(), a_, b_);
    if (star.side_count() == 0) {
      if (const auto wall = star.wall())
        return block(wall->facet, wall->feature.dart, place.kind == Exit_of::vertex ? 0 : 1);
      result_.status = Status::lost;  // signs contradict each other
      return false;
    }
    std::size_t side = 0;
    if (star.side_count() > 1) {
      result_.had_choice = true;
      side = choices_->take({star.name(), place.kind == Exit_of::vertex, star.side_count()});
    }
    const Feature<Lcc> next = star.on_side(side);
    passed_ = place;
    if (!star.is_start(next)) enter(next.dart);
    may_be_in_boundary_ = true;
    return true;
  }

  void enter(Dart_of next) {
    ++signs_.counts().crossings;
    ++result_.cells;
    dart_ = next;
    if (visited_) visited_->push_back(next);
  }

  bool block(Dart_of wall, Dart_of feature, int dimension) {
    const auto time = signs_.time_at(wall, a_, b_);
    if (!time) {
      result_.status = Status::lost;  // by rounded signs only
      return false;
    }
    result_.status = Status::contact;
    result_.contact = Contact<Lcc>{*time, dimension, wall, feature, inner_normal(signs_, wall)};
    return false;
  }

  const Signs<Lcc>& signs_;
  const Cells<Lcc>& cells_;
  const Blocks_of& blocks_;
  const Point &a_, &b_;
  const Exit_finder<Lcc> exits_;
  const Boundary_places<Lcc> places_;
  Choices_of* choices_ = nullptr;
  std::vector<Dart_of>* visited_ = nullptr;
  Dart_of dart_;
  Walk<Lcc> result_;
  std::optional<Exit_of> passed_;   ///< the last ridge or vertex passed
  bool may_be_in_boundary_ = true;  ///< the motion may run in the boundary of the cell
};

}  // namespace cellwalk::lcc::detail

#endif  // CELLWALK_INTERNAL_LCC_RUN_H
