// SPDX-License-Identifier: LGPL-3.0-or-later
// The one exception type of the library. Its code is the exit code of the command line.
#ifndef CELLWALK_KERNEL_ERROR_H
#define CELLWALK_KERNEL_ERROR_H

#include <stdexcept>
#include <string>

namespace cellwalk {

/// What kind of failure; the value is the exit code of `cellwalk`.
enum class Error_code : int {
  other = 1,          ///< anything else
  usage = 2,          ///< a call or command line that makes no sense
  input = 3,          ///< unreadable or invalid input
  not_certified = 4,  ///< an environment that is not certified
  outside = 5         ///< a particle or body that starts outside free space or across a wall
};

/// Thrown wherever the library refuses an input. `what()` is one line: what is wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  Error(Error_code code, const std::string& message) : std::runtime_error(message), code_(code) {}

  Error_code code() const noexcept { return code_; }

 private:
  Error_code code_;
};

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_ERROR_H
