// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces as the format has them, byte by byte, and how they are read, written and damaged.
#ifndef CELLWALK_TESTS_IO_RESULTS_TRACE_BYTES_H
#define CELLWALK_TESTS_IO_RESULTS_TRACE_BYTES_H

#include <cellwalk/internal/io/trace_file.h>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "io/io_fixture.h"

namespace cellwalk::io {

/// Bytes as the format has them, put down one by one: nothing of the writer is used.
class Little_endian {
 public:
  Little_endian& counts(std::initializer_list<std::uint64_t> values, int size = 4) {
    for (const std::uint64_t value : values)
      for (int i = 0; i < size; ++i) text_.push_back(static_cast<char>(value >> 8 * i & 0xff));
    return *this;
  }
  Little_endian& number(double value) { return counts({std::bit_cast<std::uint64_t>(value)}, 8); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// Where the parts of `sample_body_trace()` lie.
inline constexpr std::size_t step_count_at = 12, vertex_count_at = 16, edges_of_first_at = 28,
                             faces_of_first_at = 60, vertices_of_second_at = 84, edges_of_second_at = 96,
                             before_at = 104, body_targets_at = before_at + 3 * 6 * 24,
                             has_answers_at = body_targets_at + 2 * 6 * 24,
                             body_answers_at = has_answers_at + 1, body_trace_size = body_answers_at + 2 * 16;

/// Two bodies in two steps: four vertices, four edges and two faces; two vertices and an edge.
inline std::string sample_body_trace() {
  Little_endian bytes;
  bytes.counts({2, 2});
  bytes.counts({4, 4, 2}).counts({0, 1, 0, 2, 0, 3, 1, 2}).counts({2, 0, 1}).counts({0, 1, 2});
  bytes.counts({2, 1, 0}).counts({0, 1});
  for (int i = 0; i < (3 + 2) * 6; ++i)
    bytes.number(1 + i / 16.0).number(-i).number(i == 3 ? -0.0 : 5e-324 * i);
  bytes.counts({1}, 1);
  for (int i = 0; i < 2 * (4 + 8 + 2 + 2); ++i)
    bytes.counts({i == 9 ? 3u : i == 20 ? 2u : i == 31 ? 1u : 0u}, 1);
  return "ECCDTRC2" + bytes.text();
}

/// The same with the last face left out: the sample has two with the same vertices.
inline std::string good_body_trace() {
  std::string bytes = sample_body_trace();
  bytes[vertex_count_at + 8] = 1;
  return bytes.erase(faces_of_first_at + 12, 12);
}

inline std::string changed(std::string bytes, std::size_t at, const std::string& part) {
  return bytes.replace(at, part.size(), part);
}
inline std::string counts(std::initializer_list<std::uint64_t> values) {
  return Little_endian().counts(values).text();
}
inline std::string double_bytes(double value) { return Little_endian().number(value).text(); }

inline void expect_same(const Body_trace& a, const Body_trace& b) {
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].vertices, b.bodies[i].vertices);
    EXPECT_EQ(a.bodies[i].edges, b.bodies[i].edges);
    EXPECT_EQ(a.bodies[i].faces, b.bodies[i].faces);
    EXPECT_EQ(a.bodies[i].radii, b.bodies[i].radii);
  }
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.before, b.before);
  EXPECT_EQ(a.targets, b.targets);
  EXPECT_EQ(a.answers, b.answers);
}

inline void write(const std::filesystem::path& path, const Body_trace& trace) {
  Atomic_file file(path);
  write_trace(file, trace);
  file.commit();
}

}  // namespace cellwalk::io

#endif  // CELLWALK_TESTS_IO_RESULTS_TRACE_BYTES_H
