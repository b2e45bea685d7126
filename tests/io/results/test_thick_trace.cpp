// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces of bodies with a radius.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "io/results/damaged_trace.h"
#include "io/results/trace_bytes.h"

namespace cellwalk::io {
namespace {

// Where the parts of `thick_trace()` lie.
constexpr std::size_t radius_count_at = 36, radii_at = 40 + 32;

/// The bodies of `good_body_trace()` with these radii, the first one with one for each edge.
std::string thick_trace(std::vector<double> radii = {0.5, -0.0, 5e-324, 1e308}, std::uint32_t touch = 0) {
  Little_endian bytes;
  bytes.counts({touch, 0, 2, 2});
  bytes.counts({4, 4, 1, radii.size()}).counts({0, 1, 0, 2, 0, 3, 1, 2});
  for (const double r : radii) bytes.number(r);
  bytes.counts({2, 0, 1}).counts({2, 1, 0, 1}).counts({0, 1}).number(0.25);
  return "ECCDTRC4" + bytes.text() + good_body_trace().substr(before_at - 12);
}

TEST(ThickTrace, HoldsRadii) {
  const Folder folder;
  const auto path = folder / "out.bin";
  Body_trace trace = parse_trace("t.bin", thick_trace());
  EXPECT_TRUE(trace.has_radii());
  EXPECT_EQ(trace.bodies[0].radii, (std::vector<double>{0.5, 0, 5e-324, 1e308}));
  EXPECT_EQ(trace.bodies[1].radii, (std::vector<double>{0.25}));
  EXPECT_EQ(trace.bodies[0].faces.size(), 1u);
  write(path, trace);
  EXPECT_EQ(content_of(path), thick_trace());
  expect_same(read_trace(path), trace);
  trace.grid = {{3, 4, 5}, {7, 59}};
  write(path, trace);
  EXPECT_EQ(read_trace(path).grid->solid, trace.grid->solid);
  expect_same(read_trace(path), trace);
  trace.grid.reset();
  trace.bodies[0].radii.clear();
  write(path, trace);
  EXPECT_EQ(content_of(path), thick_trace({}));
  expect_same(read_trace(path), trace);
  trace.bodies[1].radii.clear();
  write(path, trace);
  EXPECT_EQ(content_of(path), good_body_trace());
  // Where touches block, edges may have the radius 0 only.
  EXPECT_TRUE(parse_trace("t.bin", changed(thick_trace({0}, 1), 116, double_bytes(0))).touch_blocks);
}

TEST(ThickTrace, RefusesWrongRadii) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::string good = thick_trace();
  const struct {
    std::string bytes, message;
  } cases[] = {
      {good.substr(0, radius_count_at),
       "the file ends where the number of radii of a body should be: it is cut short"},
      {good.substr(0, radii_at + 31),
       "the file ends within the radii of a body: it is cut short, get it whole"},
      {changed(good, radius_count_at, counts({0xffffffff})),
       "the file ends within the radii of a body: it is cut short, get it whole"},
      {thick_trace({1, 2}), "body 0: 2 radii of 4 edges: there is one for each, one for all, or none"},
      {thick_trace({1, 2, 3, 4, 5}),
       "body 0: 5 radii of 4 edges: there is one for each, one for all, or none"},
      {thick_trace({1, 2, 3, -1}), "body 0: radius 3 is -1: a finite number of at least 0 is expected"},
      {thick_trace({nan}), "body 0: radius 0 is nan: a finite number of at least 0 is expected"},
      {thick_trace({1, inf, 1, 1}), "body 0: radius 1 is inf: a finite number of at least 0 is expected"},
      {thick_trace({}, 1), "body 1: radius 0 is 0.25, and touches block: what has a radius touches no wall"}};
  for (const auto& c : cases)
    EXPECT_EQ(refusal([&] { parse_trace("t.bin", c.bytes); }), "t.bin: " + c.message);
}

TEST(ThickTrace, DamagedAtRandom) { damage_at_random(thick_trace(), before_at - 20); }

}  // namespace
}  // namespace cellwalk::io
