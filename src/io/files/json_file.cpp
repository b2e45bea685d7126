// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/json_file.h>

#include <nlohmann/json.hpp>

namespace cellwalk::io {

void write_json(Atomic_file& file, const nlohmann::ordered_json& value) {
  // Text that is not UTF-8, such as a file name, must not prevent a report.
  file.write(value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
  Atomic_file file(path);
  write_json(file, value);
  file.commit();
}

}  // namespace cellwalk::io
