// SPDX-License-Identifier: LGPL-3.0-or-later
// The traces of the published benchmark: every answer is the recorded, exact one.
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/internal/simulation/replay.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <gtest/gtest.h>

#include <filesystem>

#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

struct Facts {
  const char* file;
  std::uint64_t vertex_hits, edge_hits, rounds;
};

/// Facts of the recorded answers: moves with bit 0, bits 1 to 3, and bits 4 to 6 without the bit 1 to 3 that
/// belongs to it.
class PublicTraces : public testing::TestWithParam<Facts> {};

void expect_recorded_answers(const Facts& facts, const Lattice_map<3>& map) {
  const Trace trace =
      mapped(io::read_trace(std::filesystem::path(CELLWALK_TEST_DATA) / "traces" / facts.file), map);
  const Environment<3> environment = trace_environment(trace, map);
  const Locator<3> locator(environment.snapshot());
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    Replay replay(environment.snapshot(), locator, trace, {sweep, true});
    replay.run();
    EXPECT_EQ(count_mismatches(trace, replay.answers(), sweep), 0u);
    const Replay_counts& counts = replay.counts();
    EXPECT_EQ(counts.body.moves, trace.moves());
    EXPECT_GT(static_cast<double>(counts.body.in_region), 0.95 * static_cast<double>(trace.moves()));
    EXPECT_EQ(counts.vertex_hits, facts.vertex_hits);
    EXPECT_EQ(counts.edge_hits, facts.edge_hits);
    if (sweep == Sweep::triangle) {
      EXPECT_EQ(counts.rounds, facts.rounds);
      EXPECT_EQ(counts.triangle_hits, facts.edge_hits + facts.rounds);
    }
    EXPECT_NO_THROW(replay.validate());
  }
}

TEST_P(PublicTraces, GiveTheRecordedAnswers) { expect_recorded_answers(GetParam(), {}); }

TEST_P(PublicTraces, HoldTheAnswersOfBruteForce) {
  const Trace trace = io::read_trace(std::filesystem::path(CELLWALK_TEST_DATA) / "traces" / GetParam().file);
  const test::Trace_walls walls(trace);
  std::uint64_t vertex_hits = 0;
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
    ASSERT_EQ(int{trace.answers[i]}, int{test::answer(walls, from, target, q)}) << "move " << i;
    vertex_hits += trace.answers[i] & trace_segment_bit;
  });
  EXPECT_EQ(vertex_hits, GetParam().vertex_hits);
}

TEST_P(PublicTraces, GiveTheRecordedAnswersSheared) { expect_recorded_answers(GetParam(), sheared<3>()); }

INSTANTIATE_TEST_SUITE_P(Replay, PublicTraces,
                         testing::Values(Facts{"1k.bin", 884, 343, 4}, Facts{"10k.bin", 397, 235, 0},
                                         Facts{"1m.bin", 243, 193, 0}),
                         [](const auto& facts) {
                           const std::string file = facts.param.file;
                           return "Of" + file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace cellwalk
