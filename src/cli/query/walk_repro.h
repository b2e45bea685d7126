// SPDX-License-Identifier: LGPL-3.0-or-later
// A motion of a repro file, walked again step by step.
#ifndef CELLWALK_CLI_QUERY_WALK_REPRO_H
#define CELLWALK_CLI_QUERY_WALK_REPRO_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/records/queries.h>

#include <string>

#include "kernel_names.h"

namespace cellwalk::cli {

/// Certifies the environment of a repro file, walks its motion by its kernel and exactly, and prints the
/// cells, signs and choices of both, and their first difference. Of a motion with a radius it prints the
/// answers by floods from each cell of the start, which must be the same.
/// \throw Error(input) if the file is unreadable or names unknown kernels or strategies;
///        Error(not_certified); Error(outside) if the motion does not start in its cell, or in no free one
void walk_repro(const std::string& path);

/// Writes a repro file of a motion in an environment.
template <int D>
void write_repro_of(io::Atomic_file& file, const Environment<D>& environment, const Query_row<D, 2>& motion,
                    const Walk_method& method, const std::string& note);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_WALK_REPRO_H
