// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parts.h"

namespace cellwalk::cli {
namespace {

/// Of a list of `rows` rows of equal length, the columns [begin, end).
template <class T>
std::vector<T> columns_of(const std::vector<T>& values, std::size_t rows, std::size_t begin,
                          std::size_t end) {
  const std::size_t length = rows == 0 ? 0 : values.size() / rows;
  std::vector<T> part;
  part.reserve(rows * (end - begin));
  for (std::size_t row = 0; row < rows; ++row)
    part.insert(part.end(), values.begin() + static_cast<std::ptrdiff_t>(row * length + begin),
                values.begin() + static_cast<std::ptrdiff_t>(row * length + end));
  return part;
}

}  // namespace

Body_trace part_of(const Body_trace& trace, const Block& bodies) {
  Body_trace before, part;
  const auto copy = [&](Body_trace& to, std::size_t begin, std::size_t end) {
    to.bodies.assign(trace.bodies.begin() + static_cast<std::ptrdiff_t>(begin),
                     trace.bodies.begin() + static_cast<std::ptrdiff_t>(end));
  };
  copy(before, 0, bodies.begin);
  copy(part, bodies.begin, bodies.end);
  part.touch_blocks = trace.touch_blocks;
  part.grid = trace.grid;
  part.steps = trace.steps;
  const std::size_t vertex = before.vertices(), answer = before.answers_of_step();
  const std::size_t vertices = part.vertices(), answers = part.answers_of_step();
  part.before = columns_of(trace.before, trace.steps + std::size_t{1}, vertex, vertex + vertices);
  part.targets = columns_of(trace.targets, trace.steps, vertex, vertex + vertices);
  if (!trace.answers.empty()) part.answers = columns_of(trace.answers, trace.steps, answer, answer + answers);
  return part;
}

std::vector<double> per_move(std::vector<double> times, std::uint64_t moves) {
  for (double& time : times) time /= static_cast<double>(moves);
  return times;
}

}  // namespace cellwalk::cli
