// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/follow_edge.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <utility>

#include "star_clock.h"

namespace cellwalk::detail {
namespace {

template <int D>
class Vertex_search {
 public:
  Vertex_search(const Moving_star<D>& star, const Particle<D>& p)
      : snapshot_(star.snapshot()), clock_(star), p_(p) {
    clock_.add_passings(p.position, times_);
    complete_times(times_);
  }

  Followed_vertex run(std::size_t choice) {
    Followed_vertex result;
    std::vector<Reached> now{{p_.cell, 0}};
    for (std::size_t k = 0; k + 1 < times_.size(); ++k) {
      const std::vector<Reached> linked = linked_at(now, times_[k]);
      const Fraction middle = time_between(times_[k], times_[k + 1]);
      now.clear();
      for (const Reached& there : linked)
        if (clock_.holds(there.cell, p_.position, middle)) now.push_back(there);
      if (now.empty()) {
        result.block = block(linked, times_[k]);
        result.cells = way_to(linked.front());
        return result;
      }
      layers_.push_back(now);
    }
    const std::vector<std::vector<Reached>> ends = classes_of(linked_at(now, Fraction(1)));
    const std::vector<Reached>& chosen = ends[choice % ends.size()];
    const auto same = std::ranges::find(chosen, p_.cell, &Reached::cell);
    result.is_free = true;
    result.choices = ends.size();
    result.cells = way_to(same != chosen.end() ? *same : chosen.front());
    return result;
  }

 private:
  /// A cell and, by number, the one in the interval before from which it was reached.
  struct Reached {
    Cell cell;
    std::size_t parent;
  };

  /// All cells linked at a time with some of those in the interval before it, and these first.
  std::vector<Reached> linked_at(const std::vector<Reached>& before, const Fraction& time) const {
    std::vector<Reached> result;
    for (std::size_t k = 0; k < before.size(); ++k) result.push_back({before[k].cell, k});
    for (std::size_t k = 0; k < result.size(); ++k) {
      const Reached here = result[k];
      const Cell_view<D> cell = snapshot_.view(here.cell);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(here.cell, i);
        if (snapshot_.is_impassable(f)) continue;
        const Cell next = snapshot_.neighbour(f);
        if (std::ranges::find(result, next, &Reached::cell) != result.end()) continue;
        if (clock_.holds_in_facet(cell, i, p_.position, time)) result.push_back({next, here.parent});
      }
    }
    return result;
  }

  /// Cells after the move by which of them are linked; first those that hold the displaced particle.
  std::vector<std::vector<Reached>> classes_of(const std::vector<Reached>& ends) const {
    std::vector<std::vector<Reached>> classes;
    for (const Reached& end : ends) {
      if (std::ranges::any_of(classes, [&](const auto& known) {
            return std::ranges::find(known, end.cell, &Reached::cell) != known.end();
          }))
        continue;
      std::vector<Reached> linked = linked_at({end}, Fraction(1));
      for (Reached& there : linked) there.parent = end.parent;
      const bool is_displaced =
          std::ranges::any_of(linked, [&](const Reached& there) { return holds_displaced(there.cell); });
      classes.insert(is_displaced ? classes.begin() : classes.end(), std::move(linked));
    }
    return classes;
  }

  bool holds_displaced(Cell c) const {
    const Cell_view<D> cell = snapshot_.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const int at = clock_.side(cell, i, p_.position, Fraction(1));
      if (at > 0 || (at == 0 && displaced_side(cell, i) > 0)) return false;
    }
    return true;
  }

  Cells_of_vertex way_to(const Reached& end) const {
    Cells_of_vertex cells;
    cells.end = end.cell;
    std::size_t number = end.parent;
    for (std::size_t k = layers_.size(); k-- > 0;) {
      const Reached& here = layers_[k][number];
      cells.stays.push_back({here.cell, times_[k + 1]});
      number = here.parent;
    }
    std::ranges::reverse(cells.stays);
    return cells;
  }

  /// The wall that holds the particle at a time with its lowest feature.
  std::optional<Star_block> block(const std::vector<Reached>& linked, const Fraction& time) const {
    const Moving_star<D>& star = clock_.star();
    std::optional<Star_block> first;
    for (const Reached& there : linked) {
      const Cell_view<D> cell = snapshot_.view(there.cell);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(there.cell, i);
        if (!snapshot_.is_impassable(f) || !has_point(cell, i, star.vertex())) continue;
        if (!clock_.holds_in_facet(cell, i, p_.position, time)) continue;
        const std::size_t wall = star.wall_of(f);
        Star_block next{wall, hit_at<D>(star, wall, time, {exact<D>(p_.position)}, {Ring(1)})};
        if (!first || is_before(next.hit, first->hit)) first = std::move(next);
      }
    }
    return first;
  }

  const Snapshot<D>& snapshot_;
  const Star_clock<D> clock_;
  const Particle<D>& p_;
  std::vector<Fraction> times_;
  std::vector<std::vector<Reached>> layers_;  ///< of each interval between times
};

}  // namespace

template <int D>
Followed_vertex follow_vertex(const Moving_star<D>& star, const Particle<D>& p, std::size_t choice) {
  return Vertex_search<D>(star, p).run(choice);
}

template Followed_vertex follow_vertex<2>(const Moving_star<2>&, const Particle<2>&, std::size_t);
template Followed_vertex follow_vertex<3>(const Moving_star<3>&, const Particle<3>&, std::size_t);

}  // namespace cellwalk::detail
