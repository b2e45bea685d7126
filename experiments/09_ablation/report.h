// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the parts of the experiment and writes their tables.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_REPORT_H
#define CELLWALK_EXPERIMENTS_ABLATION_REPORT_H

#include <filesystem>

#include "common/plan.h"

namespace cellwalk::ablation {

/// \param scenes the list that make_scenes.py wrote
/// \param data a folder of public meshes; empty: none
/// \throw std::runtime_error where answers differ that have to be the same
void run(const experiments::Plan& plan, const std::filesystem::path& scenes,
         const std::filesystem::path& data, const std::filesystem::path& folder);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_REPORT_H
