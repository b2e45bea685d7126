// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces give the recorded answers with all certificates of bodies, with none, and with each alone.
#include <cellwalk/internal/simulation/body_replay.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "body/certificate_sets.h"
#include "simulation/recorded_motions.h"
#include "simulation/touching_trace.h"

namespace cellwalk {
namespace {

using test::Certificate_set;

/// Bits that differ from the answers of a trace.
std::uint64_t mismatches_of(const Body_trace& trace, const Snapshot<3>& snapshot, Sweep sweep,
                            const Certificate_set& set, Body_counts& counts) {
  const Locator<3> locator(snapshot);
  const Body_options options = set.chosen(body_trace_options(sweep, trace));
  std::vector<std::uint8_t> answers;
  std::vector<std::optional<Body<3>>> bodies(trace.bodies.size());
  for (std::uint32_t s = 0; s < trace.steps; ++s)
    for (std::size_t b = 0, first = 0; b < bodies.size(); first += trace.bodies[b++].vertices) {
      const auto of_body = [&](std::span<const Point<3>> of_step) {
        return of_step.subspan(first, trace.bodies[b].vertices);
      };
      const auto before = of_body(trace.before_step(s));
      Step_report<3> report;
      Body_counts uncounted;
      if (bodies[b]) bodies[b]->step(before, options, report, uncounted);
      if (!bodies[b] || !std::ranges::equal(bodies[b]->positions(), before)) {
        const Body_soup<3> soup{{before.begin(), before.end()}, trace.bodies[b].edges, {}};
        detail::use_certificates(bodies[b].emplace(snapshot, locator, soup), set.of_body, uncounted);
      }
      report.clear();
      bodies[b]->step(of_body(trace.targets_of_step(s)), options, report, counts);
      append_body_answers(answerable_degrees(trace.bodies[b], b), report.blocked, sweep, answers);
    }
  return count_mismatches(trace, answers, sweep);
}

void expect_recorded_answers(const Body_trace& trace, const Snapshot<3>& snapshot) {
  Body_counts of_none;
  for (const Certificate_set& set : test::certificate_sets()) {
    SCOPED_TRACE(set.name);
    Body_counts counts;
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle})
      EXPECT_EQ(mismatches_of(trace, snapshot, sweep, set, counts), 0u);
    EXPECT_GT(counts.held, 160u);
    if (of_none.moves == 0)
      of_none = counts;
    else if (set.of_body.least_edges_a_vertex == 0 || !set.of_body.clusters || counts.regions > 0)
      EXPECT_GT(set.counted(counts), set.counted(of_none));
    else  // by the rules for all bodies, rods have no regions
      EXPECT_EQ(counts.in_region, 0u);
  }
}

TEST(ReplayCertificates, GiveTheAnswersOfAGrid) {
  const Body_trace trace = test::random_trace({});
  const Environment<3> grid = trace_environment(*trace.grid),
                       sheared_grid = trace_environment(*trace.grid, sheared<3>());
  expect_recorded_answers(trace, grid.snapshot());
  expect_recorded_answers(mapped(trace, sheared<3>()), sheared_grid.snapshot());
}

TEST(ReplayCertificates, GiveTheAnswersWhereMuchTouches) {
  test::Touching_trace_options options;
  options.bodies = 8;
  options.seed = 100;  // that no other test has
  const Body_trace trace = test::touching_trace(options);
  const Environment<3> environment = trace_environment(*trace.grid);
  expect_recorded_answers(trace, environment.snapshot());
}

TEST(ReplayCertificates, GiveTheAnswersOfManyBodies) {
  for (const test::Recorded_motion* motion : {&test::crowded_rooms(), &test::tube_motion()})
    expect_recorded_answers(motion->trace, motion->snapshot);
}

}  // namespace
}  // namespace cellwalk
