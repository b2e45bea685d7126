// SPDX-License-Identifier: LGPL-3.0-or-later
// A particle followed from interval to interval, by the classes of linked cells that hold it.
#include <cellwalk/internal/edge/follow_edge.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <span>
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

  Followed_vertex<D> run(std::size_t choice, bool to_dead_end) {
    layers_.push_back({Cell_class{{p_.cell}, {}}});
    std::size_t most = 1;
    for (std::size_t k = 0; k < times_.size(); ++k) {
      const bool is_end = k + 1 == times_.size();
      std::vector<Cell_class> next =
          continued(times_[k], is_end ? times_[k] : time_between(times_[k], times_[k + 1]));
      if (next.empty()) break;
      for (std::size_t n = 0; n < layers_.back().size(); ++n)
        if (std::ranges::none_of(next, [&](const Cell_class& one) { return one.continues(n); }))
          dead_ends_.emplace_back(k, n);
      most = std::max(most, next.size());
      layers_.push_back(std::move(next));
    }
    if (to_dead_end && !dead_ends_.empty()) {
      const auto [layer, number] = dead_ends_[choice % dead_ends_.size()];
      Followed_vertex<D> result = way(layer, number, choice);
      result.collision = collision(std::span(&layers_[layer][number], 1), times_[layer]);
      return result;
    }
    const std::size_t last = layers_.size() - 1;
    Followed_vertex<D> result = way(last, choice % layers_.back().size(), choice);
    result.choices = most;
    result.dead_ends = dead_ends_.size();
    if (!result.is_free()) result.collision = collision(layers_.back(), times_[last]);
    return result;
  }

 private:
  /// Linked cells that hold the particle in an interval of time, or at the end.
  struct Cell_class {
    std::vector<Cell> cells;
    std::vector<std::size_t> parents;  ///< by number, those in the interval before that it continues

    bool continues(std::size_t number) const { return std::ranges::find(parents, number) != parents.end(); }
  };

  /// Some cells and all that are linked with them at a time.
  std::vector<Cell> linked_at(std::vector<Cell> cells, const Fraction& time) const {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Cell here = cells[k];
      const Cell_view<D> cell = snapshot_.view(here);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(here, i);
        if (snapshot_.is_impassable(f)) continue;
        const Cell next = snapshot_.neighbour(f);
        if (std::ranges::find(cells, next) != cells.end()) continue;
        if (clock_.holds_in_facet(cell, i, p_.position, time)) cells.push_back(next);
      }
    }
    return cells;
  }

  /// The classes that continue the last ones at a time, and hold the particle at a time inside the interval
  /// that follows; first those that hold the displaced particle, then those of the least corners.
  std::vector<Cell_class> continued(const Fraction& time, const Fraction& inside) const {
    std::vector<Cell_class> classes;
    for (std::size_t parent = 0; parent < layers_.back().size(); ++parent)
      for (const Cell c : linked_at(layers_.back()[parent].cells, time)) {
        const auto has_cell = [&](const Cell_class& known) {
          return std::ranges::find(known.cells, c) != known.cells.end();
        };
        auto at = std::ranges::find_if(classes, has_cell);
        if (at == classes.end()) {
          if (!clock_.holds(c, p_.position, inside)) continue;
          at = classes.insert(at, {linked_at({c}, inside), {}});
        }
        if (at->parents.empty() || at->parents.back() != parent) at->parents.push_back(parent);
      }
    if (classes.size() > 1)
      std::ranges::sort(classes, {}, [&](const Cell_class& one) { return order_of(one, inside); });
    return classes;
  }

  /// The key of the order of classes, the same for all particles at a place: whether the displaced particle
  /// is elsewhere, and the least corners.
  std::pair<bool, std::vector<Point<D>>> order_of(const Cell_class& one, const Fraction& inside) const {
    const auto holds = [&](Cell c) { return holds_displaced(c, inside); };
    std::pair<bool, std::vector<Point<D>>> order{std::ranges::none_of(one.cells, holds), {}};
    for (const Cell c : one.cells) take_least(snapshot_.view(c), order.second);
    return order;
  }

  bool holds_displaced(Cell c, const Fraction& time) const {
    const Cell_view<D> cell = snapshot_.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const int at = clock_.side(cell, i, p_.position, time);
      if (at > 0 || (at == 0 && displaced_side(cell, i) > 0)) return false;
    }
    return true;
  }

  /// A way through the layers up to a class of one: where there are several classes, that with the number of
  /// the choice, modulo theirs.
  Followed_vertex<D> way(std::size_t layer, std::size_t number, std::size_t choice) const {
    Followed_vertex<D> result;
    result.before = p_;
    for (std::size_t k = layer; k > 0; --k) {
      const Cell_class& here = layers_[k][number];
      const bool has_own = std::ranges::find(here.cells, p_.cell) != here.cells.end();
      const Cell cell = has_own ? p_.cell : here.cells.front();
      if (k == times_.size())
        result.end = cell;
      else
        result.stays.push_back({cell, times_[k]});
      number = here.parents[choice % here.parents.size()];
    }
    std::ranges::reverse(result.stays);
    return result;
  }

  /// The collision at a time with the wall that holds the particle, in some classes until then, with its
  /// lowest feature.
  std::optional<Collision> collision(std::span<const Cell_class> classes, const Fraction& time) const {
    const Moving_star<D>& star = clock_.star();
    std::vector<Cell> last;
    for (const Cell_class& one : classes) last.insert(last.end(), one.cells.begin(), one.cells.end());
    std::optional<Collision> first;
    for (const Cell c : linked_at(std::move(last), time)) {
      const Cell_view<D> cell = snapshot_.view(c);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        if (!snapshot_.is_impassable(f) || !has_point(cell, i, star.vertex())) continue;
        if (!clock_.holds_in_facet(cell, i, p_.position, time)) continue;
        keep_first(first, collision_at<D>(star, star.wall_of(f), time, {exact<D>(p_.position)}, {Ring(1)}));
      }
    }
    return first;
  }

  const Snapshot<D>& snapshot_;
  const Star_clock<D> clock_;
  const Particle<D>& p_;
  std::vector<Fraction> times_;
  std::vector<std::vector<Cell_class>> layers_;  ///< before the start, in each interval, and at the end
  std::vector<std::pair<std::size_t, std::size_t>> dead_ends_;  ///< layers and classes that nothing continues
};

}  // namespace

template <int D>
Followed_vertex<D> follow_vertex(const Moving_star<D>& star, const Particle<D>& p, std::size_t choice,
                                 bool to_dead_end) {
  return Vertex_search<D>(star, p).run(choice, to_dead_end);
}

template Followed_vertex<2> follow_vertex(const Moving_star<2>&, const Particle<2>&, std::size_t, bool);
template Followed_vertex<3> follow_vertex(const Moving_star<3>&, const Particle<3>&, std::size_t, bool);

}  // namespace cellwalk::detail
