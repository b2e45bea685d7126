// SPDX-License-Identifier: LGPL-3.0-or-later
#include "registration.h"

#include <cellwalk/kernel/error.h>

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
    for (std::uint32_t v = 0; v < soup.points.size(); ++v) sides_[v] = sides(v, locator, cell_before(v));
    for (std::uint32_t e = 0; e < before.chains.size(); ++e) keeps_chain_[e] = is_chain_before(e);
    for (std::uint32_t e = 0; e < soup.edges.size(); ++e)
      for (const std::uint32_t v : soup.edges[e]) edges_at_[v].push_back(e);
  }

  Registered<D> run() {
    for (std::uint32_t e = 0; e < soup_.edges.size(); ++e) narrow_all(e);
    // What is left agrees edge by edge. A vertex with a choice takes one side, and its neighbours follow.
    // Those that can stay where they were go first, so that none that cannot makes them leave.
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
  using Sides = std::vector<Particle<D>>;

  std::string place(std::uint32_t v) const { return fmt::format("({})", fmt::join(soup_.points[v], ", ")); }

  Cell cell_before(std::uint32_t v) const {
    return before_.particles.empty() ? Cell::none : before_.particles[v].cell;
  }
  bool is_as_before(std::uint32_t v, const Particle<D>& side) const { return side.cell == cell_before(v); }

  /// True if an edge has the chain that it had, from cell to cell. Names of facets may be gone since.
  bool is_chain_before(std::uint32_t e) {
    const auto [u, v] = soup_.edges[e];
    const Particle<D>&p = sides_[u].front(), &q = sides_[v].front();
    const auto is_facet = [&](Half_facet f) { return to_index(f) < snapshot_.half_facet_slots(); };
    const Chain& chain = before_.chains[e];
    return is_as_before(u, p) && is_as_before(v, q) && std::ranges::all_of(chain, is_facet) &&
           is_chain(snapshot_, p, q, chain, counts_);
  }

  /// A chain between sides of the ends of an edge: that which it had, if it still holds. Faces may need it.
  Chain_result<D> chain(std::uint32_t e, const Particle<D>& p, const Particle<D>& q) {
    const auto [u, v] = soup_.edges[e];
    if (keeps_chain_[e] && is_as_before(u, p) && is_as_before(v, q)) return {before_.chains[e], {}};
    return find_any_chain(snapshot_, p, q, counts_);
  }

  /// A particle for each side of the walls at a vertex. If `first` holds the vertex, its side comes first, in
  /// that cell.
  Sides sides(std::uint32_t v, const Locator<D>& locator, Cell first) {
    Location<D> here = locator.locate(soup_.points[v]);
    if (here.sides.empty())
      throw Error(
          Error_code::outside,
          fmt::format("vertex {} of the body, at {}, is {}: move the body into free space", v, place(v),
                      here.status == Location_status::solid ? "in a solid cell" : "outside the environment"));
    if (const auto kept = std::find(here.cells.begin(), here.cells.end(), first); kept != here.cells.end()) {
      const auto side =
          here.sides.begin() + here.side_of_cell[static_cast<std::size_t>(kept - here.cells.begin())];
      std::rotate(here.sides.begin(), side, side + 1);
      here.sides.front().cell = first;
    }
    return std::move(here.sides);
  }

  /// Drops the sides of both ends of an edge that no chain joins with one of the other end. True if any were
  /// dropped; none at all are left where the edge crosses a wall.
  bool narrow(std::uint32_t e, std::optional<Wall_contact<D>>& contact) {
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
  bool narrow_from(std::uint32_t first, std::uint32_t& failed, std::optional<Wall_contact<D>>& contact) {
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
    std::optional<Wall_contact<D>> contact;
    std::uint32_t failed = e;
    if (!narrow_from(e, failed, contact)) refuse(failed, *contact);
  }

  void choose(std::uint32_t v) {
    const Sides all = sides_[v];
    std::optional<Wall_contact<D>> contact;
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

  [[noreturn]] void refuse(std::uint32_t e, const Wall_contact<D>& contact) const {
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
  std::vector<bool> keeps_chain_ = std::vector<bool>(soup_.edges.size());  ///< from the sides before
  Walk_counts counts_;
};

}  // namespace

template <int D>
Registered<D> register_body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
                            const Registered_before<D>& before) {
  return Registration<D>(snapshot, locator, soup, before).run();
}

template Registered<2> register_body<2>(const Snapshot<2>&, const Locator<2>&, const Body_soup<2>&,
                                        const Registered_before<2>&);
template Registered<3> register_body<3>(const Snapshot<3>&, const Locator<3>&, const Body_soup<3>&,
                                        const Registered_before<3>&);

}  // namespace cellwalk::detail
