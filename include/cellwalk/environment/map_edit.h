// SPDX-License-Identifier: LGPL-3.0-or-later
// Environment::edit(): changes of the combinatorial map by its user, with any operations of CGAL. Includes
// CGAL; users link CGAL::CGAL.
#ifndef CELLWALK_ENVIRONMENT_MAP_EDIT_H
#define CELLWALK_ENVIRONMENT_MAP_EDIT_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>

namespace cellwalk {

/// Marks the facet of a dart, on both sides, inside Environment::edit(). On the boundary, and between a solid
/// and a free cell, it is a wall anyway.
/// \param wall true: impassable
template <int D>
void set_impassable(Map<D>& map, Dart<D> facet, bool wall);

/// Bodies that go on are registered again after each edit: of new names only the last ones are kept.
/// \pre `change` does not edit the environment in another way, nor freeze it
template <int D>
template <class Change>
Compaction Environment<D>::edit(Change&& change) {
  return edit_storage([&](Map_storage<D>& storage) { change(storage.map); });
}

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_EDIT_H
