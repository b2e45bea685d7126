// SPDX-License-Identifier: LGPL-3.0-or-later
#include "moves_file.h"

#include <cellwalk/internal/io/query_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace cellwalk::cli {
namespace {

/// The point of a row, around which all cells are simplices.
/// \throw Error(input) without file and line
template <int D>
std::uint32_t point_to_move(const io::Parsed_number& number, Environment<D>& environment) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const std::size_t count = snapshot.points().size();
  if (!number) throw Error(Error_code::input, number.reason);
  if (!(number.value >= 0 && number.value < static_cast<double>(count)) ||
      number.value != std::floor(number.value))
    throw Error(Error_code::input, fmt::format("there is no point {}: those of the environment are 0 to {}",
                                               io::shortest(number.value), count - 1));
  const auto point = static_cast<std::uint32_t>(number.value);
  for (const Cell c : environment.cells_around(point))
    if (snapshot.view(c).vertex_count() != D + 1)
      throw Error(Error_code::input,
                  fmt::format("point {} cannot be moved: cell {} at it is not a {}; split all cells of the "
                              "environment with `cellwalk import --simplicial`",
                              point, snapshot.index(c), D == 2 ? "triangle" : "tetrahedron"));
  return point;
}

}  // namespace

template <int D>
std::vector<Vertex_move<D>> read_moves(const std::string& path, Environment<D>& environment) {
  const io::Csv_table table = io::Csv_table::read(path);
  const std::size_t column = table.column("point");
  const auto targets = io::query_rows<D, 1>(table, {""});
  std::vector<Vertex_move<D>> moves;
  moves.reserve(targets.size());
  for (std::size_t row = 0; row < targets.size(); ++row) {
    const Query_row<D, 1>& target = targets[row];
    try {
      if (!target.error.empty()) throw Error(Error_code::input, target.error);
      moves.push_back({point_to_move(table.number(row, column), environment), target.points[0]});
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}:{}: {}", path, target.line, error.what()));
    }
  }
  return moves;
}

template std::vector<Vertex_move<2>> read_moves(const std::string&, Environment<2>&);
template std::vector<Vertex_move<3>> read_moves(const std::string&, Environment<3>&);

}  // namespace cellwalk::cli
