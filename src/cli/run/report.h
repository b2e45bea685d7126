// SPDX-License-Identifier: LGPL-3.0-or-later
// The reports of a run that has ended: run.json, the summary, and the caption of its picture.
#ifndef CELLWALK_CLI_RUN_REPORT_H
#define CELLWALK_CLI_RUN_REPORT_H

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "checkpoints.h"
#include "parts.h"

namespace cellwalk::cli {

template <int D>
nlohmann::ordered_json report(const Run_input<D>& input, const Run_parts<D>& parts);
/// For people.
/// \param not_drawn why the picture is missing, if it is
template <int D>
std::string summary(const Run_input<D>& input, const Run_parts<D>& parts, const std::string& not_drawn);
/// Of a run that went on: the outputs outside of its folder that were requested at first, and are not given
/// again.
std::string not_written(const Run_settings& began, const Run_options& now);
template <int D>
std::string caption(const Run_input<D>& input, const Run_parts<D>& parts);

extern template nlohmann::ordered_json report(const Run_input<2>&, const Run_parts<2>&);
extern template nlohmann::ordered_json report(const Run_input<3>&, const Run_parts<3>&);
extern template std::string summary(const Run_input<2>&, const Run_parts<2>&, const std::string&);
extern template std::string summary(const Run_input<3>&, const Run_parts<3>&, const std::string&);
extern template std::string caption(const Run_input<2>&, const Run_parts<2>&);
extern template std::string caption(const Run_input<3>&, const Run_parts<3>&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_REPORT_H
