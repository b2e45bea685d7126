// SPDX-License-Identifier: GPL-3.0-or-later
// The first steps of a repair: the triangles of a file as a closed surface, with caps, and with sheets apart.
#ifndef CELLWALK_MESHING_REPAIR_PREPARE_H
#define CELLWALK_MESHING_REPAIR_PREPARE_H

#include <cellwalk/internal/meshing/repair_surface.h>

#include <functional>
#include <vector>

#include "changes.h"
#include "facets.h"

namespace cellwalk::detail {

struct Prepared {
  Facets given;    ///< the triangles of the file
  Facets surface;  ///< closed; directions agree within patches
  std::vector<Repaired_part> caps;
  Found one_sided;  ///< facets of one-sided bands
};

/// \param report gets the size of the surface and the changes
/// \param on_wait called between the steps, if any
/// \throw Error(input) for a surface that is malformed, or for sheets that are not wanted
Prepared prepare(const Surface_soup& soup, const Repair_options& options, Repair_report& report,
                 const std::function<void()>& on_wait);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_PREPARE_H
