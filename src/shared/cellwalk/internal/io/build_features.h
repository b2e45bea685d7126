// SPDX-License-Identifier: LGPL-3.0-or-later
// The readers that this build has.
#ifndef CELLWALK_INTERNAL_IO_BUILD_FEATURES_H
#define CELLWALK_INTERNAL_IO_BUILD_FEATURES_H

#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::io {

/// A reader that is an optional part of the build.
struct Build_feature {
  std::string_view name;  ///< such as "vtk"
  bool present = false;
  std::string version;       ///< empty if absent
  std::string_view purpose;  ///< the formats that it reads
};

/// The optional parts, with those that this build has.
std::vector<Build_feature> build_features();

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_BUILD_FEATURES_H
