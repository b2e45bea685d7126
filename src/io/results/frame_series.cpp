// SPDX-License-Identifier: LGPL-3.0-or-later
// The folder of frames, the names of their files, and the text of the collection.
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/frame_series.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <unistd.h>

#include <iterator>

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_at(const fs::path& path, const std::string& what, const std::error_code& error) {
  throw Error(Error_code::other, fmt::format("{}: {} ({})", path.string(), what, error.message()));
}

/// Makes a directory and its missing ancestors; returns those that were missing, outermost first.
std::vector<fs::path> make_directories(const fs::path& directory) {
  std::vector<fs::path> missing;
  for (fs::path p = directory; !p.empty() && !fs::exists(p); p = p.parent_path())
    missing.insert(missing.begin(), p);
  std::error_code error;
  if (!directory.empty() && !fs::exists(directory) && !fs::create_directories(directory, error))
    fail_at(directory, "the directory cannot be made", error);
  return missing;
}

void refuse_strangers(const fs::path& frames) {
  if (!fs::exists(frames)) return;
  if (!fs::is_directory(frames))
    throw Error(Error_code::usage,
                frames.string() + ": is no directory, and frames are to go there: remove it");
  for (const auto& entry : fs::directory_iterator(frames))
    if (!entry.is_regular_file() || entry.path().extension() != ".vtu")
      throw Error(Error_code::usage,
                  fmt::format("{}: is no frame, and its folder would be replaced: move it, or write "
                              "to another folder",
                              entry.path().string()));
}

}  // namespace

std::string pvd_text(const std::vector<Pvd_entry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const Pvd_entry& e : entries)
    fmt::format_to(std::back_inserter(text),
                   "<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", e.time, e.part, e.file);
  return text + "</Collection>\n</VTKFile>\n";
}

Frame_series::Frame_series(fs::path collection) : collection_(std::move(collection)) {
  const fs::path directory = collection_.parent_path();
  frames_ = directory / "frames";
  refuse_strangers(frames_);
  made_ = make_directories(directory);
  temporary_ = directory / fmt::format(".frames.{}.tmp", getpid());
  std::error_code error;
  fs::remove_all(temporary_, error);
  if (!fs::create_directory(temporary_, error)) {
    for (auto p = made_.rbegin(); p != made_.rend(); ++p) fs::remove(*p, error);
    fail_at(temporary_, "the directory cannot be made", error);
  }
}

Frame_series::~Frame_series() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  for (auto p = made_.rbegin(); p != made_.rend(); ++p) fs::remove(*p, ignored);  // fails if not empty
}

void Frame_series::add(double time, const std::string& part, const Vtu_grid& grid) {
  const std::string file = fmt::format("{}_{:05}.vtu", part, count_[part]);
  write_vtu(temporary_ / file, grid);
  ++count_[part];
  entries_.push_back({time, part, "frames/" + file});
}

void Frame_series::commit() {
  refuse_strangers(frames_);
  const fs::path old = collection_.parent_path() / fmt::format(".frames.{}.old", getpid());
  std::error_code error;
  const bool replaces = fs::exists(frames_);
  if (replaces) fs::rename(frames_, old, error);
  if (error) fail_at(frames_, "cannot be replaced", error);
  fs::rename(temporary_, frames_, error);
  if (error) {
    std::error_code ignored;
    if (replaces) fs::rename(old, frames_, ignored);
    fail_at(frames_, "cannot be put in place", error);
  }
  committed_ = true;
  fs::remove_all(old, error);
  // Parts are numbered in order of their names, since ParaView accepts numbers only.
  std::map<std::string, std::size_t> number;
  for (const auto& [part, frames] : count_) number.emplace(part, number.size());
  std::vector<Pvd_entry> numbered = entries_;
  for (Pvd_entry& e : numbered) e.part = std::to_string(number.at(e.part));
  write_file(collection_, pvd_text(numbered));
}

}  // namespace cellwalk::io
