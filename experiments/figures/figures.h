// SPDX-License-Identifier: LGPL-3.0-or-later
// The figures. Each one computes what it draws by the library, throws if that is not what its caption says,
// and writes NAME.png and NAME.json into a folder. Paper: figures 4 and 6.
#ifndef CELLWALK_EXPERIMENTS_FIGURES_FIGURES_H
#define CELLWALK_EXPERIMENTS_FIGURES_FIGURES_H

#include <filesystem>

namespace cellwalk::figures {

/// An edge of the plane that sweeps a triangle: what three segments miss, and the three searches for a
/// contact.
void draw_sweep_2d(const std::filesystem::path& folder);

/// The same in space: a thin spike through the inside of a swept triangle.
void draw_sweep_3d(const std::filesystem::path& folder);

/// A spike that comes through a face and meets none of its edges.
void draw_face_3d(const std::filesystem::path& folder);

}  // namespace cellwalk::figures

#endif  // CELLWALK_EXPERIMENTS_FIGURES_FIGURES_H
