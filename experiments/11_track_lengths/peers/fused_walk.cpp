// SPDX-License-Identifier: LGPL-3.0-or-later
// The plain walk for processors with AVX2 and fused multiply-adds.
#include "plain_steps.h"

namespace cellwalk::track_lengths {

void fused_walk(const Plain_mesh<double>& mesh, const Plain_ray* rays, unsigned count, unsigned together,
                const Plain_rows& rows) {
  follow(mesh, rays, count, together, rows);
}
void fused_walk(const Plain_mesh<float>& mesh, const Plain_ray* rays, unsigned count, unsigned together,
                const Plain_rows& rows) {
  follow(mesh, rays, count, together, rows);
}

}  // namespace cellwalk::track_lengths
