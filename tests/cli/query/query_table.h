// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs `cellwalk query` on a table and reads the answers.
#ifndef CELLWALK_TESTS_CLI_QUERY_QUERY_TABLE_H
#define CELLWALK_TESTS_CLI_QUERY_QUERY_TABLE_H

#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {

class Query_table : public Program {
 protected:
  using Row = std::vector<std::string>;

  explicit Query_table(Row header) : header_(std::move(header)) {}

  /// Runs the query `queries.csv` on `env.ovm` and returns the rows of answers.
  std::vector<Row> query(const std::string& queries, const std::vector<std::string>& options = {}) const {
    const Outcome outcome = run(arguments(queries, options));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    said_ = outcome.out;
    warned_ = outcome.err;
    auto rows = read_table(path("out.csv"));
    EXPECT_EQ(rows.at(0), header_);
    rows.erase(rows.begin());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].size(), header_.size());
      EXPECT_EQ(rows[i].at(0), std::to_string(i));
    }
    return rows;
  }

  void expect_refused(int exit_code, const std::string& queries, const std::vector<std::string>& texts,
                      const std::vector<std::string>& options = {}) const {
    expect_failure(exit_code, arguments(queries, options), texts);
  }

  /// Options of every query.
  std::vector<std::string> always_;
  mutable std::string said_, warned_;  // by the last query

 private:
  std::vector<std::string> arguments(const std::string& queries,
                                     const std::vector<std::string>& options) const {
    write("queries.csv", queries);
    std::vector<std::string> arguments{"query", "env.ovm", "queries.csv", "-o", "out.csv"};
    arguments.insert(arguments.end(), always_.begin(), always_.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }

  Row header_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_QUERY_QUERY_TABLE_H
