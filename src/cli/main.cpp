// SPDX-License-Identifier: LGPL-3.0-or-later
// The program: parses the command line, runs one command, turns exceptions into one line and an exit code.
#include <cellwalk/io/atomic_file.h>
#include <cellwalk/kernel/error.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "cli/command.h"

namespace {

using cellwalk::Error;
using cellwalk::Error_code;

/// Files half written go when the program is interrupted.
void discard_and_stop(int signal) {
  cellwalk::io::discard_unfinished_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

int fail(Error_code code, const std::string& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "cellwalk: %s\n", message.substr(0, message.find('\n')).c_str());
  return static_cast<int>(code);
}

/// What is wrong with a command line. A word that no command knows explains more than what is missing because of it.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const auto unknown = app.remaining(true);
  const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const std::string message =
      missing && !unknown.empty() ? unknown.front() + " is not known here" : error.what();
  return message + "; see cellwalk --help";
}

int run(const cellwalk::cli::Action& action) {
  try {
    action();
    if (std::fflush(stdout) != 0) throw Error(Error_code::other, "standard output cannot be written");
    return EXIT_SUCCESS;
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(Error_code::other, "out of memory: use a smaller input or a larger machine");
  } catch (const std::exception& error) {
    return fail(Error_code::other, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace cellwalk::cli;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, discard_and_stop);

  CLI::App app{"Exact, fast contact detection in convex cell complexes.", "cellwalk"};
  add_version(app);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 usage, 3 unreadable or invalid input, 4 environment not certified,\n"
      "5 a particle or body starts outside free space or across a wall, 1 anything else. Options of a "
      "command: cellwalk COMMAND "
      "--help");

  Action action;
  add_import(app, action);
  add_check(app, action);
  add_generate(app, action);
  add_query(app, action);
  add_replay(app, action);
  add_run(app, action);
  add_view(app, action);
  add_completion(app, action);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return run([&] { app.exit(help_or_version); });
  } catch (const CLI::ParseError& error) {
    return fail(Error_code::usage, explain(app, error));
  } catch (const Error& error) {  // --version --json FILE
    return fail(error.code(), error.what());
  }
  return run(action);
}
