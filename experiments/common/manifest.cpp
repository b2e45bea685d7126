// SPDX-License-Identifier: LGPL-3.0-or-later
#include "common/manifest.h"

#include <cellwalk/internal/io/cpu_model.h>

#include <CGAL/version.h>
#include <boost/version.hpp>
#include <fmt/format.h>

namespace cellwalk::experiments {
nlohmann::ordered_json manifest(const std::string& commit) {
  nlohmann::ordered_json result;
  result["commit"] = commit;
  result["cellwalk"] = CELLWALK_VERSION;
  result["compiler"] = CELLWALK_COMPILER;
  result["flags"] = CELLWALK_FLAGS;
  result["processor"] = io::cpu_model();
  result["versions"]["cgal"] = CGAL_VERSION_STR;
  result["versions"]["boost"] =
      fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  return result;
}

}  // namespace cellwalk::experiments
