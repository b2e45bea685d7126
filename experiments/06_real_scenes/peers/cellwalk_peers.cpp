// SPDX-License-Identifier: LGPL-3.0-or-later
// Cellwalk itself: the library's replay, exact and with contacts reported, in the certified environment of
// the scene.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/walk/locate.h>

#include "peer.h"

namespace cellwalk::real_scenes {
namespace {

class Library_replay : public Peer {
 public:
  Library_replay(const Motion& motion, std::shared_ptr<Environment<3>> environment,
                 std::shared_ptr<Locator<3>> locator, Sweep sweep)
      : motion_(motion), environment_(std::move(environment)), locator_(std::move(locator)), sweep_(sweep) {}

  void prepare() override {
    replay_.emplace(environment_->snapshot(), *locator_, motion_.trace, body_trace_options(sweep_));
  }
  void place(std::span<const Point<3>>) override { replay_->prepare(); }
  void step(std::span<const Point<3>>, std::span<std::uint8_t>) override { replay_->step(); }
  void note(std::span<std::uint8_t> blocked) override {
    const std::size_t known = replay_->answers().size();
    replay_->note_answers();
    note_blocked(motion_, replay_->answers().subspan(known), blocked);
  }
  std::optional<Body_counts> counts() const override { return replay_->counts(); }

 private:
  const Motion& motion_;
  std::shared_ptr<Environment<3>> environment_;
  std::shared_ptr<Locator<3>> locator_;
  Sweep sweep_;
  std::optional<Body_replay> replay_;
};

}  // namespace

void add_cellwalk_peers(const Scene_walls& walls, const Motion& motion, Peers& peers) {
  Build build;
  const auto environment = experiments::measured_build(build, "cell", [&] {
    const Build_options options{.duplicates = Duplicate_vertices::keep, .split = false, .keep_map = false};
    return std::make_shared<Environment<3>>(Environment<3>::build(*walls.soup, options));
  });
  const auto locator = std::make_shared<Locator<3>>(environment->snapshot());
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    auto peer = std::make_unique<Library_replay>(motion, environment, locator, sweep);
    peer->name = sweep == Sweep::triangle ? "cellwalk_complete" : "cellwalk_three_segments";
    peer->library = "cellwalk";
    peer->is_exact = true;
    peer->build = build;
    peers.push_back(std::move(peer));
  }
}

}  // namespace cellwalk::real_scenes
