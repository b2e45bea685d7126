// SPDX-License-Identifier: LGPL-3.0-or-later
// The checks of output names against each other and against inputs, and the joint commit.
#include "outputs.h"

#include <cellwalk/internal/io/mesh_files.h>
#include <cellwalk/internal/io/output.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/kernel/error.h>

#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <span>
#include <utility>

#include "work_log.h"

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& what) { throw Error(Error_code::usage, what); }

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw Error(Error_code::other, "standard output cannot be written");
}

}  // namespace

Named_file::Named_file(std::string name) : name_(std::move(name)) {
  std::error_code failure;
  path_ = io::target_of(fs::absolute(name_, failure));
  if (!path_.has_filename()) path_ = path_.parent_path();  // a name that ends in a slash
  struct stat status;
  exists_ = stat(name_.c_str(), &status) == 0;
  if (!exists_) return;
  device_ = status.st_dev;
  inode_ = status.st_ino;
  keeps_nothing_ = S_ISCHR(status.st_mode);
  is_pipe_ = S_ISFIFO(status.st_mode) && !names_standard_input(name_);
}

bool Named_file::is_same(const Named_file& other) const {
  if (exists_ && other.exists_) return device_ == other.device_ && inode_ == other.inode_;
  return !path_.empty() && path_ == other.path_;
}

bool Named_file::is_within(const Named_file& folder) const {
  const auto [in_folder, in_path] =
      std::mismatch(folder.path_.begin(), folder.path_.end(), path_.begin(), path_.end());
  return in_folder == folder.path_.end() && in_path != path_.end();
}

Outputs::Outputs(const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (!input.empty()) add_input(input);
  if (const std::string log = Work_log::name(); !log.empty()) add(Named_file(log));
}

void Outputs::add_input(const std::string& name) {
  const Named_file input(name);
  refuse_pipe(input);
  inputs_.push_back(input);
  for (const fs::path& file : io::files_of_mesh(name))
    if (file != name) inputs_.emplace_back(file.string());
}

void Outputs::refuse_pipe(const Named_file& input) const {
  if (are_inputs_shared_ && input.is_pipe())
    refuse(input.name() + ": is a pipe, which only one process can read: give a file, or /dev/stdin");
}

void Outputs::inputs_are_shared() {
  are_inputs_shared_ = true;
  for (const Named_file& input : inputs_) refuse_pipe(input);
}

void Outputs::refuse_clash(const Named_file& output, const Named_file& input) const {
  if (!output.keeps_nothing() && output.is_same(input))
    refuse(output.name() + ": is read by this command, and would be replaced; give the output another name");
}

void Outputs::refuse_replaced(const Named_file& folder, const Named_file& input) const {
  if (input.is_within(folder))
    refuse(folder.name() + ": holds " + input.name() +
           ", which is read by this command, and would be replaced; give another folder");
}

void Outputs::refuse_within(const Named_file& output, const Named_file& folder) const {
  if (output.is_within(folder))
    refuse(output.name() + ": lies in " + folder.name() +
           ", which appears as a whole; give a place outside of it");
}

void Outputs::add(const Named_file& output) {
  for (const Named_file& input : inputs_) refuse_clash(output, input);
  for (const Named_file& other : outputs_)
    if (!output.keeps_nothing() && output.is_same(other))
      refuse(output.name() +
             ": is named for two outputs, and one would replace the other; give each its own name");
  for (const Named_file& folder : folder_names_) refuse_within(output, folder);
  outputs_.push_back(output);
}

void Outputs::also_reads(const std::string& name) {
  const std::size_t first = inputs_.size();
  add_input(name);
  for (const Named_file& input : std::span(inputs_).subspan(first)) {
    for (const Named_file& output : outputs_) refuse_clash(output, input);
    for (const Named_file& folder : folder_names_) refuse_replaced(folder, input);
  }
}

io::Atomic_file* Outputs::file(const std::string& name) {
  if (name.empty()) return nullptr;
  add(Named_file(name));
  files_.push_back(std::make_unique<io::Atomic_file>(name));
  return files_.back().get();
}

void Outputs::name_folder(const Named_file& folder) {
  add(folder);
  for (const Named_file& input : inputs_) refuse_replaced(folder, input);
  for (const Named_file& output : outputs_) refuse_within(output, folder);
  folder_names_.push_back(folder);
}

Output_folder& Outputs::folder(const std::string& name, bool replace) {
  name_folder(Named_file(name));
  auto folder = std::make_unique<Output_folder>(name, replace);
  Output_folder& made = *folder;
  folder_ = std::move(folder);
  return made;
}

Working_folder& Outputs::working_folder(const std::string& name, bool replace, bool is_taken_up) {
  name_folder(Named_file(name));
  name_folder(Named_file(Output_folder::place_of(name).string() + ".part"));  // where it is until the end
  auto folder = is_taken_up ? Working_folder::take_up(name) : Working_folder::make(name, replace);
  Working_folder& made = *folder;
  folder_ = std::move(folder);
  return made;
}

void Outputs::commit(const std::string& summary) {
  std::vector<io::Output*> all;
  for (const auto& file : files_) all.push_back(file.get());
  if (folder_) all.push_back(folder_.get());
  io::put_in_place(all, [&summary] { print(summary); });
}

}  // namespace cellwalk::cli
