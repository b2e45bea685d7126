// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/chain.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "rational_segment.h"

namespace cellwalk {
namespace {

/// All ways from p to q: each cell as early as the segment gets into it, since it can leave by the same facets from then on.
template <int D>
class All_ways {
 public:
  All_ways(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, Walk_counts& counts)
      : snapshot_(snapshot), p_(p), q_(q), counts_(counts), segment_(p.position, q.position) {}

  /// True if there is one; it is put into `chain`.
  bool find(Chain& chain) {
    reach({p_.cell, 0, 0, Half_facet::none});
    for (std::size_t head = 0; head < places_.size(); ++head) {
      if (places_[head].cell == q_.cell) {
        put_way_to(head, chain);
        return true;
      }
      const Cell_view<D> cell = snapshot_.view(places_[head].cell);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(places_[head].cell, i);
        if (snapshot_.is_impassable(f) || is_apart(cell, i)) continue;
        const auto met = segment_.in_facet(cell, i);
        if (!met || met->high < places_[head].time) continue;
        reach({snapshot_.neighbor(f), std::max<Fraction>(places_[head].time, met->low), head, f});
      }
    }
    return false;
  }

 private:
  struct Place {
    Cell cell;
    Fraction time;       ///< along the segment
    std::size_t parent;  ///< from which it is reached,
    Half_facet facet;    ///< through this
  };

  void reach(const Place& place) {
    const auto [known, is_new] = earliest_.try_emplace(place.cell, place.time);
    if (!is_new && known->second <= place.time) return;
    known->second = place.time;
    places_.push_back(place);
  }

  /// True if the segment lies strictly on one side of a facet.
  bool is_apart(const Cell_view<D>& cell, std::size_t i) {
    const int of_p = detail::side<Exact>(cell, i, p_.position, counts_);
    return of_p != 0 && of_p == detail::side<Exact>(cell, i, q_.position, counts_);
  }

  void put_way_to(std::size_t place, Chain& chain) const {
    chain.clear();
    for (; place != 0; place = places_[place].parent) chain.push_back(places_[place].facet);
    std::reverse(chain.begin(), chain.end());
  }

  const Snapshot<D>& snapshot_;
  const Particle<D>&p_, &q_;
  Walk_counts& counts_;
  const detail::Rational_segment<D> segment_;
  std::vector<Place> places_;
  std::map<Cell, Fraction> earliest_;
};

}  // namespace

template <int D>
Chain_result<D> find_any_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                               Walk_counts& counts) {
  Chain_result<D> result = find_chain(snapshot, p, q, counts);
  if (!result.contact) return result;
  if (All_ways<D>(snapshot, p, q, counts).find(result.chain)) result.contact.reset();
  return result;
}

template <int D>
bool is_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, const Chain& chain,
              Walk_counts& counts) {
  Cell cell = p.cell;
  for (const Half_facet f : chain) {
    if (snapshot.cell_of(f) != cell || snapshot.is_impassable(f)) return false;
    cell = snapshot.neighbor(f);
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
