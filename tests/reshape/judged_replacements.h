// SPDX-License-Identifier: LGPL-3.0-or-later
// Replacements of cells judged in rational numbers: whether one may be made. Of the library it uses which
// cells there are and how they are joined.
#ifndef CELLWALK_TESTS_RESHAPE_JUDGED_REPLACEMENTS_H
#define CELLWALK_TESTS_RESHAPE_JUDGED_REPLACEMENTS_H

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "reshape/near_cells.h"
#include "reshape/replacing.h"

namespace cellwalk::test {

template <int D>
class Replacement_judge {
 public:
  explicit Replacement_judge(const Snapshot<D>& snapshot) : snapshot_(snapshot) {}

  /// Whether a replacement may be made; none if that depends on what lies there.
  std::optional<bool> may_be_made(const Replacement_request<D>& request) const {
    switch (request.kind) {
      case 0:
        return is_insertion(request.cell, request.position);
      case 1:
        return is_split(request.u, request.v, request.position);
      case 2:
        return is_flip(request.facet);
      case 3:
        return is_removal(request.u, request.v);
      default:
        return is_collapse(request.u, request.v);
    }
  }

  /// Whether solid cells may be taken back from a vertex.
  bool may_be_taken_back(std::uint32_t vertex, std::span<const Cell> solid, const Point<D>& target) const {
    bool has_gap = false;
    for (const Cell c : solid) {
      if (!keeps_sense(c, vertex, target)) return false;
      for (const std::uint32_t behind : snapshot_.view(c).vertices) {
        const Half_facet f = facet_off(c, behind);
        if (behind == vertex || std::ranges::find(solid, snapshot_.neighbour(f)) != solid.end()) continue;
        has_gap = true;
        if (!keeps_sense(c, behind, target)) return false;
      }
      for (const std::uint32_t x : snapshot_.view(c).vertices)
        if (x != vertex && !are_joined(solid, vertex, x)) return false;
    }
    return has_gap;
  }

  /// Whether a point may be merged with another one if nothing lies there.
  bool may_be_merged(std::uint32_t point, std::uint32_t onto) const {
    bool has_gap = false;
    for (const Cell c : cells_at(point, point)) {
      for (std::size_t k = 0; k <= D; ++k)
        if (const Half_facet f = Snapshot<D>::half_facet(c, k);
            has_both(f, point, point) && snapshot_.neighbour(f) == Cell::none)
          return false;
      if (!has(c, onto)) {
        if (!keeps_sense(c, point, snapshot_.point(onto))) return false;
        continue;
      }
      if (snapshot_.is_solid(c)) return false;
      has_gap = true;
    }
    return has_gap;
  }

 private:
  using Simplex = std::array<Place<D>, static_cast<std::size_t>(D) + 1>;

  Place<D> place(std::uint32_t point) const { return exact_place<D>(snapshot_.point(point), 0); }
  Simplex corners(Cell c) const {
    Simplex x;
    for (std::size_t k = 0; k <= D; ++k) x[k] = place(snapshot_.view(c).point_index(k));
    return x;
  }
  bool has(Cell c, std::uint32_t point) const {
    return std::ranges::find(snapshot_.view(c).vertices, point) != snapshot_.view(c).vertices.end();
  }
  Half_facet facet_off(Cell c, std::uint32_t corner) const {
    for (std::size_t k = 0; k <= D; ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      const auto loop = snapshot_.loop(f);
      if (std::ranges::find(loop, corner) == loop.end()) return f;
    }
    return Half_facet::none;
  }
  bool has_both(Half_facet f, std::uint32_t u, std::uint32_t v) const {
    const auto loop = snapshot_.loop(f);
    return std::ranges::find(loop, u) != loop.end() && std::ranges::find(loop, v) != loop.end();
  }

  /// True if a cell is as positive as before with a corner elsewhere.
  bool keeps_sense(Cell c, std::uint32_t corner, const Point<D>& position) const {
    Simplex x = corners(c);
    const int before = volume(x).sign();
    for (std::size_t k = 0; k <= D; ++k)
      if (snapshot_.view(c).point_index(k) == corner) x[k] = exact_place<D>(position, 0);
    return volume(x).sign() * before > 0;
  }

  std::vector<Cell> cells_at(std::uint32_t u, std::uint32_t v) const {
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < snapshot_.cell_slots(); ++i)
      if (const Cell c = snapshot_.cell(i); c != Cell::none && has(c, u) && has(c, v)) cells.push_back(c);
    return cells;
  }
  bool has_wall(const std::vector<Cell>& cells, std::uint32_t u, std::uint32_t v) const {
    for (const Cell c : cells)
      for (std::size_t k = 0; k <= D; ++k)
        if (const Half_facet f = Snapshot<D>::half_facet(c, k);
            has_both(f, u, v) && snapshot_.is_impassable(f))
          return true;
    return false;
  }
  /// True if all of some cells that have an edge are joined through facets with it.
  bool are_joined(std::span<const Cell> cells, std::uint32_t u, std::uint32_t v) const {
    std::vector<Cell> all, seen;
    for (const Cell c : cells)
      if (has(c, u) && has(c, v)) all.push_back(c);
    seen.push_back(all.front());
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (std::size_t k = 0; k <= D; ++k) {
        const Half_facet f = Snapshot<D>::half_facet(seen[i], k);
        const Cell other = snapshot_.neighbour(f);
        if (has_both(f, u, v) && std::ranges::find(all, other) != all.end() &&
            std::ranges::find(seen, other) == seen.end())
          seen.push_back(other);
      }
    return seen.size() == all.size();
  }

  bool is_insertion(Cell cell, const Point<D>& position) const {
    return std::ranges::all_of(snapshot_.view(cell).vertices,
                               [&](std::uint32_t corner) { return keeps_sense(cell, corner, position); });
  }

  std::optional<bool> is_split(std::uint32_t u, std::uint32_t v, const Point<D>& position) const {
    const std::vector<Cell> cells = cells_at(u, v);
    const bool is_positive = std::ranges::all_of(
        cells, [&](Cell c) { return keeps_sense(c, u, position) && keeps_sense(c, v, position); });
    if (!has_wall(cells, u, v)) return is_positive;
    for (const Cell c : cells)
      for (std::size_t k = 0; k <= D; ++k)
        if (const Half_facet f = Snapshot<D>::half_facet(c, k);
            has_both(f, u, v) && snapshot_.neighbour(f) == Cell::none)
          return false;
    if (!is_positive || !are_in_line(place(u), place(v), exact_place<D>(position, 0))) return false;
    return std::nullopt;  // if nothing lies there
  }

  static bool are_in_line(const Place<D>& a, const Place<D>& b, const Place<D>& x) {
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((b[i] - a[i]) * (x[j] - a[j]) != (b[j] - a[j]) * (x[i] - a[i])) return false;
    return true;
  }

  std::uint32_t apex(Half_facet f) const {
    const auto loop = snapshot_.loop(f);
    for (const std::uint32_t v : snapshot_.view(snapshot_.cell_of(f)).vertices)
      if (std::ranges::find(loop, v) == loop.end()) return v;
    return loop[0];
  }

  bool is_flip(Half_facet f) const {
    if (snapshot_.is_impassable(f)) return false;
    const auto loop = snapshot_.loop(f);
    const Place<D> d = place(apex(f)), e = place(apex(snapshot_.opposite(f)));
    // The line between the apices passes the inside of the facet.
    std::vector<int> signs;
    for (std::size_t k = 0; k < D; ++k) {
      if constexpr (D == 2)
        signs.push_back((k == 0 ? 1 : -1) * volume({d, e, place(loop[k])}).sign());
      else
        signs.push_back(volume({d, e, place(loop[k]), place(loop[(k + 1) % 3])}).sign());
    }
    return signs[0] != 0 && std::ranges::all_of(signs, [&](int s) { return s == signs[0]; });
  }

  bool is_removal(std::uint32_t u, std::uint32_t v) const {
    if constexpr (D == 3) {
      const std::vector<Cell> cells = cells_at(u, v);
      if (has_wall(cells, u, v) || cells.size() < 3 || cells.size() > 7) return false;
      std::map<std::uint32_t, std::uint32_t> next;
      for (const Cell c : cells) {
        std::vector<std::uint32_t> off;
        for (const std::uint32_t x : snapshot_.view(c).vertices)
          if (x != u && x != v) off.push_back(x);
        if (volume({place(u), place(v), place(off[0]), place(off[1])}).sign() < 0) std::swap(off[0], off[1]);
        next[off[0]] = off[1];
      }
      std::vector<std::uint32_t> ring{next.begin()->first};
      while (ring.size() < cells.size()) ring.push_back(next.at(ring.back()));
      return may_be_filled(ring, u, v);
    }
    return false;
  }

  /// True if some triangulation of a ring makes positive cells with both ends of an edge.
  bool may_be_filled(const std::vector<std::uint32_t>& ring, std::uint32_t u, std::uint32_t v) const {
    if (ring.size() < 3) return true;
    if constexpr (D == 3)
      for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
        const std::uint32_t a = ring.front(), b = ring[k], c = ring.back();
        if (volume({place(a), place(b), place(c), place(v)}).sign() <= 0 ||
            volume({place(a), place(b), place(c), place(u)}).sign() >= 0)
          continue;
        const auto at = ring.begin() + static_cast<std::ptrdiff_t>(k);
        if (may_be_filled({ring.begin(), at + 1}, u, v) && may_be_filled({at, ring.end()}, u, v)) return true;
      }
    return false;
  }

  bool is_collapse(std::uint32_t u, std::uint32_t onto) const {
    const std::vector<Cell> star = cells_at(u, u);
    return !has_wall(star, u, u) && std::ranges::all_of(star, [&](Cell c) {
      return has(c, onto) || keeps_sense(c, u, snapshot_.point(onto));
    });
  }

  const Snapshot<D>& snapshot_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_JUDGED_REPLACEMENTS_H
