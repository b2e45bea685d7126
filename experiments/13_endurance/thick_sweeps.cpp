// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges with a radius that move on and on in one world, one end at a time.
#include <algorithm>
#include <utility>

#include "thick_judge.h"
#include "trial.h"
#include "wrong.h"

namespace cellwalk::endurance {
namespace {

template <int D>
class Thick_trial {
 public:
  explicit Thick_trial(const Trial& trial)
      : trial_(trial),
        draw_(trial.seed),
        bits_(bits_of(trial.population.grid, thick_bits)),
        world_(random_lattice<D>(trial.population.cut, Walls::few, draw_),
               random_placement<D>(Placing::similarity, bits_, reach_in_cells, draw_), bits_),
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
  /// An edge in free space that keeps its radius from all walls.
  void begin() {
    do {
      do p_at_ = sites_.begin(draw_);
      while (!is_in_free_cell(p_at_));
      q_at_ = sites_.next(p_at_, draw_);
      radius_ = radius();
    } while (!judge_.starts_free({p_at_, p_at_, q_at_}, radius_));
  }

  bool is_in_free_cell(const Site<D>& x) const {
    for (std::uint32_t c = 0; c < world_.lattice.cell_count(); ++c)
      if (!world_.lattice.is_solid(c) && holds(world_.lattice, bits_, c, x)) return true;
    return false;
  }

  /// Up to half a cell: mostly the distance of an end to a plane that may be a wall, or a multiple of an
  /// eighth.
  Whole radius() {
    const Whole unit = Whole{1} << bits_;
    if (trial_.population.grid != Grid::fine && draw_.whole(4) > 0) {
      const Whole x = (draw_.whole(2) == 0 ? p_at_ : q_at_)[draw_.whole(D)];
      const Whole rest = std::min(x & (unit - 1), -x & (unit - 1));
      return rest > 0 ? rest : unit / 8 * draw_.whole(Whole{1}, Whole{4});
    }
    return std::max(Whole{1}, draw_.whole(Whole{1}, unit / 2) >> draw_.whole(4));
  }

  void sweep() {
    if (draw_.whole(2) == 0) std::swap(p_at_, q_at_);
    const Edge_sites<D> move{p_at_, sites_.next(p_at_, draw_), q_at_};
    const Edge_motion<D> motion{world_.place(move.a), world_.place(move.b), world_.place(move.q),
                                world_.place(radius_)};
    const Answer<D> answer = answer_sweep(world_.snapshot(), world_.locator, motion, {}, counts_);
    const Thick_fault fault = judge_.fault_of(world_, move, radius_, answer);
    ++tally_.motions;
    tally_.degenerate += judge_.was_tied();
    tally_.blocked += answer.status == Motion_status::contact;
    tally_.by_edge += answer.contact && answer.contact->body == Body_feature::edge;
    if (fault != Thick_fault::none) {
      if (tally_.wrong++ == 0)
        keep_sweep(trial_, world_, move, world_.place(radius_),
                   thick_fault_names[static_cast<std::size_t>(fault)]);
      begin();
    } else if (answer.status == Motion_status::free) {
      p_at_ = move.b;
    }
  }

  const Trial& trial_;
  Draw draw_;
  const int bits_;
  const World<D> world_;
  Thick_judge<D> judge_;
  Sites<D> sites_;
  Site<D> p_at_{}, q_at_{};
  Whole radius_ = 1;
  Edge_counts counts_;
  Tally tally_;
};

}  // namespace

Tally judge_thick_sweeps(const Trial& trial) {
  return trial.population.dimension == 2 ? Thick_trial<2>(trial).run() : Thick_trial<3>(trial).run();
}

}  // namespace cellwalk::endurance
