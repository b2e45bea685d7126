// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk query ENV QUERIES.csv -o OUT.csv: answers every motion of a table exactly.
#include <cellwalk/io/query_file.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <thread>

#include "cli/command.h"
#include "cli/environment_file.h"
#include "cli/query_moves.h"

namespace cellwalk::cli {
namespace {

enum class Query_mode { move };
struct Query_options {
  std::string environment, queries, output, json;
  Query_mode mode = Query_mode::move;
  Move_options move;
  std::optional<Walk_strategy> strategy;  // default: certified, or exit_rule for kernels without certificates
  int threads = 0;
  Build_options build{.keep_map = false};
};

nlohmann::ordered_json to_json(const Walk_counts& c) {
  return {{"walks", c.walks},
          {"stays", c.stays},
          {"crossings", c.crossings},
          {"plane_blocks", c.plane_blocks},
          {"uncertain_lanes", c.uncertain_lanes},
          {"side_tests", c.side_tests},
          {"along_tests", c.along_tests},
          {"turns", c.turns},
          {"star_searches", c.star_searches},
          {"star_cells", c.star_cells},
          {"orientations", c.predicates.orientations},
          {"exact_fallbacks", c.predicates.fallbacks}};
}

/// Writes the answers and says how many there are of each status.
template <int D, std::size_t N>
void report(const Query_options& options, const Snapshot<D>& snapshot,
            const std::vector<Query_row<D, N>>& rows, const std::vector<Answer<D>>& answers,
            const nlohmann::ordered_json& counts) {
  write_answers(options.output, snapshot, rows, answers);
  std::array<std::size_t, std::size(status_names)> tally{};
  for (const auto& a : answers) ++tally[static_cast<std::size_t>(a.status)];
  nlohmann::ordered_json by_status;
  std::string line;
  for (std::size_t s = 0; s < tally.size(); ++s) {
    by_status[status_names[s]] = tally[s];
    if (tally[s] != 0) line += fmt::format("{} {} {}", line.empty() ? ":" : ",", tally[s], status_names[s]);
  }
  write_json(options.json, {{"motions", answers.size()}, {"status", by_status}, {"counts", counts}});
  fmt::print("{}: {} motions{}\n", options.output, answers.size(), line);
  const auto invalid =
      std::find_if(rows.begin(), rows.end(), [](const auto& row) { return !row.invalid.empty(); });
  if (invalid != rows.end())
    fmt::print(stderr, "cellwalk: {}:{}: {}; rows marked invalid: {}\n", options.queries, invalid->line,
               invalid->invalid, tally[static_cast<std::size_t>(Status::invalid)]);
}

template <int D>
void query_environment(const Query_options& options, const Environment<D>& environment) {
  const std::vector<Move_query<D>> moves = io::read_moves<D>(options.queries);
  Walk_counts counts;
  const auto answers = answer_moves(environment.snapshot(), moves, options.move, counts);
  report(options, environment.snapshot(), moves, answers, to_json(counts));
}

void query(Query_options& options) {
  const bool has_certificates = options.move.kernel == Kernel_choice::exact;
  if (options.strategy == Walk_strategy::certified && !has_certificates)
    throw Error(Error_code::usage,
                "--strategy certified needs --kernel exact; take exit_rule or predictive_simplex");
  options.move.strategy =
      options.strategy.value_or(has_certificates ? Walk_strategy::certified : Walk_strategy::exit_rule);
  const auto threads = options.threads > 0 ? static_cast<unsigned>(options.threads)
                                           : std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const Loaded_environment loaded = load_environment(options.environment, options.build);
  std::visit([&](const auto& environment) { query_environment(options, environment); }, loaded.environment);
}

}  // namespace

void add_query(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Query_options>();
  CLI::App* command =
      app.add_subcommand("query", "Answer every motion of a table exactly: free, or a contact");
  command->add_option("environment", options->environment, "A certified environment")
      ->required()
      ->type_name("ENV");
  command
      ->add_option(
          "queries", options->queries,
          "A table with the columns ax,ay,az,bx,by,bz (from a to b; without z in 2D). Numbers are decimal, "
          "hexadecimal, or fractions n/d that are exactly a double")
      ->required()
      ->type_name("QUERIES.csv");
  command->add_option("-o,--output", options->output, "The answers, a row each")
      ->required()
      ->type_name("OUT.csv");
  add_choice(*command, "--mode", options->mode, {{"move", Query_mode::move}}, "What a row means");
  add_choice(*command, "--kernel", options->move.kernel,
             {{"exact", Kernel_choice::exact},
              {"lazy", Kernel_choice::lazy},
              {"double", Kernel_choice::double_precision},
              {"float", Kernel_choice::float_precision}},
             "Number policy; double and float may miss walls and are for experiments");
  add_choice(*command, "--strategy", options->strategy,
             {{"certified", std::optional(Walk_strategy::certified)},
              {"exit_rule", std::optional(Walk_strategy::exit_rule)},
              {"predictive_simplex", std::optional(Walk_strategy::predictive_simplex)}},
             "How the exit of a cell is found (default: certified, with other kernels exit_rule)");
  command->add_option("--threads", options->threads, "Threads; 0: all. The answers do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  add_duplicates(*command, options->build.duplicates);
  add_json(*command, options->json);
  command->callback([options, &chosen] { chosen = [options] { query(*options); }; });
}

}  // namespace cellwalk::cli
