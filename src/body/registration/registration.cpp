// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for sides that agree along all edges: each choice narrows those of the neighbours.
#include "registration.h"

#include <cellwalk/internal/edge/chain_as_before.h>
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace cellwalk::detail {
namespace {

template <int D>
class Registration {
 public:
  Registration(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
               const Registered_before<D>& before)
      : snapshot_(snapshot),
        soup_(soup),
        before_(before),
        sides_(soup.points.size()),
        edges_at_(soup.points.size()) {
    for (std::uint32_t v = 0; v < soup.points.size(); ++v) sides_[v] = sides(v, locator);
    for (std::uint32_t e = 0; e < before.chains.size(); ++e) look_back(e);
    for (std::uint32_t e = 0; e < soup.edges.size(); ++e)
      for (const std::uint32_t v : soup.edges[e]) edges_at_[v].push_back(e);
  }

  using Sides = std::vector<Particle<D>>;

  /// The sides that agree edge by edge.
  std::vector<Sides> left() {
    for (std::uint32_t e = 0; e < soup_.edges.size(); ++e) narrow_all(e);
    return sides_;
  }

  Registered<D> run() {
    left();
    // The sides that are left agree edge by edge. A vertex with a choice takes one side, and its neighbours
    // follow. Those that can stay where they were go first, so that none that cannot makes them leave.
    for (const bool can_stay : {true, false})
      for (std::uint32_t v = 0; v < sides_.size(); ++v)
        if (sides_[v].size() > 1 && is_as_before(v, sides_[v].front()) == can_stay) choose(v);
    Registered<D> result;
    for (const auto& sides : sides_) result.particles.push_back(sides.front());
    for (std::uint32_t e = 0; e < soup_.edges.size(); ++e) {
      const auto [u, v] = soup_.edges[e];
      result.chains.push_back(chain(e, sides_[u].front(), sides_[v].front()).chain);
    }
    return result;
  }

 private:
  std::string place(std::uint32_t v) const { return fmt::format("({})", fmt::join(soup_.points[v], ", ")); }

  Cell cell_before(std::uint32_t v) const {
    return before_.particles.empty() ? Cell::none : before_.particles[v].cell;
  }
  bool is_as_before(std::uint32_t v, const Particle<D>& side) const { return side.cell == cell_before(v); }

  /// \pre the point is in the closed cell
  bool is_in(Cell cell, std::size_t facet, const Point<D>& x) const {
    Walk_counts uncounted;
    const Cell_view<D> view = snapshot_.view(cell);
    return side<Exact>(view, facet, x, uncounted) == 0 && in_facet(view, facet, x);
  }

  /// The cells that were linked with that of a vertex, at it.
  std::vector<Cell> linked_before(std::uint32_t v) const {
    std::vector<Cell> cells{cell_before(v)};
    if (const auto parts = before_.parts.find(v); parts != before_.parts.end()) cells = parts->second;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Cell cell = cells[i];
      for (std::size_t k = 0; k < snapshot_.facet_count(cell); ++k) {
        const Half_facet f = Snapshot<D>::half_facet(cell, k);
        const Cell behind = snapshot_.neighbour(f);
        if (behind == Cell::none || std::ranges::find(cells, behind) != cells.end() ||
            !was_passable(snapshot_, before_.edits, f) || !is_in(cell, k, soup_.points[v]))
          continue;
        cells.push_back(behind);
      }
    }
    return cells;
  }

  Edge_before edge_before(std::uint32_t e) const {
    const auto [u, v] = soup_.edges[e];
    return {cell_before(u), cell_before(v), before_.chains[e]};
  }

  void look_back(std::uint32_t e) {
    const auto [u, v] = soup_.edges[e];
    const Edge_before before = edge_before(e);
    is_way_known_[e] = was_chain(snapshot_, before_.edits, soup_.points[u], soup_.points[v], before, counts_);
    keeps_chain_[e] =
        is_way_known_[e] && before_.may_keep_chain[e] &&
        std::ranges::none_of(before.chain, [&](Half_facet f) { return snapshot_.is_impassable(f); });
  }

  /// A chain between sides of the ends of an edge, on its side of the walls that stood before if it is known:
  /// that which it had, if it still holds. Faces may need it.
  Chain_result<D> chain(std::uint32_t e, const Particle<D>& p, const Particle<D>& q) {
    const auto [u, v] = soup_.edges[e];
    if (keeps_chain_[e] && is_as_before(u, p) && is_as_before(v, q)) return {before_.chains[e], {}};
    return is_way_known_[e] ? find_chain_as_before(snapshot_, before_.edits, p, q, edge_before(e), counts_)
                            : find_any_chain(snapshot_, p, q, counts_);
  }

  /// A particle for each side of the walls at a vertex that was linked with its cell, that of the cell first;
  /// for each side at all if its cell is not known.
  Sides sides(std::uint32_t v, const Locator<D>& locator) {
    check_finite(soup_.points[v], fmt::format("vertex {} of the body", v));
    Location<D> here = locator.locate(soup_.points[v]);
    if (here.sides.empty())
      refuse_vertex(v, here.status == Location_status::solid ? "in a solid cell" : "outside the environment");
    const Cell known = cell_before(v);
    if (known == Cell::none || !in_closure(snapshot_, known, soup_.points[v])) return std::move(here.sides);
    const auto side_of = [&](Cell cell) {
      const auto place = std::ranges::find(here.cells, cell);
      return place == here.cells.end()
                 ? -1
                 : here.side_of_cell[static_cast<std::size_t>(place - here.cells.begin())];
    };
    const int own = side_of(known);
    if (here.sides.size() == 1 && own == 0) {
      here.sides.front().cell = known;
      return std::move(here.sides);
    }
    std::vector<bool> is_linked(here.sides.size());
    for (const Cell cell : linked_before(v))
      if (const int side = side_of(cell); side >= 0) is_linked[static_cast<std::size_t>(side)] = true;
    Sides result;
    for (std::size_t i = 0; i < here.sides.size(); ++i) {
      if (!is_linked[i]) continue;
      result.push_back(here.sides[i]);
      if (static_cast<int>(i) != own) continue;
      result.back().cell = known;
      if (before_.prefers_cells) std::rotate(result.begin(), result.end() - 1, result.end());
    }
    if (result.empty()) refuse_vertex(v, "on a side of walls that was filled");
    return result;
  }

  /// Drops the sides of both ends of an edge that no chain joins with one of the other end. True if any were
  /// dropped; none at all are left where the edge crosses a wall.
  bool narrow(std::uint32_t e, std::optional<Contact<D>>& contact) {
    Sides &of_u = sides_[soup_.edges[e][0]], &of_v = sides_[soup_.edges[e][1]];
    if (of_u.size() == 1 && of_v.size() == 1 && is_checked_[e]) return false;
    std::vector<bool> keep_u(of_u.size()), keep_v(of_v.size());
    for (std::size_t i = 0; i < of_u.size(); ++i)
      for (std::size_t j = 0; j < of_v.size(); ++j) {
        const auto found = chain(e, of_u[i], of_v[j]);
        if (found.contact) {
          if (!contact) contact = found.contact;
          continue;
        }
        keep_u[i] = keep_v[j] = true;
      }
    const std::size_t before = of_u.size() + of_v.size();
    keep(soup_.edges[e][0], keep_u);
    keep(soup_.edges[e][1], keep_v);
    if (of_u.size() == 1 && of_v.size() == 1) {
      is_checked_[e] = true;
      checked_.push_back(e);
    }
    return of_u.size() + of_v.size() < before;
  }

  void keep(std::uint32_t v, const std::vector<bool>& kept) {
    if (std::find(kept.begin(), kept.end(), false) == kept.end()) return;
    Sides result;
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i]) result.push_back(sides_[v][i]);
    dropped_.emplace_back(v, std::exchange(sides_[v], result));
  }

  /// Takes back all that was done since the last choice.
  void undo() {
    for (; !dropped_.empty(); dropped_.pop_back()) sides_[dropped_.back().first] = dropped_.back().second;
    for (; !checked_.empty(); checked_.pop_back()) is_checked_[checked_.back()] = false;
  }

  /// Narrows an edge, and all that depend on it. False if an edge has no chain then.
  bool narrow_from(std::uint32_t first, std::uint32_t& failed, std::optional<Contact<D>>& contact) {
    std::vector<std::uint32_t> todo{first};
    while (!todo.empty()) {
      const std::uint32_t e = todo.back();
      todo.pop_back();
      contact.reset();
      if (!narrow(e, contact)) continue;
      const auto [u, v] = soup_.edges[e];
      if (sides_[u].empty() || sides_[v].empty()) {
        failed = e;
        return false;
      }
      for (const std::uint32_t w : {u, v})
        for (const std::uint32_t other : edges_at_[w])
          if (other != e) todo.push_back(other);
    }
    return true;
  }

  void narrow_all(std::uint32_t e) {
    std::optional<Contact<D>> contact;
    std::uint32_t failed = e;
    if (!narrow_from(e, failed, contact)) refuse(failed, *contact);
  }

  void choose(std::uint32_t v) {
    const Sides all = sides_[v];
    std::optional<Contact<D>> contact;
    std::uint32_t failed = 0;
    for (const Particle<D>& side : all) {
      dropped_ = {{v, all}};
      checked_.clear();
      sides_[v] = {side};
      bool is_good = true;
      for (const std::uint32_t e : edges_at_[v]) is_good = is_good && narrow_from(e, failed, contact);
      if (is_good) return;
      undo();
    }
    refuse(failed, *contact);
  }

  [[noreturn]] void refuse_vertex(std::uint32_t v, const char* where) const {
    throw Error(Error_code::outside,
                fmt::format("vertex {} of the body, at {}, is {}: move the body into free space", v, place(v),
                            where));
  }

  [[noreturn]] void refuse(std::uint32_t e, const Contact<D>& contact) const {
    const auto [u, v] = soup_.edges[e];
    throw Error(
        Error_code::outside,
        fmt::format("edge {} of the body, from vertex {} at {} to vertex {} at {}, crosses a wall at ({}), "
                    "in cell {}: move the body into free space",
                    e, u, place(u), v, place(v), fmt::join(contact.point, ", "),
                    snapshot_.index(contact.cell)));
  }

  const Snapshot<D>& snapshot_;
  const Body_soup<D>& soup_;
  const Registered_before<D>& before_;
  std::vector<Sides> sides_;
  std::vector<std::vector<std::uint32_t>> edges_at_;
  /// Sides of vertices before some were dropped, in order.
  std::vector<std::pair<std::uint32_t, Sides>> dropped_;
  std::vector<std::uint32_t> checked_;  ///< edges checked in the same time
  std::vector<bool> is_checked_ = std::vector<bool>(soup_.edges.size());
  std::vector<bool> is_way_known_ = std::vector<bool>(soup_.edges.size());
  std::vector<bool> keeps_chain_ = std::vector<bool>(soup_.edges.size());  ///< from the sides before
  Walk_counts counts_;
};

}  // namespace

template <int D>
Registered<D> register_body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
                            const Registered_before<D>& before) {
  return Registration<D>(snapshot, locator, soup, before).run();
}

std::vector<std::vector<Particle<3>>> sides_left(const Snapshot<3>& snapshot, const Locator<3>& locator,
                                                 const Body_soup<3>& soup) {
  return Registration<3>(snapshot, locator, soup, {}).left();
}

template Registered<2> register_body<2>(const Snapshot<2>&, const Locator<2>&, const Body_soup<2>&,
                                        const Registered_before<2>&);
template Registered<3> register_body<3>(const Snapshot<3>&, const Locator<3>&, const Body_soup<3>&,
                                        const Registered_before<3>&);

}  // namespace cellwalk::detail
