// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace cellwalk {

Body_options body_trace_options(Sweep sweep, const Body_trace& trace) {
  Body_options options;
  options.sweep.sweep = sweep;
  options.sweep.touch = trace.touch_blocks ? Touch::stop : Touch::pass;
  options.rule = Step_rule::reject_at_target;
  options.reports_blocked = true;
  return options;
}

std::vector<std::uint32_t> answerable_degrees(const Traced_body& body, std::size_t number) {
  constexpr std::uint32_t most_edges = 64;
  std::vector<std::uint32_t> counts = degrees(body);
  const auto most = std::ranges::max_element(counts);
  if (most != counts.end() && *most > most_edges)
    throw Error(Error_code::input,
                fmt::format("body {}: vertex {} has {} edges, and traces answer moves of vertices with {} at "
                            "most: leave the body out",
                            number, most - counts.begin(), *most, most_edges));
  return counts;
}

void append_body_answers(std::span<const std::uint32_t> degrees, std::span<const Rejected_move<3>> blocked,
                         Sweep sweep, std::vector<std::uint8_t>& answers) {
  auto move = blocked.begin();
  for (std::uint32_t v = 0; v < degrees.size(); ++v) {
    if (move == blocked.end() || move->vertex != v) {
      answers.resize(answers.size() + 1 + degrees[v]);
      continue;
    }
    const bool sweeps = sweep != Sweep::three_segments;
    answers.push_back(move->is_vertex_blocked ? body_trace_blocked : 0);
    for (std::uint32_t i = 0; i < degrees[v]; ++i) {
      const bool is_swept = move->is_vertex_blocked ? sweeps : (move->swept_edges >> i & 1) != 0;
      answers.push_back(static_cast<std::uint8_t>(((move->edges >> i & 1) != 0 ? body_trace_blocked : 0) |
                                                  (is_swept ? body_trace_swept : 0)));
    }
    ++move;
  }
}

Body_replay::Body_replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Body_trace& trace,
                         const Body_options& options, std::size_t first_body)
    : snapshot_(&snapshot), locator_(&locator), trace_(&trace), options_(options), first_body_(first_body) {
  if (options.sweep.sweep == Sweep::faces)
    throw Error(Error_code::usage,
                "faces are not answered in a trace: replay it by three_segments or triangle");
  for (std::size_t b = 0; b < trace.bodies.size(); vertices_ += trace.bodies[b++].vertices) {
    first_vertex_.push_back(vertices_);
    degrees_.push_back(answerable_degrees(trace.bodies[b], first_body + b));
    bodies_.push_back(registered(b, 0));
  }
  reports_.resize(bodies_.size());
  answers_.reserve(trace.steps * trace.answers_of_step());
}

std::span<const Point<3>> Body_replay::part(std::span<const Point<3>> of_step, std::size_t body) const {
  return of_step.subspan(first_vertex_[body], trace_->bodies[body].vertices);
}

Body<3> Body_replay::registered(std::size_t body, std::size_t step) const {
  const auto positions = part(trace_->before_step(step), body);
  try {
    // Faces are left alone by the rule, and a wall may pierce one: a body without them moves alike.
    return Body<3>(
        *snapshot_, *locator_,
        {{positions.begin(), positions.end()}, trace_->bodies[body].edges, {}, trace_->bodies[body].radii});
  } catch (const Error& error) {
    throw Error(error.code(),
                fmt::format("body {} before step {}: {}", first_body_ + body, step, error.what()));
  }
}

void Body_replay::prepare() {
  const auto before = trace_->before_step(steps_done_);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto positions = part(before, b);
    if (std::ranges::equal(bodies_[b].positions(), positions)) continue;
    Step_report<3>& report = reports_[b];
    report.clear();
    bodies_[b].step(positions, options_, report, counts_of_preparing_);
    if (std::ranges::equal(bodies_[b].positions(), positions)) continue;
    bodies_[b] = registered(b, steps_done_);
    ++registered_anew_;
  }
}

void Body_replay::step() {
  const Point<3>* targets = trace_->targets.data() + steps_done_ * vertices_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::uint32_t vertices = trace_->bodies[b].vertices;
    reports_[b].clear();
    bodies_[b].step({targets, vertices}, options_, reports_[b], counts_);
    targets += vertices;
  }
  ++steps_done_;
}

void Body_replay::note_answers() {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    append_body_answers(degrees_[b], reports_[b].blocked, options_.sweep.sweep, answers_);
}

void Body_replay::validate() {
  for (Body<3>& body : bodies_) {
    body.refresh(counts_of_preparing_);
    body.validate();
  }
}

std::uint64_t count_mismatches(const Body_trace& trace, std::span<const std::uint8_t> answers, Sweep sweep) {
  const std::uint8_t decided = sweep == Sweep::three_segments ? body_trace_blocked : body_trace_bits;
  std::uint64_t count = (trace.answers.size() - answers.size()) * std::popcount(decided);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto differ = static_cast<std::uint8_t>((trace.answers[i] ^ answers[i]) & decided);
    count += static_cast<std::uint64_t>(std::popcount(differ));
  }
  return count;
}

}  // namespace cellwalk
