// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk deform ENV MOVES.csv -o OUT.ovm: moves points of an environment one after the other, as far as the
// bodies in it allow.
#include <cellwalk/io/body_file.h>
#include <cellwalk/io/ovm.h>
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
#include "results.h"

namespace cellwalk::cli {
namespace {

struct Deform_options {
  std::string environment, moves, output, report, json;
  std::vector<std::string> bodies;
  At_contact at_contact = At_contact::stop;
  Build_options build{.keep_map = false};
};

/// The output files; null for those not requested.
struct Deform_files {
  explicit Deform_files(const Deform_options& options)
      : all(inputs(options)),
        environment(all.file(options.output)),
        report(all.file(options.report)),
        json(all.file(options.json)) {}

  Outputs all;
  io::Atomic_file *environment, *report, *json;

 private:
  static std::vector<std::string> inputs(const Deform_options& options) {
    std::vector<std::string> names = options.bodies;
    names.push_back(options.environment);
    names.push_back(options.moves);
    return names;
  }
};

/// Reads the bodies and registers them where they stand.
template <int D>
std::vector<Body<D>> place_bodies(const std::vector<std::string>& files, const Snapshot<D>& snapshot,
                                  Standing_bodies& standing) {
  std::vector<Body<D>> bodies;
  if (files.empty()) return bodies;
  const Locator<D> locator(snapshot);
  for (const std::string& file : files) {
    const io::Body_file<D> read = io::read_body<D>(file);
    const Body<D>& body =
        naming(file, [&]() -> Body<D>& { return bodies.emplace_back(snapshot, locator, read.body); });
    ++standing.count;
    standing.vertices += body.vertex_count();
    standing.edges += body.edges().size();
    standing.faces += body.faces().size();
    for (const std::string& note : read.report.notes) standing.notes.push_back(file + ": " + note);
  }
  return bodies;
}

template <int D>
void deform_environment(const Deform_options& options, Deform_files& files, Environment<D>& environment) {
  const std::vector<Vertex_move<D>> moves = read_moves(options.moves, environment);
  Standing_bodies standing;
  std::vector<Body<D>> bodies = place_bodies(options.bodies, environment.snapshot(), standing);
  Residents<D> residents;
  for (Body<D>& body : bodies) residents.bodies.push_back(&body);

  Reshaping<D> reshaping(environment, residents, {.at_contact = options.at_contact});
  Move_results<D> results(files.report, environment.snapshot());
  {
    Progress progress("moving points", moves.size());
    for (const auto& [point, target] : moves) {
      results.add(reshaping.move(point, target));
      progress.update(results.count());
    }
  }
  reshaping.close();
  const Certificate certificate = [&] {
    const Progress progress("certifying " + options.output);
    return naming(options.output, [&] { return environment.certify(); });
  }();

  io::write_ovm(*files.environment, environment.soup());
  nlohmann::ordered_json json{{"environment", options.output}, {"certificate", to_json(certificate, D)}};
  json.update(moves_json(results, standing, reshaping.counts()));
  write_json(files.json, json);
  files.all.commit(fmt::format("{}: certified, {}D\n{}{}", options.output, D, describe(certificate, D),
                               describe_moves(results, standing, reshaping.counts())));
}

void deform(const Deform_options& options) {
  Deform_files files(options);
  Loaded_environment loaded = load_with_progress(options.environment, options.build);
  refuse_other_numbers(options.environment, loaded.built);
  std::visit([&](auto& environment) { deform_environment(options, files, environment); }, loaded.environment);
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
  add_environment_output(*command, options->output);
  command
      ->add_option("--body", options->bodies,
                   "A body that stands in the environment where its file has it; may be given several times")
      ->type_name("FILE");
  add_choice(*command, "--at-contact", options->at_contact,
             {{"stop", At_contact::stop}, {"hold", At_contact::hold}},
             "What a point does whose walls would meet a body. stop: it goes as far as they may. hold: it "
             "stays where it is");
  command->add_option("--report", options->report, "What came of each move, a row each")
      ->type_name("OUT.csv");
  add_choice(*command, "--duplicates", options->build.duplicates,
             {{"refuse", Duplicate_vertices::refuse}, {"keep", Duplicate_vertices::keep}},
             "Vertices in the same place: refuse the file, or keep them apart (a slit)");
  add_json(*command, options->json);
  add_examples(
      *command,
      {"cellwalk deform vessel.ovm moves.csv -o narrow.ovm --body catheter.obj --report report.csv",
       "cellwalk deform rooms.ovm moves.csv -o moved.ovm --body box.off --body ball.off --at-contact hold"});
  command->callback([options, &chosen] { chosen = [options] { deform(*options); }; });
}

}  // namespace cellwalk::cli
