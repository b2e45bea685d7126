// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/wall_editor.h>

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
void Wall_editor<D>::set_solid(Cell cell, bool solid) {
  Map_storage<D>& storage = environment_.editable();
  for (std::size_t i = 0; i < snapshot().facet_count(cell); ++i)
    for_each_dart_of_half_facet<D>(storage.map,
                                   storage.dart_of_half_facet[to_index(Snapshot<D>::half_facet(cell, i))],
                                   [&](Dart<D> d) { storage.map.info(d).set_solid(solid); });
  Snapshot_compiler<D>(*environment_.snapshot_).set_solid(cell, solid);
}

template <int D>
void Wall_editor<D>::fill(Cell cell, std::span<const Half_facet> passages) {
  for (const Half_facet f : passages) set_wall(f, true);
  set_solid(cell, true);
}

template <int D>
void Wall_editor<D>::take_back_fill(Cell cell, std::span<const Half_facet> passages) {
  set_solid(cell, false);
  for (const Half_facet f : passages) set_wall(f, false);
}

template <int D>
void Wall_editor<D>::excavate(Cell cell) {
  for (const Half_facet f : passages(cell, true)) set_wall(f, true);
  set_solid(cell, false);
  for (std::size_t i = 0; i < snapshot().facet_count(cell); ++i) {
    const Half_facet f = Snapshot<D>::half_facet(cell, i);
    const Cell other = snapshot().neighbour(f);
    if (other != Cell::none && !snapshot().is_solid(other)) set_wall(f, false);
  }
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
