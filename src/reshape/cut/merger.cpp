// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells around both points with one of them replaced, and the reasons why they may not merge.
#include "merger.h"

#include <algorithm>

#include "reshape/replace/patch.h"
#include "simplices.h"

namespace cellwalk::detail {

/// True if the facet that a kept cell gets where a gap cell vanishes is passable: solid heals, and free space
/// stays joined unless a membrane was on either side of the gap cell.
template <int D>
bool Merger<D>::is_sewn(Cell kept, Cell gap, std::uint32_t point, std::uint32_t onto) const {
  const Snapshot<D>& s = snapshot();
  const Half_facet inner = facet_off(s, gap, onto), outer = facet_off(s, gap, point);
  const Cell beyond = s.neighbour(outer);
  if (beyond == Cell::none || s.is_solid(beyond) != s.is_solid(kept)) return false;
  return s.is_solid(kept) || !(s.is_impassable(inner) || s.is_impassable(outer));
}

/// Adds the cells around a point, with another one instead of it, but for those that have both. Returns why
/// this cannot be; empty if it can.
/// \param opened receives the facets that are to be passable where a gap cell vanishes
template <int D>
std::string Merger<D>::add_cells(std::span<const Cell> star, std::uint32_t point, std::uint32_t onto,
                                 Cell_soup<D>& soup, std::vector<Seam>& opened) const {
  const Snapshot<D>& s = snapshot();
  const auto has_both = [&](Cell c) { return has_corner(s, c, onto); };
  if (std::ranges::any_of(star, [&](Cell c) { return has_both(c) && s.is_solid(c); }))
    return "a solid cell has both points";
  if (std::ranges::none_of(star, has_both)) return "no free cell has both points";
  const auto is_on_boundary = [&](Cell c) {
    return std::ranges::any_of(s.view(c).vertices, [&](std::uint32_t corner) {
      return corner != point && s.neighbour(facet_off(s, c, corner)) == Cell::none;
    });
  };
  if (std::ranges::any_of(star, is_on_boundary)) return "the boundary has the point";
  for (const Cell c : star) {
    const auto old = corners_of(s, c);
    const bool vanishes = has_both(c);
    std::array<bool, static_cast<std::size_t>(D) + 1> walls{};
    std::array<Point<D>, static_cast<std::size_t>(D) + 1> x;
    for (std::size_t k = 0; k < old.size(); ++k) {
      x[k] = s.point(old[k] == point ? onto : old[k]);
      const Half_facet facet = facet_off(s, c, old[k]);
      const Cell other = s.neighbour(facet);
      walls[k] = s.is_impassable(facet);
      if (old[k] == point) continue;
      if (vanishes || !has_corner(s, other, onto)) continue;
      walls[k] = !is_sewn(c, other, point, onto);
      if (!walls[k]) opened.push_back({soup.cell_count(), old[k]});
    }
    if (vanishes) continue;
    if (volume_sign(x) <= 0) return "a cell would be flat or inverted";
    auto simplex = old;
    std::ranges::replace(simplex, point, onto);
    add_cell(soup, simplex, walls, s.is_solid(c));
  }
  return "";
}

template <int D>
Replacement Merger<D>::merge_vertices(std::uint32_t point, std::uint32_t onto) {
  const std::vector<Cell> star = transaction_.environment().cells_around(point);
  Replacement result;
  Cell_soup<D> soup;
  std::vector<Seam> opened;
  result.reason = add_cells(star, point, onto, soup, opened);
  if (!result.reason.empty()) return result;
  const std::vector<Cell> free = transaction_.free_of(star);
  transaction_.open(star);
  const typename Cell_transaction<D>::Moved_walls moved{soup, {}};
  result.held_by = transaction_.leave(free, &moved);
  if (!result.held_by.empty()) {
    result.reason = "something lies in the free cells around the point";
    return result;
  }
  transaction_.note(free);
  result.cells = transaction_.replace(star, soup, glue_patch(soup), {}, Cell_transaction<D>::Into::free,
                                      [&](std::span<const Cell> cells) {
                                        for (const Seam& seam : opened)
                                          toggle_.open(facet_off(snapshot(), cells[seam.cell], seam.apex));
                                      });
  result.is_made = true;
  result.point = point;
  return result;
}

template class Merger<2>;
template class Merger<3>;

}  // namespace cellwalk::detail
