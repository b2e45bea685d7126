// SPDX-License-Identifier: LGPL-3.0-or-later
// The traces of the published benchmark: read with their counts, written again byte for byte.
#include <cellwalk/internal/io/trace_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

TEST(PublicTraceFiles, AreReadAndWrittenByteForByte) {
  const struct {
    const char* file;
    std::array<std::uint32_t, 3> cells;
    std::uint32_t steps, obstacles;
  } traces[] = {{"1k.bin", {10, 10, 10}, 100, 100},
                {"10k.bin", {20, 20, 25}, 60, 1000},
                {"1m.bin", {100, 100, 100}, 40, 100000}};
  const Folder folder;
  for (const auto& t : traces) {
    SCOPED_TRACE(t.file);
    const auto path = std::filesystem::path(CELLWALK_TEST_DATA) / "traces" / t.file;
    const Trace trace = read_trace(path);
    EXPECT_EQ((std::array<std::uint32_t, 3>{trace.nx, trace.ny, trace.nz}), t.cells);
    EXPECT_EQ(trace.bodies, 225u);
    EXPECT_EQ(trace.steps, t.steps);
    EXPECT_EQ(trace.obstacles.size(), t.obstacles);
    // A vertex that hits on its way has no edges to ask about, and all its triangles hit.
    const auto hits = [&](std::uint8_t a) { return (a & trace_segment_bit) != 0; };
    EXPECT_GT(std::count_if(trace.answers.begin(), trace.answers.end(), hits), 0);
    for (std::uint8_t a : trace.answers) {
      if (hits(a)) {
        ASSERT_EQ(a & (trace_edge_bits | trace_triangle_bits), trace_triangle_bits);
      }
    }
    write_trace(folder / t.file, trace);
    EXPECT_TRUE(content_of(folder / t.file) == content_of(path));
  }
}

}  // namespace
}  // namespace cellwalk::io
