// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments, written into a file that the caller commits.
#ifndef CELLWALK_INTERNAL_LOADING_ENVIRONMENT_WRITER_H
#define CELLWALK_INTERNAL_LOADING_ENVIRONMENT_WRITER_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/loading/environment_file.h>

namespace cellwalk {

/// Writes an environment into a file that the caller commits: compiled, if that is named *.cellwalk, or else
/// in OpenVolumeMesh. Indices that edits left unused are given up first, as OpenVolumeMesh has none: see
/// Environment::compact().
/// \param certificate of the environment as it is now
/// \throw Error(other) if the device is full
template <int D>
void write_environment(io::Atomic_file& file, Environment<D>& environment, const Certificate& certificate,
                       Groups<D> groups);
extern template void write_environment(io::Atomic_file&, Environment<2>&, const Certificate&, Groups<2>);
extern template void write_environment(io::Atomic_file&, Environment<3>&, const Certificate&, Groups<3>);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_LOADING_ENVIRONMENT_WRITER_H
