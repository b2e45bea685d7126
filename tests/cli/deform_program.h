// SPDX-License-Identifier: LGPL-3.0-or-later
// `cellwalk deform` as a user runs it, on small grids of simplices.
#ifndef CELLWALK_TESTS_CLI_DEFORM_PROGRAM_H
#define CELLWALK_TESTS_CLI_DEFORM_PROGRAM_H

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/ovm_text.h"
#include "cli/program.h"

namespace cellwalk::test {

using Row = std::vector<std::string>;

inline const Row header_in_space{"row",    "status", "time", "x",  "y",  "z",  "kind", "body", "feature",
                                 "number", "cx",     "cy",   "cz", "nx", "ny", "nz",   "cell"};
inline const Row header_in_plane{"row",     "status", "time", "x",  "y",  "kind", "body",
                                 "feature", "number", "cx",   "cy", "nx", "ny",   "cell"};

class Deform : public Program {
 protected:
  /// Squares of side 1 in the plane, 4 in a row and 2 high, as triangles. Point x + 5 y lies in (x,y).
  void make_plane(const std::vector<std::pair<std::size_t, std::size_t>>& membranes = {}) const {
    succeed({"generate", "squares", "--cells", "4", "2", "-o", "squares.ovm"});
    Ovm_text squares(text("squares.ovm"));
    for (const auto& [a, b] : membranes) squares.separate(a, b);
    write("squares.ovm", squares.text());
    succeed({"import", "squares.ovm", "--simplicial", "-o", "env.ovm"});
  }

  /// Cubes of side 1 as tetrahedra, 2 along each axis. Point x + 3 y + 9 z lies in (x,y,z).
  void make_space() const {
    succeed({"generate", "hexes", "--cells", "2", "-o", "hexes.ovm"});
    succeed({"import", "hexes.ovm", "--simplicial", "-o", "env.ovm"});
  }

  static std::vector<std::string> arguments(const std::vector<std::string>& options) {
    std::vector<std::string> all{"deform", "env.ovm", "moves.csv", "-o", "out.ovm"};
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }

  /// Makes the moves, expects that what is written is certified as reported, and returns the rows.
  std::vector<Row> deform(const std::string& moves, const std::vector<std::string>& options = {}) const {
    write("moves.csv", moves);
    std::vector<std::string> all = arguments(options);
    all.insert(all.end(), {"--report", "report.csv", "--json", "report.json"});
    said_ = succeed(all);
    report_ = nlohmann::json::parse(text("report.json"));
    succeed({"check", "out.ovm", "--duplicates", "keep", "--json", "check.json"});
    expect_same_certificate(path("report.json"), path("check.json"));
    std::vector<Row> rows = read_table(path("report.csv"));
    EXPECT_EQ(rows.at(0), report_["certificate"]["dimension"] == 3 ? header_in_space : header_in_plane);
    rows.erase(rows.begin());
    EXPECT_EQ(report_["moves"], rows.size());
    std::map<std::string, std::size_t> ends;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].at(0), std::to_string(i));
      ++ends[rows[i].at(1)];
    }
    for (const auto& [end, count] : report_["status"].items()) EXPECT_EQ(count, ends[end]) << end;
    return rows;
  }

  void refuse(int exit_code, const std::string& moves, const std::vector<std::string>& texts,
              const std::vector<std::string>& options = {"--report", "report.csv"}) const {
    write("moves.csv", moves);
    expect_failure(exit_code, arguments(options), texts);
  }

  /// The points of an environment file.
  std::vector<std::vector<double>> points(const std::string& name) const {
    std::istringstream stream(text(name));
    std::string word;
    while (word != "Vertices") stream >> word;
    std::size_t count = 0;
    stream >> count;
    std::vector<std::vector<double>> points(count, std::vector<double>(3));
    for (auto& point : points)
      for (double& x : point) stream >> x;
    return points;
  }

  mutable std::string said_;  // by the last command
  mutable nlohmann::json report_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_DEFORM_PROGRAM_H
