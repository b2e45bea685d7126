// SPDX-License-Identifier: GPL-3.0-or-later
// Helper programs, in processes of their own: a crash there is an answer.
#ifndef CELLWALK_MESHING_CHILD_RUN_HELPER_H
#define CELLWALK_MESHING_CHILD_RUN_HELPER_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/meshing/mesher_limits.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "meshing/child/protocol.h"

namespace cellwalk::detail {

/// A helper program, and the mesher in it as messages call it.
struct Helper {
  const char* program;
  const char* mesher;
};
inline constexpr Helper tetgen_helper{"cellwalk-tetgen", "TetGen"};
inline constexpr Helper mesh3_helper{"cellwalk-mesh3", "Mesh_3"};

/// The program: in the folder CELLWALK_LIBEXEC; in libexec/cellwalk of the build or prefix of the program or
/// Python module, or beside the libraries that it is linked with; in the prefix of the installation. Empty if
/// there is none.
std::filesystem::path find_helper(const Helper& helper);

/// A mesher used up the time or memory that it has: another try would, too.
class Used_up : public Error {
 public:
  using Error::Error;
};

/// The output of a helper, with indices that are not checked. Several threads may call it.
/// \param start from when on its limit of time counts
/// \throw Used_up (not_certified) if it does not end in time, or runs out of memory
/// \throw Error(not_certified) if the mesher fails, crashes, or writes invalid output: the name of the mesher
///        and the problem
/// \throw Error(usage) if there is no such program, or it belongs to another version, or for a limit that is
///        not positive; Error(other) if the system cannot run it
/// \throw as limits.on_wait, once the process has ended
Mesher_output run_helper(const Helper& helper, const std::vector<std::string>& options,
                         const Mesher_input& input, const Mesher_limits& limits,
                         std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now());

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_CHILD_RUN_HELPER_H
