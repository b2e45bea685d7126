// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/atomic_file.h>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <functional>
#include <stdexcept>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

TEST(Output, SeveralAppearTogether) {
  const Folder folder;
  folder.write("b", "old");
  Atomic_file a(folder / "a"), b(folder / "b");
  a.write("new a");
  b.write("new b");
  Output* const both[] = {&a, &b};
  bool seen = false;
  put_in_place(both,
               [&] { seen = content_of(folder / "a") == "new a" && content_of(folder / "b") == "new b"; });
  EXPECT_TRUE(seen) << "what finishes sees all of them";
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(Output, WhatFinishesCanTakeAllBack) {
  const Folder folder;
  folder.write("b", "old");
  Atomic_file a(folder / "a"), b(folder / "b");
  a.write("new a");
  b.write("new b");
  Output* const both[] = {&a, &b};
  EXPECT_THROW(put_in_place(both, [] { throw std::runtime_error("stdout is full"); }), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder / "a"));
  EXPECT_EQ(content_of(folder / "b"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Output, OneThatCannotBePutTakesTheOthersBack) {
  const Folder folder;
  folder.write("a", "old");
  Atomic_file a(folder / "a"), b(folder / "b"), c(folder / "c");
  fs::create_directories(folder / "c" / "full");  // after the file was opened
  Output* const all[] = {&a, &b, &c};
  EXPECT_NE(refusal([&] { put_in_place(all); }, Error_code::other)
                .find("c: cannot be put in place (Is a directory)"),
            std::string::npos);
  EXPECT_EQ(content_of(folder / "a"), "old");
  EXPECT_FALSE(fs::exists(folder / "b"));
  EXPECT_TRUE(fs::is_directory(folder / "c" / "full"));
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(Output, AFullDeviceKeepsFilesFromAppearing) {
  const Folder folder;
  Atomic_file device("/dev/full"), file(folder / "a");
  device.write("text");
  file.write("text");
  Output* const both[] = {&device, &file};
  EXPECT_NE(refusal([&] { put_in_place(both); }, Error_code::other).find("/dev/full: writing failed"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "a"));
}

TEST(Output, PermissionsOfTheOldFileStay) {
  const Folder folder;
  folder.write("a", "old");
  ASSERT_EQ(chmod((folder / "a").c_str(), 0640), 0);
  write_file(folder / "a", "new");
  struct stat status;
  ASSERT_EQ(stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
  EXPECT_EQ(content_of(folder / "a"), "new");
}

TEST(Output, ADescriptorOfTheProcessIsWrittenWhereItStands) {
  const Folder folder;
  folder.write("log", "before\n");
  FILE* const log = fopen((folder / "log").c_str(), "a");
  ASSERT_NE(log, nullptr);
  write_file("/dev/fd/" + std::to_string(fileno(log)), "after\n");
  write_file("/proc/self/fd/" + std::to_string(fileno(log)), "end\n");
  fclose(log);
  EXPECT_EQ(content_of(folder / "log"), "before\nafter\nend\n");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Output, LongNamesAreWritten) {
  const Folder folder;
  const std::string longest(255, 'n');
  write_file(folder / longest, "text");
  EXPECT_EQ(content_of(folder / longest), "text");
  EXPECT_NE(refusal([&] { Atomic_file file(folder / (longest + "n")); }, Error_code::other)
                .find("(File name too long)"),
            std::string::npos)
      << "at once, not when it is put in place";
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Output, NamesAreExchangedInStepsWhereTheyCannotBeAtOnce) {
  const Folder folder;
  folder.write("a", "A");
  folder.write("b", "B");
  ASSERT_TRUE(detail::exchange_in_steps(folder / "a", folder / "b"));
  EXPECT_EQ(content_of(folder / "a") + content_of(folder / "b"), "BA");
  fs::create_directory(folder / "x");
  fs::create_directory(folder / "y");
  write_file(folder / "x" / "1", "X");
  write_file(folder / "y" / "2", "Y");
  ASSERT_TRUE(detail::exchange_in_steps(folder / "x", folder / "y"));
  EXPECT_TRUE(fs::exists(folder / "x" / "2") && fs::exists(folder / "y" / "1"));
  EXPECT_FALSE(detail::exchange_in_steps(folder / "none", folder / "b"));
  EXPECT_EQ(errno, ENOENT);
  EXPECT_EQ(content_of(folder / "b"), "A");
  EXPECT_EQ(folder.file_count(), 4u);
}

TEST(Output, WhatIsThereStaysIfItIsNotToBeReplaced) {
  const auto put = [](const fs::path& from, const fs::path& to) {
    return Replacement().put(from, to, false);
  };
  const auto put_in_steps = [](const fs::path& from, const fs::path& to) {
    return detail::move_in_steps(from, to);
  };
  for (const auto& move : {std::function<bool(const fs::path&, const fs::path&)>(put), {put_in_steps}}) {
    const Folder folder;
    fs::create_directory(folder / "new");
    folder.write("new/file", "new");
    fs::create_directory(folder / "empty");
    folder.write("file", "old");
    fs::create_symlink("nowhere", folder / "link");
    for (const char* taken : {"empty", "file", "link"}) {
      errno = 0;
      EXPECT_FALSE(move(folder / "new", folder / taken)) << taken;
      EXPECT_EQ(errno, EEXIST);
    }
    EXPECT_EQ(content_of(folder / "new/file"), "new");
    EXPECT_EQ(content_of(folder / "file"), "old");
    EXPECT_TRUE(move(folder / "new", folder / "free"));
    EXPECT_EQ(content_of(folder / "free/file"), "new");
    EXPECT_FALSE(fs::exists(folder / "new"));
  }
}

TEST(Output, MoreThanAHandlerCanRemoveAreWrittenAllTheSame) {
  const Folder folder;
  std::vector<std::unique_ptr<Atomic_file>> files;
  std::vector<Output*> all;
  for (int i = 0; i < 100; ++i) {
    files.push_back(std::make_unique<Atomic_file>(folder / std::to_string(i)));
    all.push_back(files.back().get());
  }
  put_in_place(all);
  files.clear();
  EXPECT_EQ(folder.file_count(), 100u);
}

}  // namespace
}  // namespace cellwalk::io
