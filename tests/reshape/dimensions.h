// SPDX-License-Identifier: LGPL-3.0-or-later
// Typed tests in 2D and 3D, and what many tests of moved walls share.
#ifndef CELLWALK_TESTS_RESHAPE_DIMENSIONS_H
#define CELLWALK_TESTS_RESHAPE_DIMENSIONS_H

#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "walk/oracle_trial.h"

namespace cellwalk::test {

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

struct Name_of_dimension {
  template <class Dimension>
  static std::string GetName(int) {
    return std::to_string(Dimension::value) + "D";
  }
};

inline constexpr Reshape_options hold{.at_contact = At_contact::hold};

/// How many worlds: no fewer under a sanitizer, since of few of them too few have the cases in question.
inline std::size_t count_at_least(std::size_t worlds) {
  return std::max(oracle::scaled_count(worlds), worlds);
}

}  // namespace cellwalk::test

#endif
