// SPDX-License-Identifier: LGPL-3.0-or-later
// The one exception type of the library. Its code is the exit code of the command line.
#ifndef CELLWALK_KERNEL_ERROR_H
#define CELLWALK_KERNEL_ERROR_H

#include <stdexcept>
#include <string>

namespace cellwalk {

/// The kind of an error; its value is the exit code of `cellwalk`.
enum class Error_code : int {
  other = 1,          ///< any other error
  usage = 2,          ///< an invalid call or command line
  input = 3,          ///< unreadable or invalid input
  not_certified = 4,  ///< an environment that is not certified
  outside = 5         ///< a particle or body that starts outside free space or across a wall
};

/// Thrown by every function that refuses an input. `what()` is one line: the problem, the place and the
/// remedy.
class Error : public std::runtime_error {
 public:
  Error(Error_code code, const std::string& message) : std::runtime_error(message), code_(code) {}

  Error_code code() const noexcept { return code_; }

 private:
  Error_code code_;
};

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_ERROR_H
