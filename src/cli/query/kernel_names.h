// SPDX-License-Identifier: LGPL-3.0-or-later
// The words of --kernel and --strategy, on the command line and in repro files.
#ifndef CELLWALK_CLI_QUERY_KERNEL_NAMES_H
#define CELLWALK_CLI_QUERY_KERNEL_NAMES_H

#include <cellwalk/internal/query/kernel_choice.h>

#include <initializer_list>
#include <utility>

namespace cellwalk::cli {

inline constexpr std::initializer_list<std::pair<const char*, Kernel_choice>> kernel_names{
    {"exact", Kernel_choice::exact},
    {"lazy", Kernel_choice::lazy},
    {"rational", Kernel_choice::rational},
    {"double", Kernel_choice::double_precision},
    {"double_1e-9", Kernel_choice::double_tolerance},
    {"double_16u", Kernel_choice::double_scale_free},
    {"float", Kernel_choice::float_precision}};
inline constexpr std::initializer_list<std::pair<const char*, Walk_strategy>> strategy_names{
    {"certified", Walk_strategy::certified},
    {"exit_rule", Walk_strategy::exit_rule},
    {"predictive_simplex", Walk_strategy::predictive_simplex}};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_KERNEL_NAMES_H
