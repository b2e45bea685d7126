// SPDX-License-Identifier: LGPL-3.0-or-later
#include "common/shared.h"

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <utility>

namespace cellwalk::experiments {
namespace {

namespace fs = std::filesystem;

/// The folder of a rank, which exists: that of the results on the first, elsewhere one that is removed.
class Folder_of_rank {
 public:
  explicit Folder_of_rank(const fs::path& folder) : path_(folder) {
    if (!ranks().is_first()) {
      std::string name = (fs::temp_directory_path() / "cellwalk_rank_XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr)
        throw Error(Error_code::other, fmt::format("{}: cannot be made", name));
      path_ = name;
    }
    fs::create_directories(path_);
  }
  ~Folder_of_rank() {
    std::error_code ignored;
    if (!ranks().is_first()) fs::remove_all(path_, ignored);
  }
  Folder_of_rank(const Folder_of_rank&) = delete;
  Folder_of_rank& operator=(const Folder_of_rank&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

Ranks& ranks() {
  static Ranks joined = Ranks::join();
  return joined;
}

void silence_later_ranks() {
  if (!is_later_rank()) return;
  for (std::FILE* stream : {stdout, stderr})
    if (std::freopen("/dev/null", "w", stream) == nullptr) std::abort();
}

int run_on_ranks(const std::string& program, const fs::path& folder,
                 const std::function<int(const fs::path&)>& run) {
  std::string problem;
  try {
    int exit_code = 0;
    {
      const Folder_of_rank own(folder);
      exit_code = run(own.path());
    }
    ranks().leave();
    return ranks().is_first() ? exit_code : 0;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}\n", program, problem);  // of later ranks nothing is seen
  try {
    ranks().fail(Error_code::other, problem);
  } catch (const std::exception&) {  // there is no MPI, which is the problem
  }
  return 1;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void gather_files(const fs::path& folder, const std::string& prefix) {
  if (ranks().is_alone()) return;
  detail::Byte_writer own;
  std::vector<fs::path> files;
  if (!ranks().is_first())
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().starts_with(prefix)) files.push_back(entry.path());
  own(files.size());
  for (const fs::path& file : files) own(file.filename().string(), text_of(file));
  ranks().gather(own.message(), [&](const std::string& bytes) {
    detail::Byte_reader reader(bytes);
    for (auto left = reader.next<std::size_t>(); left > 0; --left) {
      const auto name = reader.next<std::string>();
      io::write_file(folder / name, reader.next<std::string>());
    }
  });
}

}  // namespace cellwalk::experiments
