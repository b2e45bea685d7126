// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers to a table of motions of points or edges, and the table that `cellwalk query` writes of them.
#ifndef CELLWALK_CLI_QUERY_ANSWERS_H
#define CELLWALK_CLI_QUERY_ANSWERS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/records/queries.h>
#include <cellwalk/query/query.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/common/progress.h"

namespace cellwalk::cli {

/// Answers every valid row by answer(row, counts), in parallel; the answers do not depend on the number of
/// threads. Hands them on in batches, in order: use(first, answers) with the number of the first row.
template <class Counts, int D, std::size_t N, class Answer_row, class Use>
void answer_rows(const std::vector<Query_row<D, N>>& rows, const char* label, Counts& total,
                 Answer_row answer, Use use) {
  constexpr std::size_t batch = 1 << 14;  // few enough for their answers to stay in the cache
  tbb::enumerable_thread_specific<Counts> counts;
  Progress progress(label, rows.size());
  std::vector<Answer<D>> answers;
  for (std::size_t begin = 0; begin < rows.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, rows.size());
    answers.assign(end - begin, {});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
        if (rows[i].error.empty()) answers[i - begin] = answer(rows[i], counts.local());
    });
    use(begin, std::as_const(answers));
    progress.update(end);
  }
  for (const Counts& c : counts) total += c;
}

/// The columns of the table of answers: row,status,time,x,y,z,kind,nx,ny,nz,cells,cell; for edges (rows of
/// three points) with `body` after `kind`; with radii, `distance` at the end.
std::vector<std::string> answer_columns(bool of_edges, bool has_radii);

/// Writes rows of the table of answers. Rows and cells count from 0; cells are those of the file; fields that
/// do not apply are empty. A free motion ends at the second point of its row.
/// \param first the number of the first row in the whole table
/// \param has_radii some row of the whole table has a radius
/// \pre as many rows as answers
/// \throw Error(other) if it cannot be written
template <int D, std::size_t N>
void write_answers(io::Csv_writer& table, std::size_t first, const Snapshot<D>& snapshot,
                   std::span<const Query_row<D, N>> rows, const std::vector<Answer<D>>& answers,
                   bool has_radii);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_ANSWERS_H
