// SPDX-License-Identifier: LGPL-3.0-or-later
// The folders above the program or module, and those in which the linker searches.
#include <cellwalk/internal/kernel/beside_program.h>

#include <dlfcn.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>

namespace cellwalk::detail {
namespace {

namespace fs = std::filesystem;

/// Appends the files under a folder and those above it.
void climb(const fs::path& folder, const fs::path& file, std::vector<fs::path>& found) {
  for (fs::path above = folder; above.has_relative_path(); above = above.parent_path())
    if (is_trusted(above / file)) found.push_back(above / file);
}

/// Where the linker looks for libraries of the program.
std::vector<fs::path> library_folders() {
  std::vector<fs::path> folders;
  void* const program = dlopen(nullptr, RTLD_LAZY);
  Dl_serinfo size{};
  if (program == nullptr || dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return folders;
  std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
  auto* const list = reinterpret_cast<Dl_serinfo*>(memory.data());
  if (dlinfo(program, RTLD_DI_SERINFOSIZE, list) == 0 && dlinfo(program, RTLD_DI_SERINFO, list) == 0)
    for (unsigned i = 0; i < list->dls_cnt; ++i) folders.emplace_back(list->dls_serpath[i].dls_name);
  return folders;
}

}  // namespace

bool is_trusted(const fs::path& file) {
  struct stat status;
  return stat(file.c_str(), &status) == 0 && (status.st_uid == 0 || status.st_uid == geteuid());
}

std::vector<fs::path> beside_program(const fs::path& file) {
  std::vector<fs::path> found;
  std::error_code ignored;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&is_trusted), &info) != 0 && info.dli_fname != nullptr)
    climb(fs::canonical(info.dli_fname, ignored).parent_path(), file, found);
  climb(fs::canonical("/proc/self/exe", ignored).parent_path(), file, found);
  return found;
}

std::vector<fs::path> beside_libraries(const fs::path& file) {
  std::vector<fs::path> found;
  for (const fs::path& folder : library_folders()) climb(folder, file, found);
  return found;
}

}  // namespace cellwalk::detail
