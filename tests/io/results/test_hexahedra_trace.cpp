// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/trace_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "io/io_fixture.h"
#include "io/results/damaged_trace.h"

namespace cellwalk::io {
namespace {

/// Bytes as the format has them, put down one by one: nothing of the writer is used.
class Bytes {
 public:
  Bytes& count(std::uint64_t value, int size = 4) {
    for (int i = 0; i < size; ++i) text_.push_back(static_cast<char>(value >> 8 * i & 0xff));
    return *this;
  }
  Bytes& number(double value) { return count(std::bit_cast<std::uint64_t>(value), 8); }
  const std::string& text() const { return text_; }

 private:
  std::string text_ = "ECCDTRC1";
};

// Where the parts of `sample_trace()` lie.
constexpr std::size_t nx_at = 8, bodies_at = 20, steps_at = 24, obstacles_at = 28, fraction_at = 40,
                      speed_at = 56, indices_at = 64, padding_at = 76, starts_at = 80,
                      targets_at = starts_at + 192, answers_at = targets_at + 2 * 192,
                      hexahedra_trace_size = answers_at + 2 * 8;

/// A grid of 3 x 4 x 5 cells of which 3 are solid, one body, two steps.
std::string sample_trace() {
  Bytes bytes;
  bytes.count(3).count(4).count(5).count(1).count(2).count(3).count(0x0123456789abcdef, 8);
  bytes.number(0.05).number(0.25).number(1e-2);
  bytes.count(0).count(7).count(59).count(0);
  for (int i = 0; i < 3 * 8; ++i) bytes.number(1 + i / 16.0).number(-i).number(i == 3 ? -0.0 : 5e-324 * i);
  for (int i = 0; i < 2 * 8; ++i) bytes.count(i == 9 ? 0x71 : i == 12 ? 0x2a : 0, 1);
  return bytes.text();
}

std::string with(std::string bytes, std::size_t at, const std::string& part) {
  return bytes.replace(at, part.size(), part);
}
std::string count(std::uint32_t value) { return Bytes().count(value).text().substr(8); }
std::string number(double value) { return Bytes().number(value).text().substr(8); }

TEST(HexahedraTrace, IsReadAsATraceOfBodies) {
  ASSERT_EQ(sample_trace().size(), hexahedra_trace_size);
  const Body_trace trace = parse_trace("t.bin", sample_trace());
  EXPECT_TRUE(trace.touch_blocks);
  ASSERT_TRUE(trace.grid);
  EXPECT_EQ(trace.grid->cells, (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_EQ(trace.grid->solid, (std::vector<std::uint32_t>{0, 7, 59}));
  ASSERT_EQ(trace.bodies.size(), 1u);
  EXPECT_EQ(trace.bodies[0].vertices, 8u);
  EXPECT_EQ(trace.bodies[0].edges.size(), 12u);
  EXPECT_TRUE(std::ranges::is_sorted(trace.bodies[0].edges));
  for (const auto& [v, w] : trace.bodies[0].edges) EXPECT_TRUE(v < w && std::has_single_bit(v ^ w));
  EXPECT_TRUE(trace.bodies[0].faces.empty());
  EXPECT_EQ(trace.steps, 2u);
  ASSERT_EQ(trace.before.size(), 24u);
  ASSERT_EQ(trace.targets.size(), 16u);
  EXPECT_EQ(trace.before_step(0)[2], (Point<3>{1.125, -2, 1e-323}));
  EXPECT_TRUE(std::signbit(trace.before_step(0)[3][2]));
  EXPECT_EQ(trace.targets_of_step(0)[0], (Point<3>{1.5, -8, 8 * 5e-324}));
  EXPECT_EQ(trace.targets_of_step(1)[4], (Point<3>{2.25, -20, 20 * 5e-324}));
  // All vertices move in the first step; 1 and 4 stay in the second one.
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_EQ(trace.before_step(1)[v], trace.targets_of_step(0)[v]);
    EXPECT_EQ(trace.before_step(2)[v], trace.targets_of_step(v == 1 || v == 4 ? 0 : 1)[v]);
  }
  std::vector<std::uint8_t> answers(2 * 8 * 4);
  std::ranges::copy(std::array{1, 2, 2, 2}, answers.begin() + (8 + 1) * 4);
  // Of the edges of vertex 4, those to 5 and 0 hit where it would be, and that to 6 hits on its way.
  std::ranges::copy(std::array{0, 1, 1, 2}, answers.begin() + (8 + 4) * 4);
  EXPECT_EQ(trace.answers, answers);
}

TEST(HexahedraTrace, StartsAreAllThatIsThereWithoutSteps) {
  const std::string bytes = with(sample_trace(), steps_at, count(0)).substr(0, targets_at);
  const Body_trace trace = parse_trace("t.bin", bytes);
  EXPECT_EQ(trace.moves(), 0u);
  EXPECT_EQ(trace.before.size(), 8u);
  EXPECT_TRUE(trace.answers.empty());
}

TEST(HexahedraTrace, RefusesGridsThatAreTooLargeForItsBytes) {
  const auto with_layers = [](std::uint32_t nx) {
    return with(sample_trace(), nx_at, count(nx));
  };  // of 20 cells
  EXPECT_EQ(parse_trace("t.bin", with_layers(50'000)).grid->cell_count(), 1'000'000u);
  EXPECT_EQ(refusal([&] { parse_trace("t.bin", with_layers(50'001)); }),
            "t.bin: announces a grid of 1000020 cells in 672 bytes, too large for so little motion: it may "
            "be damaged; get it anew, "
            "or record in a smaller grid");
  EXPECT_EQ(refusal([&] { parse_trace("t.bin", with_layers(200'000'000)); }),
            "t.bin: announces a grid of 4000000000 cells in 672 bytes, too large for so little motion: it "
            "may be damaged; get it anew, "
            "or record in a smaller grid");
}

TEST(HexahedraTrace, RefusesStepsInWhichNothingMoves) {
  const std::string none = with(with(sample_trace(), bodies_at, count(0)), steps_at, count(4'294'967'295));
  EXPECT_EQ(refusal([&] { parse_trace("t.bin", none.substr(0, starts_at)); }),
            "t.bin: announces 4294967295 steps of no bodies: nothing moves in them");
}

TEST(HexahedraTrace, RefusesDamage) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const struct {
    std::string bytes, message;
  } cases[] = {
      {sample_trace().substr(0, 63), "the file ends where the header should be: it is cut short"},
      {sample_trace().substr(0, hexahedra_trace_size - 1),
       "announces 3 obstacles, 1 bodies and 2 steps, more than its 671 bytes hold: it is cut short, get it "
       "whole"},
      {sample_trace().substr(0, indices_at + 2),
       "announces 3 obstacles, 1 bodies and 2 steps, more than its 66 bytes hold: it is cut short, get it "
       "whole"},
      {sample_trace() + "x",
       "goes on for 1 bytes after the 3 obstacles, 1 bodies and 2 steps that it announces: it is damaged, "
       "get "
       "it anew"},
      {with(sample_trace(), obstacles_at, count(0xffffffff)),
       "announces 4294967295 obstacles, 1 bodies and 2 steps, more than its 672 bytes hold: it is cut short, "
       "get "
       "it whole"},
      {with(sample_trace(), bodies_at, count(0xffffffff) + count(0xffffffff)),
       "announces 3 obstacles, 4294967295 bodies and 4294967295 steps, more than its 672 bytes hold: it is "
       "cut "
       "short, get it whole"},
      // 2^29 bodies and 2^27 steps: the number of bytes, 200 x 2^56, does not fit 64 bits.
      {with(sample_trace(), bodies_at, count(1u << 29) + count(1u << 27)),
       "announces 3 obstacles, 536870912 bodies and 134217728 steps, more than its 672 bytes hold: it is cut "
       "short, get it whole"},
      {with(sample_trace(), nx_at, count(0)),
       "a grid of 0 x 4 x 5 cells: there must be some, and no more than 32-bit indices name"},
      {with(sample_trace(), nx_at, count(1u << 16) + count(1u << 16) + count(2)),
       "a grid of 65536 x 65536 x 2 cells: there must be some, and no more than 32-bit indices name"},
      {with(sample_trace(), nx_at, count(0xffffffff) + count(0xffffffff) + count(0xffffffff)),
       "a grid of 4294967295 x 4294967295 x 4294967295 cells: there must be some, and no more than 32-bit "
       "indices name"},
      {with(sample_trace(), fraction_at, number(nan)),
       "a number of the header is not finite: the trace is damaged"},
      {with(sample_trace(), speed_at, number(inf)),
       "a number of the header is not finite: the trace is damaged"},
      {with(sample_trace(), indices_at + 8, count(60)), "obstacle 2 is cell 60, of 60: the trace is damaged"},
      {with(sample_trace(), indices_at + 4, count(0)),
       "obstacle 1 is cell 0, after cell 0: obstacles must ascend"},
      {with(sample_trace(), indices_at + 8, count(6)),
       "obstacle 2 is cell 6, after cell 7: obstacles must ascend"},
      {with(sample_trace(), padding_at + 3, "\1"),
       "the bytes after the obstacles, which fill up to eight, are not zero: it is damaged"},
      {with(sample_trace(), starts_at + 3 * 24 + 8, number(nan)),
       "vertex 3 of body 0 starts at a coordinate that is not finite"},
      {with(sample_trace(), targets_at + (8 + 5) * 24, number(-inf)),
       "the target of vertex 5 of body 0 in step 1 has a coordinate that is not finite"},
      {with(sample_trace(), answers_at + 2, "\x80"),
       "the answer to vertex 2 of body 0 in step 0 has an unknown bit: it is 128"}};
  for (const auto& c : cases)
    EXPECT_EQ(refusal([&] { parse_trace("t.bin", c.bytes); }), "t.bin: " + c.message);
}

TEST(HexahedraTrace, DamagedAtRandom) { damage_at_random(sample_trace(), padding_at - 8); }

}  // namespace
}  // namespace cellwalk::io
