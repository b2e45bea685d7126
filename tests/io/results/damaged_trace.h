// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces whose bytes are changed at random.
#ifndef CELLWALK_TESTS_IO_RESULTS_DAMAGED_TRACE_H
#define CELLWALK_TESTS_IO_RESULTS_DAMAGED_TRACE_H

#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <set>
#include <string>

namespace cellwalk::io {

/// Whatever bytes change, the trace is read or refused in one line.
/// \param head the number of bytes after the first eight that half of the changes are made in
inline void damage_at_random(const std::string& good, std::size_t head) {
  std::mt19937 random(7);
  std::size_t read = 0, refused = 0;
  std::set<std::string> reasons;
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = good;
    for (auto n = 1 + random() % 3; n > 0; --n)
      bytes[8 + random() % (i % 2 == 0 ? head : good.size() - 8)] = static_cast<char>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    try {
      parse_trace("t.bin", bytes);
      ++read;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::input) << e.what();
      reasons.insert(e.what());
      ++refused;
    }
  }
  EXPECT_GT(read, 500u);
  EXPECT_GT(refused, 2000u);
  EXPECT_GT(reasons.size(), 200u);
}

}  // namespace cellwalk::io

#endif  // CELLWALK_TESTS_IO_RESULTS_DAMAGED_TRACE_H
