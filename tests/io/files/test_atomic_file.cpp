// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/atomic_file.h>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

TEST(AtomicFile, AppearsOnCommitOnly) {
  const Folder folder;
  Atomic_file file(folder / "out.txt");
  file.write("one\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.txt"));
  file.write(std::string(1 << 20, 'x'));
  file.commit();
  EXPECT_EQ(content_of(folder / "out.txt"), "one\n" + std::string(1 << 20, 'x'));
  EXPECT_EQ(folder.file_count(), 1u);
  struct stat status;
  ASSERT_EQ(stat((folder / "out.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0400u, 0400u);
}

TEST(AtomicFile, LeavesTheOldFileWithoutCommit) {
  const Folder folder;
  folder.write("out.txt", "old");
  {
    Atomic_file file(folder / "out.txt");
    file.write(std::string(1 << 20, 'x'));
    EXPECT_EQ(folder.file_count(), 2u);
  }
  EXPECT_EQ(content_of(folder / "out.txt"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
  write_file(folder / "out.txt", "new");
  EXPECT_EQ(content_of(folder / "out.txt"), "new");
}

TEST(AtomicFile, ReplacesTheFileBehindALink) {
  const Folder folder;
  folder.write("real.txt", "old");
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  write_file(folder / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(content_of(folder / "real.txt"), "new");
}

TEST(AtomicFile, MakesTheFileToWhichALinkLeads) {
  const Folder folder;
  std::filesystem::create_directory(folder / "there");
  std::filesystem::create_symlink("there/next.txt", folder / "link.txt");
  std::filesystem::create_symlink("real.txt", folder / "there" / "next.txt");
  write_file(folder / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "there" / "next.txt"));
  EXPECT_EQ(content_of(folder / "there" / "real.txt"), "new");
  std::filesystem::create_symlink("nowhere/real.txt", folder / "astray.txt");
  std::filesystem::create_symlink("loop.txt", folder / "loop.txt");
  for (const char* name : {"astray.txt", "loop.txt"}) {
    const std::string link = (folder / name).string();
    EXPECT_TRUE(refusal([&] { write_file(link, "new"); }, Error_code::other)
                    .starts_with(link + ": cannot be written"));
    EXPECT_TRUE(std::filesystem::is_symlink(link));
  }
}

TEST(AtomicFile, WritesDevicesDirectly) {
  write_file("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_NE(
      refusal([] { write_file("/dev/full", "text"); }, Error_code::other).find("/dev/full: writing failed"),
      std::string::npos);
}

TEST(AtomicFile, SaysWhatCannotBeWritten) {
  const Folder folder;
  const std::string inside = (folder / "missing" / "out.txt").string();
  EXPECT_EQ(refusal([&] { Atomic_file file(inside); }, Error_code::other),
            inside +
                ": cannot be written: check that its directory exists and may be written (No such file or "
                "directory)");
  std::filesystem::create_directories(folder / "taken" / "x");
  EXPECT_NE(refusal([&] { write_file(folder / "taken", "text"); }, Error_code::other), "");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, IsDiscardedFromASignalHandler) {
  const Folder folder;
  Atomic_file file(folder / "out.txt");
  file.write("text");
  EXPECT_EQ(folder.file_count(), 1u);
  discard_unfinished_files();
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace cellwalk::io
