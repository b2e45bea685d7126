// SPDX-License-Identifier: LGPL-3.0-or-later
// The traces of the published benchmark: read with their counts, and written in the format of today.
#include <cellwalk/internal/io/trace_file.h>

#include <gtest/gtest.h>

#include <array>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

TEST(PublicTraceFiles, AreReadAndWrittenAnew) {
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
    const Body_trace trace = read_trace(path);
    EXPECT_EQ(trace.grid.value().cells, t.cells);
    EXPECT_EQ(trace.bodies.size(), 225u);
    EXPECT_EQ(trace.steps, t.steps);
    EXPECT_EQ(trace.grid->solid.size(), t.obstacles);
    // A vertex that hits on its way has no edges to ask about, and all its triangles hit.
    int hits = 0;
    for (std::size_t i = 0; i < trace.answers.size(); i += 4) {
      if (trace.answers[i] == 0) continue;
      ++hits;
      for (std::size_t k = 1; k < 4; ++k) ASSERT_EQ(trace.answers[i + k], body_trace_swept);
    }
    EXPECT_GT(hits, 0);
    Atomic_file file(folder / t.file);
    write_trace(file, trace);
    file.commit();
    const Body_trace again = read_trace(folder / t.file);
    EXPECT_TRUE(again.before == trace.before && again.targets == trace.targets &&
                again.answers == trace.answers);
  }
}

}  // namespace
}  // namespace cellwalk::io
