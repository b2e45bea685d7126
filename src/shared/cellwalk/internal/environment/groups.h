// SPDX-License-Identifier: LGPL-3.0-or-later
// Named groups of facets and cells: from the soup of which an environment is built, and through edits.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_GROUPS_H
#define CELLWALK_INTERNAL_ENVIRONMENT_GROUPS_H

#include <cellwalk/environment/selection.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk {

/// The places of the groups of a soup, by which they are found in the environment built from it: building may
/// split cells and facets, and drop and merge points.
template <int D>
class Group_places {
 public:
  /// \throw Error(input) for a facet or cell that the soup does not have, naming the group
  /// Cost: that of the facets and cells named.
  Group_places(const Cell_soup<D>& soup, const Soup_groups& groups);

  /// The parts of the cells and facets named.
  /// \param origin the input cell of each cell, or empty: as Build_report has it
  /// \pre the environment is built of the soup, and was not edited
  /// Cost: linear, if there are groups.
  Groups<D> find(const Snapshot<D>& snapshot, std::span<const std::uint32_t> origin) const;

 private:
  struct Place {
    std::uint32_t cell;
    std::string group;
    std::vector<Point<D>> points;  ///< of a facet, ascending; none for the cell
  };
  std::vector<std::string> names_;
  std::vector<Place> places_;  ///< by cell
};

/// Groups through edits: a facet or cell stays in its group as long as it is there. Edits that replace cells
/// give their names to others; therefore the points are remembered too.
template <int D>
class Lasting_groups {
 public:
  Lasting_groups() = default;
  Lasting_groups(const Snapshot<D>& snapshot, const Groups<D>& groups);

  /// Their names, ascending.
  std::vector<std::string> names() const;
  /// The current members of every group; empty groups included.
  Groups<D> now(const Snapshot<D>& snapshot) const;

 private:
  template <class Name>
  struct With_points {
    Name name;
    std::vector<std::uint32_t> points;  ///< ascending
  };
  struct Group {
    std::vector<With_points<Half_facet>> facets;
    std::vector<With_points<Cell>> cells;
  };
  std::map<std::string, Group> groups_;
};

extern template class Group_places<2>;
extern template class Group_places<3>;
extern template class Lasting_groups<2>;
extern template class Lasting_groups<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_GROUPS_H
