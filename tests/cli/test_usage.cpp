// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using Usage = Program;

TEST_F(Usage, VersionNamesTheOptionalParts) {
  const std::string version = succeed({"--version"});
  EXPECT_TRUE(version.starts_with("cellwalk 0.")) << version;
  for (const char* part : {"cgal", "meshing", "tetgen", "vtk", "viewer"})
    EXPECT_NE(version.find("\n  " + std::string(part) + " "), std::string::npos) << version;
}

TEST_F(Usage, VersionIsToldToProgramsToo) {
  const std::string text = succeed({"--version"}), printed = succeed({"--version", "--json"});
  const auto version = nlohmann::json::parse(printed);
  EXPECT_TRUE(text.starts_with("cellwalk " + version.at("cellwalk").get<std::string>() + "\n")) << text;
  EXPECT_FALSE(version.at("compiler").get<std::string>().empty());
  EXPECT_NE(version.at("flags").get<std::string>().find("-ffp-contract=off"), std::string::npos);
  std::size_t named = 0;
  for (const auto& [name, part] : version.at("parts").items()) {
    const bool present = part.at("present");
    const auto number = part.at("version");
    EXPECT_TRUE(present || number.is_null()) << name;
    // The same is told to people.
    const std::size_t line = text.find("\n  " + name + " ");
    ASSERT_NE(line, std::string::npos) << name;
    const std::string word = !present ? "no" : number.is_null() ? "yes" : number.get<std::string>();
    EXPECT_EQ(text.substr(line + 12, word.size() + 1), word + " ") << name;
    EXPECT_NE(text.find(part.at("purpose").get<std::string>(), line), std::string::npos) << name;
    ++named;
  }
  EXPECT_EQ(named, 6U);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);

  EXPECT_EQ(succeed({"--version", "--json", "version.json"}), text) << "a file comes beside the text";
  EXPECT_EQ(this->text("version.json"), printed);
  EXPECT_EQ(succeed({"--json", "--version"}), printed);
  expect_failure(1, {"--version", "--json", "nowhere/version.json"}, {"nowhere"});
  expect_failure(2, {"--json"}, {"--json requires --version"});
  expect_failure(2, {"--json", "check", "a.ovm"}, {"--json requires --version"});
}

TEST_F(Usage, HelpNamesEveryCommandAndExitCode) {
  const std::string help = succeed({"--help"});
  for (const char* text : {"import", "check", "generate", "query", "replay", "run", "deform", "edit", "view",
                           "4 environment not certified", "--version", "--json [FILE]"})
    EXPECT_NE(help.find(text), std::string::npos) << help;
}

TEST_F(Usage, EveryCommandHasHelp) {
  for (const char* command :
       {"import", "check", "generate", "query", "replay", "run", "deform", "edit", "view"})
    EXPECT_NE(succeed({command, "--help"}).find("Usage: cellwalk " + std::string(command)),
              std::string::npos);
}

TEST_F(Usage, MistakesEndWithExitCode2AndOneLine) {
  expect_failure(2, {}, {"subcommand is required", "see cellwalk --help"});
  expect_failure(2, {"fly"}, {"fly is not known here", "see cellwalk --help"});
  expect_failure(2, {"check"}, {"environment is required"});
  expect_failure(2, {"check", "a.ovm", "b.ovm"}, {"b.ovm"});
  expect_failure(2, {"check", "a.ovm", "--fast"}, {"--fast"});
  expect_failure(2, {"check", "a.ovm", "--duplicates", "perhaps"},
                 {"--duplicates", "refuse|merge|keep", "perhaps"});
}

TEST_F(Usage, ModesThatDoNotExistAreRefused) {
  expect_failure(2, {"query", "a.ovm", "q.csv", "-o", "out.csv", "--mode", "fly"},
                 {"--mode", "takes move|sweep"});
}

TEST_F(Usage, EmptyWordsAreRefused) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  expect_failure(2, {"check", "env.ovm", "--json", ""}, {"argument 4, after --json, is empty"});
  expect_failure(2, {"check", "env.ovm", "--json="}, {"--json= is given no value"});
  expect_failure(2, {"--version", "--json", ""}, {"argument 3, after --json, is empty"});
  expect_failure(2, {"completion", ""}, {"argument 2, after completion, is empty"});
  expect_failure(2, {""}, {"argument 1, after cellwalk, is empty"});
  expect_failure(2, {"run", "-o", ""}, {"argument 3, after -o, is empty"});
  expect_failure(2, {"query", "env.ovm", "q.csv", "-o", "a.csv", "--row", ""}, {"after --row, is empty"});
  expect_failure(2, {"--version", "--json", "a", "b"}, {"b is not known here"});
}

TEST_F(Usage, LongWordsAreQuotedShortened) {
  const std::string word = std::string(4000, 'a');
  const std::string brief = std::string(40, 'a') + "...";
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  const auto refuse = [&](int code, const std::vector<std::string>& arguments, const std::string& said) {
    expect_failure(code, arguments, {said});
    EXPECT_LT(run(arguments).err.size(), 300u);
  };
  refuse(2, {word}, brief + " is not known here");
  refuse(2, {"check", "env.ovm", word}, brief);
  refuse(2, {"check", "env.ovm", "--duplicates", word}, "takes refuse|merge|keep, not " + brief);
  refuse(2, {"check", "env.ovm", "--duplicates=" + word}, "takes refuse|merge|keep, not " + brief);
  refuse(2, {"generate", "hexes", "--cells", word, "-o", "e.ovm"}, brief);
  refuse(2, {"run", "-o", "out", "--set", word}, brief + ": no key");
  refuse(3, {"check", word}, brief + ": cannot be opened");
  refuse(1, {"check", "env.ovm", "--json", word}, brief + ": cannot be written");
}

TEST_F(Usage, AFolderIsNoScene) {
  expect_failure(3, {"run", ".", "-o", "out"}, {".: is a directory: name a file"});
  expect_failure(3, {"run", "none.json", "-o", "out"}, {"none.json: cannot be opened"});
}

TEST_F(Usage, ReportsThatCannotBeWrittenAreErrors) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  expect_failure(1, {"check", "env.ovm", "--json", "nowhere/report.json"}, {"nowhere"});
}

TEST_F(Usage, AFullDeviceIsAnError) {
  expect_failure(1, {"generate", "squares", "--cells", "2", "-o", "/dev/full"}, {"/dev/full"});
}

TEST_F(Usage, HelpEndsWithExamples) {
  for (const char* command :
       {"import", "check", "generate", "query", "replay", "run", "deform", "edit", "view", "completion"}) {
    const std::string help = succeed({command, "--help"});
    const std::size_t at = help.find("Examples:\n  ");
    ASSERT_NE(at, std::string::npos) << help;
    EXPECT_NE(help.find("cellwalk " + std::string(command), at), std::string::npos) << help;
    EXPECT_NE(help.find("Exit codes:", at), std::string::npos) << help;
  }
}

TEST_F(Usage, ShellsCompleteCommandsOptionsAndChoices) {
  write("complete.bash", succeed({"completion", "bash"}));
  write("try.bash",
        "source complete.bash; COMP_WORDS=(cellwalk \"$@\"); COMP_CWORD=$#; _cellwalk; echo ${COMPREPLY[*]} "
        "> answer");
  const auto answer = [this](const std::string& words) {
    EXPECT_EQ(std::system(("cd '" + path("").string() + "' && bash try.bash " + words).c_str()), 0);
    return text("answer");
  };
  EXPECT_EQ(answer("im"), "import\n");
  EXPECT_EQ(answer("generate ro"), "room2d\n");
  EXPECT_EQ(answer("generate hexes --so"), "--solid\n");
  EXPECT_EQ(answer("query env.ovm q.csv --mode s"), "sweep\n");
  EXPECT_EQ(answer("import --mesher ''"), "tetgen mesh3\n");
  EXPECT_EQ(answer("deform env.ovm m.csv --at-contact ''"), "stop hold push test\n");
  EXPECT_EQ(answer("deform env.ovm m.csv --b"), "--body\n");
  EXPECT_EQ(answer("--version --j"), "--json\n");
  EXPECT_EQ(answer("check data/x"), "\n") << "files are for the shell";
  const std::string fish = succeed({"completion", "fish"});
  EXPECT_NE(fish.find("__fish_seen_subcommand_from query' -l mode -x -a 'move sweep'"), std::string::npos)
      << fish;
  EXPECT_TRUE(succeed({"completion", "zsh"}).starts_with("autoload -U +X bashcompinit"));
  expect_failure(2, {"completion", "tcsh"}, {"bash|zsh|fish", "tcsh"});
}

}  // namespace
}  // namespace cellwalk::test
