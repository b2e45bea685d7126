// SPDX-License-Identifier: LGPL-3.0-or-later
// Cellwalk itself: the library's replay, exact and with contacts reported, in the certified environment of
// the scene.
#include <cellwalk/edge/chain.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>

#include "peer.h"

namespace cellwalk::real_scenes {
namespace {

/// Of so many steps, evenly spread, edges are looked up.
constexpr std::size_t sampled_steps = 32;

/// The mean number of cells that an edge lies in, where vertices stand before a step. Edges of length 0, as
/// wait at the entry of a catheter, are left out.
double mean_edge_cells(const Snapshot<3>& snapshot, const Locator<3>& locator, const Motion& motion) {
  std::size_t edges = 0, cells = 0;
  Walk_counts counts;
  const auto look_up = [&](const Particle<3>& a, const Particle<3>& b) {
    if (a.position == b.position) return;
    const Chain_result<3> found = find_chain(snapshot, a, b, counts, false);
    if (found.contact) return;
    ++edges;
    cells += found.chain.size() + 1;
  };
  const std::size_t steps = motion.trace.steps, stride = std::max<std::size_t>(1, steps / sampled_steps);
  for (std::size_t s = 0; s < steps; s += stride) {
    const auto positions = motion.trace.before_step(s);
    for (std::size_t b = 0; b < motion.bodies(); ++b) {
      std::vector<Particle<3>> particles;
      for (std::size_t v = motion.first_vertex[b]; v < motion.first_vertex[b + 1]; ++v)
        particles.push_back(locator.particle_at(positions[v]).value());
      for (const auto& [p, q] : motion.trace.bodies[b].edges) look_up(particles[p], particles[q]);
    }
  }
  return edges == 0 ? 0 : static_cast<double>(cells) / static_cast<double>(edges);
}

class Library_replay : public Peer {
 public:
  Library_replay(const Motion& motion, std::shared_ptr<Environment<3>> environment,
                 std::shared_ptr<Locator<3>> locator, Sweep sweep)
      : motion_(motion), environment_(std::move(environment)), locator_(std::move(locator)), sweep_(sweep) {}

  void prepare() override {
    replay_.emplace(environment_->snapshot(), *locator_, motion_.trace,
                    body_trace_options(sweep_, motion_.trace));
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
  const double edge_cells = mean_edge_cells(environment->snapshot(), *locator, motion);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    auto peer = std::make_unique<Library_replay>(motion, environment, locator, sweep);
    peer->name = sweep == Sweep::triangle ? "cellwalk_complete" : "cellwalk_three_segments";
    peer->library = "cellwalk";
    peer->is_exact = true;
    peer->build = build;
    peer->edge_cells = edge_cells;
    peers.push_back(std::move(peer));
  }
}

}  // namespace cellwalk::real_scenes
