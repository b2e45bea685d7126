// SPDX-License-Identifier: LGPL-3.0-or-later
// The pieces of motions in cells: the table of `cellwalk query --trace`, and the sums by cell of `--tally`.
#ifndef CELLWALK_CLI_QUERY_PIECES_H
#define CELLWALK_CLI_QUERY_PIECES_H

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/records/queries.h>
#include <cellwalk/query/query.h>
#include <cellwalk/walk/tally.h>
#include <cellwalk/walk/trace.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::cli {

/// A bound of the length of a motion in an environment times a weight.
template <int D>
double largest_value(const Snapshot<D>& snapshot, double largest_weight);

/// Traces the motions of a table, batch after batch.
template <int D>
class Piece_tables {
 public:
  /// \param table receives row,cell,length of each piece, if not null
  /// \param largest if set, lengths times weights are summed up, of this size at most
  Piece_tables(const Snapshot<D>& snapshot, const Locator<D>& locator, io::Csv_writer* table,
               std::optional<double> largest);

  /// Adds the pieces of rows that are free or meet a wall.
  /// \param first the number of the first row in the whole table
  void add(std::size_t first, std::span<const Query_row<D, 2>> rows, const std::vector<Answer<D>>& answers);

  /// \pre sums were requested
  Tally& tally() { return *tally_; }

 private:
  const Locator<D>& locator_;
  const Snapshot<D>& snapshot_;
  const Tracer<D> tracer_;
  io::Csv_writer* const table_;
  std::optional<Tally> tally_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_PIECES_H
