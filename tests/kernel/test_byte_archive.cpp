// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/kernel/checksum.h>

#include <boost/container/small_vector.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cellwalk {
namespace {

enum class Colour : std::uint16_t { red, green };

/// Whole parts by a function, inner ones by a member that is private.
class Inside {
 public:
  Inside() = default;
  explicit Inside(int value) : value_(value) {}
  bool operator==(const Inside&) const = default;

 private:
  template <class Archive>
  void archive(Archive& a) {
    a(value_);
  }
  friend detail::Byte_reader;
  friend detail::Byte_writer;
  int value_ = 0;
};

struct Whole {
  bool is_there = false;
  Colour colour = Colour::red;
  double number = 0;
  std::string text;
  std::vector<Inside> list;
  std::array<std::vector<int>, 2> lists;
  std::map<std::vector<std::uint32_t>, std::string> names;
  std::set<std::array<int, 2>> pairs;
  std::optional<Inside> some, none;
  std::variant<int, std::string> either;
  boost::container::small_vector<std::uint16_t, 2> small;
  bool operator==(const Whole&) const = default;
};

template <class Archive>
void visit_parts(Archive& a, Whole& outer) {
  a(outer.is_there, outer.colour, outer.number, outer.text, outer.list, outer.lists, outer.names, outer.pairs,
    outer.some, outer.none, outer.either, outer.small);
}

Whole full() {
  Whole outer;
  outer.is_there = true;
  outer.colour = Colour::green;
  outer.number = -0.1;
  outer.text = "text";
  outer.list = {Inside(1), Inside(-2)};
  outer.lists[1] = {3, 4, 5};
  outer.names = {{{1, 2}, "a"}, {{}, "b"}};
  outer.pairs = {{1, 2}, {0, 7}};
  outer.some = Inside(9);
  outer.either = std::string("either");
  outer.small = {1, 2, 3};
  return outer;
}

TEST(ByteArchive, GivesBackWhatWasWritten) {
  for (const Whole& outer : {full(), Whole()}) {
    detail::Byte_writer out;
    out(outer, std::uint8_t{7});
    detail::Byte_reader in(out.bytes());
    Whole read = full();
    read.none = Inside(3);
    in(read);
    EXPECT_TRUE(read == outer);
    EXPECT_FALSE(in.is_at_end());
    EXPECT_THROW(in.expect_end(), Error);
    EXPECT_EQ(in.next<std::uint8_t>(), 7);
    EXPECT_TRUE(in.is_at_end());
    in.expect_end();
    const std::string message = out.message();
    EXPECT_TRUE(detail::Byte_reader(std::string_view(message)).next<Whole>() == outer);
  }
}

TEST(ByteArchive, BytesThatEndBeforeAreRefused) {
  detail::Byte_writer out;
  out(full());
  for (std::size_t size = 0; size < out.bytes().size(); ++size) {
    detail::Byte_reader in(std::span(out.bytes()).first(size));
    EXPECT_THROW(in.next<Whole>(), Error) << size;
  }
}

/// None of them asks for more memory than the bytes could fill.
TEST(ByteArchive, CountsThatCannotBeAreRefused) {
  for (const std::uint64_t count :
       {std::uint64_t{2}, std::uint64_t{1} << 40, std::numeric_limits<std::uint64_t>::max()}) {
    detail::Byte_writer out;
    out(count, std::uint8_t{1});
    const auto is_refused = [&]<class T>(T value) {
      detail::Byte_reader in(out.bytes());
      try {
        in(value);
      } catch (const Error& error) {
        return error.code() == Error_code::input;
      }
      return false;
    };
    EXPECT_TRUE(is_refused(std::vector<double>()));
    EXPECT_TRUE(is_refused(std::vector<std::string>()));
    EXPECT_TRUE(is_refused(std::string()));
    EXPECT_TRUE(is_refused(std::map<int, int>()));
    EXPECT_TRUE(is_refused(std::variant<int, double>()));
  }
}

TEST(ByteArchive, ChecksumsTellBytesApart) {
  std::array<std::byte, 3> bytes{std::byte{1}, std::byte{2}, std::byte{3}};
  const std::uint64_t before = detail::checksum(bytes);
  EXPECT_EQ(detail::checksum(bytes), before);
  bytes[1] = std::byte{0};
  EXPECT_NE(detail::checksum(bytes), before);
  EXPECT_EQ(detail::checksum({}), 0x2d06800538d394c2u);  // XXH3 of nothing, as its authors publish it
}

}  // namespace
}  // namespace cellwalk
