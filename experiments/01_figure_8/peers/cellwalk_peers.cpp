// SPDX-License-Identifier: LGPL-3.0-or-later
// Cellwalk itself: the library's replay, exact and with contacts reported, in the certified environment of
// the trace.
#include <cellwalk/internal/simulation/replay.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "families.h"

namespace cellwalk::figure_8 {
namespace {

class Library_replay : public Peer {
 public:
  Library_replay(std::string name, std::shared_ptr<Environment<3>> environment,
                 std::shared_ptr<Locator<3>> locator, Sweep sweep)
      : name_(std::move(name)),
        environment_(std::move(environment)),
        locator_(std::move(locator)),
        sweep_(sweep) {}

  std::string name() const override { return name_; }
  unsigned answer_bits() const override {
    return sweep_ == Sweep::triangle ? segment_bits | triangle_bits : segment_bits;
  }
  void prepare(const Trace& trace) override {
    replay_.emplace(environment_->snapshot(), *locator_, trace, Replay_options{sweep_, true});
  }
  void replay(const Trace&, std::span<std::uint8_t> answers) override {
    replay_->run();
    std::ranges::copy(replay_->answers(), answers.begin());
  }
  Counts count(const Trace& trace, std::span<std::uint8_t> answers) override {
    replay(trace, answers);
    const Body_counts& body = replay_->counts().body;
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
  std::string name_;
  std::shared_ptr<Environment<3>> environment_;
  std::shared_ptr<Locator<3>> locator_;
  Sweep sweep_;
  std::optional<Replay> replay_;
};

}  // namespace

void add_cellwalk_peers(const Grid_world& world, Peers& peers) {
  Build build;
  const auto environment = measured_build(
      build, "cell", [&] { return std::make_shared<Environment<3>>(trace_environment(*world.trace)); });
  const auto locator = std::make_shared<Locator<3>>(environment->snapshot());
  for (const auto& [name, sweep] : {std::pair{"cellwalk_three_segments", Sweep::three_segments},
                                    std::pair{"cellwalk_triangle", Sweep::triangle}}) {
    peers.push_back(std::make_unique<Library_replay>(name, environment, locator, sweep));
    peers.back()->build = build;
  }
}

}  // namespace cellwalk::figure_8
