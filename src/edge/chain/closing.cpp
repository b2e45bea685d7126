// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for chains that avoid the new walls and equal the present one elsewhere.
#include <cellwalk/internal/edge/closing.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>

#include "chain_search.h"
#include "equal_chains.h"
#include "link.h"

namespace cellwalk::detail {
namespace {

/// All cells linked with one once all is closed, through facets for which a rule holds.
template <int D, class Holds>
std::vector<Cell> linked_then(const Snapshot<D>& snapshot, Cell start, const Closing& closing,
                              const Holds& holds) {
  std::vector<Cell> cells;
  Link_search<D> links(snapshot, start);
  while (links.next()) {
    cells.push_back(links.cell());
    links.expand([&](const Cell_view<D>& cell, std::size_t i) {
      return !closing.has(Snapshot<D>::half_facet(links.cell(), i)) && holds(cell, i);
    });
  }
  return cells;
}

template <class Cells>
bool has_cell(const Cells& cells, Cell c) {
  return std::find(cells.begin(), cells.end(), c) != cells.end();
}

/// The rule of a search for chains that avoid the facets and the cell that are closed, and are equal to one
/// that may pass them.
template <int D>
class Closing_rule {
 public:
  /// \param now a chain of the edge, from the cell in which it starts then
  Closing_rule(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, const Closing_edge<D>& edge,
               const Closing& closing, const Chain& now, Walk_counts& counts)
      : snapshot_(snapshot),
        segment_(segment),
        edge_(edge),
        closing_(closing),
        counts_(counts),
        pieces_(pieces(now, 1)) {}

  bool forbids(Half_facet f) const { return closing_.has(f); }
  /// Chains are compared in the environment as it is: there the new walls part nothing.
  bool is_wrong(const Chain& path, const Fraction& end) const {
    return parting_of(snapshot_, segment_, pieces_, pieces(path, end)).has_value();
  }
  Fraction limit_of(const Cell_view<D>& cell, std::size_t i, int border) const {
    return segment_.at_border(cell, i, border);
  }
  bool is_accepted(const Chain& path) const { return !is_wrong(path, 1); }
  bool comes_before(const Cell_view<D>&, const Cell_view<D>&) const { return false; }

  /// The middle decides about the piece: it lies inside a facet of the cell, or along one ridge, around which
  /// the same cells lie all the way, or in no facet.
  bool admits(Cell c, const Fraction& t, const Fraction& end) const {
    if ((edge_.tips.empty() && edge_.at.empty()) || !(t < end)) return true;
    const Fraction at = middle(t, end);
    const auto holds = [&](const Cell_view<D>& cell, std::size_t i) {
      const std::optional<Span> met = segment_.in_facet(cell, i);
      return met && !(at < met->low) && !(met->high < at);
    };
    const std::vector<Cell> linked = linked_then(snapshot_, c, closing_, holds);
    for (const Half_facet f : edge_.at) {
      const Cell own = snapshot_.cell_of(f);
      if (holds(snapshot_.view(own), snapshot_.facet_of(f)) && !has_cell(linked, own)) return false;
    }
    return std::all_of(edge_.tips.begin(), edge_.tips.end(), [&](const Point<D>& tip) {
      return std::any_of(linked.begin(), linked.end(), [&](Cell in) {
        const Cell_view<D> cell = snapshot_.view(in);
        for (std::size_t i = 0; i < cell.facet_count(); ++i)
          if (holds(cell, i) && side<Exact>(cell, i, tip, counts_) > 0) return false;
        return true;
      });
    });
  }

 private:
  std::vector<Piece> pieces(const Chain& chain, const Fraction& end) const {
    return pieces_of<D>(snapshot_, segment_, edge_.p_then.cell, {chain.data(), chain.size()}, end);
  }

  const Snapshot<D>& snapshot_;
  const Rational_segment<D>& segment_;
  const Closing_edge<D>& edge_;
  const Closing& closing_;
  Walk_counts& counts_;
  const std::vector<Piece> pieces_;  ///< of the chain now
};

/// An edge of no length: the cells of its ends must be linked.
template <int D>
std::optional<Chain> chain_at_point(const Snapshot<D>& snapshot, const Closing_edge<D>& edge,
                                    const Closing& closing, Walk_counts& counts) {
  std::optional<Chain> chain;
  Link_search<D> links(snapshot, edge.p_then.cell);
  while (links.next()) {
    if (links.cell() == edge.q_then.cell) {
      links.append_path(links.place(), chain.emplace());
      return chain;
    }
    links.expand([&](const Cell_view<D>& cell, std::size_t i) {
      return !closing.has(Snapshot<D>::half_facet(links.cell(), i)) &&
             lies_in(cell, i, edge.p_then.position, counts);
    });
  }
  return chain;
}

}  // namespace

template <int D>
bool crosses_inside(const Snapshot<D>& snapshot, Half_facet facet, const Point<D>& p, const Point<D>& q,
                    Walk_counts& counts) {
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(facet));
  const std::size_t i = snapshot.facet_of(facet);
  const int at_p = side<Exact>(cell, i, p, counts), at_q = side<Exact>(cell, i, q, counts);
  if (at_p * at_q >= 0) return false;
  for (std::size_t k = 0; k < cell.loop(i).size(); ++k)
    if (at_p * along<Exact>(cell, i, k, p, q, counts) >= 0) return false;
  return true;
}

template <int D>
bool lies_along(const Snapshot<D>& snapshot, Half_facet facet, const Point<D>& p, const Point<D>& q,
                Walk_counts& counts) {
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(facet));
  const std::size_t i = snapshot.facet_of(facet);
  if (side<Exact>(cell, i, p, counts) != 0 || side<Exact>(cell, i, q, counts) != 0 || p == q) return false;
  const std::optional<Span> met = Rational_segment<D>(p, q).in_facet(cell, i);
  return met && met->low < met->high;
}

template <int D>
std::vector<Particle<D>> sides_after(const Snapshot<D>& snapshot, const Particle<D>& particle,
                                     const Closing& closing, Walk_counts& counts) {
  const Point<D>& x = particle.position;
  const auto holds = [&](const Cell_view<D>& cell, std::size_t i) { return lies_in(cell, i, x, counts); };
  std::vector<Particle<D>> sides;
  std::vector<Cell> seen;
  for (const Cell c : linked_cells(snapshot, particle.cell, holds)) {
    if (c == closing.filled || has_cell(seen, c)) continue;
    const std::vector<Cell> linked = linked_then(snapshot, c, closing, holds);
    seen.insert(seen.end(), linked.begin(), linked.end());
    Particle<D>& side_of_wall = sides.emplace_back(particle);
    if (c == particle.cell) continue;
    const Cell_view<D> cell = snapshot.view(c);
    side_of_wall.cell = c;
    side_of_wall.aimed = 0;
    side_of_wall.dimension =
        lowest_dimension(cell, x, [&](std::size_t i) { return side<Exact>(cell, i, x, counts) == 0; });
  }
  return sides;
}

template <int D>
std::optional<Chain> chain_after(const Snapshot<D>& snapshot, const Closing_edge<D>& edge,
                                 const Closing& closing, Walk_counts& counts) {
  const auto is_closed = [&](Half_facet f) { return closing.has(f); };
  if (edge.p.cell == edge.p_then.cell && edge.q.cell == edge.q_then.cell && edge.tips.empty() &&
      edge.at.empty() && std::none_of(edge.chain.begin(), edge.chain.end(), is_closed))
    return edge.chain;
  if (edge.p.position == edge.q.position) return chain_at_point(snapshot, edge, closing, counts);
  Chain now;
  append_link(snapshot, now, edge.p_then.cell, edge.p.cell, edge.p.position, counts);
  now.insert(now.end(), edge.chain.begin(), edge.chain.end());
  append_link(snapshot, now, edge.q.cell, edge.q_then.cell, edge.q.position, counts);
  const Rational_segment<D> segment(edge.p.position, edge.q.position);
  Closing_rule<D> rule(snapshot, segment, edge, closing, now, counts);
  Chain_search<D, Closing_rule<D>> search(snapshot, segment, edge.q_then, rule, counts);
  if (!search.find(edge.p_then.cell)) return {};
  return search.chain();
}

#define CELLWALK_INSTANTIATE(D)                                                                            \
  template bool crosses_inside<D>(const Snapshot<D>&, Half_facet, const Point<D>&, const Point<D>&,        \
                                  Walk_counts&);                                                           \
  template bool lies_along<D>(const Snapshot<D>&, Half_facet, const Point<D>&, const Point<D>&,            \
                              Walk_counts&);                                                               \
  template std::vector<Particle<D>> sides_after<D>(const Snapshot<D>&, const Particle<D>&, const Closing&, \
                                                   Walk_counts&);                                          \
  template std::optional<Chain> chain_after<D>(const Snapshot<D>&, const Closing_edge<D>&, const Closing&, \
                                               Walk_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
