// SPDX-License-Identifier: LGPL-3.0-or-later
// The way through the cells by signs where they suffice, otherwise by exact parameters.
#include <cellwalk/internal/edge/path_within_cells.h>
#include <cellwalk/internal/walk/certified_exit.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

template <int D>
Particle<D> particle_in(const Snapshot<D>& snapshot, Cell c, const Particle<D>& p, Walk_counts& counts) {
  Particle<D> result = p;
  result.cell = c;
  const Cell_view<D> cell = snapshot.view(c);
  result.dimension = lowest_dimension(
      cell, p.position, [&](std::size_t i) { return side<Exact>(cell, i, p.position, counts) == 0; });
  if (result.cell != p.cell) result.aimed = 0;
  return result;
}

template <int D>
bool Path_within_cells<D>::has(Cell cell) const {
  return std::ranges::binary_search(cells_, cell);
}

template <int D>
bool Path_within_cells<D>::may_pass(Half_facet f) const {
  return !snapshot_.is_impassable(f) && has(snapshot_.neighbour(f)) && has(snapshot_.cell_of(f));
}

template <int D>
void Path_within_cells<D>::append(Chain& chain, Cell from, Cell to, const Point<D>& p,
                                  const Point<D>& q) const {
  const Chain known = chain;
  if (append_by_signs(chain, from, to, p, q)) return;
  chain = known;
  if (!append_exactly(chain, from, to, p, q))
    throw Error(Error_code::other,
                "what stands in the environment has no way through cells that changed: the environment is "
                "not certified, or it was not listed");
}

/// Where the edge passes each of these facets in its interior. False if it does not.
template <int D>
bool Path_within_cells<D>::append_by_signs(Chain& chain, Cell from, Cell to, const Point<D>& p,
                                           const Point<D>& q) const {
  Float_point<D> a{}, b{};
  const bool is_framed = snapshot_.frame().map(p, a) && snapshot_.frame().map(q, b);
  // An empty chain ends in the cell of p.
  bool is_start_known = chain.empty();
  for (std::size_t steps = 0; from != to; ++steps) {
    if (steps == cells_.size()) return false;
    Half_facet exit = Half_facet::none;
    if (is_framed && is_start_known && snapshot_.block_count(from) == 1) {
      const Certified_exit certain = certified_exit<D>(*snapshot_.blocks(from), {a, b}, steps > 0);
      if (certain.verdict == Certified_exit::leaves) exit = Snapshot<D>::half_facet(from, certain.facet);
    }
    if (exit == Half_facet::none) exit = exit_by_signs(from, p, q);
    if (exit == Half_facet::none || !may_pass(exit)) return false;
    append_reduced(snapshot_, chain, exit);
    from = snapshot_.neighbour(exit);
    is_start_known = true;
  }
  return true;
}

/// The facet of a cell through whose interior the edge leaves it, if there is one.
template <int D>
Half_facet Path_within_cells<D>::exit_by_signs(Cell from, const Point<D>& p, const Point<D>& q) const {
  const Line<Exact, D> line{p, q, counts_};
  const Cell_view<D> cell = snapshot_.view(from);
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (side<Exact>(cell, i, q, counts_) > 0 && exit_through(cell, i, line).kind == Exit::facet)
      return Snapshot<D>::half_facet(from, i);
  return Half_facet::none;
}

/// The same in every position: each cell is reached as early along the edge as possible.
template <int D>
bool Path_within_cells<D>::append_exactly(Chain& chain, Cell from, Cell to, const Point<D>& p,
                                          const Point<D>& q) const {
  struct Reached {
    Cell cell;
    Fraction at;
    std::size_t parent;
    Half_facet through;
  };
  const Rational_segment<D> segment(p, q);
  const auto met = [&](Half_facet f) {
    return segment.in_facet(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f));
  };
  Fraction start = 0;
  for (const Half_facet f : chain)
    if (const auto span = met(f)) start = std::max<Fraction>(start, span->low);
  std::vector<Reached> reached{{from, start, 0, Half_facet::none}};
  std::optional<std::size_t> end;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Reached here = reached[k];
    if (here.cell == to && (!end || here.at < reached[*end].at)) end = k;
    for (std::size_t i = 0; i < snapshot_.facet_count(here.cell); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(here.cell, i);
      if (!may_pass(f)) continue;
      const auto span = met(f);
      if (!span || span->high < here.at) continue;
      const Cell next = snapshot_.neighbour(f);
      const Fraction at = std::max<Fraction>(here.at, span->low);
      if (std::none_of(reached.begin(), reached.end(),
                       [&](const Reached& other) { return other.cell == next && other.at <= at; }))
        reached.push_back({next, at, k, f});
    }
  }
  if (!end) return false;
  Chain way;
  for (std::size_t k = *end; k != 0; k = reached[k].parent) way.push_back(reached[k].through);
  for (auto f = way.rbegin(); f != way.rend(); ++f) append_reduced(snapshot_, chain, *f);
  return true;
}

template Particle<2> particle_in(const Snapshot<2>&, Cell, const Particle<2>&, Walk_counts&);
template Particle<3> particle_in(const Snapshot<3>&, Cell, const Particle<3>&, Walk_counts&);
template class Path_within_cells<2>;
template class Path_within_cells<3>;

}  // namespace cellwalk::detail
