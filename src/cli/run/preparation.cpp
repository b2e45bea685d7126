// SPDX-License-Identifier: LGPL-3.0-or-later
#include "preparation.h"

#include <cellwalk/loading/generators.h>

#include <fmt/core.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "cli/common/environment_file.h"
#include "cli/common/moves_file.h"
#include "cli/common/progress.h"

namespace cellwalk::cli {

template <int D>
bool needs_map(const Scene<D>& scene) {
  return !scene.changes.list.empty() || (scene.walls && scene.walls->relax);
}

template <int D>
Prepared_environment prepare(const Scene<D>& scene, const std::string& scene_name) {
  const bool has_cut = std::any_of(scene.changes.list.begin(), scene.changes.list.end(),
                                   [](const auto& change) { return change.kind == Change_kind::cut; });
  const bool is_simplicial = scene.walls || has_cut;
  if (const auto* file = std::get_if<std::string>(&scene.environment)) {
    Build_options options;
    options.keep_map = needs_map(scene);
    options.simplicial = is_simplicial;
    Loaded_environment loaded = load_with_progress(*file, options);
    if (scene.walls && !scene.walls->motion.empty()) refuse_other_numbers(*file, loaded.built);
    return {std::move(loaded.environment), loaded.built.certificate, std::move(loaded.groups)};
  }
  const auto& generator_call = std::get<Generator_call>(scene.environment);
  const Progress progress("generating and certifying the environment");
  Build_report report;
  const auto build = [&](auto soup) -> Any_environment {
    constexpr int dimension = std::tuple_size_v<typename decltype(soup.points)::value_type>;
    Build_options options = build_of_generated;
    options.simplicial = is_simplicial;
    options.keep_map = needs_map(scene);
    return Environment<dimension>::build(std::move(soup), options, &report);
  };
  try {
    auto environment = std::visit([&](auto soup) { return build(std::move(soup)); },
                                  generate(generator_call.generator, generator_call.options));
    return {std::move(environment), report.certificate};
  } catch (const Error& error) {
    // A recipe is input here, whatever it would be on a command line.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: environment: {}", scene_name, error.what()));
  }
}

template bool needs_map(const Scene<2>&);
template bool needs_map(const Scene<3>&);
template Prepared_environment prepare(const Scene<2>&, const std::string&);
template Prepared_environment prepare(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli
