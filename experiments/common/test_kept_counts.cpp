// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "common/kept_counts.h"
#include "common/shared.h"

namespace cellwalk::experiments {
namespace {

struct Pair {
  std::uint64_t first = 0, second = 0;
  friend bool operator==(const Pair&, const Pair&) = default;
};

constexpr const char* settings = R"({"seed":1})";

class KeptCounts : public testing::Test {
 protected:
  KeptCounts() { std::filesystem::create_directories(folder_); }
  ~KeptCounts() override { std::filesystem::remove_all(folder_); }

  /// Parts 0 to count - 1 of a run; returns how many of them were made.
  int run(int count, bool goes_on, const std::string& of = settings) {
    Kept_counts kept(file_, of, goes_on);
    int made = 0;
    for (int i = 0; i < count; ++i) {
      const Pair expected{static_cast<std::uint64_t>(i), ~std::uint64_t{0} - static_cast<std::uint64_t>(i)};
      const auto found = kept.of<Pair>("part " + std::to_string(i), [&] {
        ++made;
        return expected;
      });
      EXPECT_EQ(found, expected);
    }
    return made;
  }

  void refuses(const std::string& of, const std::string& why) {
    try {
      Kept_counts(file_, of, true);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input);
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("cellwalk_kept_" + std::to_string(getpid()));
  const std::filesystem::path file_ = folder_ / "kept.jsonl";
};

TEST_F(KeptCounts, PartsThatAreKeptAreNotMadeAgain) {
  EXPECT_EQ(run(3, false), 3);
  EXPECT_EQ(run(5, true), 2);
  EXPECT_EQ(run(5, true), 0);
  EXPECT_EQ(run(2, false), 2);  // begins anew
  EXPECT_EQ(run(5, true), 3);
}

TEST_F(KeptCounts, NothingIsKeptYet) { EXPECT_EQ(run(2, true), 2); }

TEST_F(KeptCounts, EveryLengthAtWhichAWriterCanBeKilled) {
  run(3, false);
  const std::string whole = text_of(file_);
  int made_before = 3;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    io::write_file(file_, whole.substr(0, length));
    const int made = run(3, true);
    EXPECT_LE(made, made_before);
    made_before = made;
    EXPECT_EQ(text_of(file_), whole);
  }
  EXPECT_EQ(made_before, 0);
}

TEST_F(KeptCounts, OtherSettingsAreRefusedAndNothingIsLost) {
  run(2, false);
  const std::string whole = text_of(file_);
  refuses(R"({"seed":2})", "other settings");
  EXPECT_EQ(text_of(file_), whole);
}

TEST_F(KeptCounts, ADamagedLineIsNamed) {
  run(2, false);
  const std::string whole = text_of(file_);
  for (const char* line :
       {"{\"part\":\"part 0\"}", "[]", "x", "", "{\"part\":\"part 0\",\"counts\":[-1,\"a\"]}"}) {
    io::write_file(file_, whole + line + "\n");
    refuses(settings, "line 4 is damaged");
  }
}

TEST_F(KeptCounts, APartWithOtherCountsIsRefused) {
  run(1, false);
  Kept_counts kept(file_, settings, true);
  EXPECT_THROW(kept.of<std::uint64_t>("part 0", [] { return std::uint64_t{0}; }), Error);
}

}  // namespace
}  // namespace cellwalk::experiments
