// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/internal/io/trace_file.h>

#include <gtest/gtest.h>

#include <limits>

#include "io/results/damaged_trace.h"
#include "io/results/trace_bytes.h"

namespace cellwalk::io {
namespace {

TEST(TraceFile, ReadsWhatIsThere) {
  ASSERT_EQ(sample_body_trace().size(), body_trace_size);
  const Body_trace trace = parse_trace("t.bin", good_body_trace());
  ASSERT_EQ(trace.bodies.size(), 2u);
  EXPECT_EQ(trace.bodies[0].vertices, 4u);
  EXPECT_EQ(trace.bodies[0].edges,
            (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}}));
  EXPECT_EQ(trace.bodies[0].faces, (std::vector<std::array<std::uint32_t, 3>>{{2, 0, 1}}));
  EXPECT_EQ(degrees(trace.bodies[0]), (std::vector<std::uint32_t>{3, 2, 2, 1}));
  EXPECT_EQ(trace.bodies[1].vertices, 2u);
  EXPECT_EQ(trace.bodies[1].edges, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
  EXPECT_TRUE(trace.bodies[1].faces.empty());
  EXPECT_EQ(trace.steps, 2u);
  EXPECT_EQ(trace.vertices(), 6u);
  EXPECT_EQ(trace.moves(), 12u);
  EXPECT_EQ(trace.answers_of_step(), 16u);
  ASSERT_EQ(trace.before.size(), 18u);
  ASSERT_EQ(trace.targets.size(), 12u);
  EXPECT_EQ(trace.before_step(0)[2], (Point<3>{1.125, -2, 1e-323}));
  EXPECT_TRUE(std::signbit(trace.before_step(0)[3][2]));
  EXPECT_EQ(trace.before_step(2)[1], (Point<3>{1 + 13 / 16.0, -13, 13 * 5e-324}));
  EXPECT_EQ(trace.targets_of_step(1)[5], (Point<3>{1 + 29 / 16.0, -29, 29 * 5e-324}));
  ASSERT_EQ(trace.answers.size(), 32u);
  EXPECT_EQ(trace.answers[9], body_trace_bits);
  EXPECT_EQ(trace.answers[20], body_trace_swept);
  EXPECT_EQ(trace.answers[31], body_trace_blocked);
}

TEST(TraceFile, IsWrittenAsItWasRead) {
  const Folder folder;
  const auto path = folder / "out.bin";
  Body_trace trace = parse_trace("t.bin", good_body_trace());
  write(path, trace);
  EXPECT_EQ(content_of(path), good_body_trace());
  expect_same(read_trace(path), trace);
  trace.answers.clear();
  write(path, trace);
  const std::size_t announced_at = has_answers_at - 12;
  EXPECT_EQ(content_of(path), good_body_trace().substr(0, announced_at) + '\0');
  expect_same(read_trace(path), trace);
  trace.steps = 0, trace.before.resize(6), trace.targets.clear();
  write(path, trace);
  expect_same(read_trace(path), trace);
  EXPECT_EQ(read_trace(path).moves(), 0u);
  write(path, {});
  EXPECT_EQ(content_of(path), "ECCDTRC2" + std::string(9, '\0'));
  EXPECT_EQ(read_trace(path).vertices(), 0u);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(TraceFile, MayBeCompressed) {
  const Folder folder;
  expect_same(read_trace(folder.write("t.bin", gzip(good_body_trace()))),
              parse_trace("t.bin", good_body_trace()));
}

/// The same, in a grid of 3 x 4 x 5 cells of which 2 are solid.
std::string trace_in_a_grid(std::uint32_t touch = 1) {
  return "ECCDTRC3" + counts({touch, 1, 3, 4, 5, 2, 7, 59}) + good_body_trace().substr(8);
}

TEST(TraceFile, HoldsTheGridAndTheRuleOfTouches) {
  const Folder folder;
  const auto path = folder / "out.bin";
  Body_trace trace = parse_trace("t.bin", trace_in_a_grid());
  EXPECT_TRUE(trace.touch_blocks);
  ASSERT_TRUE(trace.grid);
  EXPECT_EQ(trace.grid->cells, (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_EQ(trace.grid->solid, (std::vector<std::uint32_t>{7, 59}));
  expect_same(trace, parse_trace("t.bin", good_body_trace()));
  write(path, trace);
  EXPECT_EQ(content_of(path), trace_in_a_grid());
  trace.touch_blocks = false;
  write(path, trace);
  EXPECT_EQ(content_of(path), trace_in_a_grid(0));
  EXPECT_FALSE(read_trace(path).touch_blocks);
  trace.touch_blocks = true;
  trace.grid.reset();
  write(path, trace);
  EXPECT_EQ(content_of(path), "ECCDTRC3" + counts({1, 0}) + good_body_trace().substr(8));
  EXPECT_FALSE(read_trace(path).grid);
}

TEST(TraceFile, RefusesDamagedGrids) {
  const std::string good = trace_in_a_grid();
  const auto grid = [&](std::uint64_t nx, std::uint64_t ny, std::uint64_t nz) {
    return changed(good, 16, counts({nx, ny, nz}));
  };
  const struct {
    std::string bytes, message;
  } cases[] = {
      {good.substr(0, 10), "the file ends where the rule of touches should be: it is cut short"},
      {changed(good, 8, counts({2})), "the rule of touches is 2: 0 or 1 is expected"},
      {good.substr(0, 14), "the file ends where the number that announces a grid should be: it is cut short"},
      {changed(good, 12, counts({3})), "the number that announces a grid is 3: 0 or 1 is expected"},
      {good.substr(0, 24), "the file ends where the grid should be: it is cut short"},
      {good.substr(0, 28), "the file ends where the number of obstacles should be: it is cut short"},
      {good.substr(0, 36), "the file ends within the obstacles: it is cut short, get it whole"},
      {changed(good, 28, counts({0xffffffff})),
       "the file ends within the obstacles: it is cut short, get it whole"},
      {grid(3, 0, 5), "a grid of 3 x 0 x 5 cells: there must be some, and no more than 32-bit indices name"},
      {grid(3, 4, 4), "obstacle 1 is cell 59, of 48: the trace is damaged"},
      {changed(good, 32, counts({59})), "obstacle 1 is cell 59, after cell 59: obstacles must ascend"},
      {grid(1000, 1001, 1), "announces a grid of 1001000 cells in " + std::to_string(good.size()) +
                                " bytes, too large for so little motion: it may be damaged; get it anew, or "
                                "record in a smaller grid"}};
  for (const auto& c : cases)
    EXPECT_EQ(refusal([&] { parse_trace("t.bin", c.bytes); }), "t.bin: " + c.message);
  EXPECT_EQ(parse_trace("t.bin", grid(1000, 1000, 1)).grid->cell_count(), 1'000'000u);
}

TEST(TraceFile, IsToldByWhatItBeginsWith) {
  for (const char* other : {"", "ECCDTRC", "ECCDTRC5", "hello"})
    EXPECT_EQ(refusal([&] { parse_trace("t.bin", other); }),
              "t.bin: is no trace: it begins with none of ECCDTRC1, ECCDTRC2, ECCDTRC3 and ECCDTRC4; name a "
              "file of recorded motion");
}

TEST(TraceFile, RefusesDamage) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::string good = good_body_trace(), twice = sample_body_trace();
  const std::uint32_t most = 0xffffffff;
  const struct {
    std::string bytes, message;
  } cases[] = {
      {good.substr(0, 10), "the file ends where the number of bodies should be: it is cut short"},
      {good.substr(0, 15), "the file ends where the number of steps should be: it is cut short"},
      {good.substr(0, 16), "the file ends where the vertices of a body should be: it is cut short"},
      {good.substr(0, 20), "the file ends where the edges of a body should be: it is cut short"},
      {good.substr(0, 24), "the file ends where the faces of a body should be: it is cut short"},
      {good.substr(0, edges_of_first_at + 31),
       "the file ends within the edges of a body: it is cut short, get it whole"},
      {changed(good, vertex_count_at, counts({4, most})),
       "the file ends within the edges of a body: it is cut short, get it whole"},
      {good.substr(0, faces_of_first_at + 11),
       "the file ends within the faces of a body: it is cut short, get it whole"},
      {changed(good, vertex_count_at, counts({4, 4, most})),
       "the file ends within the faces of a body: it is cut short, get it whole"},
      {changed(good, vertex_count_at, counts({most})),
       "announces 4294967295 vertices of bodies, more than the 773 bytes left hold: it is cut short, get it "
       "whole"},
      // The vertices of this body fit, those of both do not.
      {changed(good, vertices_of_second_at - 12, counts({28})),
       "announces 32 vertices of bodies, more than the 753 bytes left hold: it is cut short, get it whole"},
      {changed(good, step_count_at, counts({most})),
       "announces 4294967295 steps of 6 vertices, more than the 753 bytes left hold: it is cut short, get it "
       "whole"},
      {changed(good, 8, counts({3})),
       "the file ends within the edges of a body: it is cut short, get it whole"},
      {changed(good, step_count_at, counts({3})),
       "announces 3 steps of 6 vertices, more than the 753 bytes left hold: it is cut short, get it whole"},
      {good.substr(0, before_at - 12 + 600),
       "the file ends within the targets: it is cut short, get it whole"},
      {good.substr(0, has_answers_at - 12),
       "the file ends where the byte that announces answers should be: it is cut short"},
      {changed(good, has_answers_at - 12, "\2"), "the byte that announces answers is 2: 0 or 1 is expected"},
      {good.substr(0, good.size() - 1), "the file ends within the answers: it is cut short, get it whole"},
      {good + "xy", "goes on for 2 bytes after what it announces: it is damaged, get it anew"},
      {changed(good, has_answers_at - 12, std::string(1, '\0')),
       "goes on for 32 bytes after what it announces: it is damaged, get it anew"},
      {changed(good, edges_of_first_at, counts({1, 0})),
       "body 0: edge 0 joins vertices 1 and 0 of 4: the lower one must come first, and both exist"},
      {changed(good, edges_of_first_at, counts({0, 0})),
       "body 0: edge 0 joins vertices 0 and 0 of 4: the lower one must come first, and both exist"},
      {changed(good, edges_of_first_at + 24, counts({1, 4})),
       "body 0: edge 3 joins vertices 1 and 4 of 4: the lower one must come first, and both exist"},
      {changed(good, edges_of_second_at - 12, counts({0, most})),
       "body 1: edge 0 joins vertices 0 and 4294967295 of 2: the lower one must come first, and both exist"},
      {changed(good, edges_of_first_at + 8, counts({0, 1})),
       "body 0: edge 1 is not above the one before: edges must ascend"},
      {changed(good, edges_of_first_at + 16, counts({0, 1})),
       "body 0: edge 2 is not above the one before: edges must ascend"},
      {changed(good, faces_of_first_at, counts({1, 3, 2})),
       "body 0: face 0 has a side from vertex 2 to vertex 3, which is no edge of the body"},
      {changed(good, faces_of_first_at, counts({1, 0, 1})),
       "body 0: face 0 has a side from vertex 1 to vertex 1, which is no edge of the body"},
      {changed(good, faces_of_first_at, counts({0, most, 1})),
       "body 0: face 0 has a side from vertex 1 to vertex 4294967295, which is no edge of the body"},
      {twice, "body 0: two faces have the vertices 0, 1 and 2: leave one out"},
      {"ECCDTRC2" + counts({1, 0, 0, 0, 0}) + '\0', "body 0: it has no vertices"},
      {changed(good, before_at - 12 + (6 + 4) * 24 + 8, double_bytes(nan)),
       "the position of vertex 4 in step 1 has a coordinate that is not finite"},
      {changed(good, body_targets_at - 12 + 24, double_bytes(-inf)),
       "the target of vertex 1 in step 0 has a coordinate that is not finite"},
      {changed(good, body_answers_at - 12 + 17, "\4"), "answer 17 has an unknown bit: it is 4"}};
  for (const auto& c : cases)
    EXPECT_EQ(refusal([&] { parse_trace("t.bin", c.bytes); }), "t.bin: " + c.message);
}

/// Bodies whose numbers of vertices add up to more than 64 bits take, times their bytes, and come out small.
TEST(TraceFile, CountsDoNotWrapAround) {
  Little_endian bytes;
  constexpr std::uint32_t bodies = 1 << 16;
  bytes.counts({bodies, 0xffffffff});
  for (std::uint32_t b = 0; b < bodies; ++b) bytes.counts({0xffffffff, 0, 0});
  const std::string message = refusal([&] { parse_trace("t.bin", "ECCDTRC2" + bytes.text()); });
  EXPECT_TRUE(message.starts_with("t.bin: announces 4294967295 vertices of bodies")) << message;
}

TEST(TraceFile, RefusesToWriteWhatItWouldNotRead) {
  const Folder folder;
  const auto path = folder / "out.bin";
  const Body_trace good = parse_trace("t.bin", good_body_trace());
  const auto message_of = [&](auto change) {
    Body_trace trace = good;
    change(trace);
    const std::string message = refusal([&] { write(path, trace); }, Error_code::usage);
    EXPECT_TRUE(message.starts_with(path.string() + ": is not written: ")) << message;
    return message.substr(path.string().size() + 18);
  };
  const std::string lengths =
      "the trace holds other numbers of positions, targets and answers than its counts say";
  EXPECT_EQ(message_of([](Body_trace& t) { t.steps = 3; }), lengths);
  EXPECT_EQ(message_of([](Body_trace& t) { t.before.pop_back(); }), lengths);
  EXPECT_EQ(message_of([](Body_trace& t) { t.targets.pop_back(); }), lengths);
  EXPECT_EQ(message_of([](Body_trace& t) { t.answers.pop_back(); }), lengths);
  EXPECT_EQ(message_of([](Body_trace& t) { t.bodies[1].edges.clear(); }), lengths);
  EXPECT_EQ(message_of([](Body_trace& t) {
              t.bodies[0].faces.push_back({0, 1, 3});
            }),
            "body 0: face 1 has a side from vertex 1 to vertex 3, which is no edge of the body");
  EXPECT_EQ(message_of([](Body_trace& t) {
              t.bodies[0].radii = {1, 2};
            }),
            "body 0: 2 radii of 4 edges: there is one for each, one for all, or none");
  EXPECT_EQ(message_of([](Body_trace& t) { t.answers[3] = 9; }), "answer 3 has an unknown bit: it is 9");
  EXPECT_EQ(message_of([](Body_trace& t) {
              t.grid = {{1, 1, 1}, {0, 0}};
            }),
            "obstacle 1 is cell 0, after cell 0: obstacles must ascend");
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(TraceFile, DamagedAtRandom) { damage_at_random(good_body_trace(), before_at - 20); }

}  // namespace
}  // namespace cellwalk::io
