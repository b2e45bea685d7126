// SPDX-License-Identifier: LGPL-3.0-or-later
// Many motions at once: rows are worked off in chunks, by one thread or by several, with the same results.
#ifndef CELLWALK_PYTHON_BATCH_H
#define CELLWALK_PYTHON_BATCH_H

#include <cellwalk/internal/kernel/gradual_underflow.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace cellwalk::python {

/// Rows of a chunk: some ten microseconds of work, so that threads are fed and their start is not noticed.
inline constexpr std::size_t chunk_rows = 4096;

inline std::size_t chunk_count(std::size_t rows) { return (rows + chunk_rows - 1) / chunk_rows; }

/// Calls work(chunk, first row, row after the last) for every chunk.
/// \pre threads >= 0; 0: as many as there are cores
/// \throw Error(usage) if this thread flushes small numbers to zero
template <class Work>
void for_each_chunk(std::size_t rows, int threads, const Work& work) {
  expect_gradual_underflow();
  const std::size_t chunks = chunk_count(rows);
  const auto run = [&](std::size_t chunk) {
    work(chunk, chunk * chunk_rows, std::min(rows, (chunk + 1) * chunk_rows));
  };
  if (threads == 1 || chunks < 2) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
    return;
  }
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chunks, 1), [&](const auto& range) {
      for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) run(chunk);
    });
  });
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_BATCH_H
