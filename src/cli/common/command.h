// SPDX-License-Identifier: LGPL-3.0-or-later
// What a command of the program is: a function that adds its options, and leaves an action to run after
// parsing.
#ifndef CELLWALK_CLI_COMMON_COMMAND_H
#define CELLWALK_CLI_COMMON_COMMAND_H

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>

namespace cellwalk::cli {

/// Run once the whole command line is understood. Failure is an exception; Error's code is the exit code.
using Action = std::function<void()>;

// Each begins in the file of its name. A new command is a line here and one in main.cpp.
void add_import(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_generate(CLI::App& app, Action& chosen);
void add_query(CLI::App& app, Action& chosen);
void add_replay(CLI::App& app, Action& chosen);
void add_run(CLI::App& app, Action& chosen);
void add_view(CLI::App& app, Action& chosen);

/// Prints what a shell needs to complete command lines of `app`.
void add_completion(CLI::App& app, Action& chosen);

/// Puts examples at the end of a command's help, before what the program says for all commands.
inline void add_examples(CLI::App& command, std::initializer_list<const char*> lines) {
  std::string text = "Examples:\n";
  for (const char* line : lines) text += "  " + std::string(line) + "\n";
  command.footer(text + "\n" + command.get_footer());
}

/// A check of an option that takes a whole number.
inline auto whole_number(std::int64_t least, std::int64_t most) {
  return [least, most](const std::string& text) {
    std::int64_t value = 0;
    const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return fits ? std::string{}
                : "takes a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
                      ", not " + text;
  };
}

/// Adds --version, which prints the version and which optional parts this build has, and --json, which makes
/// JSON of that.
void add_version(CLI::App& app);

/// An option that takes one of a few words: `value` becomes what stands behind the word.
template <class T>
CLI::Option* add_choice(CLI::App& command, const std::string& name, T& value,
                        std::initializer_list<std::pair<const char*, T>> words, const std::string& help) {
  const std::map<std::string, T> meanings(words.begin(), words.end());
  std::string names, initial;
  for (const auto& [word, meaning] : words) {
    names += (names.empty() ? "" : "|") + std::string(word);
    if (meaning == value) initial = word;
  }
  return command
      .add_option_function<std::string>(
          name, [&value, meanings](const std::string& word) { value = meanings.at(word); }, help)
      ->check([meanings, names](const std::string& word) {
        return meanings.count(word) == 0 ? "takes " + names + ", not " + word : std::string{};
      })
      ->type_name(names)
      ->default_str(initial);
}

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_COMMAND_H
