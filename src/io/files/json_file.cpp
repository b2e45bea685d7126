// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/json_file.h>

#include <nlohmann/json.hpp>

namespace cellwalk::io {

void write_json(Atomic_file& file, const nlohmann::ordered_json& value) {
  // A text that is no UTF-8, such as a file name, must not keep a report from being written.
  file.write(value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
  Atomic_file file(path);
  write_json(file, value);
  file.commit();
}

}  // namespace cellwalk::io
