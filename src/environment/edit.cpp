// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits of an environment. Each first checks whether the result would be certified, then changes map and
// snapshot.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "environment/certify/complex.h"

namespace cellwalk {
namespace {

/// True if p lies strictly on the inner side of the plane of facet i.
/// \pre the first D vertices of the loop span the facet, as in a Snapshot
bool is_strictly_inside(const Cell_view<2>& cell, std::size_t i, const Point<2>& p) {
  Predicate_counts counts;
  const auto loop = cell.loop(i);
  return Exact::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), p) > 0;
}

bool is_strictly_inside(const Cell_view<3>& cell, std::size_t i, const Point<3>& p) {
  Predicate_counts counts;
  const auto loop = cell.loop(i);
  return Exact::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]), p) < 0;
}

/// Updates the index of the boundary. If memory runs out, the index is dropped, and rebuilt when it is
/// needed.
template <int D, class Update>
void follow(std::unique_ptr<detail::Boundary_index<D>>& index, const Update& update) {
  std::unique_ptr<detail::Boundary_index<D>> kept = std::move(index);
  update(*kept);
  index = std::move(kept);
}

}  // namespace

template <int D>
Map_storage<D>& Environment<D>::editable() {
  if (!storage_) throw Error(Error_code::usage, "the environment is frozen: thaw() it to edit it");
  return *storage_;
}

template <int D>
void Environment<D>::check_half_facet(Half_facet facet) const {
  if (to_index(facet) >= storage_->dart_of_half_facet.size() ||
      storage_->dart_of_half_facet[to_index(facet)] == Dart<D>{})
    throw Error(Error_code::usage, "there is no half-facet " + std::to_string(to_index(facet)));
}

template <int D>
void Environment<D>::check_cell_name(Cell cell) const {
  if (snapshot_->is_cell(cell)) return;
  throw Error(Error_code::usage, "there is no cell with the name " + std::to_string(to_index(cell)));
}

template <int D>
void Environment<D>::set_impassable(Half_facet facet, bool wall) {
  Map_storage<D>& storage = editable();
  check_half_facet(facet);
  Map<D>& map = storage.map;
  const Dart<D> own = storage.dart_of_half_facet[to_index(facet)];
  const std::string name = "facet " + std::to_string(snapshot_->facet_of(facet)) + " of cell " +
                           std::to_string(snapshot_->index(snapshot_->cell_of(facet)));
  if (map.template is_free<D>(own)) {
    if (wall) return;
    throw Error(Error_code::not_certified, name + " lies on the boundary: it must stay impassable");
  }
  const Dart<D> other = map.template beta<D>(own);
  if (!wall && map.info(own).is_solid() != map.info(other).is_solid())
    throw Error(Error_code::not_certified,
                name + " parts a solid cell from a free one: it must stay impassable");
  snapshot_->set_impassable(facet, wall);  // first: it takes memory
  for (const Dart<D> side : {own, other})
    for_each_dart_of_half_facet<D>(map, side, [&](Dart<D> d) { map.info(d).set_impassable(wall); });
}

template <int D>
void Environment<D>::check_moved_star(std::uint32_t point, const std::vector<Cell>& star,
                                      bool may_overlap) const {
  for (const Cell c : star) {
    const Cell_check check = check_cell(snapshot_->view(c));
    if (check.defect != Cell_defect::none)
      throw Error(Error_code::not_certified, "point " + std::to_string(point) + " cannot move there: cell " +
                                                 std::to_string(snapshot_->index(c)) + " would be wrong, " +
                                                 describe(check));
  }
  // Every sign is affine in the position of the point, so the cells stay sound on the whole path from the old
  // position, as do the angles around inner ridges. Only the boundary may enter other cells.
  if (may_overlap) check_moved_boundary(point, star);
}

template <int D>
void Environment<D>::check_moved_boundary(std::uint32_t point, const std::vector<Cell>& star) const {
  const std::vector<Half_facet> near =
      boundary_->meeting(snapshot_->points(), detail::box_of<D>(*snapshot_, star));
  detail::certify_boundary_of_star<D>(*snapshot_, star, near);
  if (allow_duplicates_) return;
  // At the position of an inner vertex, the star would overlap the cells of that vertex.
  const auto points = snapshot_->points();
  for (const Half_facet f : near)
    for (const std::uint32_t p : snapshot_->loop(f))
      if (p != point && points[p] == points[point])
        throw Error(Error_code::not_certified, "point " + std::to_string(point) +
                                                   " cannot move there: point " + std::to_string(p) +
                                                   " lies in that place");
}

template <int D>
void Environment<D>::check_point(std::uint32_t point) const {
  if (!snapshot_->is_point(point))
    throw Error(Error_code::usage, "there is no point " + std::to_string(point));
}

template <int D>
void Environment<D>::check_move(std::uint32_t point, const Point<D>& position) const {
  check_point(point);
  detail::check_finite(position, "the new position");
}

template <int D>
detail::Star_index<D>& Environment<D>::stars() {
  if (!stars_) stars_ = std::make_unique<detail::Star_index<D>>(*snapshot_);
  return *stars_;
}

template <int D>
detail::Boundary_index<D>& Environment<D>::boundary() {
  if (!boundary_) boundary_ = std::make_unique<detail::Boundary_index<D>>(*snapshot_);
  return *boundary_;
}

template <int D>
std::vector<Cell> Environment<D>::cells_around(std::uint32_t point) {
  check_point(point);
  std::vector<Cell> cells;
  stars().find_cells(*snapshot_, point, cells);
  return cells;
}

template <int D>
bool Environment<D>::is_on_boundary(std::uint32_t point, const std::vector<Cell>& star) const {
  return std::any_of(star.begin(), star.end(), [&](Cell c) {
    const Cell_view<D> view = snapshot_->view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i)
      if (snapshot_->neighbour(Snapshot<D>::half_facet(c, i)) == Cell::none &&
          detail::has_point(view, i, point))
        return true;
    return false;
  });
}

/// The updates after the move of a point in the snapshot: those of the map and of the index of the boundary.
template <int D>
void Environment<D>::follow_move(std::uint32_t point, bool on_boundary) {
  if (storage_)
    for (const Map_vertex<D> vertex : storage_->vertices_of(point))
      storage_->map.point_of_vertex_attribute(vertex) = to_map_point(snapshot_->point(point));
  if (on_boundary && boundary_)
    follow<D>(boundary_, [&](detail::Boundary_index<D>& index) { index.follow(snapshot_->points(), point); });
}

template <int D>
void Environment<D>::move_vertex(std::uint32_t point, const Point<D>& position) {
  check_move(point, position);
  const Point<D> old_position = snapshot_->point(point);
  if (position == old_position) return;
  const std::vector<Cell> star = cells_around(point);
  const bool on_boundary = is_on_boundary(point, star);
  const bool is_way_free = on_boundary && boundary().is_way_free(snapshot_->points(), point, position);
  snapshot_->move_point(point, position);
  try {
    check_moved_star(point, star, on_boundary && !is_way_free);
  } catch (...) {
    snapshot_->move_point(point, old_position);
    throw;
  }
  snapshot_->update_geometry(star);
  follow_move(point, on_boundary);
}

template <int D>
std::vector<Cell> Environment<D>::insert_point(Cell cell, const Point<D>& position) {
  editable();
  check_cell_name(cell);
  detail::check_finite(position, "the new position");
  const Cell_view<D> view = snapshot_->view(cell);
  const std::uint32_t point = snapshot_->next_point();
  const bool is_solid = snapshot_->is_solid(cell);
  Cell_soup<D> soup;
  for (std::size_t i = 0; i < view.facet_count(); ++i) {
    if (!is_strictly_inside(view, i, position))
      throw Error(Error_code::not_certified, "the new point does not lie strictly inside cell " +
                                                 std::to_string(snapshot_->index(cell)) + ": facet " +
                                                 std::to_string(i) + " is in the way");
    const std::vector<std::uint32_t> base = snapshot_->loop(Snapshot<D>::half_facet(cell, i));
    soup.add_facet(base);
    if constexpr (D == 2) {
      soup.add_facet({base[1], point});
      soup.add_facet({point, base[0]});
    } else {
      for (std::size_t k = 0; k < base.size(); ++k)
        soup.add_facet({base[k + 1 == base.size() ? 0 : k + 1], base[k], point});
    }
    soup.end_cell(is_solid);
  }
  // A pyramid over a planar convex facet with its apex strictly inside is exactly convex and positive:
  // nothing is left to check.
  return detail::Cell_patcher<D>(*this).replace(std::array<Cell, 1>{cell}, soup, detail::glue_patch(soup),
                                                position);
}

// The class as a whole is instantiated in environment.cpp.
#define CELLWALK_INSTANTIATE(D)                                                                        \
  template Map_storage<D>& Environment<D>::editable();                                                 \
  template void Environment<D>::check_half_facet(Half_facet) const;                                    \
  template void Environment<D>::check_cell_name(Cell) const;                                           \
  template void Environment<D>::check_moved_star(std::uint32_t, const std::vector<Cell>&, bool) const; \
  template void Environment<D>::check_moved_boundary(std::uint32_t, const std::vector<Cell>&) const;   \
  template void Environment<D>::check_point(std::uint32_t) const;                                      \
  template void Environment<D>::check_move(std::uint32_t, const Point<D>&) const;                      \
  template bool Environment<D>::is_on_boundary(std::uint32_t, const std::vector<Cell>&) const;         \
  template detail::Star_index<D>& Environment<D>::stars();                                             \
  template detail::Boundary_index<D>& Environment<D>::boundary();                                      \
  template std::vector<Cell> Environment<D>::cells_around(std::uint32_t);                              \
  template void Environment<D>::follow_move(std::uint32_t, bool);                                      \
  template void Environment<D>::set_impassable(Half_facet, bool);                                      \
  template void Environment<D>::move_vertex(std::uint32_t, const Point<D>&);                           \
  template std::vector<Cell> Environment<D>::insert_point(Cell, const Point<D>&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
