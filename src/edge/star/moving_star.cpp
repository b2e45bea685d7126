// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls and cells of the star, the tests which of them keep a particle, and relinked chains.
#include <cellwalk/internal/edge/moving_star.h>
#include <cellwalk/internal/edge/path_within_cells.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace cellwalk::detail {
namespace {

[[noreturn]] void fail_to_register() {
  throw Error(
      Error_code::other,
      "what stands in the environment has no way through the cells around a vertex that moved past it: "
      "the environment is not certified, or it was not listed");
}

/// The sign of an orientation just after the vertex began to move: that with the vertex where it was or, if
/// that is 0, since it is affine, that where it goes. of(at) is the sign, at(v) gives the points of the cell.
template <int D, class Sign>
int sign_at_start(const Cell_view<D>& cell, std::uint32_t vertex, const Point<D>& from, const Sign& of) {
  const int before = of([&](std::uint16_t v) -> const Point<D>& {
    return cell.point_index(v) == vertex ? from : cell.point(v);
  });
  return before != 0 ? before : of([&](std::uint16_t v) -> const Point<D>& { return cell.point(v); });
}

}  // namespace

template <int D>
Moving_star<D>::Moving_star(const Snapshot<D>& snapshot, std::uint32_t vertex, const Point<D>& from,
                            std::span<const Cell> cells, Walk_counts& counts)
    : snapshot_(snapshot), vertex_(vertex), from_(from), cells_(cells.begin(), cells.end()), counts_(counts) {
  std::sort(cells_.begin(), cells_.end());
  slots_.resize(std::bit_ceil(4 * cells_.size() + 1));
  for (const Cell c : cells_) {
    slot_of(c).cell = c;
    if (snapshot.is_solid(c)) continue;
    const Cell_view<D> view = snapshot.view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (!snapshot.is_impassable(f) || !has_point(view, i, vertex)) continue;
      const Cell other = snapshot.neighbour(f);
      // One with free space on both sides is listed from the first of its cells.
      if (other == Cell::none || snapshot.is_solid(other) || c < other) add_wall(f, from);
    }
  }
}

template <int D>
void Moving_star<D>::add_wall(Half_facet facet, const Point<D>& from) {
  const Point<D>& to = snapshot_.point(vertex_);
  const auto before = [&](std::uint32_t v) -> const Point<D>& {
    return v == vertex_ ? from : snapshot_.point(v);
  };
  std::vector<std::uint32_t> loop = snapshot_.loop(facet);
  int outside = 0;
  if constexpr (D == 2)
    outside = -Exact::orientation(counts_.predicates, before(loop[0]), before(loop[1]), to);
  else
    outside = Exact::orientation(counts_.predicates, before(loop[0]), before(loop[1]), before(loop[2]), to);
  const Cell other = snapshot_.neighbour(facet);
  if (outside > 0 && other != Cell::none && !snapshot_.is_solid(other)) {
    facet = snapshot_.opposite(facet);
    loop = snapshot_.loop(facet);
  }
  typename Swept_simplex<D>::Corners still;
  std::size_t corners = 0;
  for (const std::uint32_t v : loop)
    if (v != vertex_) still[corners++] = snapshot_.point(v);
  walls_.push_back({facet, Swept_simplex<D>(from, to, still, counts_.predicates)});
  box_.extend(walls_.back().swept.box());
}

template <int D>
std::size_t Moving_star<D>::wall_of(Half_facet facet) const {
  const Half_facet other = snapshot_.opposite(facet);
  const auto wall = std::ranges::find_if(walls_, [&](const Moving_wall<D>& w) {
    return w.facet == facet || (other != Half_facet::none && w.facet == other);
  });
  return static_cast<std::size_t>(wall - walls_.begin());
}

template <int D>
bool Moving_star<D>::has(Cell cell) const {
  return cell != Cell::none && slot_of(cell).cell == cell;
}

/// The slot of a cell, or the empty one where it would be.
template <int D>
typename Moving_star<D>::Slot& Moving_star<D>::slot_of(Cell cell) const {
  const std::size_t last = slots_.size() - 1;
  std::size_t at = (to_index(cell) * 0x9e3779b9u >> 7) & last;
  while (slots_[at].cell != cell && slots_[at].cell != Cell::none) at = (at + 1) & last;
  return slots_[at];
}

template <int D>
bool Moving_star<D>::has(Half_facet facet) const {
  const Cell c = snapshot_.cell_of(facet);
  Slot& slot = slot_of(c);
  if (slot.cell != c) return false;
  const std::size_t i = snapshot_.facet_of(facet);
  if (i >= std::numeric_limits<std::uint32_t>::digits) return has_point(snapshot_.view(c), i, vertex_);
  const std::uint32_t bit = 1u << i;
  if ((slot.known & bit) == 0) {
    slot.known |= bit;
    if (has_point(snapshot_.view(c), i, vertex_)) slot.moving |= bit;
  }
  return (slot.moving & bit) != 0;
}

template <int D>
Star_meeting Moving_star<D>::meet(std::span<const Point<D>> feature, bool locates) const {
  Star_meeting result;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Swept_simplex<D>& swept = walls_[w].swept;
    const Encounter meeting = swept.meet(feature, counts_.predicates);
    if (meeting == Encounter::apart) continue;
    if (meeting == Encounter::touch) {
      result.touches = true;
      if (result.meeting == Encounter::hit) continue;
      result.leaves = (result.meeting == Encounter::apart || result.leaves) && swept.leaves(feature);
      result.meeting = Encounter::touch;
      continue;
    }
    result.meeting = Encounter::hit;
    if (!locates) return result;
    keep_first(result.collision, first_hit(w, feature));
  }
  return result;
}

template <int D>
Collision Moving_star<D>::first_hit(std::size_t wall, std::span<const Point<D>> feature) const {
  Collision collision = walls_[wall].swept.first_hit(feature);
  collision.wall = wall;
  return collision;
}

template <int D>
bool Moving_star<D>::keeps_cell(const Particle<D>& p) const {
  return in_closure(snapshot_, p.cell, p.position);
}

template <int D>
bool Moving_star<D>::keeps_facets(const Chain& facets, const Point<D>& p, const Point<D>& q) const {
  return passes(snapshot_, facets, p, q, counts_);
}

template <int D>
int Moving_star<D>::side_at_start(const Cell_view<D>& cell, std::size_t i, const Point<D>& x) const {
  const auto loop = cell.loop(i);
  return sign_at_start(cell, vertex_, from_, [&](const auto& at) {
    ++counts_.side_tests;
    if constexpr (D == 2)
      return -Exact::orientation(counts_.predicates, at(loop[0]), at(loop[1]), x);
    else
      return Exact::orientation(counts_.predicates, at(loop[0]), at(loop[1]), at(loop[2]), x);
  });
}

template <int D>
int Moving_star<D>::along_at_start(const Cell_view<D>& cell, std::size_t i, std::size_t k, const Point<D>& p,
                                   const Point<D>& q) const {
  const auto loop = cell.loop(i);
  return sign_at_start(cell, vertex_, from_, [&](const auto& at) {
    ++counts_.along_tests;
    if constexpr (D == 2) {
      const int s = Exact::orientation(counts_.predicates, p, q, at(loop[k]));
      return k == 0 ? -s : s;
    } else {
      return Exact::orientation(counts_.predicates, p, q, at(loop[k]),
                                at(loop[k + 1 == loop.size() ? 0 : k + 1]));
    }
  });
}

template <int D>
bool Moving_star<D>::keeps_cell_at_start(const Particle<D>& p) const {
  if (!has(p.cell)) return true;
  const Cell_view<D> cell = snapshot_.view(p.cell);
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (side_at_start(cell, i, p.position) > 0) return false;
  return true;
}

template <int D>
bool Moving_star<D>::keeps_chain_at_start(const Chain& chain, const Point<D>& p, const Point<D>& q) const {
  for (const Half_facet f : chain) {
    if (!has(f)) continue;
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(f));
    const std::size_t i = snapshot_.facet_of(f);
    const int at_p = side_at_start(cell, i, p), at_q = side_at_start(cell, i, q);
    if (at_p > 0 || at_q < 0 || (at_p == 0 && at_q == 0)) return false;
    for (std::size_t k = 0; k < cell.loop(i).size(); ++k)
      if (along_at_start(cell, i, k, p, q) < 0) return false;
  }
  return true;
}

template <int D>
Particle<D> Moving_star<D>::registered(const Particle<D>& p) const {
  Link_search<D> links(snapshot_, p.cell);
  while (links.next()) {
    if (in_closure(snapshot_, links.cell(), p.position)) return registered_in(links.cell(), p);
    links.expand([&](const Cell_view<D>& cell, std::size_t i) { return has_point(cell, i, vertex_); });
  }
  fail_to_register();
}

template <int D>
Particle<D> Moving_star<D>::registered_in(Cell c, const Particle<D>& p) const {
  return particle_in(snapshot_, c, p, counts_);
}

template <int D>
Chain Moving_star<D>::relinked(const Chain& before, Cell first, const Particle<D>& p,
                               const Particle<D>& q) const {
  const Path_within_cells<D> way(snapshot_, cells_, counts_);
  Chain chain;
  Cell old = first, now = p.cell;
  for (auto f = before.begin();;) {
    while (f != before.end() && has(*f)) old = snapshot_.neighbour(*f++);
    const Cell goal = f == before.end() ? q.cell : old;
    if (now != goal) way.append(chain, now, goal, p.position, q.position);
    if (f == before.end()) return chain;
    append_reduced(snapshot_, chain, *f);
    now = old = snapshot_.neighbour(*f++);
  }
}

template class Moving_star<2>;
template class Moving_star<3>;

}  // namespace cellwalk::detail
