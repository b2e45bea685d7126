// SPDX-License-Identifier: LGPL-3.0-or-later
// The tests that a split keeps cells positive and solid off free space, and the patch of it.
#include "splitter.h"

#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/signs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reshape/replace/patch.h"
#include "simplices.h"

namespace cellwalk::detail {
namespace {

/// The number of classes of cells joined through facets that have some points.
template <int D>
std::size_t count_fans(const Snapshot<D>& snapshot, std::span<const Cell> cells,
                       std::span<const std::uint32_t> points) {
  std::vector<char> is_seen(cells.size(), 0);
  std::size_t fans = 0;
  std::vector<std::size_t> stack;
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (is_seen[first]) continue;
    ++fans;
    is_seen[first] = 1;
    stack.push_back(first);
    while (!stack.empty()) {
      const Cell c = cells[stack.back()];
      stack.pop_back();
      const Cell_view<D> view = snapshot.view(c);
      for (std::size_t f = 0; f < view.facet_count(); ++f) {
        if (!std::ranges::all_of(points, [&](std::uint32_t p) { return has_point(view, f, p); })) continue;
        const auto other = std::ranges::find(cells, snapshot.neighbour(Snapshot<D>::half_facet(c, f)));
        if (other == cells.end()) continue;
        const auto next = static_cast<std::size_t>(other - cells.begin());
        if (!std::exchange(is_seen[next], 1)) stack.push_back(next);
      }
    }
  }
  return fans;
}

}  // namespace

template <int D>
bool Splitter<D>::is_wall_off(Cell cell, std::uint32_t corner) const {
  return snapshot().is_impassable(facet_off(snapshot(), cell, corner));
}

/// True if a simplex is positive with a point of it elsewhere.
template <int D>
bool Splitter<D>::is_positive(const Simplex& cell, std::uint32_t moved, const Point<D>& position) const {
  std::array<Point<D>, corner_count> x;
  for (std::size_t k = 0; k < corner_count; ++k)
    x[k] = cell[k] == moved ? position : snapshot().point(cell[k]);
  return volume_sign(x) > 0;
}

/// True if the walls at an edge may be split at a position: solid retreats, free cells at the edge are
/// joined, and nothing rests on the walls.
template <int D>
bool Splitter<D>::may_move_walls(std::span<const Cell> cells, std::uint32_t u, std::uint32_t v,
                                 const Point<D>& position) const {
  const Snapshot<D>& s = snapshot();
  std::vector<Cell> free;
  std::vector<Half_facet> walls;
  for (const Cell c : cells) {
    const Cell_view<D> view = s.view(c);
    if (!s.is_solid(c)) free.push_back(c);
    for (std::size_t f = 0; f < view.facet_count(); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(c, f);
      if (!has_point(view, f, u) || !has_point(view, f, v)) continue;
      const Cell other = s.neighbour(facet);
      const int where = side<Exact>(view, f, position, transaction_.walk_counts());
      if (other == Cell::none) {
        if (where != 0) return false;
        if (!s.is_solid(c)) walls.push_back(facet);
      } else if (!s.is_solid(c) && s.is_impassable(facet)) {
        if (!s.is_solid(other) || where < 0) return false;
        walls.push_back(facet);
      }
    }
  }
  const std::array<std::uint32_t, 2> edge{u, v};
  if (count_fans(s, std::span<const Cell>(free), edge) > 1) return false;
  if (D == 2 || !transaction_.groups().has_open()) return true;
  for (const Resident_group<D>& group : transaction_.groups().all()) {
    if (!group.is_open || !group.body || !group.body->keeps_faces() || !group.body->has_supporting_walls())
      continue;
    for (std::uint32_t f = 0; f < group.faces.size(); ++f)
      for (const Half_facet w : group.body->supporting_walls(f))
        if (std::ranges::find(walls, w) != walls.end()) return false;
  }
  return true;
}

/// True if boundary facets at an edge that is split at a position stay in their planes, and solid goes into
/// no free cell there.
template <int D>
bool Splitter<D>::keeps_solid_off(std::span<const Cell> cells, const std::array<std::uint32_t, 2>& edge,
                                  const Point<D>& position) const {
  const Snapshot<D>& s = snapshot();
  for (const Cell c : cells) {
    const Cell_view<D> view = s.view(c);
    for (std::size_t f = 0; f < view.facet_count(); ++f) {
      if (!has_point(view, f, edge[0]) || !has_point(view, f, edge[1])) continue;
      const Cell other = s.neighbour(Snapshot<D>::half_facet(c, f));
      const bool is_free_side = other != Cell::none && !s.is_solid(c) && s.is_solid(other);
      if (other != Cell::none && !is_free_side) continue;
      const int where = side<Exact>(view, f, position, transaction_.walk_counts());
      if (is_free_side ? where < 0 : where != 0) return false;
    }
  }
  return true;
}

/// All cells with an edge.
template <int D>
std::vector<Cell> Splitter<D>::cells_at(std::uint32_t u, std::uint32_t v) const {
  std::vector<Cell> cells = transaction_.environment().cells_around(u);
  std::erase_if(cells, [&](Cell c) { return !has_corner(snapshot(), c, v); });
  return cells;
}

template <int D>
void Splitter<D>::open_groups(std::uint32_t u, std::uint32_t v) {
  transaction_.open(cells_at(u, v));
}

/// The mean direction from walls at an edge into solid cells; zero if it has none.
template <int D>
Vector<D> Splitter<D>::into_solid(std::uint32_t u, std::uint32_t v) const {
  const Snapshot<D>& s = snapshot();
  Vector<D> sum{};
  for (const Cell c : transaction_.environment().cells_around(u)) {
    if (!s.is_solid(c)) continue;
    const Cell_view<D> view = s.view(c);
    for (std::size_t f = 0; f < view.facet_count(); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(c, f);
      const Cell other = s.neighbour(facet);
      if (other != Cell::none && !s.is_solid(other) && has_point(view, f, u) && has_point(view, f, v))
        sum = sum + inward_normal(s, facet);
    }
  }
  return normalized(sum, Vector<D>{});
}

template <int D>
std::optional<std::uint32_t> Splitter<D>::split_edge(std::uint32_t u, std::uint32_t v,
                                                     const Point<D>& position, Walls walls_there) {
  const Vector<D> inward = into_solid(u, v);
  double size = 0;
  for (const double x : position) size = std::max(size, std::abs(x));
  const double unit = std::nextafter(size, 2 * size + 1) - size;
  for (int k = 0; k <= most_shifts; ++k) {
    const double shift = k == 0 ? 0 : std::ldexp(unit, k);
    if (const auto point = split_at(u, v, position + shift * inward, walls_there)) return point;
    if (inward == Vector<D>{}) break;
  }
  return std::nullopt;
}

template <int D>
std::optional<std::uint32_t> Splitter<D>::split_at(std::uint32_t u, std::uint32_t v, const Point<D>& position,
                                                   Walls walls_there) {
  const Snapshot<D>& s = snapshot();
  const std::vector<Cell> cells = cells_at(u, v);
  std::vector<Cell> free;
  const std::array<std::uint32_t, 2> edge{u, v};
  if (cells.empty() || count_fans(s, std::span<const Cell>(cells), edge) > 1) return std::nullopt;
  const std::uint32_t point = s.next_point();
  Cell_soup<D> soup;
  for (const Cell c : cells) {
    if (s.view(c).vertex_count() != corner_count) return std::nullopt;
    if (!s.is_solid(c)) free.push_back(c);
    const Simplex old = corners_of(s, c);
    for (const std::uint32_t end : edge) {
      if (!is_positive(old, end, position)) return std::nullopt;
      Simplex simplex = old;
      std::array<bool, corner_count> walls{};
      for (std::size_t k = 0; k < corner_count; ++k) {
        // The facet that lacks the other end is new; all others are old ones, or parts of them.
        if (old[k] == u || old[k] == v)
          walls[k] = old[k] == end && is_wall_off(c, end);
        else
          walls[k] = is_wall_off(c, old[k]);
      }
      std::ranges::replace(simplex, end, point);
      add_cell(soup, simplex, walls, s.is_solid(c));
    }
  }
  transaction_.open(cells);
  const typename Cell_transaction<D>::Moved_walls moved{soup, position};
  const bool may_be = walls_there == Walls::retreat ? may_move_walls(cells, u, v, position)
                                                    : keeps_solid_off(cells, edge, position) &&
                                                          transaction_.leave(free, &moved).empty();
  if (!may_be) return std::nullopt;
  transaction_.note(free);
  transaction_.replace(cells, soup, glue_patch(soup), position, Cell_transaction<D>::Into::free);
  return point;
}

template <int D>
std::optional<std::uint32_t> Splitter<D>::split_vertex(std::uint32_t vertex, std::span<const Cell> solid,
                                                       const Point<D>& target, std::string& reason) {
  const Snapshot<D>& s = snapshot();
  const std::uint32_t point = s.next_point();
  Cell_soup<D> soup;
  // Facets at the vertex to cells that are not taken back.
  std::vector<std::pair<Cell, std::uint32_t>> outer;
  std::vector<std::uint32_t> others;
  const auto not_made = [&](const char* why) {
    reason = why;
    return std::nullopt;
  };
  for (const Cell c : solid) {
    const Simplex old = corners_of(s, c);
    if (!is_positive(old, vertex, target)) return not_made("a cell would be flat or inverted");
    Simplex simplex = old;
    std::array<bool, corner_count> walls{};
    for (std::size_t k = 0; k < corner_count; ++k) {
      const Half_facet facet = facet_off(s, c, old[k]);
      walls[k] = s.is_impassable(facet);
      if (old[k] == vertex) continue;
      others.push_back(old[k]);
      if (std::ranges::find(solid, s.neighbour(facet)) != solid.end()) continue;
      outer.emplace_back(c, old[k]);
      walls[k] = true;
    }
    std::ranges::replace(simplex, vertex, point);
    add_cell(soup, simplex, walls, true);
  }
  if (outer.empty()) return not_made("nothing but these cells has the vertex");
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  for (const std::uint32_t x : others) {
    std::vector<Cell> at_edge;
    for (const Cell c : solid)
      if (has_corner(s, c, x)) at_edge.push_back(c);
    const std::array<std::uint32_t, 2> edge{vertex, x};
    if (count_fans(s, std::span<const Cell>(at_edge), edge) > 1)
      return not_made("the cells meet in an edge only");
  }
  // A gap cell has the facet, and the new vertex instead of the corner behind it.
  std::vector<std::size_t> gaps;
  for (const auto& [c, behind] : outer) {
    Simplex simplex = corners_of(s, c);
    if (!is_positive(simplex, behind, target)) return not_made("a cell of the gap would be flat or inverted");
    std::array<bool, corner_count> walls{};
    for (std::size_t k = 0; k < corner_count; ++k) walls[k] = simplex[k] == vertex || simplex[k] == behind;
    std::ranges::replace(simplex, behind, point);
    gaps.push_back(soup.cell_count());
    add_cell(soup, simplex, walls, false);
  }
  const std::vector<Cell> added = transaction_.exchange(solid, soup, target);
  for (const std::size_t gap : gaps) {
    const Half_facet facet = facet_off(s, added[gap], point);
    const Cell other = s.neighbour(facet);
    if (other != Cell::none && !s.is_solid(other)) toggle_.open(facet);
  }
  return point;
}

template class Splitter<2>;
template class Splitter<3>;

}  // namespace cellwalk::detail
