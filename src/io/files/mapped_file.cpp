// SPDX-License-Identifier: LGPL-3.0-or-later
// The mapping of a file by Boost, or a copy of its content.
#include <cellwalk/internal/io/mapped_file.h>

#include <boost/interprocess/exceptions.hpp>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <system_error>

#include "text.h"

namespace cellwalk::io {
namespace {

Mapped_file copy_of(const std::string& content) {
  constexpr std::align_val_t page{4096};
  const std::shared_ptr<void> memory(::operator new(content.size() + 1, page),
                                     [](void* p) { ::operator delete(p, page); });
  std::memcpy(memory.get(), content.data(), content.size());
  return {{static_cast<std::byte*>(memory.get()), content.size()}, memory};
}

}  // namespace

Mapped_file map_file(const std::filesystem::path& path) {
  namespace ipc = boost::interprocess;
  std::error_code error;
  const bool is_file =
      path.native().find('\0') == std::string::npos && std::filesystem::is_regular_file(path, error);
  if (!is_file || std::filesystem::file_size(path, error) == 0 || error) return copy_of(load_packed(path));
  try {
    const ipc::file_mapping file(path.c_str(), ipc::read_only);
    const auto region = std::make_shared<ipc::mapped_region>(file, ipc::copy_on_write);
    return {{static_cast<std::byte*>(region->get_address()), region->get_size()}, region};
  } catch (const ipc::interprocess_exception&) {
    return copy_of(load_packed(path));  // where files are not mapped; or it fails with the reason
  }
}

bool begins_with(const std::filesystem::path& path, std::string_view beginning) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(beginning.size(), '\0');
  return file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) && bytes == beginning;
}

}  // namespace cellwalk::io
