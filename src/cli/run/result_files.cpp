// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that grow up to a checkpoint, and archives that are packed when they are complete.
#include "result_files.h"

#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/kernel/error.h>

#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace cellwalk::cli {
namespace {

/// A file that is shared with whoever makes checkpoints.
class Shared_file : public io::Byte_sink {
 public:
  explicit Shared_file(std::shared_ptr<io::Growing_file> file) : file_(std::move(file)) {}
  void write(std::string_view bytes) override { file_->write(bytes); }
  void commit() override { file_->commit(); }
  const std::filesystem::path& path() const { return file_->path(); }

 private:
  std::shared_ptr<io::Growing_file> file_;
};

/// The state of a compressor cannot be kept: content is compressed when it is complete.
class Packed_at_last final : public Shared_file {
 public:
  Packed_at_last(std::shared_ptr<io::Growing_file> content, std::filesystem::path packed)
      : Shared_file(std::move(content)), packed_(std::move(packed)) {}
  void commit() override {
    Shared_file::commit();
    io::gzip_file(path(), packed_);
  }

 private:
  std::filesystem::path packed_;
};

}  // namespace

std::shared_ptr<io::Growing_file> Result_files::growing(const std::string& name,
                                                        const std::filesystem::path& path) {
  std::uint64_t length = 0;
  if (lengths_)
    if (const auto known = lengths_->find(name); known != lengths_->end()) length = known->second;
  complete_lengths_.erase(name);
  return growing_[name] = std::make_shared<io::Growing_file>(path, length);
}

io::Csv_writer Result_files::table(const std::string& name, const std::vector<std::string>& columns) {
  if (!aside_) return {folder_ / name, columns};
  return {std::make_unique<Shared_file>(growing(name, folder_ / name)), columns, is_continued()};
}

std::unique_ptr<io::Byte_sink> Result_files::packed(const std::string& name) {
  if (!aside_) return std::make_unique<io::Gzip_file>(folder_ / name);
  return std::make_unique<Packed_at_last>(growing(name, aside_path(name + ".content")), folder_ / name);
}

std::unique_ptr<io::Byte_sink> Result_files::aside(const std::string& name) {
  return std::make_unique<Shared_file>(growing(name, aside_path(name)));
}

void Result_files::note(const std::string& name) {
  if (aside_) complete_.push_back(name);
}

void Result_files::check_complete() const {
  for (const auto& [name, length] : complete_lengths_) {
    const std::filesystem::path file = folder_ / name;
    std::error_code failure;
    if (!std::filesystem::is_regular_file(file, failure))
      throw Error(Error_code::input,
                  file.string() + ": is missing, and was there at the checkpoint: begin the run again");
    if (std::filesystem::file_size(file, failure) != length)
      throw Error(Error_code::input,
                  file.string() + ": has another length than at the checkpoint: it was changed");
  }
}

Result_files::Lengths Result_files::sync() {
  std::set<std::filesystem::path> folders{folder_, *aside_};
  for (const std::string& name : complete_) {
    const std::filesystem::path file = folder_ / name;
    io::sync(file);
    complete_lengths_[name] = std::filesystem::file_size(file);
    folders.insert(file.parent_path());
  }
  Lengths lengths = complete_lengths_;
  for (const auto& [name, file] : growing_) lengths[name] = file->sync();
  for (const std::filesystem::path& folder : folders) io::sync(folder);
  complete_.clear();
  return lengths;
}

}  // namespace cellwalk::cli
