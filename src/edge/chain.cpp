// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/chain.h>
#include <cellwalk/walk/detail/signs.h>
#include <cellwalk/walk/detail/star.h>

#include <algorithm>
#include <vector>

namespace cellwalk {
namespace {

/// True if x, a point of the closed cell, lies in its facet i.
template <int D>
bool lies_in(const Cell_view<D>& cell, std::size_t i, const Point<D>& x, Walk_counts& counts) {
  return detail::side<Exact>(cell, i, x, counts) == 0 && detail::in_facet(cell, i, x);
}

/// Appends the passable facets, all of which hold x, on the way from one cell that holds x to another. If there is no way,
/// the two are not linked at x: returns the first wall at x that the search met, else Half_facet::none.
template <int D>
Half_facet append_link(const Snapshot<D>& snapshot, Chain& chain, Cell from, Cell to, const Point<D>& x,
                       Walk_counts& counts) {
  boost::container::small_vector<detail::Star_cell, 16> queue{{from, 0, Half_facet::none}};
  Half_facet wall = Half_facet::none;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Cell c = queue[head].cell;
    if (c == to) {
      const std::size_t end = chain.size();
      for (std::size_t i = head; i != 0; i = queue[i].parent) chain.push_back(queue[i].facet);
      std::reverse(chain.begin() + static_cast<std::ptrdiff_t>(end), chain.end());
      return Half_facet::none;
    }
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      if (!lies_in(cell, i, x, counts)) continue;
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot.is_impassable(f)) {
        if (wall == Half_facet::none) wall = f;
        continue;
      }
      const Cell next = snapshot.neighbor(f);
      const auto is_next = [next](const detail::Star_cell& known) { return known.cell == next; };
      if (std::none_of(queue.begin(), queue.end(), is_next)) queue.push_back({next, head, f});
    }
  }
  return wall;
}

/// The contact of a segment that arrives at q on another side, with a wall at q.
template <int D>
Wall_contact<D> other_side(const Snapshot<D>& snapshot, const Walk_result<D>& arrival, const Point<D>& q,
                           Half_facet wall) {
  Wall_contact<D> contact;
  contact.time = 1;
  contact.point = q;
  contact.cell = arrival.cell;
  contact.kind = arrival.dimension == 0       ? Contact_kind::vertex
                 : arrival.dimension == D - 1 ? Contact_kind::facet
                                              : Contact_kind::edge;
  contact.facet = wall;
  contact.normal = detail::inner_normal(snapshot.view(snapshot.cell_of(wall)), snapshot.facet_of(wall));
  return contact;
}

}  // namespace

Edge_counts& Edge_counts::operator+=(const Edge_counts& other) {
  edges += other.edges;
  same_cell += other.same_cell;
  same_chain += other.same_chain;
  chain_facets += other.chain_facets;
  walked += other.walked;
  floods += other.floods;
  flooded_cells += other.flooded_cells;
  clear += other.clear;
  walk += other.walk;
  return *this;
}

template <int D>
Chain_result<D> find_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                           Walk_counts& counts) {
  Chain_result<D> result;
  std::vector<Half_facet> crossed;
  Walk_options options;
  options.crossed = &crossed;
  const Walk_result<D> walked = walk(snapshot, p, q.position, counts, options);
  if (walked.status != Walk_status::arrived) {
    result.contact = walked.contact;
    return result;
  }
  for (const Half_facet f : crossed) result.chain.push_back(f);
  const Half_facet wall = append_link(snapshot, result.chain, walked.cell, q.cell, q.position, counts);
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
void walk_start(const Snapshot<D>& snapshot, Chain& chain, std::span<const Half_facet> crossed) {
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
                                         Walk_counts&);                                              \
  template Chain reversed<D>(const Snapshot<D>&, const Chain&);                                      \
  template void walk_start<D>(const Snapshot<D>&, Chain&, std::span<const Half_facet>);              \
  template bool passes<D>(const Snapshot<D>&, const Chain&, const Point<D>&, const Point<D>&, Walk_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
