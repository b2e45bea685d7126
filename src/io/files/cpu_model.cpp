// SPDX-License-Identifier: LGPL-3.0-or-later
// The model name in /proc/cpuinfo.
#include <cellwalk/internal/io/cpu_model.h>

#include <fstream>

namespace cellwalk::io {

std::string cpu_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    if (const auto begin = line.find(": "); begin != std::string::npos) return line.substr(begin + 2);
  }
  return "unknown";
}

}  // namespace cellwalk::io
