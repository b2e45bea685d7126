// SPDX-License-Identifier: LGPL-3.0-or-later
// The picture of an import: a surface as it is given, and the environment made of it.
#ifndef CELLWALK_CLI_IMPORT_PICTURE_H
#define CELLWALK_CLI_IMPORT_PICTURE_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/records/surface_soup.h>

#include <nlohmann/json.hpp>

namespace cellwalk::cli {

/// Writes a picture of the walls and the groups of facets with their names; beside it, in the same view, one
/// of the surface with its open edges.
/// \param surface empty: there is none
/// \param groups facets of the snapshot
/// \param report of the import: of its part "repaired" the kinds of groups, and the places of changes as
///        arrows, those that lie apart and no more than about 30
/// \throw Error(other) if it cannot be written
template <int D>
void write_picture(io::Atomic_file& file, const Surface_soup& surface, const Snapshot<D>& snapshot,
                   const Groups<D>& groups, const nlohmann::ordered_json& report);
extern template void write_picture(io::Atomic_file&, const Surface_soup&, const Snapshot<2>&,
                                   const Groups<2>&, const nlohmann::ordered_json&);
extern template void write_picture(io::Atomic_file&, const Surface_soup&, const Snapshot<3>&,
                                   const Groups<3>&, const nlohmann::ordered_json&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_IMPORT_PICTURE_H
