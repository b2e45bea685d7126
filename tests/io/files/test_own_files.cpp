// SPDX-License-Identifier: LGPL-3.0-or-later
// Nothing that is written or removed in a folder reaches a file outside.
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/durable.h>
#include <cellwalk/internal/io/own_files.h>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <span>
#include <string>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

/// Two folders: one for the program, and one with what it must not touch.
class OwnFiles : public testing::Test {
 protected:
  OwnFiles() {
    fs::create_directories(own() / "a" / "b");
    fs::create_directory(outside());
    write_file(outside() / "precious", "mine");
  }
  ~OwnFiles() override {
    EXPECT_EQ(content_of(outside() / "precious"), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(outside()), {}), 1);
  }
  fs::path own() const { return folder_ / "own"; }
  fs::path outside() const { return folder_ / "outside"; }
  void expect_refused(const fs::path& name, const std::string& what) const {
    EXPECT_EQ(refusal([&] { check_own(own(), "own"); }, Error_code::input),
              "own: holds " + name.string() + ", " + what);
    fs::remove(own() / name);
    check_own(own(), "own");
  }

  Folder folder_;
};

TEST_F(OwnFiles, HaveNoOtherNames) {
  write_file(own() / "a" / "file", "text");
  check_own(own(), "own");
  for (const fs::path& target :
       {outside(), outside() / "precious", outside() / "none", fs::path("/dev/null")}) {
    fs::create_symlink(target, own() / "a" / "b" / "link");
    expect_refused("a/b/link", "a symbolic link: remove it");
  }
  fs::create_hard_link(outside() / "precious", own() / "hard");
  expect_refused("hard", "a file with another name (a hard link): go on with a copy of the folder");
  ASSERT_EQ(mkfifo((own() / "a" / "pipe").c_str(), 0600), 0);
  expect_refused("a/pipe", "a pipe, a socket or a device: remove it");
}

TEST_F(OwnFiles, AreOpenedWithoutFollowingLinks) {
  const auto expect_error = [&](int error) {
    EXPECT_EQ(open_own(own() / "file", O_RDWR | O_CREAT), -1);
    EXPECT_EQ(errno, error);
    EXPECT_NE(refusal([&] { Growing_file file(own() / "file"); }, Error_code::other), "");
    fs::remove(own() / "file");
  };
  for (const char* target : {"precious", "none"}) {
    fs::create_symlink(outside() / target, own() / "file");
    expect_error(ELOOP);
  }
  fs::create_hard_link(outside() / "precious", own() / "file");
  expect_error(EMLINK);
  ASSERT_EQ(mkfifo((own() / "file").c_str(), 0600), 0);
  expect_error(ELOOP);
  const int descriptor = open_own(own() / "file", O_RDWR | O_CREAT);
  EXPECT_GE(descriptor, 0);
  close(descriptor);
}

TEST_F(OwnFiles, AreWrittenDurablyWhateverHasTheNamesOfTheirParts) {
  const std::string text = "text";
  const std::array<std::span<const std::byte>, 1> pieces{std::as_bytes(std::span(text))};
  for (const char* name : {"file", "file.tmp"})
    for (const bool is_hard : {false, true}) {
      if (is_hard)
        fs::create_hard_link(outside() / "precious", own() / name);
      else
        fs::create_symlink(outside() / "precious", own() / name);
      write_durably(own() / "file", pieces);
      EXPECT_EQ(content_of(own() / "file"), text);
      EXPECT_FALSE(fs::is_symlink(own() / "file"));
      fs::remove(own() / "file");
    }
}

TEST_F(OwnFiles, AreRemovedWithTheirFolders) {
  for (int i = 0; i < 100; ++i) {
    fs::create_directories(own() / "a" / std::to_string(i) / "c");
    write_file(own() / "a" / std::to_string(i) / "file", "text");
    fs::create_symlink(outside(), own() / "a" / ("link" + std::to_string(i)));
  }
  fs::create_hard_link(outside() / "precious", own() / "hard");
  EXPECT_TRUE(remove_tree((own() / "hard").c_str()));
  EXPECT_TRUE(remove_tree(own().c_str()));
  EXPECT_FALSE(fs::exists(own()));
  EXPECT_TRUE(remove_tree(own().c_str()));
  fs::create_directory_symlink(outside(), own());
  EXPECT_TRUE(remove_tree(own().c_str())) << "the link only";
}

}  // namespace
}  // namespace cellwalk::io
