// SPDX-License-Identifier: LGPL-3.0-or-later
// The outcomes of changes of facets and cells: a table, counts, a summary.
#ifndef CELLWALK_CLI_COMMON_CHANGES_TABLE_H
#define CELLWALK_CLI_COMMON_CHANGES_TABLE_H

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/simulation/change_schedule.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// A row for each facet or cell that was changed, and one for each vertex, edge and face that forbids a
/// change.
template <int D>
class Changes_table {
 public:
  /// Counts only.
  /// \param snapshot of the environment that is changed; outlives the table
  explicit Changes_table(const Snapshot<D>& snapshot) : snapshot_(snapshot) {}
  /// \param file of the caller's, who commits it
  Changes_table(const Snapshot<D>& snapshot, io::Atomic_file& file);
  /// \param table with these columns
  Changes_table(const Snapshot<D>& snapshot, io::Csv_writer table);
  static const std::vector<std::string>& columns();

  /// \param step of a run, from 1; 0 outside of runs
  void add(std::uint32_t step, const std::vector<Change_outcome>& outcomes);
  void commit() { table_->commit(); }

  /// Facets and cells that were changed.
  std::uint64_t made() const;
  nlohmann::ordered_json to_json() const;
  /// Such as "24 facets closed; 2 refused, 1 of them for good".
  std::string describe() const;

  /// All counts, but not the file.
  template <class Archive>
  void archive(Archive& a) {
    a(made_, refusals_, left_, cuts_.cells, cuts_.edges, cuts_.split, cuts_.snapped, cuts_.slit, cuts_.facets,
      cuts_.opened, cuts_.rim, cuts_.held);
  }

 private:
  void write(std::uint32_t step, const Change_outcome& outcome);

  const Snapshot<D>& snapshot_;
  std::optional<io::Csv_writer> table_;
  std::array<std::uint64_t, change_kind_count> made_{};  ///< by Change_kind
  std::uint64_t refusals_ = 0;
  Cut_report cuts_;  ///< all together, without their points
  /// The changes that were refused and not made since: change, facet, cell.
  std::set<std::array<std::uint64_t, 3>> left_;
};

extern template class Changes_table<2>;
extern template class Changes_table<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_CHANGES_TABLE_H
