// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers to a table of motions: what `cellwalk query` computes, and the table it writes.
#ifndef CELLWALK_CLI_QUERY_ANSWERS_H
#define CELLWALK_CLI_QUERY_ANSWERS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/records/queries.h>
#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::cli {

enum class Kernel_choice { exact, lazy, double_precision, float_precision };

enum class Status : std::uint8_t {
  free,     ///< the motion arrives
  contact,  ///< a wall blocks it
  outside,  ///< it does not start in free space
  invalid,  ///< its row cannot be used
  lost      ///< inexact kernels only: the walk found no way on
};
inline constexpr const char* status_names[] = {"free", "contact", "outside", "invalid", "lost"};

template <int D>
struct Answer {
  Status status = Status::invalid;
  Walk_result<D> walk;  ///< unless outside or invalid
};

/// Answers every motion, in parallel; the answers do not depend on the number of threads.
/// A start on a wall with free space on several sides belongs to any of them: the side on which the motion gets furthest
/// is taken, the cell of lowest index first.
template <int D>
std::vector<Answer<D>> answer_motions(const Snapshot<D>& snapshot, const std::vector<Move_query<D>>& motions,
                                      Kernel_choice kernel, Walk_strategy strategy, Walk_counts& counts);

/// Writes the table of answers: row,status,time,x,y,z,kind,nx,ny,nz,cells,cell. Rows and cells count from 0; cells are
/// those of the file; what does not apply is empty. \throw Error(other) where it cannot be written
template <int D>
void write_answers(const std::string& path, const Snapshot<D>& snapshot,
                   const std::vector<Move_query<D>>& motions, const std::vector<Answer<D>>& answers);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_ANSWERS_H
