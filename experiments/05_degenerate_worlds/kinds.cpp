// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kinds.h"

#include <cellwalk/internal/generators/lattice_world.h>

#include "02_exact_versus_float/worlds.h"

namespace cellwalk::degenerate_worlds {

template <int D>
Cell_soup<D> make_soup(World_kind kind, bool is_turned, std::uint64_t seed) {
  Lattice_world_options<D> options;
  options.seed = seed;
  options.cells.fill(D == 2 ? 5 : 3);
  if (is_turned) options.map = exact_float::lattice_map<D>({});
  switch (kind) {
    case World_kind::lattice:
      options.solid_share = 0.2;
      break;
    case World_kind::coplanar_walls:
      options.box_share = 0.7;
      options.membrane_share = 0.15;
      break;
    case World_kind::membranes:
      options.simplex_share = 0.3;
      options.membrane_share = 0.4;
      break;
    case World_kind::pinched:
      options.simplex_share = 0.3;
      options.removed_share = 0.35;
      break;
    case World_kind::collinear:
      options.box_share = 0.6;
      options.merge_share = D == 3 ? 0.9 : 0;
      options.membrane_share = 0.1;
      break;
    case World_kind::simplices:
      options.simplex_share = 0.5;
      options.star_share = 0.3;
      options.prism_share = D == 3 ? 0.2 : 0;
      options.membrane_share = 0.1;
      break;
  }
  return lattice_world(options);
}

template Cell_soup<2> make_soup<2>(World_kind, bool, std::uint64_t);
template Cell_soup<3> make_soup<3>(World_kind, bool, std::uint64_t);

}  // namespace cellwalk::degenerate_worlds
