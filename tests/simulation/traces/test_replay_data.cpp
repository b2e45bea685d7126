// SPDX-License-Identifier: LGPL-3.0-or-later
// The traces of the published benchmark: every answer is the recorded, exact one.
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "simulation/replayed.h"
#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

/// Facts of the recorded answers: vertices that hit, edges that do at the target, and edges that do only on
/// their way.
struct Facts {
  const char* file;
  std::uint64_t vertex_hits, edge_hits, rounds;
};

class PublicTraces : public testing::TestWithParam<Facts> {
 protected:
  static Body_trace read() {
    return io::read_trace(std::filesystem::path(CELLWALK_TEST_DATA) / "traces" / GetParam().file);
  }
};

void expect_recorded_answers(const Body_trace& trace, const Lattice_map<3>& map) {
  const Environment<3> environment = trace_environment(*trace.grid, map);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    const test::Replayed replayed =
        test::replayed(environment.snapshot(), trace, body_trace_options(sweep, trace));
    EXPECT_EQ(replayed.mismatches, 0u);
    EXPECT_EQ(replayed.counts.moves, trace.moves());
    EXPECT_GT(static_cast<double>(replayed.counts.in_region), 0.95 * static_cast<double>(trace.moves()));
  }
}

TEST_P(PublicTraces, GiveTheRecordedAnswers) { expect_recorded_answers(read(), {}); }

TEST_P(PublicTraces, HoldTheAnswersOfBruteForce) {
  const Body_trace trace = read();
  const test::Trace_walls walls(*trace.grid);
  std::uint64_t vertex_hits = 0, edge_hits = 0, rounds = 0;
  test::for_each_recorded_move(trace, [&](const test::Recorded_move& move) {
    ASSERT_TRUE(std::ranges::equal(
        move.answers, test::answers_where_touches_block(walls, move.from, move.target, move.neighbours)));
    vertex_hits += move.is_blocked();
    for (std::size_t i = 0; i < move.neighbours.size() && !move.is_blocked(); ++i) {
      edge_hits += move.is_blocked_at_end(i);
      rounds += move.is_swept(i) && !move.is_blocked_at_end(i);
    }
  });
  EXPECT_EQ(vertex_hits, GetParam().vertex_hits);
  EXPECT_EQ(edge_hits, GetParam().edge_hits);
  EXPECT_EQ(rounds, GetParam().rounds);
}

TEST_P(PublicTraces, GiveTheRecordedAnswersSheared) {
  expect_recorded_answers(mapped(read(), sheared<3>()), sheared<3>());
}

INSTANTIATE_TEST_SUITE_P(Replay, PublicTraces,
                         testing::Values(Facts{"1k.bin", 884, 343, 4}, Facts{"10k.bin", 397, 235, 0},
                                         Facts{"1m.bin", 243, 193, 0}),
                         [](const auto& facts) {
                           const std::string file = facts.param.file;
                           return "Of" + file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace cellwalk
