// SPDX-License-Identifier: LGPL-3.0-or-later
// The way of an edge before edits, piece by piece, and the search for a chain linked with it.
#include <cellwalk/internal/edge/chain_as_before.h>

#include <algorithm>
#include <vector>

#include "any_path.h"
#include "equal_chains.h"

namespace cellwalk::detail {
namespace {

/// The way of an edge before edits: the cells through which its chain passed, piece by piece.
template <int D>
class Way_before {
 public:
  Way_before(const Snapshot<D>& snapshot, const Edits_since& edits, const Rational_segment<D>& segment,
             const Edge_before& before)
      : snapshot_(snapshot),
        edits_(edits),
        segment_(segment),
        pieces_(
            pieces_of<D>(snapshot, segment, before.start, {before.chain.data(), before.chain.size()}, 1)) {}

  /// Whether a cell that holds a piece of the edge was linked with the way at all its points.
  bool was_linked(Cell cell, const Fraction& low, const Fraction& high) const {
    return std::ranges::all_of(pieces_, [&](const Piece& piece) {
      return were_linked(piece.cell, cell, std::max<Fraction>(piece.low, low),
                         std::min<Fraction>(piece.high, high));
    });
  }

  /// Whether a chain from a cell was linked with the way at all its points.
  bool was_linked(Cell start, const Chain& chain) const {
    const auto pieces = pieces_of<D>(snapshot_, segment_, start, {chain.data(), chain.size()}, 1);
    return std::ranges::all_of(
        pieces, [this](const Piece& piece) { return was_linked(piece.cell, piece.low, piece.high); });
  }

 private:
  /// Two cells are compared at the middle of a piece that both hold, and then on both sides of the part to
  /// which the result applies.
  bool were_linked(Cell cell, Cell other, const Fraction& low, const Fraction& high) const {
    if (cell == other || !(low < high)) return true;
    const Fraction t = middle(low, high);
    Span part{low, high};
    std::vector<Cell> cells{cell};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == other)
        return were_linked(cell, other, low, part.low) && were_linked(cell, other, part.high, high);
      const Cell_view<D> view = snapshot_.view(cells[i]);
      for (std::size_t k = 0; k < view.facet_count(); ++k) {
        const Half_facet f = Snapshot<D>::half_facet(cells[i], k);
        const Cell behind = snapshot_.neighbour(f);
        if (behind == Cell::none || std::ranges::find(cells, behind) != cells.end() ||
            !was_passable(snapshot_, edits_, f))
          continue;
        const auto met = segment_.in_facet(view, k);
        if (!met || t < met->low || met->high < t) continue;
        part.low = std::max<Fraction>(part.low, met->low);
        part.high = std::min<Fraction>(part.high, met->high);
        cells.push_back(behind);
      }
    }
    return false;
  }

  const Snapshot<D>& snapshot_;
  const Edits_since& edits_;
  const Rational_segment<D>& segment_;
  std::vector<Piece> pieces_;
};

/// The rule of a search that accepts paths along the way before.
template <int D>
struct Along_way : Any_path<D> {
  const Way_before<D>& way;

  bool admits(Cell cell, const Fraction& t, const Fraction& end) const {
    return way.was_linked(cell, t, end);
  }
};

/// Where a chain is blocked: at the first facet that is a wall now, or else at the end.
template <int D>
Contact<D> blocked_chain(const Snapshot<D>& snapshot, const Rational_segment<D>& segment,
                         const Particle<D>& q, const Edge_before& before) {
  Contact<D> contact;
  contact.time = 1;
  contact.point = q.position;
  contact.cell = q.cell;
  const auto wall =
      std::ranges::find_if(before.chain, [&](Half_facet f) { return snapshot.is_impassable(f); });
  if (wall == before.chain.end()) return contact;
  contact.facet = *wall;
  contact.cell = snapshot.cell_of(*wall);
  if (const auto met = segment.in_facet(snapshot.view(contact.cell), snapshot.facet_of(*wall)))
    contact.point = segment.at(met->low).rounded();
  return contact;
}

}  // namespace

template <int D>
bool was_chain(const Snapshot<D>& snapshot, const Edits_since& edits, const Point<D>& p, const Point<D>& q,
               const Edge_before& before, Walk_counts& counts) {
  const auto is_there = [&](Cell cell) { return snapshot.is_cell(cell) && !edits.is_new(cell); };
  Cell cell = before.start;
  if (!is_there(cell) || !in_closure(snapshot, cell, p)) return false;
  for (const Half_facet f : before.chain) {
    if (to_index(f) >= snapshot.half_facet_slots() || snapshot.cell_of(f) != cell ||
        !was_passable(snapshot, edits, f))
      return false;
    cell = snapshot.neighbour(f);
    if (!is_there(cell)) return false;
  }
  return cell == before.end && in_closure(snapshot, cell, q) &&
         passes_in_order(snapshot, before.chain, p, q, counts);
}

template <int D>
Chain_result<D> find_chain_as_before(const Snapshot<D>& snapshot, const Edits_since& edits,
                                     const Particle<D>& p, const Particle<D>& q, const Edge_before& before,
                                     Walk_counts& counts) {
  Chain_result<D> result = find_chain(snapshot, p, q, counts);
  const bool is_same = !result.contact && p.cell == before.start && result.chain == before.chain;
  if (is_same || p.position == q.position) return result;
  const Rational_segment<D> segment(p.position, q.position);
  const Way_before<D> way(snapshot, edits, segment, before);
  if (!result.contact && way.was_linked(p.cell, result.chain)) return result;
  Along_way<D> rule{{p.position, q.position, counts}, way};
  Chain_search<D, Along_way<D>> search(snapshot, segment, q, rule, counts);
  if (search.find(p.cell)) return {search.chain(), {}};
  if (!result.contact) result.contact = blocked_chain(snapshot, segment, q, before);
  return result;
}

#define CELLWALK_INSTANTIATE(D)                                                                        \
  template bool was_chain<D>(const Snapshot<D>&, const Edits_since&, const Point<D>&, const Point<D>&, \
                             const Edge_before&, Walk_counts&);                                        \
  template Chain_result<D> find_chain_as_before<D>(const Snapshot<D>&, const Edits_since&,             \
                                                   const Particle<D>&, const Particle<D>&,             \
                                                   const Edge_before&, Walk_counts&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
