// SPDX-License-Identifier: LGPL-3.0-or-later
// The patches of flips, splits and collapses, with the reasons why they may not be made.
#include "replacement.h"

#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "wall_edge.h"

namespace cellwalk::detail {
namespace {

/// Rings of more cells are left alone.
constexpr std::size_t most_ring = 7;

template <int D>
bool has_vertex(const Snapshot<D>& snapshot, Cell c, std::uint32_t point) {
  const auto vertices = snapshot.view(c).vertices;
  return std::ranges::find(vertices, point) != vertices.end();
}

Replacement refused(std::string reason) {
  Replacement result;
  result.reason = std::move(reason);
  return result;
}

std::string edge_name(std::uint32_t u, std::uint32_t v) {
  return "edge " + std::to_string(u) + "-" + std::to_string(v);
}

[[noreturn]] void refuse_use(const std::string& what) { throw Error(Error_code::usage, what); }

template <int D>
void check_is_finite(const Point<D>& position) {
  if (!is_finite(position))
    throw Error(Error_code::input, "the new position is not finite: correct its coordinates");
}

/// The triangulation of a ring of points around an edge with the best least quality, all its cells positive.
class Ring_triangulation {
 public:
  Ring_triangulation(const Snapshot<3>& snapshot, const std::vector<std::uint32_t>& ring, std::uint32_t u,
                     std::uint32_t v)
      : snapshot_(snapshot), ring_(ring), u_(u), v_(v) {
    const std::size_t n = ring.size();
    for (std::size_t size = 2; size < n; ++size)
      for (std::size_t i = 0; i + size < n; ++i)
        for (std::size_t k = i + 1; k < i + size; ++k) {
          const double least = std::min({quality_of(i, k, i + size), best(i, k), best(k, i + size)});
          if (least <= at(i, i + size).least) continue;
          at(i, i + size) = {least, k};
        }
  }

  /// Appends the cells; false if there are none that are positive.
  bool append(std::vector<Patch<3>::Simplex>& cells) const {
    return best(0, ring_.size() - 1) > 0 && (append(cells, 0, ring_.size() - 1), true);
  }

 private:
  struct Best {
    double least = 0;
    std::size_t apex = 0;
  };
  Best& at(std::size_t i, std::size_t j) { return best_[i][j]; }
  double best(std::size_t i, std::size_t j) const { return j == i + 1 ? 1e300 : best_[i][j].least; }
  std::array<Patch<3>::Simplex, 2> cells(std::size_t i, std::size_t j, std::size_t k) const {
    return {{{ring_[i], ring_[j], ring_[k], v_}, {ring_[j], ring_[i], ring_[k], u_}}};
  }
  /// The lesser quality of the two cells on a triangle of the ring; 0 if one is not positive.
  double quality_of(std::size_t i, std::size_t j, std::size_t k) const {
    double least = 1e300;
    Predicate_counts counts;
    for (const Patch<3>::Simplex& cell : cells(i, j, k)) {
      const Corners_of_simplex<3> x = Patch<3>{}.corners(snapshot_, cell);
      if (Exact::orientation(counts, x[0], x[1], x[2], x[3]) <= 0) return 0;
      // Rounding must not make a sound cell unsound, nor the other way round.
      least = std::min(least, std::max(quality<3>(x), 1e-300));
    }
    return least;
  }
  void append(std::vector<Patch<3>::Simplex>& cells_of, std::size_t i, std::size_t j) const {
    if (j == i + 1) return;
    const std::size_t k = best_[i][j].apex;
    for (const Patch<3>::Simplex& cell : cells(i, k, j)) cells_of.push_back(cell);
    append(cells_of, i, k);
    append(cells_of, k, j);
  }

  const Snapshot<3>& snapshot_;
  const std::vector<std::uint32_t>& ring_;
  std::uint32_t u_, v_;
  std::array<std::array<Best, most_ring>, most_ring> best_{};
};

}  // namespace

template <int D>
void Replacer<D>::check_edit() const {
  if (transaction_.environment().is_frozen())
    refuse_use("the environment is frozen: thaw() it to replace cells");
}

template <int D>
void Replacer<D>::check_simplices(const std::vector<Cell>& cells) const {
  for (const Cell c : cells)
    if (snapshot().view(c).vertex_count() != D + 1)
      refuse_use("cell " + std::to_string(snapshot().index(c)) +
                 " cannot be replaced among bodies: it is not a simplex; build the environment with "
                 "Build_options::simplicial");
}

template <int D>
void Replacer<D>::check_point(std::uint32_t point) const {
  if (!snapshot().is_point(point)) refuse_use("there is no point " + std::to_string(point));
}

template <int D>
void Replacer<D>::check_points(std::span<const std::uint32_t> points) const {
  check_edit();
  for (const std::uint32_t point : points) {
    check_point(point);
    check_simplices(transaction_.environment().cells_around(point));
  }
}

/// All cells that have both points.
template <int D>
std::vector<Cell> Replacer<D>::cells_at_edge(std::uint32_t u, std::uint32_t v) const {
  check_edit();
  check_point(u);
  check_point(v);
  std::vector<Cell> cells = transaction_.environment().cells_around(u);
  if (u != v) std::erase_if(cells, [&](Cell c) { return !has_vertex(snapshot(), c, v); });
  if (u == v || cells.empty()) refuse_use("there is no " + edge_name(u, v));
  check_simplices(cells);
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// True if a facet with both points is a wall, or lies on the boundary.
template <int D>
bool Replacer<D>::has_wall_at_edge(const std::vector<Cell>& cells, std::uint32_t u, std::uint32_t v) const {
  return std::ranges::any_of(cells, [&](Cell c) {
    const Cell_view<D> view = snapshot().view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i)
      if (has_point(view, i, u) && has_point(view, i, v) &&
          snapshot().is_impassable(Snapshot<D>::half_facet(c, i)))
        return true;
    return false;
  });
}

/// The points around an inner edge, in their order around it from u to v; empty if they are not one ring.
template <int D>
std::vector<std::uint32_t> Replacer<D>::ring(const std::vector<Cell>& cells, std::uint32_t u,
                                             std::uint32_t v) const {
  std::vector<std::uint32_t> result;
  if constexpr (D == 3) {
    std::vector<std::array<std::uint32_t, 2>> steps;
    for (const Cell c : cells) {
      auto x = corners_of(snapshot(), c);
      // Even permutations until u is first, then until v is second.
      while (x[0] != u)
        x = x[3] == u ? std::array{x[3], x[1], x[0], x[2]} : std::array{x[1], x[2], x[0], x[3]};
      while (x[1] != v) x = {x[0], x[2], x[3], x[1]};
      steps.push_back({x[2], x[3]});
    }
    std::sort(steps.begin(), steps.end());
    result.push_back(steps.front()[0]);
    while (result.size() <= steps.size()) {
      const auto step = std::ranges::find(steps, result.back(), [](const auto& entry) { return entry[0]; });
      if (step == steps.end()) return {};
      if ((*step)[1] == result.front()) break;
      result.push_back((*step)[1]);
    }
    if (result.size() != steps.size()) return {};
  }
  return result;
}

template <int D>
bool Replacer<D>::is_off_walls(std::uint32_t point) const {
  return !has_wall_at_edge(transaction_.environment().cells_around(point), point, point);
}

template <int D>
Replacement Replacer<D>::make(const Patch<D>& patch) {
  transaction_.prefetch(patch.removed);
  Cell_soup<D> soup;
  Gluing gluing;
  if (std::string reason = check_patch(snapshot(), patch, soup, gluing); !reason.empty())
    return refused(std::move(reason));
  prepare(patch);
  return replace(patch, soup, gluing);
}

/// Before cells are replaced.
template <int D>
void Replacer<D>::prepare(const Patch<D>& patch) {
  mover_.restore();
  transaction_.open(patch.removed);
  transaction_.note(patch.removed);
}

template <int D>
Replacement Replacer<D>::replace(const Patch<D>& patch, const Cell_soup<D>& soup, const Gluing& gluing) {
  Replacement result;
  if (patch.added) result.point = snapshot().next_point();
  result.cells =
      transaction_.replace(patch.removed, soup, gluing, patch.added, Cell_transaction<D>::Into::all);
  result.is_made = true;
  return result;
}

template <int D>
Replacement Replacer<D>::insert_point(Cell cell, const Point<D>& position) {
  check_edit();
  check_is_finite<D>(position);
  if (!snapshot().is_cell(cell))
    refuse_use("there is no cell with the name " + std::to_string(to_index(cell)));
  check_simplices({cell});
  Patch<D> patch{{cell}, {}, position};
  const auto corners = corners_of(snapshot(), cell);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    patch.cells.push_back(corners);
    patch.cells.back()[k] = snapshot().next_point();
  }
  Replacement result = make(patch);
  if (!result.is_made) result.reason = "the point does not lie strictly inside the cell";
  return result;
}

template <int D>
Patch<D> Replacer<D>::split(std::uint32_t u, std::uint32_t v, const Point<D>& position,
                            std::string& reason) const {
  Patch<D> patch{cells_at_edge(u, v), {}, position};
  check_is_finite<D>(position);
  if (has_wall_at_edge(patch.removed, u, v)) reason = "a wall or the boundary has the edge";
  // Each facet at the edge lies between two of the cells, and both get its halves; all others stay.
  patch.covers = reason.empty();
  const std::uint32_t point = snapshot().next_point();
  patch.cells.reserve(2 * patch.removed.size());
  for (const Cell c : patch.removed) {
    const auto corners = corners_of(snapshot(), c);
    for (const std::uint32_t end : {u, v})
      std::ranges::replace(patch.cells.emplace_back(corners), end, point);
  }
  return patch;
}

template <int D>
Patch<D> Replacer<D>::flipped(Half_facet facet, std::string& reason) const {
  check_edit();
  const Cell own = to_index(facet) < snapshot().half_facet_slots() ? snapshot().cell_of(facet) : Cell::none;
  if (own == Cell::none || !snapshot().is_cell(own) ||
      snapshot().facet_of(facet) >= snapshot().facet_count(own))
    refuse_use("there is no half-facet " + std::to_string(to_index(facet)));
  const Cell other = snapshot().neighbour(facet);
  if (other == Cell::none || snapshot().is_impassable(facet)) {
    reason = "the facet is a wall";
    return {};
  }
  check_simplices({own, other});
  const std::vector<std::uint32_t> loop = snapshot().loop(facet);
  const auto apex_of = [&](Cell c) {
    for (const std::uint32_t v : snapshot().view(c).vertices)
      if (std::ranges::find(loop, v) == loop.end()) return v;
    return loop[0];
  };
  const std::uint32_t d = apex_of(own), e = apex_of(other);
  if constexpr (D == 2)
    return {{own, other}, {{loop[0], e, d}, {e, loop[1], d}}, {}};
  else
    return {{own, other}, {{d, e, loop[0], loop[1]}, {d, e, loop[1], loop[2]}, {d, e, loop[2], loop[0]}}, {}};
}

template <int D>
Patch<D> Replacer<D>::without_edge(std::uint32_t u, std::uint32_t v, std::string& reason) const {
  if constexpr (D == 2) {
    refuse_use("edges are removed in 3D only: flip the facet");
  } else {
    Patch<3> patch{cells_at_edge(u, v), {}, {}};
    if (has_wall_at_edge(patch.removed, u, v)) {
      reason = "a wall or the boundary has the edge";
      return patch;
    }
    const std::vector<std::uint32_t> around = ring(patch.removed, u, v);
    if (around.size() < 3 || around.size() > most_ring)
      reason = "the edge has " + std::to_string(patch.removed.size()) + " cells: more than 7";
    else if (!Ring_triangulation(snapshot(), around, u, v).append(patch.cells))
      reason = "a cell would be flat or inverted";
    return patch;
  }
}

template <int D>
Patch<D> Replacer<D>::collapsed(std::uint32_t u, std::uint32_t onto, std::string& reason) const {
  cells_at_edge(u, onto);
  Patch<D> patch{transaction_.environment().cells_around(u), {}, {}};
  check_simplices(patch.removed);
  std::sort(patch.removed.begin(), patch.removed.end());
  if (has_wall_at_edge(patch.removed, u, u)) reason = "a wall or the boundary has the point";
  for (const Cell c : patch.removed) {
    if (has_vertex(snapshot(), c, onto)) continue;
    patch.cells.push_back(corners_of(snapshot(), c));
    std::ranges::replace(patch.cells.back(), u, onto);
  }
  return patch;
}

template <int D>
Replacement Replacer<D>::split_edge(std::uint32_t u, std::uint32_t v, const Point<D>& position) {
  std::string reason;
  const Patch<D> patch = split(u, v, position, reason);
  if (reason.empty()) return make(patch);
  if (D == 3 && ring(patch.removed, u, v).empty()) return refused("the boundary has the edge");
  Cell_soup<D> soup;
  reason = check_wall_edge<D>(snapshot(), patch.removed, {u, v}, position, soup);
  if (!reason.empty()) return refused(std::move(reason));
  prepare(patch);
  if (transaction_.has_rests() || !transaction_.leave(transaction_.free_of(patch.removed)).empty())
    return refused("a wall has the edge, and something lies in the cells around it");
  transaction_.note(patch.removed);
  return replace(patch, soup, glue_patch(soup));
}

template <int D>
Replacement Replacer<D>::flip(Half_facet facet) {
  std::string reason;
  const Patch<D> patch = flipped(facet, reason);
  return reason.empty() ? make(patch) : refused(std::move(reason));
}

template <int D>
Replacement Replacer<D>::remove_edge(std::uint32_t u, std::uint32_t v) {
  std::string reason;
  const Patch<D> patch = without_edge(u, v, reason);
  return reason.empty() ? make(patch) : refused(std::move(reason));
}

template <int D>
Replacement Replacer<D>::collapse(std::uint32_t u, std::uint32_t onto) {
  std::string reason;
  const Patch<D> patch = collapsed(u, onto, reason);
  Replacement result = reason.empty() ? make(patch) : refused(std::move(reason));
  if (result.is_made) result.point = u;
  return result;
}

template class Replacer<2>;
template class Replacer<3>;

}  // namespace cellwalk::detail
