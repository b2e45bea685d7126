// SPDX-License-Identifier: LGPL-3.0-or-later
// What the tests of io share: a folder of their own, files in it, and the message of a refusal.
#ifndef CELLWALK_TESTS_IO_IO_FIXTURE_H
#define CELLWALK_TESTS_IO_IO_FIXTURE_H

#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace cellwalk::io {

/// A folder for the files of one test, removed after it.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("cellwalk_io_" + std::to_string(getpid()) + "_" + std::to_string(count_++))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  static inline int count_ = 0;
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `text` with the first occurrence of `from` replaced; fails the test where there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The message `call` refuses with; fails the test if it does not throw an Error of that code.
template <class Call>
std::string refusal(Call call, Error_code code = Error_code::input) {
  try {
    call();
  } catch (const Error& e) {
    EXPECT_EQ(static_cast<int>(e.code()), static_cast<int>(code));
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "a message is one line: " << e.what();
    return e.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

/// Runs `read` on prefixes of `text` cut at every twentieth: each must be read or refused, never crash.
/// Returns how many were refused.
template <class Read>
int refused_truncations(const std::string& text, Read read) {
  int refused = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    try {
      read(text.substr(0, text.size() * i / 20));
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Error_code::input) << e.what();
      ++refused;
    }
  }
  return refused;
}

}  // namespace cellwalk::io

#endif  // CELLWALK_TESTS_IO_IO_FIXTURE_H
