// SPDX-License-Identifier: LGPL-3.0-or-later
// The program: parses the command line, runs one command, turns exceptions into one line and an exit code.
#include <cellwalk/internal/io/output.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/kernel/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <gmp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "cli/common/command.h"
#include "cli/common/interruption.h"
#include "cli/common/printable.h"
#include "cli/common/work_log.h"

namespace {

using cellwalk::Error;
using cellwalk::Error_code;
using cellwalk::Ranks;

constexpr std::string_view no_memory = "out of memory: use a smaller input or a larger machine";
/// Where there is no error with a message: memory may not even have sufficed for one.
constexpr std::string_view no_error =
    "out of memory, or a defect of the program: use a smaller input or a larger machine, or report it";
constexpr bool for_good = true;

/// The first line of a message: that of a library may have further ones.
std::string_view first_line(std::string_view message) { return message.substr(0, message.find('\n')); }

/// Prints an error where there may be no memory.
void say(std::string_view message) {
  for (const std::string_view piece : {std::string_view("cellwalk: "), message, std::string_view("\n")})
    if (write(STDERR_FILENO, piece.data(), piece.size()) < 0) return;
}

/// Ends the program at once, and leaves nothing behind.
[[noreturn]] void end_with(std::string_view message) {
  static std::atomic_flag has_begun;
  while (has_begun.test_and_set()) pause();  // on a further thread
  say(message);
  cellwalk::io::discard_unfinished_files(for_good);
  _exit(EXIT_FAILURE);
}

/// The same at an error that nothing else can handle: on another thread, in a destructor, or while
/// another error is reported. Mostly memory is used up.
[[noreturn]] void end_at_error() {
  if (std::current_exception() == nullptr) end_with(no_error);
  try {
    throw;
  } catch (const std::bad_alloc&) {
    end_with(no_memory);
  } catch (const std::exception& error) {
    end_with(first_line(error.what()));
  }
}

void* given(void* memory) {
  if (memory == nullptr) end_with(no_memory);
  return memory;
}

/// Without memory GMP would abort.
void give_memory_to_numbers() {
  mp_set_memory_functions(
      [](std::size_t size) { return given(std::malloc(size)); },
      [](void* old, std::size_t, std::size_t size) { return given(std::realloc(old, size)); },
      [](void* memory, std::size_t) { std::free(memory); });
}

/// Before all other constructors, some of which allocate.
[[gnu::constructor(101)]] void handle_errors_at_last() { std::set_terminate(end_at_error); }

/// Removes unfinished files when the program is interrupted.
void discard_and_stop(int signal) {
  cellwalk::io::discard_unfinished_files(for_good);
  cellwalk::cli::raise_at_last(signal);
}

/// Has unfinished files removed when a signal ends the program, but for SIGKILL, and those that others handle
/// already, such as a sanitizer or a profiler.
void handle_signals() {
  using namespace cellwalk::cli;
  static std::array<char, std::size_t{1} << 16> other_stack;  // bytes, for where the stack is used up
  const stack_t stack{.ss_sp = other_stack.data(), .ss_flags = 0, .ss_size = other_stack.size()};
  sigaltstack(&stack, nullptr);
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (!(ends_programs(signal) || is_crash(signal)) || sigaction(signal, nullptr, &action) != 0 ||
        action.sa_handler != SIG_DFL)
      continue;
    action.sa_handler = discard_and_stop;
    action.sa_flags = is_crash(signal) ? SA_ONSTACK : SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
  // A closed pipe and the limit of file sizes become errors of writing, so that nothing is left behind.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  // mpirun hands these on to all ranks: the reaction of the first ends the others.
  if (cellwalk::is_later_rank())
    for (const int signal : {SIGUSR1, SIGUSR2, SIGALRM}) std::signal(signal, SIG_IGN);
}

/// Opens the standard streams that are closed, so that no file gets their numbers, and the text that is
/// printed to them. Standard output cannot be written then, and commands fail as they do on a full device.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_RDWR);
}

constexpr std::size_t longest_name = 255;  // bytes that Linux allows

/// A word, or the beginning of one that is too long for a line.
std::string shortened(std::string_view word, std::size_t longest = 100) {
  constexpr std::size_t shown = 40;  // bytes
  if (word.size() <= longest) return std::string(word);
  return fmt::format("{}...", word.substr(0, shown));
}

/// A message with long words of the command line shortened. File names may be longer.
std::string with_short_words(std::string message, std::span<char* const> words, Error_code code) {
  const auto shorten = [&](std::string_view word) {
    const std::string brief = code == Error_code::usage ? shortened(word) : shortened(word, longest_name);
    if (brief.size() == word.size()) return;
    for (std::size_t at = 0; (at = message.find(word, at)) != std::string::npos; at += brief.size())
      message.replace(at, word.size(), brief);
  };
  for (const std::string_view word : words) {
    shorten(word);
    shorten(word.substr(std::min(word.find('=') + 1, word.size())));  // the value of --option=VALUE
  }
  return message;
}

/// Prints an error, once for all ranks, and ends them.
int fail(Ranks& ranks, Error_code code, const std::string& message) {
  if (ranks.is_first()) {
    std::fflush(stdout);
    std::fprintf(stderr, "cellwalk: %s\n", cellwalk::cli::printable(message).c_str());
  }
  ranks.fail(code, message);
  return ranks.is_first() ? static_cast<int>(code) : EXIT_SUCCESS;
}

/// As far as the command line was read: "cellwalk generate hexes".
std::string command_of(const CLI::App& app) {
  const auto below = app.get_subcommands();
  return below.empty() ? app.get_name() : app.get_name() + " " + command_of(*below.front());
}

/// The error in a command line. An unknown word explains more than an argument that is missing because of it.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const auto unknown = app.remaining(true);
  const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const std::string message =
      missing && !unknown.empty() ? unknown.front() + " is not known here" : error.what();
  return message + "; see " + command_of(app) + " --help";
}

/// Refuses empty words, which come from unset variables of scripts; no command accepts one. Returns an empty
/// text if there is none.
std::string empty_word(std::span<char* const> words) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word.empty())
      return fmt::format("argument {}, after {}, is empty: give a value, or leave the option out", i,
                         shortened(i == 1 ? "cellwalk" : words[i - 1]));
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      return fmt::format("{} is given no value: give one, or leave the option out", shortened(word));
  }
  return {};
}

/// Where the progress of long work is logged.
struct Log_options {
  std::string file;  ///< none if empty
  double seconds = 60;
};

/// Adds the options of the log to all commands that may take long.
void add_log(CLI::App& app, Log_options& log) {
  const auto all = [](const CLI::App*) { return true; };
  for (CLI::App* command : app.get_subcommands(all)) {
    if (command->get_name() == "completion" || command->get_name() == "view") continue;
    if (!command->get_subcommands(all).empty()) {  // it is one of these that is called
      add_log(*command, log);
      continue;
    }
    CLI::Option* file =
        command
            ->add_option("--log", log.file,
                         "Append where the work is, its rate, the time left and the memory in use: a line "
                         "of JSON a minute")
            ->type_name("FILE");
    command->add_option("--log-interval", log.seconds, "Seconds between two lines of the log")
        ->needs(file)
        ->check(
            cellwalk::cli::number_from(0.001, "from 0.001 to 1000000", cellwalk::cli::longest_log_interval))
        ->type_name("SECONDS")
        ->capture_default_str();
  }
}

int run(Ranks& ranks, const cellwalk::cli::Action& action, std::span<char* const> words) {
  try {
    // mpirun gives it to the first rank only.
    if (std::ranges::any_of(words, cellwalk::names_standard_input)) share_standard_input(ranks);
    action(ranks);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Error(Error_code::other, "standard output cannot be written");
    ranks.leave();
    return EXIT_SUCCESS;
  } catch (const Error& error) {
    return fail(ranks, error.code(), with_short_words(error.what(), words, error.code()));
  } catch (const std::bad_alloc&) {
    return fail(ranks, Error_code::other, std::string(no_memory));
  } catch (const std::exception& error) {
    return fail(ranks, Error_code::other, std::string(first_line(error.what())));
  }
}

/// \throw std::bad_alloc if an error cannot even be reported
int run_command(int argc, char** argv) {
  using namespace cellwalk::cli;
  const std::span<char* const> words(argv, static_cast<std::size_t>(argc));
  Ranks ranks;
  try {
    ranks = Ranks::join();
  } catch (const std::exception& error) {
    if (!cellwalk::is_later_rank()) return fail(ranks, Error_code::other, error.what());
    return static_cast<int>(Error_code::other);
  }
  if (const std::string problem = empty_word(words); !problem.empty())
    return fail(ranks, Error_code::usage, problem + "; see cellwalk --help");

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
  add_deform(app, action);
  add_edit(app, action);
  add_view(app, action);
  add_completion(app, action);
  Log_options log;
  add_log(app, log);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return run(
        ranks, [&] { app.exit(help_or_version); }, words);
  } catch (const CLI::ParseError& error) {
    return fail(ranks, Error_code::usage, with_short_words(explain(app, error), words, Error_code::usage));
  } catch (const Error& error) {  // --version --json FILE
    return fail(ranks, error.code(), error.what());
  }
  std::optional<Work_log> work_log;
  const auto logged = [&](Ranks& all) {
    // The first logs the work of all. Outputs of the command test the name.
    if (!log.file.empty() && !cellwalk::is_later_rank())
      work_log.emplace(log.file, std::chrono::duration<double>(log.seconds));
    action(all);
  };
  return run(ranks, logged, words);
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  handle_signals();
  give_memory_to_numbers();
  try {
    return run_command(argc, argv);
  } catch (...) {
    end_at_error();
  }
}
