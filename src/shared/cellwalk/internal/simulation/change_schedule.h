// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of an environment at steps of a run: the facets and cells that they name, and their outcomes.
#ifndef CELLWALK_INTERNAL_SIMULATION_CHANGE_SCHEDULE_H
#define CELLWALK_INTERNAL_SIMULATION_CHANGE_SCHEDULE_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/records/environment_change.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/reshape/reshaping.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk {

/// A point that a cut took back, and the one from which it did, which a suture makes one again.
struct Stitch {
  std::uint32_t point, onto;
};

/// The outcome of a change of one facet or cell, of a cut, or of a stitch of a suture.
struct Change_outcome {
  std::size_t change = 0;  ///< in the list of changes
  Change_kind kind = Change_kind::open;
  Half_facet facet = Half_facet::none;  ///< that is opened or closed
  Cell cell = Cell::none;               ///< that is excavated or filled; of a facet, one of its two
  Outcome result;
  std::optional<Cut_report> cut;  ///< of cuts only, which name neither facet nor cell
  std::optional<Stitch> stitch;   ///< of sutures only, likewise
};

/// The groups that the file of an environment names, and named parts of the environment as it is.
/// \throw Error(input) for a part with the name of a group
/// Cost: linear for each part.
template <int D>
Groups<D> all_groups(const Snapshot<D>& snapshot, const Environment_changes<D>& changes, Groups<D> of_file);

/// Changes with the facets and cells that they have, found when it is made: later motion of walls affects
/// none. Those that a cut replaces are refused from then on.
template <int D>
class Change_schedule {
 public:
  /// \param of_file groups that the file of the environment names, besides those of the changes
  /// \throw Error(input) naming a change that has no facet or cell, or a group that is not there, or there
  ///        twice, or a suture before which nothing is cut
  Change_schedule(const Snapshot<D>& snapshot, const Environment_changes<D>& changes,
                  const Groups<D>& of_file = {});

  /// True if apply() would do something before a step.
  bool is_due(std::uint32_t step) const;

  /// Makes all changes of a step, in order, and tries those again that were refused and have not run out.
  /// A suture joins the points that the cuts of this schedule parted, the last first, where they gape at that
  /// time. A facet or cell that need not change has no outcome: a facet that is a wall is not closed, a facet
  /// of a solid cell neither opened nor closed, a free cell not excavated.
  /// \pre the steps of calls ascend
  /// \throw Error as Reshaping
  std::vector<Change_outcome> apply(const Snapshot<D>& snapshot, Reshaping<D>& reshaping, std::uint32_t step);

 private:
  /// A facet or a cell with its points, since a cut may give its name to another.
  template <class Name>
  struct With_points {
    Name name;
    std::vector<std::uint32_t> points;
  };
  struct Planned {
    std::size_t number = 0;
    Change_kind kind = Change_kind::open;
    std::uint32_t step = 0, until = 0;
    // The changes still to be made.
    std::vector<With_points<Half_facet>> facets;
    std::vector<With_points<Cell>> cells;
    std::optional<Blade_stroke<D>> blade;

    std::optional<Environment_part<D>> suture;  // until it runs out
    bool has_sewn = false;                      // or tried to

    bool is_done() const { return facets.empty() && cells.empty() && !blade && !suture; }
  };
  Change_schedule() = default;
  void make_cut(Reshaping<D>& reshaping, Planned& planned, std::vector<Change_outcome>& outcomes);
  void sew(const Snapshot<D>& snapshot, Reshaping<D>& reshaping, Planned& planned, std::uint32_t step,
           std::vector<Change_outcome>& outcomes);
  void apply_once(const Snapshot<D>& snapshot, Reshaping<D>& reshaping, Planned& planned,
                  std::vector<Change_outcome>& outcomes) const;

  std::vector<Planned> planned_;
  std::vector<Stitch> stitches_;  // not made yet, of all cuts

  friend detail::State_access<D>;
};

extern template Groups<2> all_groups(const Snapshot<2>&, const Environment_changes<2>&, Groups<2>);
extern template Groups<3> all_groups(const Snapshot<3>&, const Environment_changes<3>&, Groups<3>);
extern template class Change_schedule<2>;
extern template class Change_schedule<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_CHANGE_SCHEDULE_H
