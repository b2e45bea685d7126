// SPDX-License-Identifier: LGPL-3.0-or-later
// The commands of the program. Each is a function that adds its options, and an action that runs after
// parsing.
#ifndef CELLWALK_CLI_COMMON_COMMAND_H
#define CELLWALK_CLI_COMMON_COMMAND_H

#include <cellwalk/internal/ranks/ranks.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace cellwalk::cli {

/// Runs after the whole command line is parsed. A failure is an exception; Error's code is the exit code.
class Action {
 public:
  Action() = default;
  /// The action of a command that shares its work among ranks.
  template <std::invocable<Ranks&> Work>
  Action(Work work) : work_(std::move(work)) {}
  /// The action of a command that does not share its work: the first rank works alone.
  template <std::invocable Work>
  Action(Work work)
      : work_([work](Ranks& ranks) {
          if (ranks.is_first()) work();
        }) {}

  void operator()(Ranks& ranks) const { work_(ranks); }

 private:
  std::function<void(Ranks&)> work_;
};

// Each is defined in the file of its name. A new command needs a line here and one in main.cpp.
void add_import(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_generate(CLI::App& app, Action& chosen);
void add_query(CLI::App& app, Action& chosen);
void add_replay(CLI::App& app, Action& chosen);
void add_run(CLI::App& app, Action& chosen);
void add_deform(CLI::App& app, Action& chosen);
void add_edit(CLI::App& app, Action& chosen);
void add_view(CLI::App& app, Action& chosen);

/// Prints a script with which a shell completes command lines of `app`.
void add_completion(CLI::App& app, Action& chosen);

/// Adds examples to the end of a command's help, before the text common to all commands.
inline void add_examples(CLI::App& command, std::initializer_list<const char*> lines) {
  std::string text = "Examples:\n";
  for (const char* line : lines) text += "  " + std::string(line) + "\n";
  command.footer(text + "\n" + command.get_footer());
}

constexpr double least_size = std::numeric_limits<double>::denorm_min();  // anything greater than 0

/// A check of an option whose value is a finite number within bounds.
/// \param bound the bounds in words: "of at least 0"
inline auto number_from(double least, const char* bound, double most = std::numeric_limits<double>::max()) {
  return [least, most, bound](const std::string& text) {
    double value = 0;
    const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return fits ? std::string{} : "takes a number " + std::string(bound) + ", not " + text;
  };
}

/// A check of an option whose value is an integer.
inline auto whole_number(std::int64_t least, std::int64_t most) {
  return [least, most](const std::string& text) {
    std::int64_t value = 0;
    const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return fits ? std::string{}
                : "takes a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
                      ", not " + text;
  };
}

/// Adds --version, which prints the version and the optional parts of this build, and --json, which prints
/// the same as JSON.
void add_version(CLI::App& app);

/// Adds an option whose value is one of a few words; `value` is set to the value of the word.
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
