// SPDX-License-Identifier: LGPL-3.0-or-later
// Wrong answers, kept with their worlds.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_WRONG_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_WRONG_H

#include <string>

#include "sweep_judge.h"
#include "trial.h"

namespace cellwalk::endurance {

/// Writes NAME.json, which `cellwalk query --replay-failure` reads.
template <int D>
void keep_walk(const Trial& trial, const World<D>& world, const Walk_motion<D>& motion,
               const std::string& what);

/// Writes NAME.ovm and NAME.csv, which `cellwalk query --mode sweep` reads, and the fault into NAME.txt.
template <int D>
void keep_sweep(const Trial& trial, const World<D>& world, const Edge_sites<D>& move, double radius,
                const std::string& what);

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_WRONG_H
