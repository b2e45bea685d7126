// SPDX-License-Identifier: LGPL-3.0-or-later
// The rows of a table as moves, each of a point whose cells are all simplices.
#include "moves_file.h"

#include <cellwalk/internal/io/query_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

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

template <int D>
std::vector<Vertex_move<D>> moves_of(const io::Csv_table& table, const std::string& path,
                                     Environment<D>& environment) {
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

constexpr double most_steps = 100'000'000;

}  // namespace

void refuse_other_numbers(const std::string& path, const Build_report& built) {
  if (built.unused_points != 0)
    throw Error(Error_code::input,
                fmt::format("{}: {} of its points belong to no cell, so the numbers of others may change: "
                            "write it without them by `cellwalk import`",
                            path, built.unused_points));
}

template <int D>
std::vector<Vertex_move<D>> read_moves(const std::string& path, Environment<D>& environment) {
  return moves_of(io::Csv_table::read(path), path, environment);
}

template <int D>
std::vector<Timed_move<D>> read_timed_moves(const std::string& path, Environment<D>& environment) {
  const io::Csv_table table = io::Csv_table::read(path);
  const std::size_t column = table.column("step");
  const std::vector<Vertex_move<D>> moves = moves_of(table, path, environment);
  std::vector<Timed_move<D>> result;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::size_t row = 0; row < moves.size(); ++row) {
    const auto refuse = [&](const std::string& what) {
      throw Error(Error_code::input, fmt::format("{}:{}: {}", path, table.line(row), what));
    };
    const io::Parsed_number number = table.number(row, column);
    if (!number) refuse(number.reason);
    if (!(number.value >= 1 && number.value <= most_steps) || number.value != std::floor(number.value))
      refuse(fmt::format("there is no step {}: steps are counted from 1", io::shortest(number.value)));
    const auto step = static_cast<std::uint32_t>(number.value);
    if (!seen.emplace(step, moves[row].point).second)
      refuse(fmt::format("point {} has two places in step {}: give one", moves[row].point, step));
    result.push_back({step, moves[row]});
  }
  std::ranges::stable_sort(result, {}, &Timed_move<D>::step);
  return result;
}

template std::vector<Vertex_move<2>> read_moves(const std::string&, Environment<2>&);
template std::vector<Vertex_move<3>> read_moves(const std::string&, Environment<3>&);
template std::vector<Timed_move<2>> read_timed_moves(const std::string&, Environment<2>&);
template std::vector<Timed_move<3>> read_timed_moves(const std::string&, Environment<3>&);

}  // namespace cellwalk::cli
