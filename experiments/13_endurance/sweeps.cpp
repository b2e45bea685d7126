// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges without a radius that move on and on in one world, one end at a time.
#include <utility>

#include "sweep_judge.h"
#include "trial.h"
#include "wrong.h"

namespace cellwalk::endurance {
namespace {

template <int D>
class Sweep_trial {
 public:
  explicit Sweep_trial(const Trial& trial)
      : trial_(trial),
        draw_(trial.seed),
        bits_(bits_of(trial.population.grid, sweep_bits)),
        world_(random_lattice<D>(trial.population.cut, Walls::solid, draw_),
               random_placement<D>(Placing::affine, bits_, reach_in_cells, draw_), bits_),
        judge_(world_.lattice, bits_),
        sites_(world_.lattice, trial.population.grid, bits_) {}

  Tally run() {
    for (int left = 0; tally_.motions < trial_.motions; --left) {
      if (left == 0) {
        begin();
        left = moves_of_run;
      }
      sweep();
    }
    return tally_;
  }

 private:
  /// An edge in free space.
  void begin() {
    for (;;) {
      p_at_ = sites_.begin(draw_);
      q_at_ = sites_.next(p_at_, draw_);
      const auto p = world_.locator.particle_at(world_.place(p_at_));
      if (!p) continue;
      const auto q = world_.locator.particle_at(world_.place(q_at_));
      if (!q) continue;
      const Chain_result<D> edge = find_chain(world_.snapshot(), *p, *q, counts_.walk);
      const bool is_free = judge_.walks().follow(world_.snapshot().index(p->cell), p_at_, q_at_).arrives;
      if (is_free == edge.contact.has_value()) note({p_at_, p_at_, q_at_}, "wrong chain of an edge at rest");
      if (edge.contact || !is_free) continue;
      p_ = *p;
      q_ = *q;
      chain_ = edge.chain;
      return;
    }
  }

  void sweep() {
    if (draw_.whole(2) == 0) {
      chain_ = reversed(world_.snapshot(), chain_);
      std::swap(p_, q_);
      std::swap(p_at_, q_at_);
    }
    const Edge_sites<D> move{p_at_, target(), q_at_};
    const Sweep_result<D> result =
        sweep_edge(world_.snapshot(), p_, world_.place(move.b), q_, chain_, {}, counts_);
    const Sweep_truth truth = judge_.judge(world_.snapshot().index(p_.cell), move);
    const Sweep_fault fault = fault_of(world_, truth, move, q_, result);
    ++tally_.motions;
    tally_.degenerate += truth.degenerate;
    tally_.blocked += !truth.is_free;
    tally_.by_edge += !truth.is_free && !truth.by_vertex;
    if (fault != Sweep_fault::none) {
      note(move, sweep_fault_names[static_cast<std::size_t>(fault)]);
      begin();
    } else if (truth.is_free) {
      p_at_ = move.b;
      p_ = result.p;
      chain_ = result.chain;
    }
  }

  /// Some edges lead exactly through points of the coarse grid at the end.
  Site<D> target() {
    if (trial_.population.grid != Grid::mixed || draw_.whole(4) > 0) return sites_.next(p_at_, draw_);
    const Site<D> through = sites_.coarse_near(q_at_, draw_);
    Site<D> x;
    for (std::size_t i = 0; i < D; ++i) x[i] = 2 * through[i] - q_at_[i];
    return x;
  }

  void note(const Edge_sites<D>& move, const char* what) {
    if (tally_.wrong++ == 0) keep_sweep(trial_, world_, move, 0, what);
  }

  const Trial& trial_;
  Draw draw_;
  const int bits_;
  const World<D> world_;
  Sweep_judge<D> judge_;
  Sites<D> sites_;
  Site<D> p_at_{}, q_at_{};
  Particle<D> p_{}, q_{};
  Chain chain_;
  Edge_counts counts_;
  Tally tally_;
};

}  // namespace

Tally judge_sweeps(const Trial& trial) {
  return trial.population.dimension == 2 ? Sweep_trial<2>(trial).run() : Sweep_trial<3>(trial).run();
}

}  // namespace cellwalk::endurance
