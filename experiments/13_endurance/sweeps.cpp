// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges without a radius that move on and on in one world, one end at a time.
#include <optional>
#include <type_traits>
#include <utility>

#include "membrane_judge.h"
#include "trial.h"
#include "wrong.h"

namespace cellwalk::endurance {
namespace {

/// \tparam walls solid cells alone, or membranes, too
template <int D, Walls walls>
class Sweep_trial {
 public:
  explicit Sweep_trial(const Trial& trial)
      : trial_(trial),
        draw_(trial.seed),
        bits_(bits_of(trial.population.grid, sweep_bits)),
        world_(random_lattice<D>(trial.population.cut, walls, draw_),
               random_placement<D>(Placing::affine, bits_, reach_in_cells, draw_), bits_),
        judge_(make_judge(world_)),
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
  static constexpr bool with_membranes = walls == Walls::any;
  using Judge = std::conditional_t<with_membranes, Membrane_judge<D>, Sweep_judge<D>>;

  static Judge make_judge(const World<D>& world) {
    if constexpr (with_membranes)
      return Judge(world);
    else
      return Judge(world.lattice, world.bits);
  }

  /// A particle on any side of walls.
  std::optional<Particle<D>> particle_at(const Site<D>& x) {
    const auto particles = world_.locator.particles_at(world_.place(x));
    if (particles.size() < 2) return particles.empty() ? std::nullopt : std::optional(particles[0]);
    return particles[draw_.whole(static_cast<std::uint32_t>(particles.size()))];
  }

  /// An edge in free space.
  void begin() {
    for (;;) {
      p_at_ = sites_.begin(draw_);
      q_at_ = sites_.next(p_at_, draw_);
      const auto p = particle_at(p_at_);
      if (!p) continue;
      const auto q = particle_at(q_at_);
      if (!q) continue;
      const Chain_result<D> edge = find_chain(world_.snapshot(), *p, *q, counts_.walk);
      const std::uint32_t p_cell = world_.snapshot().index(p->cell),
                          q_cell = world_.snapshot().index(q->cell);
      // Among membranes the edge may lead to the other side of one at its end.
      const bool is_free = !edge.contact;
      const bool is_right = is_free ? is_passed(world_, p_at_, q_at_, p_cell, q_cell, edge.chain)
                                    : with_membranes || !judge_.walks().follow(p_cell, p_at_, q_at_).arrives;
      if (!is_right) note({p_at_, p_at_, q_at_}, "wrong chain of an edge at rest");
      if (!is_free || !is_right) continue;
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
    const std::optional<Sweep_truth> judged = judge(move);
    if (!judged) return;
    const Sweep_truth& truth = *judged;
    const Sweep_result<D> result =
        sweep_edge(world_.snapshot(), p_, world_.place(move.b), q_, chain_, {}, counts_);
    Sweep_fault fault = fault_of(world_, truth, move, q_, result);
    if constexpr (with_membranes)
      if (fault == Sweep_fault::none && truth.is_free &&
          !judge_.is_chain_after(cells_of(result.p, result.chain), move))
        fault = Sweep_fault::wrong_chain;
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

  Edge_cells cells_of(const Particle<D>& p, const Chain& chain) const {
    return {world_.snapshot().index(p.cell), world_.snapshot().index(q_.cell), &chain};
  }

  /// Nothing if the triangle lies in a plane of facets, among which may be membranes.
  std::optional<Sweep_truth> judge(const Edge_sites<D>& move) {
    if constexpr (with_membranes)
      return judge_.judge(cells_of(p_, chain_), move);
    else
      return judge_.judge(world_.snapshot().index(p_.cell), move);
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
  Judge judge_;
  Sites<D> sites_;
  Site<D> p_at_{}, q_at_{};
  Particle<D> p_{}, q_{};
  Chain chain_;
  Edge_counts counts_;
  Tally tally_;
};

}  // namespace

Tally judge_sweeps(const Trial& trial) {
  return trial.population.dimension == 2 ? Sweep_trial<2, Walls::solid>(trial).run()
                                         : Sweep_trial<3, Walls::solid>(trial).run();
}

Tally judge_membrane_sweeps(const Trial& trial) {
  return trial.population.dimension == 2 ? Sweep_trial<2, Walls::any>(trial).run()
                                         : Sweep_trial<3, Walls::any>(trial).run();
}

}  // namespace cellwalk::endurance
