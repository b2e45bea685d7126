// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/counts_json.h"

#include <nlohmann/json.hpp>

namespace cellwalk::cli {

nlohmann::ordered_json to_json(const Walk_counts& c) {
  return {{"walks", c.walks},
          {"stays", c.stays},
          {"crossings", c.crossings},
          {"plane_blocks", c.plane_blocks},
          {"uncertain_lanes", c.uncertain_lanes},
          {"side_tests", c.side_tests},
          {"along_tests", c.along_tests},
          {"turns", c.turns},
          {"star_searches", c.star_searches},
          {"star_cells", c.star_cells},
          {"orientations", c.predicates.orientations},
          {"exact_fallbacks", c.predicates.fallbacks}};
}

nlohmann::ordered_json to_json(const Edge_counts& c) {
  return {{"checked", c.edges},
          {"same_cell", c.same_cell},
          {"convex_pair", c.convex_pair},
          {"same_chain", c.same_chain},
          {"chain_facets", c.chain_facets},
          {"clear", c.clear},
          {"event_sweeps", c.event_sweeps},
          {"changed", c.changed},
          {"floods", c.floods},
          {"flooded_cells", c.flooded_cells},
          {"pierced", c.pierced},
          {"searches", c.searches},
          {"search_sweeps", c.search_sweeps},
          {"search_walks", c.search_walks},
          {"search_walls", c.search_walls},
          {"search_misses", c.search_misses}};
}

}  // namespace cellwalk::cli
