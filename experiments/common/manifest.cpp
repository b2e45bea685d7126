// SPDX-License-Identifier: LGPL-3.0-or-later
#include "common/manifest.h"

#include <CGAL/version.h>
#include <boost/version.hpp>
#include <fmt/format.h>

#include <fstream>

namespace cellwalk::experiments {
namespace {

/// As Linux says it.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    if (const auto begin = line.find(": "); begin != std::string::npos) return line.substr(begin + 2);
  }
  return "unknown";
}

}  // namespace

nlohmann::ordered_json manifest(const std::string& commit) {
  nlohmann::ordered_json result;
  result["commit"] = commit;
  result["cellwalk"] = CELLWALK_VERSION;
  result["compiler"] = CELLWALK_COMPILER;
  result["flags"] = CELLWALK_FLAGS;
  result["processor"] = processor();
  result["versions"]["cgal"] = CGAL_VERSION_STR;
  result["versions"]["boost"] =
      fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  return result;
}

}  // namespace cellwalk::experiments
