// SPDX-License-Identifier: LGPL-3.0-or-later
// Ranks as far as one process goes; several are in test_mpi.py.
#include <cellwalk/internal/kernel/bytes.h>
#include <cellwalk/internal/ranks/ranks.h>

#include <gtest/gtest.h>

namespace cellwalk {
namespace {

TEST(Ranks, AloneHandsEverythingToItself) {
  Ranks ranks = Ranks::join();
  EXPECT_TRUE(ranks.is_alone());
  EXPECT_TRUE(ranks.is_first());
  EXPECT_FALSE(is_later_rank());
  EXPECT_EQ(ranks.block(7).begin, 0u);
  EXPECT_EQ(ranks.block(7).end, 7u);
  EXPECT_EQ(ranks.gather("mine"), std::vector<std::string>{"mine"});
  EXPECT_EQ(ranks.broadcast("all's"), "all's");
  ranks.fail(Error_code::input, "the caller has printed it");  // and goes on: it ends itself
  ranks.leave();
}

TEST(Bytes, AreReadAsTheyWereWritten) {
  Byte_writer writer;
  writer.value(std::uint16_t{7});
  writer.list(std::vector<double>{0.5, -0.0});
  writer.text("a text");
  writer.list(std::vector<int>{});
  const std::string bytes = writer.take();
  Byte_reader reader(bytes);
  EXPECT_EQ(reader.value<std::uint16_t>(), 7);
  EXPECT_EQ(reader.list<double>(), (std::vector<double>{0.5, 0.0}));
  EXPECT_EQ(reader.text(), "a text");
  EXPECT_TRUE(reader.list<int>().empty());
  EXPECT_THROW(reader.value<char>(), Error);
}

TEST(Bytes, CutShortAreRefused) {
  Byte_writer writer;
  writer.list(std::vector<double>(5, 1.0));
  const std::string bytes = writer.take();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    Byte_reader reader(std::string_view(bytes).substr(0, length));
    EXPECT_THROW(reader.list<double>(), Error) << length;
  }
  Byte_writer huge;
  huge.value(~std::uint64_t{0});
  const std::string announced = huge.take();
  Byte_reader list(announced), text(announced);
  EXPECT_THROW(list.list<double>(), Error);
  EXPECT_THROW(text.text(), Error);
}

}  // namespace
}  // namespace cellwalk
