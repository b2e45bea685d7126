// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk view DIR -o run.html: one page that replays a run in a browser, without a network.
#include <cellwalk/internal/io/recording_file.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"
#include "cli/common/viewer_page.h"
#include "cli/run/results.h"

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

struct View_options {
  std::string folder, output, json;
};

void check_build() {
  if (viewer_page.empty())
    throw Error(Error_code::other,
                "this build cannot make pages: install Node.js 18 or later with npm (Debian: apt-get install "
                "nodejs npm), then "
                "configure with -DCELLWALK_WITH_VIEWER=ON and build again");
}

std::string base64(std::string_view bytes) {
  std::string text;
  io::append_base64(text, {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  return text;
}

/// JSON within a script element, without text that could end the element.
std::string embedded(const nlohmann::ordered_json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

/// The page, with each piece of data in place of its mark.
std::string page_of(const Run_results& results) {
  std::string page;
  std::string_view rest = viewer_page;
  const auto put = [&](std::string_view mark, const std::string& data) {
    const std::size_t at = rest.find(mark);
    page.append(rest.substr(0, at)).append(data);
    rest.remove_prefix(at + mark.size());
  };
  put("/*RUN*/", embedded(results.report));
  put("/*CONTACTS*/", base64(io::gzip(results.contacts)));
  put("/*MOTION*/", base64(results.motion.packed));
  return page.append(rest);
}

void view(const View_options& options) {
  check_build();
  std::vector<std::string> inputs;
  for (const char* name : {"run.json", "motion.gz", "contacts.csv"})
    inputs.push_back((fs::path(options.folder) / name).string());
  Outputs outputs(inputs);
  io::Atomic_file* const output = outputs.file(options.output);
  io::Atomic_file* const json = outputs.file(options.json);
  const Run_results results = read_run(options.folder);
  const Recording_scene& scene = results.motion.scene;
  const std::string page = page_of(results);
  output->write(page);
  write_json(json, {{"run", options.folder},
                    {"page", options.output},
                    {"bytes", page.size()},
                    {"records", scene.frame_count()},
                    {"every", scene.every},
                    {"contacts", results.contact_count}});
  outputs.commit(fmt::format("{}: {} records of {} steps, {} contacts, {:.1f} MB; open it in a browser\n",
                             options.output, scene.frame_count(), scene.steps, results.contact_count,
                             static_cast<double>(page.size()) / 1e6));
}

}  // namespace

void add_view(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<View_options>();
  CLI::App* command =
      app.add_subcommand("view", "Make a page of a run that replays it in a browser, without network");
  command->add_option("run", options->folder, "The folder that cellwalk run wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("-o,--output", options->output, "The page to write")
      ->required()
      ->type_name("PAGE.html");
  add_json(*command, options->json);
  add_examples(*command, {"cellwalk view out -o run.html"});
  command->callback([options, &chosen] { chosen = [options] { view(*options); }; });
}

}  // namespace cellwalk::cli
