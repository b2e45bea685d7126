// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/module.h>

#include <dlfcn.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>
#include <vector>

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

/// True if the file belongs to root or to the user, since it is executed as a part of the program.
bool is_trusted(const fs::path& file) {
  struct stat status;
  return stat(file.c_str(), &status) == 0 && (status.st_uid == 0 || status.st_uid == geteuid());
}

/// The files of the program and of the shared library that contains this code, if it is in one.
std::vector<fs::path> own_files() {
  std::vector<fs::path> files;
  std::error_code ignored;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&is_trusted), &info) != 0 && info.dli_fname != nullptr)
    files.push_back(fs::canonical(info.dli_fname, ignored));
  files.push_back(fs::canonical("/proc/self/exe", ignored));
  return files;
}

/// The names for dlopen(), in this order: those with a folder, and one without.
std::vector<fs::path> candidates(const std::string& file) {
  const fs::path folder = fs::path(CELLWALK_INSTALL_LIBDIR) / "cellwalk";
  std::vector<fs::path> found;
  if (const char* chosen = secure_getenv("CELLWALK_READERS")) found.push_back(fs::path(chosen) / file);
  for (const fs::path& own : own_files())
    for (fs::path above = own.parent_path(); above.has_relative_path(); above = above.parent_path())
      if (is_trusted(above / folder / file)) found.push_back(above / folder / file);
  found.emplace_back(file);
  found.push_back(fs::path(CELLWALK_INSTALL_PREFIX) / folder / file);
  return found;
}

}  // namespace

Module_function load_module(const std::string& file, const char* name, const char* (*version)(void*)) {
  std::string problem;
  for (const fs::path& candidate : candidates(file)) {
    void* const handle = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
      const char* why = dlerror();
      // The message about a file that exists and cannot be loaded is more helpful than one about a missing
      // file.
      if (problem.empty() || is_trusted(candidate)) problem = why != nullptr ? why : "no reason given";
      continue;
    }
    void* const function = dlsym(handle, name);
    if (function != nullptr && std::string_view(version(function)) == CELLWALK_VERSION) return {function, {}};
    problem =
        fmt::format("{}: is of another version of Cellwalk than {}", candidate.string(), CELLWALK_VERSION);
    dlclose(handle);
  }
  return {nullptr, problem};
}

}  // namespace cellwalk::io
