// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes that a scene imports, and where their environments are kept.
#ifndef CELLWALK_INTERNAL_LOADING_IMPORT_CALL_H
#define CELLWALK_INTERNAL_LOADING_IMPORT_CALL_H

#include <cellwalk/internal/records/scene.h>
#include <cellwalk/loading/environment_file.h>

#include <functional>
#include <string>
#include <vector>

namespace cellwalk {

/// The options of an import.
/// \throw Error(input) naming an option that there is not, or whose value is none of it
Import_options import_options(const Import_call& call);

struct Kept_import {
  Loaded_environment loaded;
  std::vector<std::string> lines;  ///< a sentence on where it comes from, and those of an import
};

/// Imports a mesh, and keeps the environment in the folder of the call, compiled, in a file that is named
/// after the content of all files, the options and the version of this program; opens that file if it is
/// there. A damaged one is replaced. A folder that cannot be written costs nothing but the time of the next
/// import.
/// \param options of the build, beside those of the call: simplicial and keep_map
/// \param on_stage as Import_options
/// \throw Error as import_options() and import_environment()
Kept_import import_or_reopen(const Import_call& call, const Build_options& options,
                             std::function<void(const std::string&)> on_stage = {});

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_LOADING_IMPORT_CALL_H
