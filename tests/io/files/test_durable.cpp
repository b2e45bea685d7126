// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/durable.h>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <span>
#include <string>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

/// No file may grow beyond a size: writing fails as it does on a full device.
class Size_limit {
 public:
  explicit Size_limit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~Size_limit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  Size_limit(const Size_limit&) = delete;
  Size_limit& operator=(const Size_limit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

void write_pieces(const std::filesystem::path& path, const std::string& a, const std::string& b) {
  const std::array<std::span<const std::byte>, 2> pieces{std::as_bytes(std::span(a)),
                                                         std::as_bytes(std::span(b))};
  write_durably(path, pieces);
}

TEST(Durable, ReplacesAFileAsAWhole) {
  const Folder folder;
  write_pieces(folder / "file", "one ", "two");
  EXPECT_EQ(content_of(folder / "file"), "one two");
  write_pieces(folder / "file", "three", "");
  EXPECT_EQ(content_of(folder / "file"), "three");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Durable, KeepsTheOldFileWhereTheDeviceIsFull) {
  const Folder folder;
  write_pieces(folder / "file", "old", "");
  const Size_limit limit(1000);
  EXPECT_NE(refusal([&] { write_pieces(folder / "file", std::string(600, 'a'), std::string(600, 'b')); },
                    Error_code::other)
                .find("file: writing failed (File too large)"),
            std::string::npos);
  EXPECT_EQ(content_of(folder / "file"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Durable, SaysWhatCannotBeWritten) {
  const Folder folder;
  const std::string inside = (folder / "missing" / "file").string();
  EXPECT_EQ(refusal([&] { write_pieces(inside, "", ""); }, Error_code::other),
            inside + ": cannot be written (No such file or directory)");
  EXPECT_EQ(refusal([&] { sync(inside); }, Error_code::other),
            inside + ": cannot be written to the device (No such file or directory)");
  EXPECT_EQ(refusal([&] { sync_all(inside); }, Error_code::other),
            inside + ": cannot be read: No such file or directory");
  sync_all(folder / "");
}

TEST(Durable, GrowsFromALengthThatWasKept) {
  const Folder folder;
  {
    Growing_file file(folder / "table");
    file.write("header\n");
    EXPECT_EQ(file.sync(), 7u);
    EXPECT_EQ(content_of(folder / "table"), "header\n");
    file.write(std::string(1 << 20, 'x'));
    file.sync();
    file.write("lost");
  }  // as if the program ended here
  EXPECT_EQ(content_of(folder / "table").size(), 7u + (1 << 20));
  Growing_file file(folder / "table", 7);
  file.write("row\n");
  file.commit();
  EXPECT_EQ(content_of(folder / "table"), "header\nrow\n");
}

/// The number of a process that has ended.
std::string ended_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return std::to_string(child);
}

TEST(Durable, RemovesWhatKilledProcessesLeft) {
  const Folder folder;
  const std::string dead = ended_process(), alive = std::to_string(getpid());
  for (const std::string& name :
       {".out.json." + dead + ".0.tmp", ".out.json." + dead + ".12.tmp", ".out.json." + alive + ".0.tmp",
        ".other.json." + dead + ".0.tmp", std::string(".out.json.x.0.tmp"), std::string("out.json")})
    folder.write(name, "");
  remove_abandoned(folder / "out.json");
  EXPECT_EQ(folder.file_count(), 4u);
  EXPECT_TRUE(std::filesystem::exists(folder / (".out.json." + alive + ".0.tmp")));
  EXPECT_TRUE(std::filesystem::exists(folder / (".other.json." + dead + ".0.tmp")));
  remove_abandoned(folder / "missing" / "out.json");
}

TEST(Durable, RemovesWhatKilledProcessesLeftInTheWorkingFolder) {
  const Folder folder;
  folder.write(".out.json." + ended_process() + ".0.tmp", "");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  remove_abandoned("out.json");  // which is not there
  std::filesystem::current_path(before);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Durable, RefusesAFileThatIsShorterThanItWas) {
  const Folder folder;
  folder.write("table", "header");
  EXPECT_NE(refusal([&] { Growing_file file(folder / "table", 7); }).find("is shorter than it was"),
            std::string::npos);
  EXPECT_EQ(
      refusal([&] { Growing_file file(folder / "other", 7); }),
      (folder / "other").string() + ": is missing, and was there at the checkpoint: begin the run again");
  EXPECT_EQ(content_of(folder / "table"), "header");
}

TEST(Durable, AGrowingFileSaysThatTheDeviceIsFull) {
  const Folder folder;
  Growing_file file(folder / "table");
  const Size_limit limit(1000);
  file.write(std::string(2000, 'x'));
  EXPECT_NE(refusal([&] { file.sync(); }, Error_code::other).find("table: writing failed"),
            std::string::npos);
}

}  // namespace
}  // namespace cellwalk::io
