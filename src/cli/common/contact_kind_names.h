// SPDX-License-Identifier: LGPL-3.0-or-later
// The names of features of environments and bodies in tables and reports.
#ifndef CELLWALK_CLI_COMMON_CONTACT_KIND_NAMES_H
#define CELLWALK_CLI_COMMON_CONTACT_KIND_NAMES_H

namespace cellwalk::cli {

/// By Contact_kind.
inline constexpr const char* contact_kind_names[] = {"vertex", "edge", "facet"};
/// By Sweep.
inline constexpr const char* sweep_names[] = {"three_segments", "triangle", "faces"};
/// By Body_feature.
inline constexpr const char* feature_names[] = {"vertex", "edge", "face"};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_CONTACT_KIND_NAMES_H
