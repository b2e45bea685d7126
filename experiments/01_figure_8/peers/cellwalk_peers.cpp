// SPDX-License-Identifier: LGPL-3.0-or-later
// Cellwalk itself: its steps by the rule of traces, exact and with contacts reported, in the certified
// environment of the trace.
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "families.h"

namespace cellwalk::figure_8 {
namespace {

/// The rule of these traces.
Body_trace touching() {
  Body_trace trace;
  trace.touch_blocks = true;
  return trace;
}

class Library_replay : public Peer {
 public:
  Library_replay(std::string name, std::shared_ptr<Environment<3>> environment,
                 std::shared_ptr<Locator<3>> locator, Sweep sweep)
      : name_(std::move(name)),
        environment_(std::move(environment)),
        locator_(std::move(locator)),
        options_(body_trace_options(sweep, touching())) {}

  std::string name() const override { return name_; }
  unsigned answer_bits() const override {
    return options_.sweep.sweep == Sweep::triangle ? segment_bits | triangle_bits : segment_bits;
  }
  void prepare(const Trace& trace) override {
    bodies_.clear();
    for (auto x = trace.start_positions.begin(); x != trace.start_positions.end(); x += trace_vertices)
      bodies_.emplace_back(environment_->snapshot(), *locator_,
                           Body_soup<3>{{x, x + trace_vertices}, hexahedron().edges, {}});
    counts_ = {};
  }
  void replay(const Trace& trace, std::span<std::uint8_t> answers) override {
    std::ranges::fill(answers, std::uint8_t{0});
    for (std::size_t at = 0; at < trace.targets.size();)
      for (Body<3>& body : bodies_) {
        report_.clear();
        body.step({&trace.targets[at], trace_vertices}, options_, report_, counts_);
        for (const Rejected_move<3>& move : report_.blocked) answers[at + move.vertex] = answer(move);
        at += trace_vertices;
      }
  }
  Counts count(const Trace& trace, std::span<std::uint8_t> answers) override {
    replay(trace, answers);
    const Body_counts& body = counts_;
    const Edge_counts& edges = body.edges;
    Counts counts;
    counts.walks = edges.walk.walks;
    counts.crossings = edges.walk.crossings;
    counts.signs = edges.walk.predicates.orientations;
    counts.fallbacks = edges.walk.predicates.fallbacks;
    counts.clear_moves = body.in_region;
    counts.certified_edges = edges.same_cell + edges.same_chain + edges.relinked;
    return counts;
  }

 private:
  std::uint8_t answer(const Rejected_move<3>& move) const {
    if (!move.is_vertex_blocked)
      return trace_answer(move.vertex, false, static_cast<unsigned>(move.edges),
                          static_cast<unsigned>(move.swept_edges));
    return (trace_segment_bit | trace_triangle_bits) & answer_bits();
  }

  std::string name_;
  std::shared_ptr<Environment<3>> environment_;
  std::shared_ptr<Locator<3>> locator_;
  Body_options options_;
  std::vector<Body<3>> bodies_;
  Step_report<3> report_;  ///< of one body in one step
  Body_counts counts_;
};

}  // namespace

void add_cellwalk_peers(const Grid_world& world, Peers& peers) {
  Build build;
  const Traced_grid grid{{world.trace->nx, world.trace->ny, world.trace->nz}, world.trace->obstacles};
  const auto environment = measured_build(
      build, "cell", [&] { return std::make_shared<Environment<3>>(trace_environment(grid)); });
  const auto locator = std::make_shared<Locator<3>>(environment->snapshot());
  for (const auto& [name, sweep] : {std::pair{"cellwalk_three_segments", Sweep::three_segments},
                                    std::pair{"cellwalk_triangle", Sweep::triangle}}) {
    peers.push_back(std::make_unique<Library_replay>(name, environment, locator, sweep));
    peers.back()->build = build;
  }
}

}  // namespace cellwalk::figure_8
