// SPDX-License-Identifier: LGPL-3.0-or-later
// The checks of facets and cells, and changes of wall marks that take no memory once they begin.
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/wall_editor.h>

#include <utility>

#include "environment/snapshot/compiler.h"

namespace cellwalk {
namespace detail {

template <int D>
void Wall_editor<D>::check(Half_facet facet) const {
  environment_.editable();
  environment_.check_half_facet(facet);
}

template <int D>
void Wall_editor<D>::check(Cell cell) const {
  environment_.editable();
  environment_.check_cell_name(cell);
}

template <int D>
std::vector<Half_facet> Wall_editor<D>::passages(Cell cell, bool to_solid) const {
  std::vector<Half_facet> result;
  for (std::size_t i = 0; i < snapshot().facet_count(cell); ++i) {
    const Half_facet f = Snapshot<D>::half_facet(cell, i);
    if (!snapshot().is_impassable(f) && snapshot().is_solid(snapshot().neighbour(f)) == to_solid)
      result.push_back(f);
  }
  return result;
}

template <int D>
void Wall_editor<D>::change(Cell turned, std::span<const Half_facet> closed,
                            std::span<const Half_facet> opened) {
  Map_storage<D>& storage = environment_.editable();
  typename Snapshot_compiler<D>::Wall_change change(*environment_.snapshot_, closed, opened, turned);
  // Nothing takes memory from here on.
  change.keep();
  const auto mark = [&](Half_facet side, const auto& set) {
    for_each_dart_of_half_facet<D>(storage.map, storage.dart_of_half_facet[to_index(side)],
                                   [&](Dart<D> d) { set(storage.map.info(d)); });
  };
  for (const auto& [facets, wall] : {std::pair(closed, true), std::pair(opened, false)})
    for (const Half_facet f : facets)
      for (const Half_facet side : {f, snapshot().opposite(f)})
        mark(side, [wall = wall](Dart_info& info) { info.set_impassable(wall); });
  for (std::size_t i = 0; i < snapshot().facet_count(turned); ++i)
    mark(Snapshot<D>::half_facet(turned, i),
         [&](Dart_info& info) { info.set_solid(snapshot().is_solid(turned)); });
}

template <int D>
void Wall_editor<D>::fill(Cell cell, std::span<const Half_facet> passages) {
  change(cell, passages, {});
}

template <int D>
void Wall_editor<D>::excavate(Cell cell) {
  std::vector<Half_facet> opened;
  for (std::size_t i = 0; i < snapshot().facet_count(cell); ++i) {
    const Half_facet f = Snapshot<D>::half_facet(cell, i);
    const Cell other = snapshot().neighbour(f);
    if (other != Cell::none && !snapshot().is_solid(other)) opened.push_back(f);
  }
  change(cell, passages(cell, true), opened);
}

template <int D>
void Wall_editor<D>::with_walls(std::span<const Half_facet> walls, Cell filled,
                                const std::function<void()>& use) {
  const typename Snapshot_compiler<D>::Wall_change change(*environment_.snapshot_, walls, {}, filled);
  use();
}

template class Wall_editor<2>;
template class Wall_editor<3>;

}  // namespace detail

template <int D>
void Environment<D>::excavate(Cell cell) {
  detail::Wall_editor<D> editor(*this);
  editor.check(cell);
  if (snapshot_->is_solid(cell)) editor.excavate(cell);
}

template <int D>
void Environment<D>::fill(Cell cell) {
  detail::Wall_editor<D> editor(*this);
  editor.check(cell);
  if (!snapshot_->is_solid(cell)) editor.fill(cell, editor.passages(cell, false));
}

template void Environment<2>::excavate(Cell);
template void Environment<2>::fill(Cell);
template void Environment<3>::excavate(Cell);
template void Environment<3>::fill(Cell);

}  // namespace cellwalk
