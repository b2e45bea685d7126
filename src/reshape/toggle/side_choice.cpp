// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of vertices narrowed along edges, and the search for a choice that suits all.
#include "side_choice.h"

#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <utility>

namespace cellwalk::detail {

template <int D>
void Side_choice<D>::add_vertex(std::uint32_t vertex) {
  const auto [place, is_new] = vertices_.try_emplace(vertex);
  if (!is_new) return;
  Vertex& of_vertex = place->second;
  of_vertex.sides = sides_after(snapshot_, groups_.particle({group_, vertex}), closing_, counts_);
  // A side is in these cells as a whole, or beside them.
  std::erase_if(of_vertex.sides, [&](const Particle<D>& side) {
    return std::binary_search(left_.begin(), left_.end(), side.cell);
  });
  if (of_vertex.sides.size() > 1) {
    std::vector<std::pair<Side_order, Particle<D>>> sides;
    for (const Particle<D>& side : of_vertex.sides) sides.emplace_back(order_of(side), side);
    std::ranges::sort(sides, {}, &std::pair<Side_order, Particle<D>>::first);
    for (std::size_t k = 0; k < sides.size(); ++k) of_vertex.sides[k] = sides[k].second;
  }
  of_vertex.may_be.assign(of_vertex.sides.size(), true);
}

/// The key of the order in which sides are tried, which depends on geometry only: whether the displaced
/// vertex is elsewhere, and the least corners of the cells that are linked there then.
template <int D>
typename Side_choice<D>::Side_order Side_choice<D>::order_of(const Particle<D>& side) const {
  const Point<D>& x = side.position;
  Side_order order{true, {}};
  Link_search<D> links(snapshot_, side.cell);
  while (links.next()) {
    bool holds_displaced = true;
    links.expand_all(
        [&](const Cell_view<D>& cell, std::size_t i) {
          const int at = detail::side<Exact>(cell, i, x, counts_);
          holds_displaced &= at < 0 || (at == 0 && displaced_side(cell, i) < 0);
          return at == 0 && in_facet(cell, i, x) && !closing_.has(Snapshot<D>::half_facet(links.cell(), i));
        },
        [](const Cell_view<D>&, std::size_t, Half_facet) {});
    if (holds_displaced) order.first = false;
    take_least(snapshot_.view(links.cell()), order.second);
  }
  return order;
}

template <int D>
void Side_choice<D>::add_edge(std::uint32_t edge) {
  if (!edges_.try_emplace(edge).second) return;
  for (const std::uint32_t v : groups_.all()[group_].edges[edge]) add_vertex(v);
}

/// False if a vertex keeps its cell, and can do nothing else.
template <int D>
bool Side_choice<D>::may_change(std::uint32_t vertex) const {
  const auto known = vertices_.find(vertex);
  if (known == vertices_.end()) return false;
  const auto& sides = known->second.sides;
  return sides.size() != 1 || sides.front().cell != groups_.particle({group_, vertex}).cell;
}

template <int D>
void Side_choice<D>::complete() {
  const auto& edges = groups_.all()[group_].edges;
  for (std::size_t before = vertices_.size() + 1; before != vertices_.size();) {
    before = vertices_.size();
    if (std::none_of(vertices_.begin(), vertices_.end(), [&](const auto& v) { return may_change(v.first); }))
      return;
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      if (may_change(edges[e][0]) || may_change(edges[e][1])) add_edge(e);
  }
}

template <int D>
void Side_choice<D>::find_holders(std::vector<Resident>& held_by, bool all_edges) {
  for (const auto& [v, vertex] : vertices_)
    if (vertex.sides.empty()) held_by.push_back(groups_.at({group_, v}, Body_feature::vertex));
  for (const auto& [e, edge] : edges_) {
    const auto [u, v] = groups_.all()[group_].edges[e];
    const std::size_t of_u = vertices_.at(u).sides.size(), of_v = vertices_.at(v).sides.size();
    bool has_chain = !all_edges && (of_u == 0 || of_v == 0);  // then its end holds
    for (std::size_t k = 0; k < of_u * of_v && !has_chain; ++k)
      has_chain = chain_between(e, k / of_v, k % of_v).has_value();
    if (!has_chain) held_by.push_back(groups_.at({group_, e}, Body_feature::edge));
  }
}

template <int D>
void Side_choice<D>::add_tip(std::uint32_t edge, const Point<D>& tip) {
  Edge& of_edge = edges_.at(edge);
  of_edge.tips.push_back(tip);
  of_edge.chains.clear();
}

template <int D>
void Side_choice<D>::demand(std::uint32_t edge, Half_facet at) {
  Edge& of_edge = edges_.at(edge);
  of_edge.at.push_back(at);
  of_edge.chains.clear();
}

template <int D>
void Side_choice<D>::forget_demands() {
  for (auto& [e, edge] : edges_) {
    if (edge.at.empty()) continue;
    edge.at.clear();
    edge.chains.clear();
  }
}

template <int D>
const std::optional<Chain>& Side_choice<D>::chain_between(std::uint32_t edge, std::size_t of_u,
                                                          std::size_t of_v) {
  Edge& of_edge = edges_.at(edge);
  const auto [place, is_new] = of_edge.chains.try_emplace({of_u, of_v});
  if (is_new) {
    const auto [u, v] = groups_.all()[group_].edges[edge];
    const Closing_edge<D> request{groups_.particle({group_, u}),
                                  groups_.particle({group_, v}),
                                  groups_.chain({group_, edge}),
                                  vertices_.at(u).sides[of_u],
                                  vertices_.at(v).sides[of_v],
                                  of_edge.tips,
                                  of_edge.at};
    place->second = chain_after(snapshot_, request, closing_, counts_);
  }
  return place->second;
}

/// Drops sides from which an edge cannot be passed. False if none are left.
template <int D>
bool Side_choice<D>::narrow() {
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const auto& [e, edge] : edges_) {
      const auto [u, v] = groups_.all()[group_].edges[e];
      Vertex &at_u = vertices_.at(u), &at_v = vertices_.at(v);
      const std::vector<bool> before_u = std::exchange(at_u.may_be, std::vector<bool>(at_u.may_be.size()));
      const std::vector<bool> before_v = std::exchange(at_v.may_be, std::vector<bool>(at_v.may_be.size()));
      bool has_chain = false;
      for (std::size_t i = 0; i < before_u.size(); ++i)
        for (std::size_t j = 0; j < before_v.size(); ++j) {
          if (!before_u[i] || !before_v[j] || !chain_between(e, i, j)) continue;
          at_u.may_be[i] = at_v.may_be[j] = has_chain = true;
        }
      if (!has_chain) {
        failed_ = e;
        return false;
      }
      goes_on |= at_u.may_be != before_u || at_v.may_be != before_v;
    }
  }
  return true;
}

template <int D>
bool Side_choice<D>::solve() {
  if (++tries_ > most_tries || !narrow()) return false;
  const auto open = std::find_if(vertices_.begin(), vertices_.end(), [](const auto& v) {
    return std::count(v.second.may_be.begin(), v.second.may_be.end(), true) > 1;
  });
  if (open == vertices_.end()) return true;
  const Vertices before = vertices_;
  const std::uint32_t vertex = open->first;
  for (std::size_t k = 0; k < before.at(vertex).may_be.size(); ++k) {
    if (!before.at(vertex).may_be[k]) continue;
    std::vector<bool>& may_be = vertices_.at(vertex).may_be;
    std::fill(may_be.begin(), may_be.end(), false);
    may_be[k] = true;
    if (solve()) return true;
    vertices_ = before;
  }
  return false;
}

template <int D>
bool Side_choice<D>::choose() {
  tries_ = 0;
  for (auto& [v, vertex] : vertices_) std::fill(vertex.may_be.begin(), vertex.may_be.end(), true);
  return solve();
}

template <int D>
std::size_t Side_choice<D>::chosen(const Vertex& vertex) {
  return static_cast<std::size_t>(std::find(vertex.may_be.begin(), vertex.may_be.end(), true) -
                                  vertex.may_be.begin());
}

template <int D>
const Particle<D>& Side_choice<D>::particle(std::uint32_t vertex) const {
  const auto known = vertices_.find(vertex);
  return known == vertices_.end() ? groups_.particle({group_, vertex})
                                  : known->second.sides[chosen(known->second)];
}

template <int D>
const Chain& Side_choice<D>::chain(std::uint32_t edge) {
  if (!edges_.contains(edge)) return groups_.chain({group_, edge});
  const auto [u, v] = groups_.all()[group_].edges[edge];
  return *chain_between(edge, chosen(vertices_.at(u)), chosen(vertices_.at(v)));
}

template <int D>
void Side_choice<D>::prepare() {
  for (const auto& [v, vertex] : vertices_) {
    const Particle<D>& side = vertex.sides[chosen(vertex)];
    if (groups_.particle({group_, v}).cell == side.cell) continue;
    moved_.emplace_back(v, side);
    groups_.enter_vertex({group_, v}, side.cell);
  }
  for (const auto& [e, edge] : edges_) {
    const std::uint32_t first = groups_.all()[group_].edges[e][0];
    const Chain& now = groups_.chain({group_, e});
    Chain then = chain(e);
    const Cell from = particle(first).cell;
    // An edge in one cell has no facets, also if it is in another one then.
    if (then == now && groups_.particle({group_, first}).cell == from) continue;
    groups_.enter_edge({group_, e}, from, then, {});
    chains_.emplace_back(e, std::move(then));
  }
}

template <int D>
void Side_choice<D>::commit() noexcept {
  for (const auto& [v, side] : moved_) groups_.particle({group_, v}) = side;
  for (auto& [e, chain] : chains_) groups_.chain({group_, e}) = std::move(chain);
}

template class Side_choice<2>;
template class Side_choice<3>;

}  // namespace cellwalk::detail
