// SPDX-License-Identifier: LGPL-3.0-or-later
#include "output_folder.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, const std::error_code& reason) {
  throw Error(Error_code::other, path.string() + ": " + what + ": " + reason.message());
}

}  // namespace

fs::path Output_folder::place_of(const fs::path& name) {
  std::error_code failure;
  fs::path place = fs::weakly_canonical(fs::absolute(name, failure), failure);
  if (failure) place = name;
  return place.has_filename() ? place : place.parent_path();
}

void Output_folder::check_destination(const fs::path& destination, bool replace) {
  std::error_code ignored;
  if (!fs::exists(destination, ignored)) return;
  if (!replace)
    throw Error(Error_code::usage,
                destination.string() + ": exists already; give another folder, or --force to replace it");
  if (!fs::is_regular_file(destination / "run.json", ignored))
    throw Error(Error_code::usage,
                destination.string() + ": holds no run.json, so it is no earlier run; give another folder");
}

Output_folder::Output_folder(const fs::path& destination, bool replace)
    : name_(destination), destination_(place_of(destination)) {
  check_destination(name_, replace);
  temporary_ = destination_;
  temporary_ += fmt::format(".tmp-{}", getpid());  // a name that no other process uses
  std::error_code failure;
  if (!fs::create_directory(temporary_, failure)) fail(name_, "cannot be made", failure);
  unfinished_.hold(temporary_.string());
}

Output_folder::~Output_folder() { settle(); }

void Output_folder::put() {
  if (!replacement_.put(temporary_, destination_))
    fail(name_, "cannot be put in place", std::error_code(errno, std::generic_category()));
}

void Output_folder::take_back() noexcept { replacement_.take_back(temporary_, destination_); }

void Output_folder::settle() noexcept {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);  // the new folder before put(), the old one after it
}

}  // namespace cellwalk::cli
