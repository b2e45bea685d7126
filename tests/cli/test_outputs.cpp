// SPDX-License-Identifier: LGPL-3.0-or-later
// What every command does with its outputs: all of them appear or none, and none replaces what is read.
#include <sys/stat.h>

#include <cstdlib>
#include <map>

#include "cli/meshes.h"
#include "cli/program.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// A command that writes files, with the options that name them.
struct Writing_command {
  Arguments arguments;
  std::vector<std::pair<std::string, std::string>> outputs;  ///< option, name
  Arguments inputs;

  Arguments with(const std::map<std::string, std::string>& other_names = {}) const {
    Arguments all = arguments;
    for (const auto& [option, name] : outputs) {
      all.push_back(option);
      all.push_back(other_names.contains(option) ? other_names.at(option) : name);
    }
    return all;
  }
};

class Outputs : public Program {
 protected:
  Outputs() {
    succeed({"generate", "hexes", "--cells", "2", "-o", "env.ovm"});
    succeed({"generate", "squares", "--cells", "2", "-o", "flat.ovm"});
    succeed({"import", "flat.ovm", "--simplicial", "-o", "triangles.ovm"});
    write("points.csv", "point,x,y\n4,0.75,1.25\n");
    write("rod.csv", "x,y\n0.5,0.5\n0.75,0.5\n");
    write("moves.csv", "ax,ay,az,bx,by,bz\n0.5,0.5,0.5,1.5,0.5,0.5\n");
    write("flat.csv", "ax,ay,bx,by\n0.5,0.5,1.5,0.5\n");
    write("cube.off", cube_off(2));
    write("cube.ovm", hexahedron_ovm(0));
    succeed({"run", "-o", "first", "--set", "bodies[0].count=1", "--set", "environment.cells=2", "--set",
             "environment.solid=0", "--steps", "2", "--set", "output.picture=false", "--record", "t.trace"});
    write("s.json",
          R"({"environment": {"generate": "hexes", "cells": 2},
              "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 1}], "steps": 2})");
    write("file.json",
          R"({"environment": "env.ovm",
              "bodies": [{"file": "cube.off", "count": 1, "scale": 0.1}], "steps": 1})");
    commands_ = {
        {{"import", "cube.ovm"}, {{"-o", "e.ovm"}, {"--json", "r.json"}}, {"cube.ovm"}},
        {{"check", "env.ovm"}, {{"--json", "r.json"}}, {"env.ovm"}},
        {{"generate", "hexes", "--cells", "2"}, {{"-o", "e.ovm"}, {"--json", "r.json"}}, {}},
        {{"query", "env.ovm", "moves.csv", "--row", "0"},
         {{"-o", "a.csv"}, {"--json", "r.json"}, {"--record", "m.json"}},
         {"env.ovm", "moves.csv"}},
        {{"query", "flat.ovm", "flat.csv", "--row", "0"},
         {{"-o", "a.csv"}, {"--json", "r.json"}, {"--picture", "p.png"}},
         {"flat.ovm", "flat.csv"}},
        {{"deform", "triangles.ovm", "points.csv", "--body", "rod.csv"},
         {{"-o", "e.ovm"}, {"--report", "a.csv"}, {"--json", "r.json"}},
         {"triangles.ovm", "points.csv", "rod.csv"}},
        {{"replay", "t.trace", "--environment", "env.ovm", "--repeat", "1"},
         {{"--json", "r.json"}},
         {"t.trace", "env.ovm"}},
        {{"run", "s.json", "--force"},
         {{"-o", "out"}, {"--json", "r.json"}, {"--record", "m.trace"}},
         {"s.json"}},
#ifdef CELLWALK_TEST_VIEWER
        {{"view", "first"},
         {{"-o", "p.html"}, {"--json", "r.json"}},
         {"first/run.json", "first/motion.gz", "first/contacts.csv"}},
#endif
    };
  }

  static bool is_folder(const Writing_command& command, const std::string& option) {
    return command.arguments[0] == "run" && option == "-o";
  }
  static bool is_environment(const Writing_command& command, const std::string& option) {
    const std::string& name = command.arguments[0];
    return option == "-o" && (name == "import" || name == "generate" || name == "deform");
  }

  std::vector<Writing_command> commands_;
};

TEST_F(Outputs, AllOfThemAppear) {
  for (const Writing_command& command : commands_) {
    SCOPED_TRACE(command.arguments[0]);
    auto expected = files();
    succeed(command.with());
    for (const auto& [option, name] : command.outputs) {
      EXPECT_TRUE(exists(name)) << name;
      fs::remove_all(path(name));
    }
    EXPECT_EQ(files(), expected);
  }
}

TEST_F(Outputs, NoneAppearsWhereOneCannotBeWritten) {
  int tried = 0;
  for (const Writing_command& command : commands_)
    for (const auto& [option, name] : command.outputs) {
      SCOPED_TRACE(command.arguments[0] + " " + option);
      const std::string nowhere = is_environment(command, option) ? "nowhere/e.ovm" : "nowhere/x";
      expect_failure(1, command.with({{option, nowhere}}), {"nowhere/"});
      // A full device is found when all else is written.
      if (!is_folder(command, option))
        expect_failure(1, command.with({{option, "/dev/full"}}), {"/dev/full: writing failed"});
      if (!is_folder(command, option) && !is_environment(command, option))
        expect_failure(1, command.with({{option, "first"}}), {"first: cannot be written (Is a directory)"});
      ++tried;
    }
  EXPECT_GE(tried, 15);
}

TEST_F(Outputs, OlderFilesStayWhereACommandFails) {
  for (const Writing_command& command : commands_) {
    SCOPED_TRACE(command.arguments[0]);
    if (command.outputs.size() < 2) continue;
    for (const auto& [option, name] : command.outputs)
      if (!is_folder(command, option)) write(name, "older");
    expect_failure(1, command.with({{command.outputs.back().first, "/dev/full"}}), {"/dev/full"});
    for (const auto& [option, name] : command.outputs)
      if (!is_folder(command, option)) {
        EXPECT_EQ(text(name), "older");
        fs::remove(path(name));
      }
  }
}

TEST_F(Outputs, NothingAppearsWhereTheSummaryCannotBePrinted) {
  write("all.sh", "\"$@\" > /dev/full 2> err");
  for (const Writing_command& command : commands_) {
    SCOPED_TRACE(command.arguments[0]);
    write("r.json", "older");
    write("err", "");
    const auto before = files();
    std::string line = "cd '" + path("").string() + "' && bash all.sh " CELLWALK_PROGRAM;
    for (const std::string& word : command.with()) line += " '" + word + "'";
    EXPECT_EQ(std::system(line.c_str()) >> 8, 1);
    EXPECT_EQ(text("err"), "cellwalk: standard output cannot be written\n");
    EXPECT_EQ(files(), before);
    EXPECT_EQ(text("r.json"), "older");
  }
}

TEST_F(Outputs, NoneIsAnInputByWhateverName) {
  fs::create_directory(path("folder"));
  int tried = 0;
  for (const Writing_command& command : commands_)
    for (const auto& [option, name] : command.outputs)
      for (const std::string& input : command.inputs) {
        SCOPED_TRACE(command.arguments[0] + " " + option + " " + input);
        if (is_folder(command, option)) continue;
        const std::string before = text(input);
        fs::create_symlink("../" + input, path("folder/link.ovm"));
        fs::create_hard_link(path(input), path("folder/hard.ovm"));
        Arguments names{"./folder/../" + input, path(input).string(), "folder/link.ovm", "folder/hard.ovm"};
        if (!is_environment(command, option) || input.ends_with(".ovm")) names.push_back(input);
        for (const std::string& other : names) {
          if (is_environment(command, option) && !other.ends_with(".ovm")) continue;
          expect_failure(2, command.with({{option, other}}), {other + ": is read by this command"});
          ++tried;
        }
        EXPECT_EQ(text(input), before);
        fs::remove(path("folder/link.ovm"));
        fs::remove(path("folder/hard.ovm"));
      }
  EXPECT_GE(tried, 60);
  // Before anything is read: the input need not even be there.
  expect_failure(2, {"check", "none.ovm", "--json", "none.ovm"}, {"none.ovm: is read by this command"});
}

TEST_F(Outputs, NoneIsAnotherOutput) {
  int tried = 0;
  for (const Writing_command& command : commands_)
    for (const auto& [option, name] : command.outputs)
      for (const auto& [other_option, other_name] : command.outputs) {
        if (option == other_option || is_environment(command, other_option)) continue;
        SCOPED_TRACE(command.arguments[0] + " " + option + " " + other_option);
        expect_failure(2, command.with({{other_option, "./" + name}}), {"is named for two outputs"});
        ++tried;
      }
  EXPECT_GE(tried, 12);
  fs::create_symlink("nobody.json", path("link.json"));
  expect_failure(2, {"query", "env.ovm", "moves.csv", "-o", "nobody.json", "--json", "link.json"},
                 {"link.json: is named for two outputs"});
  succeed({"query", "env.ovm", "moves.csv", "-o", "/dev/null", "--json", "/dev/null"});
}

TEST_F(Outputs, TheLogIsOneOfThem) {
  write("empty", "");
  int tried = 0;
  for (const Writing_command& command : commands_) {
    if (command.arguments[0] == "view") continue;
    const auto refused = [&](const std::string& log, const std::string& why) {
      SCOPED_TRACE(command.arguments[0] + " " + log);
      Arguments all = command.with();
      all.insert(all.end(), {"--log", log});
      expect_failure(2, all, {log + ": " + why});
      ++tried;
    };
    for (const auto& [option, name] : command.outputs) {
      Arguments all = command.with();
      all.insert(all.end(), {"--log", name});
      expect_failure(2, all, {name + ": is named for two outputs"});
    }
    for (const std::string& input : command.inputs) {
      const std::string before = text(input);
      refused(input, "is read by this command");
      EXPECT_EQ(text(input), before);
    }
  }
  EXPECT_GE(tried, 10);
  // One to which lines could be appended.
  expect_failure(2, {"query", "env.ovm", "empty", "-o", "a.csv", "--log", "empty"}, {"empty: is read by"});
  EXPECT_EQ(text("empty"), "");
  expect_failure(2, {"run", "file.json", "-o", "out", "--log", "cube.off"}, {"cube.off: is read by"});
  expect_failure(2, {"run", "s.json", "-o", "first", "--force", "--log", "first/log"},
                 {"first/log: lies in first"});
}

TEST_F(Outputs, WhatASceneReadsIsAnInput) {
  for (const char* input : {"env.ovm", "cube.off"}) {
    const std::string before = text(input);
    expect_failure(2, {"run", "file.json", "-o", "out", "--json", input},
                   {std::string(input) + ": is read by this command"});
    EXPECT_EQ(text(input), before);
  }
  fs::copy_file(path("env.ovm"), path("first/walls.vtu"), fs::copy_options::overwrite_existing);
  write("inside.json", R"({"environment": "first/walls.vtu", "particles": [{"count": 1}], "steps": 1})");
  expect_failure(2, {"run", "inside.json", "-o", "first", "--force"},
                 {"first: holds first/walls.vtu, which is read"});
  fs::copy_file(path("s.json"), path("first/s.json"));
  expect_failure(2, {"run", "first/s.json", "-o", "./first/", "--force"},
                 {"./first/: holds first/s.json, which is read"});
}

TEST_F(Outputs, NoneLiesInTheFolderOfARun) {
  expect_failure(2, {"run", "s.json", "-o", "out", "--json", "out/r.json"}, {"out/r.json: lies in out"});
  expect_failure(2, {"run", "s.json", "-o", "first", "--force", "--record", "first/m.trace"},
                 {"first/m.trace: lies in first"});
  // With checkpoints it is another one until the end.
  for (const std::string option : {"--json", "--record", "--log"}) {
    expect_failure(2, {"run", "s.json", "-o", "./out/", "--checkpoint-every", "1", option, "out.part/r"},
                   {"out.part/r: lies in ", "/out.part, which appears as a whole"});
    expect_failure(2, {"run", "s.json", "-o", "out", "--checkpoint-every", "1", option, "out.part"},
                   {"is named for two outputs"});
  }
}

TEST_F(Outputs, AFolderThatALinkLeadsToIsReplaced) {
  fs::create_directory_symlink("first", path("link"));
  succeed({"run", "s.json", "-o", "link", "--force"});
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(text("first/run.json"), text("link/run.json"));
  EXPECT_NE(text("first/run.json").find("\"side\": 0.3"), std::string::npos);
}

TEST_F(Outputs, StandardOutputTakesOne) {
  const std::string said = succeed({"query", "env.ovm", "moves.csv", "-o", "/dev/stdout"});
  EXPECT_TRUE(said.starts_with("row,status,")) << said;
  EXPECT_TRUE(said.ends_with("/dev/stdout: 1 motions: 1 free\n")) << said;
  write("log", "before\n");
  const std::string line = "cd '" + path("").string() + "' && " CELLWALK_PROGRAM " check env.ovm --json ";
  ASSERT_EQ(std::system((line + "/dev/stdout >> log").c_str()), 0);
  EXPECT_TRUE(text("log").starts_with("before\n{")) << "what a shell appends to is not replaced";
  const std::string env = text("env.ovm");
  EXPECT_EQ(std::system((line + "/dev/stdout >> env.ovm 2> err").c_str()) >> 8, 2);
  EXPECT_EQ(text("env.ovm"), env);
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  ASSERT_EQ(std::system(("cd '" + path("").string() +
                         "' && (cat pipe > got &) && " CELLWALK_PROGRAM
                         " check env.ovm --json pipe > said && while ! [ -s got ]; do sleep 0.01; done")
                            .c_str()),
            0);
  EXPECT_TRUE(text("got").starts_with("{\n  \"environment\": \"env.ovm\""));
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(Outputs, AFullDiskLeavesNothing) {
  // A limit of file sizes stands for the disk: 512 bytes, of which an environment needs more.
  const auto before = files();
  const std::string line = "cd '" + path("").string() +
                           "' && (ulimit -f 1; " CELLWALK_PROGRAM
                           " generate hexes --cells 9 -o big.ovm --json r.json > /dev/null 2> /dev/null)";
  EXPECT_EQ(std::system(("bash -c \"" + line + "\"").c_str()) >> 8, 1);
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace cellwalk::test
