// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk completion SHELL: a script that completes command lines, made from the commands and options of the
// program. CLI11 makes no such scripts.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/common/command.h"

namespace cellwalk::cli {
namespace {

enum class Shell { bash, zsh, fish };

/// A command with its path of words.
struct Known_command {
  std::string path;  ///< such as /generate/hexes; empty: the program itself
  const CLI::App* app;
};

void collect(const CLI::App& app, const std::string& path, std::vector<Known_command>& commands) {
  commands.push_back({path, &app});
  for (const CLI::App* child : app.get_subcommands(nullptr))
    collect(*child, path + "/" + child->get_name(), commands);
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options(nullptr))
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  return names;
}

/// The values of an option, if it has a fixed set of them.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.find('|') == std::string::npos ? std::vector<std::string>{} : CLI::detail::split(type, '|');
}

/// Calls `visit(option's long name, its choices)`.
template <class Visit>
void for_choices(const CLI::App& app, Visit&& visit) {
  for (const CLI::Option* option : app.get_options(nullptr))
    if (const auto choices = choices_of(*option); !choices.empty())
      for (const std::string& name : option->get_lnames()) visit(name, choices);
}

std::string for_bash(const std::vector<Known_command>& commands) {
  std::string paths, values, words;
  for (const Known_command& command : commands) {
    if (!command.path.empty()) paths += (paths.empty() ? "" : "|") + command.path;
    for_choices(*command.app, [&](const std::string& name, const std::vector<std::string>& choices) {
      values += fmt::format("    '{} --{}') words='{}' ;;\n", command.path, name, fmt::join(choices, " "));
    });
    std::string known;
    for (const CLI::App* child : command.app->get_subcommands(nullptr)) known += child->get_name() + " ";
    for (const std::string& name : options_of(*command.app)) known += "--" + name + " ";
    words += fmt::format("      '{}') words='{}' ;;\n", command.path, known);
  }
  return fmt::format(R"(_cellwalk() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} path= words= word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$path/$word" in
      {}) path=$path/$word ;;
    esac
  done
  case "$path $previous" in
{}    *) case "$path" in
{}    esac ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _cellwalk cellwalk
)",
                     paths, values, words);
}

std::string for_fish(const std::vector<Known_command>& commands) {
  std::string script;
  for (const Known_command& command : commands) {
    const std::string name = command.path.empty() ? "" : command.app->get_name();
    const std::string when = name.empty() ? "__fish_use_subcommand" : "__fish_seen_subcommand_from " + name;
    for (const CLI::App* child : command.app->get_subcommands(nullptr))
      script += fmt::format("complete -c cellwalk -n '{}' -a {}\n", when, child->get_name());
    for (const std::string& option : options_of(*command.app))
      script += fmt::format("complete -c cellwalk -n '{}' -l {}\n", when, option);
    for_choices(*command.app, [&](const std::string& option, const std::vector<std::string>& choices) {
      script += fmt::format("complete -c cellwalk -n '{}' -l {} -x -a '{}'\n", when, option,
                            fmt::join(choices, " "));
    });
  }
  return script;
}

std::string script_for(Shell shell, const CLI::App& app) {
  std::vector<Known_command> commands;
  collect(app, "", commands);
  switch (shell) {
    case Shell::fish:
      return for_fish(commands);
    case Shell::zsh:
      return "autoload -U +X bashcompinit && bashcompinit\n" + for_bash(commands);
    default:
      return for_bash(commands);
  }
}

}  // namespace

void add_completion(CLI::App& app, Action& chosen) {
  const auto shell = std::make_shared<Shell>(Shell::bash);
  CLI::App* command =
      app.add_subcommand("completion", "Print a script that completes command lines in a shell");
  add_choice(*command, "shell", *shell, {{"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}},
             "The shell that reads it");
  add_examples(*command, {"source <(cellwalk completion)",
                          "cellwalk completion fish > ~/.config/fish/completions/cellwalk.fish"});
  command->callback(
      [shell, &app, &chosen] { chosen = [shell, &app] { fmt::print("{}", script_for(*shell, app)); }; });
}

}  // namespace cellwalk::cli
