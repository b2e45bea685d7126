// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/output_folder.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, const std::error_code& reason) {
  throw Error(Error_code::other, path.string() + ": " + what + ": " + reason.message());
}

/// A name beside the destination that no other process uses.
fs::path beside(const fs::path& destination, const char* word) {
  fs::path name = destination;
  if (!name.has_filename()) name = name.parent_path();  // a name that ends in a slash
  name += fmt::format(".{}-{}", word, getpid());
  return name;
}

}  // namespace

void Output_folder::check(const fs::path& destination, bool replace) {
  std::error_code ignored;
  if (!fs::exists(destination, ignored)) return;
  if (!replace)
    throw Error(Error_code::usage,
                destination.string() + ": exists already; give another folder, or --force to replace it");
  if (!fs::is_regular_file(destination / "run.json", ignored))
    throw Error(Error_code::usage,
                destination.string() + ": holds no run.json, so it is no earlier run; give another folder");
}

Output_folder::Output_folder(fs::path destination, bool replace)
    : destination_(std::move(destination)), temporary_(beside(destination_, "tmp")) {
  check(destination_, replace);
  std::error_code failure;
  if (!fs::create_directory(temporary_, failure)) fail(destination_, "cannot be made", failure);
}

Output_folder::~Output_folder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);  // nothing is there after commit()
}

void Output_folder::commit() {
  std::error_code failure;
  const fs::path old = beside(destination_, "old");
  const bool replaces = fs::exists(destination_, failure);
  if (replaces) {
    fs::rename(destination_, old, failure);
    if (failure) fail(destination_, "cannot be replaced", failure);
  }
  fs::rename(temporary_, destination_, failure);
  if (failure) {
    std::error_code ignored;
    if (replaces) fs::rename(old, destination_, ignored);
    fail(destination_, "cannot be put in place", failure);
  }
  if (replaces) fs::remove_all(old, failure);
}

}  // namespace cellwalk::cli
