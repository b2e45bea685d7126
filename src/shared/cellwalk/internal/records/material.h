// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials of deformable bodies.
#ifndef CELLWALK_INTERNAL_RECORDS_MATERIAL_H
#define CELLWALK_INTERNAL_RECORDS_MATERIAL_H

#include <cstdint>

namespace cellwalk {

/// The deformations of a body: none; stretch and shear; bend and twist as well.
enum class Shape_mode : std::uint8_t { rigid, linear, quadratic };

/// A material of shape matching (Mueller, Heidelberger, Teschner and Gross 2005).
struct Shape_material {
  Shape_mode mode = Shape_mode::rigid;
  /// The fraction of the way to its goal that a vertex is drawn in each step, in (0,1]; 1 is as stiff as the
  /// mode allows.
  double stiffness = 1;
  /// Weight of the deformed shape against the rigid one, in [0,1]; the paper's beta. Not used by the rigid
  /// mode.
  double deformation = 0.5;
  /// Whether the linear mode preserves the volume of the shape (2D: its area). Not used by the other modes.
  bool keeps_volume = true;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_MATERIAL_H
