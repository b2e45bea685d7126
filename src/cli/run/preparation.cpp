// SPDX-License-Identifier: LGPL-3.0-or-later
// The loading or generation of the environment, with a map only if its run needs one.
#include "preparation.h"

#include <cellwalk/internal/loading/generators.h>

#include <fmt/core.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "cli/common/moves_file.h"
#include "cli/common/node_environment.h"
#include "cli/common/progress.h"

namespace cellwalk::cli {

template <int D>
bool needs_map(const Scene<D>& scene) {
  return !scene.changes.list.empty() || (scene.walls && scene.walls->relax);
}

template <int D>
Prepared_environment prepare(const Scene<D>& scene, const std::string& scene_name, Ranks& ranks) {
  const bool has_cut = std::any_of(scene.changes.list.begin(), scene.changes.list.end(),
                                   [](const auto& change) { return change.kind == Change_kind::cut; });
  const bool is_simplicial = scene.walls || has_cut;
  if (const auto* file = std::get_if<std::string>(&scene.environment)) {
    Build_options options;
    options.keep_map = needs_map(scene);
    options.simplicial = is_simplicial;
    Loaded_environment loaded = load_once_a_node(ranks, *file, options);
    if (scene.walls && !scene.walls->motion.empty()) refuse_other_numbers(*file, loaded.built);
    return {std::move(loaded.environment), loaded.built.certificate, std::move(loaded.groups)};
  }
  const auto& generator_call = std::get<Generator_call>(scene.environment);
  const auto build = [&](auto soup) {
    constexpr int dimension = std::tuple_size_v<typename decltype(soup.points)::value_type>;
    Build_options options = build_of_generated;
    options.simplicial = is_simplicial;
    options.keep_map = needs_map(scene);
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
    Loaded_environment made = needs_map(scene) ? make() : once_a_node(ranks, make);
    return {std::move(made.environment), made.built.certificate, std::move(made.groups)};
  } catch (const Error& error) {
    // A recipe is input here, whatever it would be on a command line.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: environment: {}", scene_name, error.what()));
  }
}

template bool needs_map(const Scene<2>&);
template bool needs_map(const Scene<3>&);
template Prepared_environment prepare(const Scene<2>&, const std::string&, Ranks&);
template Prepared_environment prepare(const Scene<3>&, const std::string&, Ranks&);

}  // namespace cellwalk::cli
