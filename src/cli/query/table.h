// SPDX-License-Identifier: LGPL-3.0-or-later
// The work of `cellwalk query`: the answers to a table, whose rows ranks share.
#ifndef CELLWALK_CLI_QUERY_TABLE_H
#define CELLWALK_CLI_QUERY_TABLE_H

#include <cellwalk/edge/contact_search.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/query/kernel_choice.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/query/query.h>

#include <cstddef>
#include <optional>
#include <string>

#include "cli/common/outputs.h"

namespace cellwalk::cli {

enum class Query_mode { move, sweep };
struct Query_options {
  std::string environment, queries, output, json;
  std::string failure;             // if set, a repro file to replay, and nothing else
  std::string record;              // if set, the repro file for the motion of the row
  std::string picture;             // if set, the picture of the row
  std::string trace, tally;        // if set, the table of pieces, and the grid of their sums
  std::optional<std::size_t> row;  // of the repro file or the picture
  Query_mode mode = Query_mode::move;
  double radius = 0;  // of rows without one of their own
  Walk_method method;
  Sweep_options sweep;                    // its `touch` also applies to moves
  std::optional<Contact_search> contact;  // default: exact
  Search_options search;                  // its method is that of `contact`
  std::optional<Walk_strategy> strategy;  // default: certified, or exit_rule for kernels without certificates
  int threads = 0;
  Build_options build{.keep_map = false};
};

/// The output files of a query; null for those not requested.
struct Query_files {
  /// \throw Error(usage) if one replaces an input or another; Error(other) if one cannot be written
  explicit Query_files(const Query_options& options)
      : all({options.environment, options.queries}),
        answers(all.file(options.output)),
        json(all.file(options.json)),
        record(all.file(options.record)),
        picture(all.file(options.picture)),
        trace(all.file(options.trace)),
        tally(all.file(options.tally)) {}

  Outputs all;
  io::Atomic_file *answers, *json, *record, *picture, *trace, *tally;
};

/// Answers the rows of this rank, and hands the answers to the first rank, which writes those of all.
/// \param files on the first rank; null on others
/// \throw Error(input) for a table that is none; Error(usage) for a row that there is not;
///        Error(other) if a file cannot be written
template <int D>
void answer_table(const Query_options& options, Query_files* files, Ranks& ranks,
                  const Environment<D>& environment);

extern template void answer_table(const Query_options&, Query_files*, Ranks&, const Environment<2>&);
extern template void answer_table(const Query_options&, Query_files*, Ranks&, const Environment<3>&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_TABLE_H
