// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/atomic_file.h>
#include <cellwalk/io/json_file.h>

#include <nlohmann/json.hpp>

namespace cellwalk::io {

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
  // A text that is no UTF-8, such as a file name, must not keep a report from being written.
  write_file(path, value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace cellwalk::io
