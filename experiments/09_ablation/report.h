// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the parts of the experiment and writes their tables.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_REPORT_H
#define CELLWALK_EXPERIMENTS_ABLATION_REPORT_H

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/plan.h"

namespace cellwalk::ablation {

inline constexpr std::array part_names{"certificates", "flights", "forms", "segments", "orders"};

struct Inputs {
  std::filesystem::path scenes;    ///< the list that make_scenes.py wrote
  std::filesystem::path data;      ///< a folder of public meshes; empty: none
  std::vector<std::string> parts;  ///< of part_names; empty: all
};

/// \throw std::runtime_error where answers differ that have to be the same
void run(const experiments::Plan& plan, const Inputs& inputs, const std::filesystem::path& folder);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_REPORT_H
