// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/checkpoint_folder.h>
#include <cellwalk/internal/kernel/checksum.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

std::string text_of(const Checkpoint& checkpoint) {
  return {reinterpret_cast<const char*>(checkpoint.state.data()), checkpoint.state.size()};
}

void keep(Checkpoint_folder& folder, std::uint64_t step, const std::string& state) {
  folder.keep(step, std::as_bytes(std::span(state)));
}

class Checkpoints : public testing::Test {
 protected:
  std::filesystem::path file(int step) const {
    return folder_ / ("step-000000000" + std::to_string(step) + ".checkpoint");
  }
  void change(int step, std::size_t byte) const {
    std::string bytes = content_of(file(step));
    bytes.at(byte) ^= 1;
    folder_.write(file(step).filename().string(), bytes);
  }

  /// Writes the checksum that a file has: of its head, in which that of the rest stands for it.
  static void seal(std::string& bytes) {
    constexpr std::size_t head_size = 40, at = head_size - sizeof(std::uint64_t);
    const auto put = [&](const std::string& text) {
      const std::uint64_t checksum = cellwalk::detail::checksum(std::as_bytes(std::span(text)));
      std::memcpy(bytes.data() + at, &checksum, sizeof checksum);
    };
    put(bytes.substr(head_size));
    put(bytes.substr(0, head_size));
  }

  Folder folder_;
  Checkpoint_folder checkpoints_{folder_ / "", "program 1"};
};

TEST_F(Checkpoints, TheLastTwoAreKept) {
  EXPECT_FALSE(checkpoints_.has_any());
  for (int step = 0; step < 5; ++step) {
    keep(checkpoints_, static_cast<std::uint64_t>(step), "state " + std::to_string(step));
    EXPECT_EQ(folder_.file_count(), std::min<std::size_t>(2, static_cast<std::size_t>(step) + 1));
    const Checkpoint newest = checkpoints_.newest();
    EXPECT_EQ(newest.step, static_cast<std::uint64_t>(step));
    EXPECT_EQ(text_of(newest), "state " + std::to_string(step));
    EXPECT_TRUE(newest.passed_over.empty());
  }
  EXPECT_TRUE(checkpoints_.has_any());
  keep(checkpoints_, 7, "");
  EXPECT_EQ(text_of(checkpoints_.newest()), "");
}

TEST_F(Checkpoints, WhatIsDamagedIsPassedOver) {
  keep(checkpoints_, 1, "first");
  keep(checkpoints_, 2, "second");
  const std::string whole = content_of(file(2));
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    folder_.write(file(2).filename().string(), whole);
    change(2, byte);
    const Checkpoint found = checkpoints_.newest();
    EXPECT_EQ(text_of(found), "first") << "byte " << byte;
    ASSERT_EQ(found.passed_over.size(), 1u);
    EXPECT_EQ(found.passed_over[0].find(file(2).string() + ": it"), 0u) << found.passed_over[0];
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    folder_.write(file(2).filename().string(), whole.substr(0, size));
    EXPECT_EQ(text_of(checkpoints_.newest()), "first") << size << " bytes";
  }
  folder_.write(file(2).filename().string(), whole + "x");
  EXPECT_EQ(text_of(checkpoints_.newest()), "first");
  folder_.write(file(2).filename().string(), whole);
  EXPECT_EQ(text_of(checkpoints_.newest()), "second");
}

TEST_F(Checkpoints, DamagedOnesDoNotTakeThePlaceOfGoodOnes) {
  keep(checkpoints_, 1, "first");
  keep(checkpoints_, 9, "ninth");
  change(9, 50);
  EXPECT_EQ(checkpoints_.newest().step, 1u);
  keep(checkpoints_, 2, "second");
  EXPECT_FALSE(std::filesystem::exists(file(9)));
  EXPECT_TRUE(std::filesystem::exists(file(1)));
  EXPECT_EQ(text_of(checkpoints_.newest()), "second");
}

TEST_F(Checkpoints, SaysThatThereIsNone) {
  EXPECT_NE(refusal([&] { checkpoints_.newest(); }).find("holds no checkpoint: begin the run again"),
            std::string::npos);
  folder_.write("step-7.checkpoint.tmp", "");
  folder_.write("step-x.checkpoint", "");
  folder_.write("notes", "");
  EXPECT_FALSE(checkpoints_.has_any());
  keep(checkpoints_, 1, "first");
  change(1, 60);
  EXPECT_NE(refusal([&] {
              checkpoints_.newest();
            }).find("its checksum differs, and there is no other checkpoint: begin the run again"),
            std::string::npos);
}

TEST_F(Checkpoints, AnotherProgramDoesNotGoOn) {
  keep(checkpoints_, 1, "first");
  const Checkpoint_folder other(folder_ / "", "program 2");
  EXPECT_NE(
      refusal([&] {
        other.newest();
      }).find("was written by program 1, and this is program 2: go on with the program that began the run"),
      std::string::npos);
  std::string bytes = content_of(file(1));
  bytes[8] = 9;
  seal(bytes);
  folder_.write(file(1).filename().string(), bytes);
  EXPECT_NE(refusal([&] { checkpoints_.newest(); }).find("was written in version 9 of the format"),
            std::string::npos);
}

TEST_F(Checkpoints, FoldersAreNone) {
  keep(checkpoints_, 1, "first");
  std::filesystem::create_directory(file(9));
  const Checkpoint found = checkpoints_.newest();
  EXPECT_EQ(text_of(found), "first");
  EXPECT_TRUE(found.passed_over.empty());
  keep(checkpoints_, 2, "second");
  EXPECT_TRUE(std::filesystem::exists(file(9)));
}

TEST_F(Checkpoints, ADeviceThatIsFullLeavesTheOldOnes) {
  keep(checkpoints_, 1, "first");
  std::filesystem::create_directory(file(2));  // nothing can be written there
  EXPECT_NE(refusal([&] { keep(checkpoints_, 2, "second"); }, Error_code::other).find("writing failed"),
            std::string::npos);
  std::filesystem::remove(file(2));
  EXPECT_EQ(text_of(checkpoints_.newest()), "first");
  EXPECT_EQ(folder_.file_count(), 1u);
}

}  // namespace
}  // namespace cellwalk::io
