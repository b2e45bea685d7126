// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of moves of `cellwalk deform`.
#ifndef CELLWALK_CLI_DEFORM_MOVES_FILE_H
#define CELLWALK_CLI_DEFORM_MOVES_FILE_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/reshape/reshaping.h>

#include <string>
#include <vector>

namespace cellwalk::cli {

/// Reads moves of points of an environment: columns point,x,y,z (2D: without z) in any order; others are
/// ignored. Every row is checked before anything moves.
/// \throw Error(input) naming the file, and the line of a row that is no move: a wrong number of fields, a
///        value that is not a finite number, a point that does not exist or has a cell that is no simplex
template <int D>
std::vector<Vertex_move<D>> read_moves(const std::string& path, Environment<D>& environment);

extern template std::vector<Vertex_move<2>> read_moves(const std::string&, Environment<2>&);
extern template std::vector<Vertex_move<3>> read_moves(const std::string&, Environment<3>&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_DEFORM_MOVES_FILE_H
