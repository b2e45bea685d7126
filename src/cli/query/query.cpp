// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk query ENV QUERIES.csv -o OUT.csv: answers every motion of a table, of points or of edges, exactly.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "cli/common/command.h"
#include "cli/common/environment_file.h"
#include "cli/common/node_environment.h"
#include "kernel_names.h"
#include "table.h"
#include "walk_repro.h"

namespace cellwalk::cli {
namespace {

/// Refuses missing arguments: a repro file is replayed alone; otherwise an environment, queries and an output
/// are needed.
void refuse_missing(const Query_options& options, const CLI::App& command) {
  constexpr std::array<const char*, 3> names{"environment", "queries", "--output"};
  if (options.failure.empty()) {
    for (const char* name : names)
      if (command.count(name) == 0)
        throw Error(Error_code::usage, fmt::format("{} is required; see cellwalk query --help", name));
  } else if (command.get_options([](const CLI::Option* option) { return option->count() > 0; }).size() > 1) {
    throw Error(Error_code::usage, "--replay-failure takes everything from its file: give no other option");
  }
}

/// Refuses options without effect, and options that contradict each other.
void refuse_misfits(const Query_options& options, const CLI::App& command) {
  const auto need = [&command](std::initializer_list<const char*> names, const char* condition) {
    for (const char* name : names)
      if (command.count(name) != 0)
        throw Error(Error_code::usage,
                    fmt::format("{} needs {}; see cellwalk query --help", name, condition));
  };
  const bool is_exact = options.method.kernel == Kernel_choice::exact;
  if (options.mode == Query_mode::sweep || !is_exact || options.sweep.touch == Touch::stop)
    need({"--trace", "--tally"}, "--mode move, --kernel exact and --touch pass");
  if (options.row.has_value() != (!options.record.empty() || !options.picture.empty()))
    throw Error(Error_code::usage,
                "--row says what --record or --picture is of: give both; see cellwalk query --help");
  if (!options.picture.empty() && (!is_exact || options.sweep.touch == Touch::stop))
    throw Error(Error_code::usage,
                "--picture needs --kernel exact and --touch pass: it shows the exact walk, to its end");
  if (options.mode == Query_mode::move) {
    need({"--sweep", "--contact", "--tolerance", "--search-cells", "--search-limit"}, "--mode sweep");
    if (options.strategy == Walk_strategy::certified && !is_exact)
      throw Error(Error_code::usage,
                  "--strategy certified needs --kernel exact; take exit_rule or predictive_simplex");
    if (options.sweep.touch == Touch::stop && !is_exact)
      throw Error(Error_code::usage, "--touch stop needs --kernel exact: touches are found exactly only");
    return;
  }
  need({"--strategy", "--record"}, "--mode move");
  if (!is_exact) throw Error(Error_code::usage, "--mode sweep needs --kernel exact: sweeps are exact only");
  const bool is_exhaustive = options.contact == Contact_search::exhaustive;
  if (!options.contact || is_exhaustive) need({"--tolerance"}, "--contact dichotomic");
  if (!is_exhaustive) need({"--search-cells", "--search-limit"}, "--contact exhaustive");
}

void query(Query_options& options, const CLI::App& command, Ranks& ranks) {
  refuse_missing(options, command);
  if (!options.failure.empty()) {
    if (ranks.is_first()) walk_repro(options.failure);
    return;
  }
  refuse_misfits(options, command);
  options.method.strategy = options.strategy.value_or(
      options.method.kernel == Kernel_choice::exact ? Walk_strategy::certified : Walk_strategy::exit_rule);
  if (options.contact) {
    options.search.method = *options.contact;
    options.sweep.search = &options.search;
  }
  std::optional<Query_files> files;
  if (ranks.is_first()) files.emplace(options);
  if (files && !ranks.is_alone()) files->all.inputs_are_shared();
  const auto threads = options.threads > 0 ? static_cast<unsigned>(options.threads)
                                           : std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const Loaded_environment loaded = load_once_a_node(ranks, options.environment, options.build);
  const auto query_it = [&](const auto& environment) {
    answer_table(options, files ? &*files : nullptr, ranks, environment);
  };
  std::visit(query_it, loaded.environment);
}

void add_move_options(CLI::App& command, Query_options& options) {
  constexpr const char* group = "With --mode move";
  add_choice(command, "--kernel", options.method.kernel, kernel_names,
             "Number policy; those of double and float may miss walls and are for experiments. double_1e-9: "
             "determinants up to that count as 0; double_16u: up to 16 u of the sum of their terms")
      ->group(group);
  add_choice(command, "--strategy", options.strategy,
             {{"certified", std::optional(Walk_strategy::certified)},
              {"exit_rule", std::optional(Walk_strategy::exit_rule)},
              {"predictive_simplex", std::optional(Walk_strategy::predictive_simplex)}},
             "How the exit of a cell is found (default: certified, with other kernels exit_rule)")
      ->group(group);
  command
      .add_option("--record", options.record,
                  "Write the motion of a row with all that --replay-failure needs")
      ->type_name("FILE")
      ->group(group);
}

void add_trace_options(CLI::App& command, Query_options& options) {
  constexpr const char* group = "With --mode move";
  command
      .add_option(
          "--trace", options.trace,
          "Write the cells that each motion crosses, with the length in each: row,cell,length. Lengths "
          "are rounded to nearest")
      ->type_name("PIECES.csv")
      ->group(group);
  command
      .add_option("--tally", options.tally,
                  "Write the cells with the sum of these lengths over all motions, each times its column "
                  "`weight` if the table has one. The sums do not depend on the order of motions")
      ->type_name("CELLS.vtu")
      ->group(group);
}

void add_sweep_options(CLI::App& command, Query_options& options) {
  constexpr const char* group = "With --mode sweep";
  add_choice(
      command, "--sweep", options.sweep.sweep,
      {{"three_segments", Sweep::three_segments}, {"triangle", Sweep::triangle}, {"faces", Sweep::faces}},
      "What is checked. three_segments: the way of p, then the edge, as in the paper; misses what fits "
      "between. "
      "triangle: all that the edge sweeps. faces: the same here, since an edge has no face")
      ->group(group);
  add_choice(
      command, "--contact", options.contact,
      {{"exact", std::optional<Contact_search>()},
       {"dichotomic", Contact_search::dichotomic},
       {"dichotomic_segment", Contact_search::dichotomic_segment},
       {"exhaustive", Contact_search::exhaustive}},
      "How a contact of the edge is located. exact: where the motion cannot go on. dichotomic: by bisection "
      "of "
      "the sweep. dichotomic_segment: by bisection of walks along the edge, as in the paper; may be late. "
      "exhaustive: the first obstacle vertex (2D) or edge (3D) in the swept triangle")
      ->group(group);
  command
      .add_option(
          "--tolerance", options.search.tolerance,
          "With --contact dichotomic or dichotomic_segment: when the motion is halved no more; in (0,1]. "
          "The time of dichotomic is at most this much too early")
      ->check([](const std::string& text) {
        double value = 0;
        const bool fits = CLI::detail::lexical_cast(text, value) && value > 0 && value <= 1;
        return fits ? std::string{} : "takes a number in (0,1], not " + text;
      })
      ->type_name("T")
      ->default_str("2^-20")
      ->group(group);
  add_choice(
      command, "--search-cells", options.search.cells,
      {{"flooded", Search_cells::flooded}, {"traversed", Search_cells::traversed}},
      "With --contact exhaustive: the obstacles of which cells are looked at. flooded: those that the swept "
      "triangle meets. traversed: those that the edge passes at its end, as in the paper")
      ->group(group);
  add_choice(
      command, "--search-limit", options.search.below, {{"below", true}, {"none", false}},
      "With --contact exhaustive: which of their obstacles are computed with. below: those that are not "
      "beyond the edge at its end. none: all, which finds the same and costs more")
      ->group(group);
}

}  // namespace

void add_query(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Query_options>();
  CLI::App* command = app.add_subcommand(
      "query", "Answer every motion of a table, of points or of edges, exactly: free, or a contact");
  command->add_option("environment", options->environment, "A certified environment")->type_name("ENV");
  command
      ->add_option(
          "queries", options->queries,
          "A table with a motion in each row; --mode says which columns it has. Numbers are decimal, "
          "hexadecimal, or fractions n/d that are exactly a double")
      ->type_name("QUERIES.csv");
  command->add_option("-o,--output", options->output, "The answers, a row each")->type_name("OUT.csv");
  add_choice(*command, "--mode", options->mode, {{"move", Query_mode::move}, {"sweep", Query_mode::sweep}},
             "What moves. move: a point from a to b, columns ax,ay,az,bx,by,bz. sweep: an edge, its end p to "
             "t while "
             "its end q stands still, columns px,py,pz,tx,ty,tz,qx,qy,qz. Without z in 2D");
  add_choice(*command, "--touch", options->sweep.touch, {{"pass", Touch::pass}, {"stop", Touch::stop}},
             "Whether a motion may touch a wall that it does not cross, or stops there");
  command
      ->add_option(
          "--radius", options->radius,
          "How far what moves keeps from every wall; a column `radius` of the table gives its own to "
          "each row. 0: it may touch walls")
      ->check(number_from(0, "of at least 0"))
      ->type_name("R");
  command->add_option("--threads", options->threads, "Threads; 0: all. The answers do not depend on it")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  command
      ->add_option("--picture", options->picture,
                   "Draw the motion of a row and what is in its way; in the plane also the cells it passes")
      ->type_name("FILE.png");
  command->add_option("--row", options->row, "The row to draw or to record, from 0")
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()))
      ->type_name("N");
  command
      ->add_option(
          "--replay-failure", options->failure,
          "Walk one recorded motion again and print every cell, sign and choice; takes all else from the "
          "file")
      ->type_name("FILE");
  add_duplicates(*command, options->build.duplicates);
  add_json(*command, options->json);
  add_move_options(*command, *options);
  add_trace_options(*command, *options);
  add_sweep_options(*command, *options);
  add_examples(*command, {"cellwalk query vessel.ovm moves.csv -o answers.csv",
                          "cellwalk query vessel.ovm edges.csv --mode sweep --touch stop -o contacts.csv",
                          "cellwalk query vessel.ovm edges.csv --mode sweep --radius 0.05 -o thick.csv",
                          "cellwalk query rooms.ovm moves.csv -o answers.csv --picture first.png --row 0"});
  command->callback([options, command, &chosen] {
    chosen = [options, command](Ranks& ranks) { query(*options, *command, ranks); };
  });
}

}  // namespace cellwalk::cli
