// SPDX-License-Identifier: LGPL-3.0-or-later
#include "prepared_environment.h"

#include <cellwalk/kernel/error.h>
#include <cellwalk/loading/generators.h>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "cli/common/moves_file.h"
#include "cli/common/node_environment.h"
#include "cli/common/progress.h"

namespace cellwalk::cli {

template <int D>
Prepared_environment prepare(const Environment_source& source, const Scene_walls<D>* walls,
                             const Environment_changes<D>& changes, const std::string& scene, Ranks& ranks) {
  const bool has_cut = std::any_of(changes.list.begin(), changes.list.end(),
                                   [](const auto& change) { return change.kind == Change_kind::cut; });
  const bool needs_map = !changes.list.empty() || (walls != nullptr && walls->relax);
  if (const auto* file = std::get_if<std::string>(&source)) {
    Build_options options;
    options.keep_map = needs_map;
    options.simplicial = walls != nullptr || has_cut;
    Loaded_environment loaded = load_once_a_node(ranks, *file, options);
    if (walls != nullptr && !walls->motion.empty()) refuse_other_numbers(*file, loaded.built);
    return {std::move(loaded.environment), loaded.built.certificate, std::move(loaded.groups)};
  }
  const auto& generator_call = std::get<Generator_call>(source);
  const auto build = [&](auto soup) {
    constexpr int dimension = std::tuple_size_v<typename decltype(soup.points)::value_type>;
    Build_options options = build_of_generated;
    options.simplicial = walls != nullptr || has_cut;
    options.keep_map = needs_map;
    Build_report report;
    Any_environment built = Environment<dimension>::build(std::move(soup), options, &report);
    return Loaded_environment{std::move(built), std::move(report), {}, Groups<dimension>{}};
  };
  const auto make = [&] {
    const Progress progress("generating and certifying the environment");
    return std::visit([&](auto soup) { return build(std::move(soup)); },
                      generate(generator_call.generator, generator_call.options));
  };
  try {
    Loaded_environment made = needs_map ? make() : once_a_node(ranks, make);
    return {std::move(made.environment), made.built.certificate, std::move(made.groups)};
  } catch (const Error& error) {
    // A recipe is input here, whatever it would be on a command line.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: environment: {}", scene, error.what()));
  }
}

template Prepared_environment prepare(const Environment_source&, const Scene_walls<2>*,
                                      const Environment_changes<2>&, const std::string&, Ranks&);
template Prepared_environment prepare(const Environment_source&, const Scene_walls<3>*,
                                      const Environment_changes<3>&, const std::string&, Ranks&);

}  // namespace cellwalk::cli
