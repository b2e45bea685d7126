// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles that walk on and on in one world.
#include <optional>

#include "sweep_judge.h"
#include "trial.h"
#include "walk_judge.h"
#include "wrong.h"

namespace cellwalk::endurance {
namespace {

template <int D>
class Walk_trial {
 public:
  explicit Walk_trial(const Trial& trial)
      : trial_(trial),
        draw_(trial.seed),
        bits_(bits_of(trial.population.grid, walk_bits)),
        world_(random_lattice<D>(trial.population.cut, Walls::any, draw_),
               random_placement<D>(Placing::affine, bits_, reach_in_cells, draw_), bits_),
        judge_(world_.lattice, bits_),
        sites_(world_.lattice, trial.population.grid, bits_) {}

  Tally run() {
    for (int left = 0; tally_.motions < trial_.motions; --left) {
      if (left == 0) {
        begin();
        left = moves_of_run;
      }
      walk();
    }
    return tally_;
  }

 private:
  /// A particle in free space, on any side of walls.
  void begin() {
    for (;;) {
      at_ = sites_.begin(draw_);
      const auto particles = world_.locator.particles_at(world_.place(at_));
      if (particles.empty()) continue;
      particle_ = particles[draw_.whole(static_cast<std::uint32_t>(particles.size()))];
      return;
    }
  }

  void walk() {
    Walk_motion<D> motion;
    motion.a = at_;
    motion.b = sites_.next(at_, draw_);
    motion.from = particle_.position;
    motion.to = world_.place(motion.b);
    motion.cell = world_.snapshot().index(particle_.cell);
    const Walk_result<D> result = move(world_.snapshot(), particle_, motion.to, counts_);
    const bool is_placed =
        !world_.lattice.is_solid(motion.cell) && holds(world_.lattice, bits_, motion.cell, at_);
    const Walk_truth& truth = judge_.follow(motion.cell, motion.a, motion.b);
    const Walk_fault fault =
        is_placed ? fault_of(world_, judge_, truth, motion, result) : Walk_fault::wrong_cell;
    ++tally_.motions;
    tally_.degenerate += truth.degenerate;
    tally_.blocked += !truth.arrives;
    if (fault != Walk_fault::none) note(motion, fault);
    if (truth.arrives && fault == Walk_fault::none) at_ = motion.b;
    if (fault != Walk_fault::none) begin();
  }

  void note(const Walk_motion<D>& motion, Walk_fault fault) {
    if (tally_.wrong++ == 0)
      keep_walk(trial_, world_, motion, walk_fault_names[static_cast<std::size_t>(fault)]);
  }

  const Trial& trial_;
  Draw draw_;
  const int bits_;
  const World<D> world_;
  Walk_judge<D> judge_;
  Sites<D> sites_;
  Site<D> at_{};
  Particle<D> particle_{};
  Walk_counts counts_;
  Tally tally_;
};

}  // namespace

Tally judge_walks(const Trial& trial) {
  return trial.population.dimension == 2 ? Walk_trial<2>(trial).run() : Walk_trial<3>(trial).run();
}

}  // namespace cellwalk::endurance
