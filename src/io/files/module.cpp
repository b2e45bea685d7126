// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for a module beside the program and in the folders of libraries.
#include <cellwalk/internal/io/module.h>
#include <cellwalk/internal/kernel/beside_program.h>

#include <dlfcn.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <string_view>
#include <vector>

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

/// The names for dlopen(), in this order: those with a folder, and one without.
std::vector<fs::path> candidates(const std::string& file) {
  const fs::path folder = fs::path(CELLWALK_INSTALL_LIBDIR) / "cellwalk";
  std::vector<fs::path> found;
  if (const char* chosen = secure_getenv("CELLWALK_READERS")) found.push_back(fs::path(chosen) / file);
  for (const fs::path& own : cellwalk::detail::beside_program(folder / file)) found.push_back(own);
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
      if (problem.empty() || cellwalk::detail::is_trusted(candidate))
        problem = why != nullptr ? why : "no reason given";
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
