// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled environments, as the commands write, read and refuse them.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/program.h"
#include "environment/images.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class Compiled_file : public Program {
 protected:
  /// Makes env.ovm, and of it env.cellwalk.
  void make(const std::vector<std::string>& kind) const {
    std::vector<std::string> all{"generate"};
    all.insert(all.end(), kind.begin(), kind.end());
    all.insert(all.end(), {"-o", "env.ovm"});
    succeed(all);
    succeed({"import", "env.ovm", "-o", "env.cellwalk"});
  }
  /// The same bytes, but for some that are written over.
  void damage(const std::string& name, std::size_t at, const std::string& bytes) const {
    std::string all = text("env.cellwalk");
    ASSERT_LE(at + bytes.size(), all.size());
    ASSERT_NE(all.substr(at, bytes.size()), bytes);
    write(name, all.replace(at, bytes.size(), bytes));
  }
};

TEST_F(Compiled_file, IsTheEnvironmentItWasMadeOf) {
  for (const std::vector<std::string>& kind :
       {std::vector<std::string>{"vessel"}, {"room2d"}, {"lattice"}, {"hexes", "--cells", "4"}}) {
    SCOPED_TRACE(kind[0]);
    make(kind);
    EXPECT_EQ(text("env.cellwalk").substr(0, 8), "CELLWALK");
    succeed({"check", "env.ovm", "--json", "known.json"});
    succeed({"check", "env.cellwalk", "--json", "check.json"});
    expect_same_certificate(path("check.json"), path("known.json"));

    // Written as text, it is what import writes of the text itself.
    succeed({"import", "env.cellwalk", "-o", "back.ovm", "--json", "report.json"});
    EXPECT_NE(text("report.json").find("Cellwalk, compiled"), std::string::npos);
    succeed({"import", "env.ovm", "-o", "known.ovm"});
    EXPECT_EQ(text("back.ovm"), text("known.ovm"));
    succeed({"import", "env.cellwalk", "-o", "again.cellwalk"});
    EXPECT_EQ(text("again.cellwalk"), text("env.cellwalk"));
  }
}

TEST_F(Compiled_file, IsReadFromPipes) {
  make({"hexes", "--cells", "3"});
  succeed({"check", "env.ovm", "--json", "known.json"});
  const std::string program = CELLWALK_PROGRAM;
  int read = 0;
  for (const std::string file : {"env.ovm", "env.cellwalk"})
    for (const std::string command :
         {"cat FILE | P check /dev/stdin --json out.json", "P check /dev/stdin --json out.json < FILE",
          "P check <(cat FILE) --json out.json",
          "rm -f f && mkfifo f && (cat FILE > f &) && P check f --json out.json",
          "gzip -c env.ovm | P check /dev/stdin --json out.json",
          "cat FILE | P import /dev/stdin -o copy.ovm && P check copy.ovm --json out.json"}) {
      std::string line = command;
      for (const auto& [word, text] : {std::pair{"FILE", file}, {"P ", program + " "}})
        for (std::size_t at = 0; (at = line.find(word, at)) != line.npos; at += text.size())
          line.replace(at, std::string(word).size(), text);
      SCOPED_TRACE(line);
      std::filesystem::remove(path("out.json"));
      const std::string shell =
          "cd '" + path("").string() + "' && timeout 20 bash -c '" + line + "' > said 2>&1";
      ASSERT_EQ(std::system(shell.c_str()), 0) << text("said");
      expect_same_certificate(path("out.json"), path("known.json"));
      ++read;
    }
  EXPECT_EQ(read, 12);
}

TEST_F(Compiled_file, AnswersAsTheTextDoes) {
  make({"hexes", "--cells", "5", "5", "5", "--solid", "0.1", "--seed", "3"});
  std::string rows = "ax,ay,az,bx,by,bz\n";
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 6; ++k) {
      if (k > 0) rows += ',';
      rows += std::to_string(0.05 + (i * (7 + 3 * k) + 11 * k) % 98 * 0.05);
    }
    rows += "\n";
  }
  write("moves.csv", rows);
  succeed({"query", "env.ovm", "moves.csv", "-o", "known.csv"});
  succeed({"query", "env.cellwalk", "moves.csv", "-o", "answers.csv"});
  EXPECT_EQ(text("answers.csv"), text("known.csv"));
  EXPECT_NE(text("answers.csv").find("contact"), std::string::npos);
}

TEST_F(Compiled_file, IsKnownByItsContentToo) {
  make({"squares", "--cells", "3"});
  std::filesystem::rename(path("env.cellwalk"), path("env.bin"));
  succeed({"check", "env.bin", "--json", "check.json"});
  EXPECT_EQ(json::parse(text("check.json"))["certificate"]["cells"], 9);
}

TEST_F(Compiled_file, IsWrittenByGenerateEditAndDeform) {
  succeed({"generate", "squares", "--cells", "4", "3", "-o", "squares.cellwalk"});
  succeed({"import", "squares.cellwalk", "--simplicial", "-o", "env.cellwalk"});
  write("changes.json",
        R"({"groups": {"door": {"plane": [[2, 0], [1, 0]]}}, "changes": [{"close": "door"}]})");
  succeed({"edit", "env.cellwalk", "changes.json", "-o", "shut.cellwalk"});
  succeed({"edit", "env.cellwalk", "changes.json", "-o", "shut.ovm"});
  succeed({"check", "shut.ovm", "--json", "known.json"});
  succeed({"check", "shut.cellwalk", "--json", "check.json"});
  expect_same_certificate(path("check.json"), path("known.json"));
  EXPECT_EQ(json::parse(text("check.json"))["certificate"]["membranes"], 3);

  write("moves.csv", "point,x,y\n6,1.25,1\n");
  succeed({"deform", "env.cellwalk", "moves.csv", "-o", "moved.cellwalk"});
  succeed({"deform", "env.cellwalk", "moves.csv", "-o", "moved.ovm"});
  succeed({"import", "moved.cellwalk", "-o", "back.ovm"});
  succeed({"import", "moved.ovm", "-o", "known.ovm"});
  EXPECT_EQ(text("back.ovm"), text("known.ovm"));
}

TEST_F(Compiled_file, KeepsGroups) {
  make({"squares", "--cells", "4", "3"});
  std::string named = text("env.ovm");
  const std::size_t faces = 12;
  named += "FProp bool \"group ward\"\n";
  for (std::size_t f = 0; f < faces; ++f) named += f < 2 ? "1\n" : "0\n";
  write("named.ovm", named);
  succeed({"import", "named.ovm", "-o", "named.cellwalk"});
  write("changes.json", R"({"changes": [{"fill": "ward"}]})");
  succeed({"edit", "named.cellwalk", "changes.json", "-o", "filled.ovm", "--json", "report.json"});
  EXPECT_EQ(json::parse(text("report.json"))["certificate"]["solid_cells"], 2);
  EXPECT_NE(text("filled.ovm").find("group ward"), std::string::npos);
}

TEST_F(Compiled_file, SplitsCellsWhereSimplicesAreAskedFor) {
  make({"squares", "--cells", "3"});
  succeed({"import", "env.cellwalk", "--simplicial", "-o", "simplices.cellwalk", "--json", "report.json"});
  EXPECT_EQ(json::parse(text("report.json"))["certificate"]["cells"], 18);
}

TEST_F(Compiled_file, DamagedFilesAreRefused) {
  make({"hexes", "--cells", "2"});
  const std::string whole = text("env.cellwalk");
  const auto refused = [&](const std::string& name, const std::string& why) {
    SCOPED_TRACE(name);
    expect_failure(3, {"check", name}, {name + ": ", why});
    expect_failure(3, {"import", name, "-o", "out.ovm"}, {name + ": ", why});
  };
  for (const std::size_t length : {std::size_t{8}, std::size_t{63}, std::size_t{200}, whole.size() - 1}) {
    const std::string name = "cut" + std::to_string(length) + ".cellwalk";
    write(name, whole.substr(0, length));
    refused(name,
            "this compiled environment is damaged: it is cut short; make it again, by `cellwalk import`");
  }
  write("empty.cellwalk", "");
  refused("empty.cellwalk", "this is no compiled environment");
  write("text.cellwalk", text("env.ovm"));
  refused("text.cellwalk", "this is no compiled environment");
  write("longer.cellwalk", whole + "x");
  refused("longer.cellwalk", "more follows its end");
  damage("older.cellwalk", 8, std::string("\x00\x00\x00\x00", 4));
  refused("older.cellwalk", "was compiled in version 0 of the format, and this program reads version 2");
  damage("foreign.cellwalk", 12, "\x01\x02\x03\x04");
  refused("foreign.cellwalk", "compiled on a machine of another byte order");
  damage("flipped.cellwalk", whole.size() - 8, "\x7f");
  refused("flipped.cellwalk", "a checksum differs");
}

TEST_F(Compiled_file, ContentThatIsNoneIsFoundWhateverItsChecksums) {
  make({"squares", "--cells", "3"});
  const std::string whole = text("env.cellwalk");
  int tried = 0;
  constexpr std::size_t cells = 9, lanes = 4, word = 4;
  for (std::size_t place = 0; place < cells * lanes; ++place)
    for (std::size_t other = place / lanes * lanes; other < place; ++other) {
      // Two facets of a cell lead where the other one did.
      std::string changed = whole;
      const auto image = std::as_writable_bytes(std::span(changed));
      const std::span<std::byte> links = section_of(image, "links");
      std::swap_ranges(&links[place * word], &links[place * word] + word, &links[other * word]);
      if (changed == whole) continue;  // both are of the boundary
      seal(image);
      write("changed.cellwalk", changed);
      expect_failure(3, {"check", "changed.cellwalk"},
                     {"changed.cellwalk: this compiled environment is damaged"});
      ++tried;
    }
  EXPECT_EQ(tried, 50);  // 6 of each cell, but for those at a corner
}

}  // namespace
}  // namespace cellwalk::test
