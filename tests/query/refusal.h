// SPDX-License-Identifier: LGPL-3.0-or-later
// The refusal of a call.
#ifndef CELLWALK_TESTS_QUERY_REFUSAL_H
#define CELLWALK_TESTS_QUERY_REFUSAL_H

#include <cellwalk/kernel/error.h>

#include <functional>
#include <optional>

namespace cellwalk::test {

/// The code of the error that a call throws; none if it throws none.
inline std::optional<Error_code> refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return {};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_QUERY_REFUSAL_H
