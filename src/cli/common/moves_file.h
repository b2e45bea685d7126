// SPDX-License-Identifier: LGPL-3.0-or-later
// Tables of positions to which points of an environment are to move.
#ifndef CELLWALK_CLI_COMMON_MOVES_FILE_H
#define CELLWALK_CLI_COMMON_MOVES_FILE_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/reshape/reshaping.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// Refuses an environment whose points have other numbers than in its file.
/// \throw Error(input)
void refuse_other_numbers(const std::string& path, const Build_report& built);

/// Reads moves of points of an environment: columns point,x,y,z (2D: without z) in any order; others are
/// ignored. Every row is checked before anything moves.
/// \throw Error(input) naming the file, and the line of a row that is no move: a wrong number of fields, a
///        value that is not a finite number, a point that does not exist or has a cell that is no simplex
template <int D>
std::vector<Vertex_move<D>> read_moves(const std::string& path, Environment<D>& environment);

/// A move that is made in a step of a run.
template <int D>
struct Timed_move {
  std::uint32_t step = 0;
  Vertex_move<D> move{};

  /// See byte_archive.h.
  template <class Archive>
  void archive(Archive& a) {
    a(step, move.point, move.target);
  }
};

/// Reads moves as read_moves(), with the step of each in a column `step`: a whole number, at least 1. The
/// result is in the order of steps; the moves of one step in the order of their rows.
/// \throw Error(input) as read_moves(); also for a point that is given twice in a step
template <int D>
std::vector<Timed_move<D>> read_timed_moves(const std::string& path, Environment<D>& environment);

extern template std::vector<Vertex_move<2>> read_moves(const std::string&, Environment<2>&);
extern template std::vector<Vertex_move<3>> read_moves(const std::string&, Environment<3>&);
extern template std::vector<Timed_move<2>> read_timed_moves(const std::string&, Environment<2>&);
extern template std::vector<Timed_move<3>> read_timed_moves(const std::string&, Environment<3>&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_MOVES_FILE_H
