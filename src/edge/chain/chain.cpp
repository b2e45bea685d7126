// SPDX-License-Identifier: LGPL-3.0-or-later
// The chain by a walk from one end, the reversed chain, and the test whether a segment passes it.
#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <vector>

#include "certain_crossing.h"
#include "chain_of_walk.h"
#include "link.h"

namespace cellwalk {
namespace {

/// The proof by doubles for a segment and a facet, if that is a triangle.
detail::Crossing_proof prove_crossing(const Cell_view<3>& cell, std::size_t i, const Point<3>& p,
                                      const Point<3>& q, Walk_counts& counts) {
  const auto loop = cell.loop(i);
  if (loop.size() != 3) return detail::Crossing_proof::none;
  const detail::Crossing_proof proof =
      detail::Certain_crossing(p, q)(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]));
  if (proof != detail::Crossing_proof::none) {
    counts.side_tests += 2;
    counts.along_tests += 3;
    counts.predicates.orientations += 5;
  }
  return proof;
}

/// The contact of a segment that arrives at q on the wrong side, with a wall at q.
template <int D>
Contact<D> other_side(const Snapshot<D>& snapshot, const Walk_result<D>& arrival, const Point<D>& q,
                      Half_facet wall) {
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(wall));
  const std::size_t i = snapshot.facet_of(wall);
  Contact<D> contact;
  contact.time = 1;
  contact.point = q;
  contact.cell = arrival.cell;
  const detail::Facet_feature feature = detail::lowest_feature(cell, i, q);
  contact.kind = feature.kind;
  contact.corner = feature.corner;
  contact.facet = wall;
  contact.normal = detail::inner_normal(cell, i);
  return contact;
}

}  // namespace

template <int D>
Chain_result<D> find_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                           Walk_counts& counts, bool locates_contact) {
  bool on_planes = false;
  Chain_result<D> result = detail::chain_of_walk(snapshot, p, q, counts, on_planes);
  if (result.contact && locates_contact) locate_contact(snapshot, p.position, q.position, *result.contact);
  return result;
}

template <int D>
Chain_result<D> detail::chain_of_walk(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                                      Walk_counts& counts, bool& on_planes) {
  Chain_result<D> result;
  std::vector<Half_facet> crossed;
  Walk_options options;
  options.crossed = &crossed;
  options.locates_contact = false;
  const Walk_result<D> walked = walk(snapshot, p, q.position, counts, options);
  on_planes = walked.on_planes;
  result.has_choice = walked.had_choice;
  if (walked.status != Walk_status::arrived) {
    result.contact = walked.contact;
    return result;
  }
  for (const Half_facet f : crossed) result.chain.push_back(f);
  const Half_facet wall =
      detail::append_link(snapshot, result.chain, walked.cell, q.cell, q.position, counts);
  if (wall != Half_facet::none) {
    result.chain.clear();
    result.contact = other_side(snapshot, walked, q.position, wall);
  }
  return result;
}

template <int D>
Chain reversed(const Snapshot<D>& snapshot, const Chain& chain) {
  Chain other;
  for (auto f = chain.rbegin(); f != chain.rend(); ++f) other.push_back(snapshot.opposite(*f));
  return other;
}

template <int D>
void prepend_crossed_facets(const Snapshot<D>& snapshot, Chain& chain, std::span<const Half_facet> crossed) {
  for (const Half_facet f : crossed) {
    if (!chain.empty() && chain.front() == f)
      chain.erase(chain.begin());
    else
      chain.insert(chain.begin(), snapshot.opposite(f));
  }
}

template <int D>
bool passes(const Snapshot<D>& snapshot, const Chain& chain, const Point<D>& p, const Point<D>& q,
            Walk_counts& counts) {
  for (const Half_facet f : chain) {
    const Cell_view<D> cell = snapshot.view(snapshot.cell_of(f));
    const std::size_t i = snapshot.facet_of(f);
    if constexpr (D == 3) {
      const detail::Crossing_proof proof = prove_crossing(cell, i, p, q, counts);
      if (proof == detail::Crossing_proof::misses) return false;
      if (proof == detail::Crossing_proof::crosses) continue;
    }
    const int at_p = detail::side<Exact>(cell, i, p, counts);
    if (at_p > 0) return false;
    const int at_q = detail::side<Exact>(cell, i, q, counts);
    if (at_q < 0 || (at_p == 0 && at_q == 0)) return false;
    const std::size_t ridges = cell.loop(i).size();
    for (std::size_t k = 0; k < ridges; ++k)
      if (detail::along<Exact>(cell, i, k, p, q, counts) < 0) return false;
  }
  return true;
}

#define CELLWALK_INSTANTIATE(D)                                                                      \
  template Chain_result<D> find_chain<D>(const Snapshot<D>&, const Particle<D>&, const Particle<D>&, \
                                         Walk_counts&, bool);                                        \
  template Chain_result<D> detail::chain_of_walk<D>(const Snapshot<D>&, const Particle<D>&,          \
                                                    const Particle<D>&, Walk_counts&, bool&);        \
  template Chain reversed<D>(const Snapshot<D>&, const Chain&);                                      \
  template void prepend_crossed_facets<D>(const Snapshot<D>&, Chain&, std::span<const Half_facet>);  \
  template bool passes<D>(const Snapshot<D>&, const Chain&, const Point<D>&, const Point<D>&, Walk_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
