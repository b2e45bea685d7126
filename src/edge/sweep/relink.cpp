// SPDX-License-Identifier: LGPL-3.0-or-later
// The chains just after a time, searched among all cells linked with the edge in its plane.
#include "relink.h"

#include <cellwalk/internal/edge/may_intersect.h>
#include <cellwalk/internal/walk/link_search.h>

#include <algorithm>

#include "edge/chain/chain_search.h"
#include "edge/chain/equal_chains.h"

namespace cellwalk::detail {
namespace {

/// True if the plane of a facet of a cell contains the triangle.
template <int D>
bool holds_triangle(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell c) {
  const Cell_view<D> cell = snapshot.view(c);
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (line.holds_triangle(cell, i)) return true;
  return false;
}

template <int D>
class Relink_search {
 public:
  Relink_search(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start, const Particle<D>& q,
                const Chain& chain)
      : snapshot_(snapshot),
        line_(line),
        start_(start),
        q_(q),
        chain_(chain),
        now_(at(line.time().value())),
        pieces_(pieces_of<D>(snapshot, now_, start, {chain.data(), chain.size()}, 1)),
        cells_(linked_cells(snapshot, start, [&](const Cell_view<D>& cell, std::size_t i) {
          return now_.in_facet(cell, i).has_value();
        })) {}

  /// Finds at most `most` chains that are not equal to each other, in the order of preference.
  std::vector<Relinked<D>> run(std::size_t most) {
    if (!lies_in_plane()) return {};
    const Event_time<D> end = next_root();
    after_.emplace(line_.triangle(), middle(line_.time().value(), end.value()));
    most_ = most;
    Chain_search<D, Relink_search> search(snapshot_, *after_, q_, *this, line_.counts());
    if (most == 1)
      search.find(start_);
    else
      search.find_by_sides(start_);
    std::vector<Relinked<D>> relinked;
    for (Chain& chain : found_) relinked.push_back({std::move(chain), end});
    return relinked;
  }

  /// True if a path is not equal to the chain up to a parameter.
  bool is_wrong(const Chain& path, const Fraction& end) const {
    const auto pieces = pieces_of<D>(snapshot_, now_, start_, {path.data(), path.size()}, end);
    return parting_of(snapshot_, now_, pieces_, pieces).has_value();
  }
  /// The parameter at this time of the point at which the edge passes a border just after it.
  Fraction limit_of(const Cell_view<D>& cell, std::size_t i, int border) const {
    return now_.at_border(cell, i, border);
  }
  /// Keeps a chain, and accepts the last one that is looked for.
  bool is_accepted(const Chain& path) {
    Half_facet wall = Half_facet::none;
    if (are_equal(snapshot_, now_, start_, chain_, path, wall) &&
        std::ranges::none_of(found_, [&](const Chain& other) {
          return are_equal(snapshot_, *after_, start_, other, path, wall);
        }))
      found_.push_back(path);
    return found_.size() == most_;
  }
  /// There are only two sides, so those that are not preferred need no order.
  bool comes_before(const Cell_view<D>&, const Cell_view<D>&) const { return false; }

 private:
  Rational_segment<D> at(const Fraction& time) const { return {line_.triangle(), time}; }

  bool lies_in_plane() const {
    return std::any_of(cells_.begin(), cells_.end(),
                       [&](Cell c) { return holds_triangle(snapshot_, line_, c); });
  }

  /// The time until which the edge passes the facets of these cells in the same way.
  Event_time<D> next_root() const {
    Event_time<D> end(1.0);
    const auto note = [&](const Event_time<D>& root) {
      if (root < end) end = root;
    };
    for (const Cell c : cells_) {
      const Cell_view<D> cell = snapshot_.view(c);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) line_.for_all_roots(cell, i, note);
    }
    return end;
  }

  const Snapshot<D>& snapshot_;
  const Moving_line<D>& line_;
  const Cell start_;
  const Particle<D>& q_;
  const Chain& chain_;
  const Rational_segment<D> now_;
  const std::vector<Piece> pieces_;  ///< of the chain
  const std::vector<Cell> cells_;    ///< linked with the chain somewhere on the edge
  std::optional<Rational_segment<D>> after_;
  std::vector<Chain> found_;  ///< chains of the edge after that time
  std::size_t most_ = 1;
};

/// False proves that the plane of no facet (`of_walls`: of no wall) of the cells linked with the edge
/// contains the triangle.
template <int D>
bool may_lie_in_plane(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start, bool of_walls) {
  Flooded cells{start};
  for (std::size_t head = 0; head < cells.size(); ++head) {
    const Cell c = cells[head];
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const bool is_wall = snapshot.is_impassable(f);
      if ((is_wall || !of_walls) && line.holds_triangle(cell, i)) return true;
      if (is_wall) continue;
      const Cell next = snapshot.neighbour(f);
      if (std::find(cells.begin(), cells.end(), next) == cells.end() &&
          may_overlap(cell, i, line.triangle(), line.counts()))
        cells.push_back(next);
    }
  }
  return false;
}

}  // namespace

bool has_wall_in_plane(const Snapshot<3>& snapshot, const Moving_line<3>& line, Cell start) {
  return may_lie_in_plane(snapshot, line, start, true);
}

template <int D>
std::vector<Relinked<D>> relink_on_all_sides(const Snapshot<D>& snapshot, const Moving_line<D>& line,
                                             Cell start, const Particle<D>& q, const Chain& chain,
                                             std::size_t most) {
  if (!may_lie_in_plane(snapshot, line, start, false)) return {};
  return Relink_search<D>(snapshot, line, start, q, chain).run(most);
}

template <int D>
std::optional<Relinked<D>> relink(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start,
                                  const Particle<D>& q, const Chain& chain) {
  auto relinked = relink_on_all_sides(snapshot, line, start, q, chain, 1);
  return relinked.empty() ? std::nullopt : std::optional(std::move(relinked.front()));
}

#define CELLWALK_INSTANTIATE(D)                                                                          \
  template std::optional<Relinked<D>> relink(const Snapshot<D>&, const Moving_line<D>&, Cell,            \
                                             const Particle<D>&, const Chain&);                          \
  template std::vector<Relinked<D>> relink_on_all_sides(const Snapshot<D>&, const Moving_line<D>&, Cell, \
                                                        const Particle<D>&, const Chain&, std::size_t);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
