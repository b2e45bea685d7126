// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/chain.h>

#include <algorithm>

#include "chain_search.h"

namespace cellwalk {
namespace {

/// The rule of a search that accepts any path.
template <int D>
struct Any_way {
  const Point<D>&p, &q;
  Walk_counts& counts;

  bool is_wrong(const Chain&, const Fraction&) const { return false; }
  Fraction limit_of(const Cell_view<D>&, std::size_t, int) const { return 0; }
  bool is_accepted(const Chain&) const { return true; }
  bool comes_before(const Cell_view<D>& x, const Cell_view<D>& y) const {
    if constexpr (D == 2)
      return false;
    else
      return detail::Rotational_order<Exact>(p, q, counts)(x, y);
  }
};

}  // namespace

template <int D>
Chain_result<D> find_any_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                               Walk_counts& counts) {
  Chain_result<D> result = find_chain(snapshot, p, q, counts);
  if (!result.contact || p.position == q.position) return result;
  const detail::Rational_segment<D> segment(p.position, q.position);
  const Any_way<D> rule{p.position, q.position, counts};
  detail::Chain_search<D, Any_way<D>> search(snapshot, segment, q, rule, counts);
  if (!search.find(p.cell)) return result;
  result.chain = search.chain();
  result.contact.reset();
  return result;
}

template <int D>
bool is_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, const Chain& chain,
              Walk_counts& counts) {
  Cell cell = p.cell;
  for (const Half_facet f : chain) {
    if (snapshot.cell_of(f) != cell || snapshot.is_impassable(f)) return false;
    cell = snapshot.neighbour(f);
  }
  if (cell != q.cell) return false;
  if (passes(snapshot, chain, p.position, q.position, counts)) return true;
  const detail::Rational_segment<D> segment(p.position, q.position);
  Fraction last = 0;
  for (const Half_facet f : chain) {
    const auto met = segment.in_facet(snapshot.view(snapshot.cell_of(f)), snapshot.facet_of(f));
    if (!met || met->high < last) return false;
    last = std::max<Fraction>(last, met->low);
  }
  return true;
}

#define CELLWALK_INSTANTIATE(D)                                                                          \
  template Chain_result<D> find_any_chain<D>(const Snapshot<D>&, const Particle<D>&, const Particle<D>&, \
                                             Walk_counts&);                                              \
  template bool is_chain<D>(const Snapshot<D>&, const Particle<D>&, const Particle<D>&, const Chain&,    \
                            Walk_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
