// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk deform ENV MOVES.csv -o OUT.ovm: moves points of an environment one after the other, as far as the
// bodies in it allow.
#include <cellwalk/internal/loading/environment_writer.h>
#include <cellwalk/reshape/reshaping.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/environment_file.h"
#include "cli/common/moves_file.h"
#include "cli/common/outputs.h"
#include "cli/common/progress.h"
#include "cli/common/standing_bodies.h"
#include "results.h"

namespace cellwalk::cli {
namespace {

/// The reaction of a point whose walls meet a body.
enum class Contact_rule : std::uint8_t { stop, hold, push, test };

struct Deform_options {
  std::string environment, moves, output, report, positions, json;
  std::vector<std::string> bodies;
  Contact_rule at_contact = Contact_rule::stop;
  Build_options build{.keep_map = false};
};

/// \throw Error(usage) if there is no output for the moved environment, or nothing to write
void check_outputs(const Deform_options& options) {
  const bool tests_only = options.at_contact == Contact_rule::test;
  if (!tests_only && options.output.empty())
    throw Error(Error_code::usage, "--output is required: name the environment to write");
  if (tests_only && !options.output.empty())
    throw Error(Error_code::usage,
                "--at-contact test moves nothing, so that there is no environment to write: leave out -o");
}

/// The output files; null for those not requested.
struct Deform_files {
  explicit Deform_files(const Deform_options& options)
      : all(inputs(options)),
        environment(all.file(options.output)),
        report(all.file(options.report)),
        positions(all.file(options.positions)),
        json(all.file(options.json)) {}

  Outputs all;
  io::Atomic_file *environment, *report, *positions, *json;

 private:
  static std::vector<std::string> inputs(const Deform_options& options) {
    std::vector<std::string> names = options.bodies;
    names.push_back(options.environment);
    names.push_back(options.moves);
    return names;
  }
};

/// Moves the points, or tests where they would go.
template <int D>
void move_points(const std::vector<Vertex_move<D>>& moves, bool tests_only, Reshaping<D>& reshaping,
                 Move_results<D>& results) {
  Progress progress("moving points", moves.size());
  for (const auto& [point, target] : moves) {
    results.add(tests_only ? reshaping.test_move(point, target) : reshaping.move(point, target));
    progress.update(results.count());
  }
  reshaping.finish();
}

At_contact reshape_rule(Contact_rule rule) {
  switch (rule) {
    case Contact_rule::stop:
      return At_contact::stop;
    case Contact_rule::push:
      return At_contact::push;
    default:
      return At_contact::hold;
  }
}

template <int D>
void deform_environment(const Deform_options& options, Deform_files& files, Environment<D>& environment,
                        const Groups<D>& groups) {
  const std::vector<Vertex_move<D>> moves = read_moves(options.moves, environment);
  Standing_bodies<D> bodies(options.bodies, environment.snapshot());
  const bool tests_only = options.at_contact == Contact_rule::test;
  Reshaping<D> reshaping(environment, bodies.residents(), {.at_contact = reshape_rule(options.at_contact)});
  Move_results<D> results(files.report, environment.snapshot());
  move_points(moves, tests_only, reshaping, results);
  bodies.write_positions(files.positions);

  // An environment in which nothing moved is certified as it was read.
  const std::string& name = tests_only ? options.environment : options.output;
  const Certificate certificate = [&] {
    const Progress progress("certifying " + name);
    return naming(name, [&] { return environment.certify(); });
  }();
  if (!tests_only) write_environment<D>(*files.environment, environment, certificate, groups);
  nlohmann::ordered_json json{{"environment", name}, {"certificate", to_json(certificate, D)}};
  json.update(moves_json(results, bodies, reshaping.counts()));
  write_json(files.json, json);
  files.all.commit(fmt::format("{}: certified, {}D\n{}{}", name, D, describe(certificate, D),
                               describe_moves(results, bodies, reshaping.counts())));
}

void deform(const Deform_options& options) {
  check_outputs(options);
  Deform_files files(options);
  Loaded_environment loaded = load_with_progress(options.environment, options.build);
  refuse_other_numbers(options.environment, loaded.built);
  std::visit(
      [&]<int D>(Environment<D>& environment) {
        deform_environment(options, files, environment, std::get<Groups<D>>(loaded.groups));
      },
      loaded.environment);
}

}  // namespace

void add_deform(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Deform_options>();
  CLI::App* command = app.add_subcommand(
      "deform", "Move points of an environment one after the other, as far as the bodies in it allow");
  command
      ->add_option("environment", options->environment,
                   "A certified environment; cells at points that move are tetrahedra, or triangles in 2D")
      ->required()
      ->type_name("ENV");
  command
      ->add_option("moves", options->moves,
                   "A table with a move in each row, made in order: columns point,x,y,z, without z in 2D. "
                   "Points are numbered as in ENV, from 0")
      ->required()
      ->type_name("MOVES.csv");
  add_environment_output(*command, options->output)->required(false);
  command
      ->add_option("--body", options->bodies,
                   "A body that stands in the environment where its file has it; may be given several times")
      ->allow_extra_args(false)
      ->type_name("FILE");
  add_choice(
      *command, "--at-contact", options->at_contact,
      {{"stop", Contact_rule::stop},
       {"hold", Contact_rule::hold},
       {"push", Contact_rule::push},
       {"test", Contact_rule::test}},
      "What a point does whose walls would meet a body. stop: it goes as far as they may. hold: it "
      "stays where it is. push: what is in the way is moved, as far as other walls allow. test: nothing "
      "moves; the report says where each point could go by itself");
  command->add_option("--report", options->report, "What came of each move, a row each")
      ->type_name("OUT.csv");
  command
      ->add_option("--positions", options->positions,
                   "Where the vertices of the bodies are in the end, a row each: body,vertex,x,y,z")
      ->type_name("OUT.csv");
  add_choice(
      *command, "--duplicates", options->build.duplicates,
      {{"refuse", Duplicate_vertices::refuse}, {"keep", Duplicate_vertices::keep}},
      "Vertices in the same place, and facets that overlap without being shared: refuse the file, or keep "
      "them (a slit)");
  add_json(*command, options->json);
  add_examples(*command,
               {"cellwalk deform vessel.ovm moves.csv -o narrow.ovm --body catheter.obj --report report.csv",
                "cellwalk deform rooms.ovm moves.csv -o moved.ovm --body box.off --at-contact push "
                "--positions box.csv",
                "cellwalk deform rooms.ovm moves.csv --body box.off --at-contact test --report report.csv"});
  command->callback([options, &chosen] { chosen = [options] { deform(*options); }; });
}

}  // namespace cellwalk::cli
