// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of facets and cells in a run.
#ifndef CELLWALK_CLI_RUN_CHANGES_H
#define CELLWALK_CLI_RUN_CHANGES_H

#include <cellwalk/internal/simulation/saved_state.h>
#include <cellwalk/internal/simulation/world.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "cli/common/changes_table.h"
#include "result_files.h"

namespace cellwalk::cli {

/// Makes the changes of a scene before the steps of a world, and writes their outcomes to changes.csv.
template <int D>
class Run_changes {
 public:
  /// \param place of the table
  /// \param groups that the file of the environment names
  /// \param scene names the scene in errors
  /// \throw Error(input) for a change that has no facet or cell
  Run_changes(Result_files& place, Environment<D>& environment, const Environment_changes<D>& changes,
              const Groups<D>& groups, const std::string& scene);
  /// Those that were saved, in an environment that is as it was then.
  Run_changes(Result_files& place, Environment<D>& environment, const Scene<D>& scene,
              detail::Byte_reader& saved);
  void save(detail::Byte_writer& out) const;

  /// Makes the changes that are due before the next step. Returns their outcomes.
  std::vector<Change_outcome> step(World<D>& world);
  /// Completes the table.
  void finish() { table_.commit(); }

  nlohmann::ordered_json report() const;
  std::string describe() const { return table_.describe(); }

 private:
  Environment<D>& environment_;
  Change_schedule<D> schedule_;
  Changes_table<D> table_;
  Reshape_counts counts_;
};

extern template class Run_changes<2>;
extern template class Run_changes<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_CHANGES_H
