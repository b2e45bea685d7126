// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/simulation/trace_rule.h>

#include <array>

namespace cellwalk {
namespace {

/// Of each vertex, which of its edges leads to its i-th neighbour in ascending order.
constexpr auto edge_of = [] {
  std::array<std::array<std::uint8_t, trace_edges>, trace_vertices> table{};
  for (std::size_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < trace_edges; ++k) {
      std::size_t place = 0;
      for (std::size_t j = 0; j < trace_edges; ++j) place += trace_neighbour(v, j) < trace_neighbour(v, k);
      table[v][place] = static_cast<std::uint8_t>(k);
    }
  return table;
}();

}  // namespace

Body_options trace_options(Sweep sweep) {
  Body_options options;
  options.sweep.sweep = sweep;
  options.sweep.touch = Touch::stop;
  options.rule = Step_rule::reject_at_target;
  options.reports_blocked = true;
  return options;
}

std::uint8_t trace_answer(const Rejected_move<3>& blocked, Sweep sweep) {
  if (blocked.is_vertex_blocked)
    return sweep == Sweep::triangle ? trace_segment_bit | trace_triangle_bits : trace_segment_bit;
  std::uint8_t answer = 0;
  for (std::size_t i = 0; i < trace_edges; ++i) {
    const auto k = edge_of[blocked.vertex][i];
    answer |= static_cast<std::uint8_t>((blocked.edges >> i & 1) << (1 + k) | (blocked.swept_edges >> i & 1)
                                                                                  << (4 + k));
  }
  return answer;
}

void append_answers(std::span<const Rejected_move<3>> blocked, Sweep sweep,
                    std::vector<std::uint8_t>& answers) {
  const std::size_t first = answers.size();
  answers.resize(first + trace_vertices);
  for (const Rejected_move<3>& move : blocked) answers[first + move.vertex] = trace_answer(move, sweep);
}

}  // namespace cellwalk
