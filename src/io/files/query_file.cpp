// SPDX-License-Identifier: LGPL-3.0-or-later
// The columns of points in a table, and the reason why a row is invalid.
#include <cellwalk/internal/io/query_file.h>

#include <fmt/format.h>

#include "text.h"

namespace cellwalk::io {

Parsed_number radius_of(const Csv_table& table, std::size_t row, std::size_t column) {
  Parsed_number number = table.number(row, column);
  if (number) number.reason = radius_problem(number.value);
  return number;
}

template <int D, std::size_t N>
std::vector<Query_row<D, N>> query_rows(const Csv_table& table,
                                        const std::array<std::string_view, N>& prefixes, double radius) {
  constexpr std::string_view axes = "xyz";
  std::array<std::array<std::size_t, D>, N> columns;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < D; ++k)
      columns[i][k] = table.column(fmt::format("{}{}", prefixes[i], axes[k]));
    const std::string z = fmt::format("{}z", prefixes[i]);
    if (D == 2 && table.find_column(z))
      fail(table.name(), fmt::format("has a column '{}', and the environment is 2D: leave z out", z));
  }
  const auto radii = N > 1 ? table.find_column("radius") : std::nullopt;
  std::vector<Query_row<D, N>> rows(table.row_count());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].line = table.line(r);
    if (const auto problem = table.row_problem(r)) rows[r].error = *problem;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < D && rows[r].error.empty(); ++k) {
        const Parsed_number number = table.number(r, columns[i][k]);
        rows[r].points[i][k] = number.value;
        rows[r].error = number.reason;
      }
    rows[r].radius = radius;
    if (!radii || !rows[r].error.empty()) continue;
    const Parsed_number number = radius_of(table, r, *radii);
    rows[r].radius = number.value;
    rows[r].error = number.reason;
  }
  return rows;
}

template std::vector<Query_row<2, 1>> query_rows(const Csv_table&, const std::array<std::string_view, 1>&,
                                                 double);
template std::vector<Query_row<3, 1>> query_rows(const Csv_table&, const std::array<std::string_view, 1>&,
                                                 double);
template std::vector<Query_row<2, 2>> query_rows(const Csv_table&, const std::array<std::string_view, 2>&,
                                                 double);
template std::vector<Query_row<3, 2>> query_rows(const Csv_table&, const std::array<std::string_view, 2>&,
                                                 double);
template std::vector<Query_row<2, 3>> query_rows(const Csv_table&, const std::array<std::string_view, 3>&,
                                                 double);
template std::vector<Query_row<3, 3>> query_rows(const Csv_table&, const std::array<std::string_view, 3>&,
                                                 double);

}  // namespace cellwalk::io
