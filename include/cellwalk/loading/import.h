// SPDX-License-Identifier: LGPL-3.0-or-later
// An environment from any mesh file, in one line. environment_file.h has options and reports.
#ifndef CELLWALK_LOADING_IMPORT_H
#define CELLWALK_LOADING_IMPORT_H

#include <cellwalk/environment/environment.h>

#include <string>

namespace cellwalk {

/// Converts a mesh file to a certified environment: cells are certified, and split if necessary; a closed
/// surface is filled with tetrahedra, a planar domain with triangles.
/// \throw Error as import_environment(path, options), and Error(usage) if it has another dimension
/// Cost: that of the reader, the mesher and Environment::build().
template <int D>
Environment<D> import_environment(const std::string& path);

extern template Environment<2> import_environment(const std::string&);
extern template Environment<3> import_environment(const std::string&);

}  // namespace cellwalk

#endif  // CELLWALK_LOADING_IMPORT_H
