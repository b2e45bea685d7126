// SPDX-License-Identifier: LGPL-3.0-or-later
// What deformable bodies are made of.
#ifndef CELLWALK_RECORDS_MATERIAL_H
#define CELLWALK_RECORDS_MATERIAL_H

#include <cstdint>

namespace cellwalk {

/// What a body may do beside moving: nothing; be stretched and sheared; be bent and twisted as well.
enum class Shape_mode : std::uint8_t { rigid, linear, quadratic };

/// A material of shape matching (Mueller, Heidelberger, Teschner and Gross 2005).
struct Shape_material {
  Shape_mode mode = Shape_mode::rigid;
  /// How far vertices are drawn to their goals in each step, in (0,1]: 1 is as stiff as the mode allows.
  double stiffness = 1;
  /// Weight of the deformed shape against the rigid one, in [0,1]; the paper's beta. Not used by the rigid mode.
  double deformation = 0.5;
  /// Whether the linear mode keeps the volume of the shape (in the plane its area). Not used by the others.
  bool keeps_volume = true;
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_MATERIAL_H
