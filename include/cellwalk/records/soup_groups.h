// SPDX-License-Identifier: LGPL-3.0-or-later
// Named groups of the facets and cells of a soup, as files have them.
#ifndef CELLWALK_RECORDS_SOUP_GROUPS_H
#define CELLWALK_RECORDS_SOUP_GROUPS_H

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cellwalk {

struct Soup_group {
  std::vector<std::uint32_t> facets;  ///< numbers of half-facets; one side of a facet suffices
  std::vector<std::uint32_t> cells;

  bool operator==(const Soup_group&) const = default;
};

using Soup_groups = std::map<std::string, Soup_group>;

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_SOUP_GROUPS_H
