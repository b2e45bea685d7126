// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orders.h"

#include <cellwalk/edge/sweep.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <cmath>

#include "box_world.h"
#include "random_direction.h"
#include "wall_judge.h"

namespace cellwalk::ablation {
namespace {

constexpr std::uint32_t period = 4;  // cubes along each axis in which edges start

class Motions {
 public:
  explicit Motions(const Order_setting& setting)
      : setting_(setting),
        step_(setting.edge * setting.step_over_edge),
        border_(static_cast<std::uint32_t>(std::ceil(setting.edge + step_))),
        environment_(make_world()),
        soup_(environment_.soup()),
        judge_(experiments::wall_mesh(soup_, glue(soup_))),
        locator_(environment_.snapshot()),
        random_(setting.seed) {}

  Order_tally run() {
    for (std::uint64_t i = 0; i < setting_.draws; ++i) make(draw());
    return tally_;
  }

 private:
  Environment<3> make_world() const {
    const std::uint32_t n = period + 2 * border_;
    if (setting_.world == "boxes")
      return small_obstacles::box_world<3>({n, setting_.size, scramble(setting_.seed)});
    Grid_options<3> options;
    options.cells = Grid_options<3>::filled(n);
    options.solid_share = 0.08;
    options.seed = scramble(setting_.seed);
    return Environment<3>::build(hex_grid(options),
                                 {.duplicates = Duplicate_vertices::keep, .split = false, .keep_map = false});
  }

  Moving_edge draw() {
    Point<3> a;
    for (double& x : a) x = border_ + period * random_.real();
    const Point<3> c = a + setting_.edge * random_direction(random_);
    const Vector<3> move = step_ * random_direction(random_), other = step_ * random_direction(random_);
    switch (setting_.motion) {
      case Motion_kind::shift:
        return {a, a + move, c, c + move};
      case Motion_kind::turn:
        return {a, a + move, c, c - move};
      default:
        return {a, a + move, c, c + other};
    }
  }

  /// True if an end is blocked, or the edge, when p moves and then q.
  bool is_blocked_in_turn(Particle<3> p, const Point<3>& b, Particle<3> q, const Point<3>& d, Chain chain) {
    Edge_counts counts;
    const Snapshot<3>& snapshot = environment_.snapshot();
    const Sweep_result<3> first = sweep_edge<3>(snapshot, p, b, q, chain, {}, counts);
    compare(first.contact.has_value(), {p.position, b, q.position, q.position});
    if (first.contact) return true;
    const Sweep_result<3> second =
        sweep_edge<3>(snapshot, q, d, first.p, reversed(snapshot, first.chain), {}, counts);
    compare(second.contact.has_value(), {q.position, d, b, b});
    return second.contact.has_value();
  }
  void compare(bool is_blocked, const Moving_edge& edge) {
    const Verdict verdict = judge_.judge(edge);
    tally_.undecided += verdict == Verdict::undecided;
    tally_.wrong += verdict != Verdict::undecided && is_blocked != (verdict == Verdict::blocked);
  }

  void make(const Moving_edge& e) {
    const auto p = locator_.particle_at(e.a), q = locator_.particle_at(e.c);
    if (!p || !q) return;
    Walk_counts walk;
    const Chain_result<3> before = find_chain(environment_.snapshot(), *p, *q, walk);
    if (before.contact) return;
    const Verdict verdict = judge_.judge(e);
    if (verdict == Verdict::undecided) {
      ++tally_.undecided;
      return;
    }
    const bool together = verdict == Verdict::blocked;
    const bool p_first = is_blocked_in_turn(*p, e.b, *q, e.d, before.chain);
    const bool q_first =
        is_blocked_in_turn(*q, e.d, *p, e.b, reversed(environment_.snapshot(), before.chain));
    ++tally_.made;
    tally_.together += together;
    tally_.p_first += p_first;
    tally_.q_first += q_first;
    tally_.together_only += together && !p_first;
    tally_.p_first_only += p_first && !together;
    tally_.orders_differ += p_first != q_first;
    tally_.any_order_only += p_first && q_first && !together;
    tally_.no_order += together && !p_first && !q_first;
  }

  Order_setting setting_;
  double step_;
  std::uint32_t border_;
  Environment<3> environment_;
  Cell_soup<3> soup_;
  Wall_judge judge_;
  Locator<3> locator_;
  Random random_;
  Order_tally tally_;
};

}  // namespace

Order_tally run_orders(const Order_setting& setting) { return Motions(setting).run(); }

}  // namespace cellwalk::ablation
