// SPDX-License-Identifier: LGPL-3.0-or-later
// Records of failures, for `cellwalk query --replay-failure`: the first of each sort that each rounded kernel
// of that command makes.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_FAILURES_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_FAILURES_H

#include <cellwalk/internal/io/repro_file.h>

#include "kernels.h"
#include "run_options.h"
#include "scene.h"

namespace cellwalk::exact_float {

/// Writes the motion of a particle in a scene.
/// \pre `cellwalk query` has the kernel
template <int D>
void write_failure(const std::filesystem::path& path, const Scene<D>& scene, const Kernel<D>& kernel,
                   const Particle<D>& particle, const Point<D>& to, const std::string& note) {
  Repro<D> record{scene.world.soup, particle.position, to,  scene.snapshot.index(particle.cell),
                  kernel.policy,    "exit_rule",       note};
  if (kernel.strategy == Walk_strategy::certified) record.strategy = "certified";
  io::write_repro(path, record);
}

/// Walks degenerate motions until each rounded kernel has failed in each way, or enough have been walked.
/// Writes failures/2d_float_missed_wall.json and so on. Returns how many.
std::uint64_t run_failures(const Run_options& options);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_FAILURES_H
