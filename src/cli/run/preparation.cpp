// SPDX-License-Identifier: LGPL-3.0-or-later
// The loading, generation or import of the environment, with a map only if its run needs one.
#include "preparation.h"

#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/internal/loading/import_call.h>

#include <fmt/core.h>

#include <algorithm>
#include <optional>
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

namespace {

Loaded_environment made(const Generator_call& call, const Build_options& how) {
  const auto build = [&](auto soup) {
    constexpr int dimension = std::tuple_size_v<typename decltype(soup.points)::value_type>;
    Build_options options = build_of_generated;
    options.simplicial = how.simplicial;
    options.keep_map = how.keep_map;
    Build_report report;
    Any_environment built = Environment<dimension>::build(std::move(soup), options, &report);
    return Loaded_environment{std::move(built), std::move(report), {}, Groups<dimension>{}};
  };
  const Progress progress("generating and certifying the environment");
  return std::visit([&](auto soup) { return build(std::move(soup)); },
                    generate(call.generator, call.options));
}

/// \param lines receives those of the import
Loaded_environment made(const Import_call& call, const Build_options& how, std::vector<std::string>& lines) {
  std::optional<Progress> progress;
  Kept_import kept = import_or_reopen(call, how, [&progress](const std::string& stage) {
    progress.reset();
    progress.emplace(stage);
  });
  lines = std::move(kept.lines);
  return std::move(kept.loaded);
}

}  // namespace

template <int D>
Prepared_environment prepare(const Scene<D>& scene, const std::string& scene_name, Ranks& ranks) {
  const bool has_cut = std::any_of(scene.changes.list.begin(), scene.changes.list.end(),
                                   [](const auto& change) { return change.kind == Change_kind::cut; });
  Build_options options;
  options.keep_map = needs_map(scene);
  options.simplicial = scene.walls || has_cut;
  if (const auto* file = std::get_if<std::string>(&scene.environment)) {
    Loaded_environment loaded = load_once_a_node(ranks, *file, options);
    if (scene.walls && !scene.walls->motion.empty()) refuse_other_numbers(*file, loaded.built);
    return {std::move(loaded.environment), loaded.built.certificate, std::move(loaded.groups)};
  }
  std::vector<std::string> lines;
  const auto make = [&] {
    if (const auto* call = std::get_if<Import_call>(&scene.environment)) return made(*call, options, lines);
    return made(std::get<Generator_call>(scene.environment), options);
  };
  try {
    Loaded_environment loaded = options.keep_map ? make() : once_a_node(ranks, make);
    return {std::move(loaded.environment), loaded.built.certificate, std::move(loaded.groups),
            std::move(lines)};
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
