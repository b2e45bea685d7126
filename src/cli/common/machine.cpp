// SPDX-License-Identifier: LGPL-3.0-or-later
// The version, compiler, flags and processor as JSON.
#include "machine.h"

#include <cellwalk/internal/io/cpu_model.h>

#include <nlohmann/json.hpp>

namespace cellwalk::cli {
namespace {

#ifdef __clang__
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "gcc " __VERSION__;
#endif

}  // namespace

nlohmann::ordered_json machine_json() {
  return {{"cellwalk", CELLWALK_VERSION},
          {"compiler", compiler},
          {"flags", CELLWALK_COMPILER_FLAGS},
          {"cpu", io::cpu_model()}};
}

}  // namespace cellwalk::cli
