// SPDX-License-Identifier: LGPL-3.0-or-later
// The outcomes of the moves of `cellwalk deform`: a table, a report, a summary.
#ifndef CELLWALK_CLI_DEFORM_RESULTS_H
#define CELLWALK_CLI_DEFORM_RESULTS_H

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/reshape/reshaping.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/move_end_names.h"
#include "cli/common/standing_bodies.h"

namespace cellwalk::cli {

/// The results of moves, written row by row, and counted.
template <int D>
class Move_results {
 public:
  /// \param file the table, or null
  /// \param snapshot of the environment that is moved; outlives the results
  Move_results(io::Atomic_file* file, const Snapshot<D>& snapshot);
  void add(const Vertex_result<D>& result);

  std::size_t count() const { return count_; }
  /// How many ended in each way, by Move_end.
  const std::array<std::size_t, move_end_names.size()>& ends() const { return ends_; }

 private:
  const Snapshot<D>& snapshot_;
  std::optional<io::Csv_writer> table_;
  std::size_t count_ = 0;
  std::array<std::size_t, move_end_names.size()> ends_{};
};

/// The lines of the summary about moves, bodies and work.
template <int D>
std::string describe_moves(const Move_results<D>& results, const Standing_bodies<D>& bodies,
                           const Reshape_counts& counts);
template <int D>
nlohmann::ordered_json moves_json(const Move_results<D>& results, const Standing_bodies<D>& bodies,
                                  const Reshape_counts& counts);

extern template class Move_results<2>;
extern template class Move_results<3>;
extern template std::string describe_moves(const Move_results<2>&, const Standing_bodies<2>&,
                                           const Reshape_counts&);
extern template std::string describe_moves(const Move_results<3>&, const Standing_bodies<3>&,
                                           const Reshape_counts&);
extern template nlohmann::ordered_json moves_json(const Move_results<2>&, const Standing_bodies<2>&,
                                                  const Reshape_counts&);
extern template nlohmann::ordered_json moves_json(const Move_results<3>&, const Standing_bodies<3>&,
                                                  const Reshape_counts&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_DEFORM_RESULTS_H
