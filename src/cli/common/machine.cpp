// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machine.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace cellwalk::cli {
namespace {

#ifdef __clang__
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "gcc " __VERSION__;
#endif

/// The name in Linux.
std::string cpu_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    if (const auto begin = line.find(": "); begin != std::string::npos) return line.substr(begin + 2);
  }
  return "unknown";
}

}  // namespace

nlohmann::ordered_json machine_json() {
  return {{"cellwalk", CELLWALK_VERSION},
          {"compiler", compiler},
          {"flags", CELLWALK_COMPILER_FLAGS},
          {"cpu", cpu_model()}};
}

}  // namespace cellwalk::cli
