// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges whose ends move.
#include <memory>

#include "edge_judge.h"
#include "makers.h"
#include "touch.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::corpus {
namespace {

template <int D>
class Sweep_maker final : public Maker<D> {
 public:
  Sweep_maker(const World<D>& world, std::uint64_t seed)
      : world_(world),
        judge_(world.soup),
        source_world_{"", world.soup, true},
        source_(source_world_, seed) {}

  std::optional<Case<D>> propose() override {
    oracle::Motion_kind kind = source_.kind(source_.random().below(12) == 0);
    Case<D> c;
    const Point<D> p = source_.start(kind);
    const Point<D> q = source_.target(kind, p, p);
    c.points = {p, q};
    if (p == q) return {};
    if (meets_walls<D>(world_, c.points)) {
      const std::optional<std::vector<Point<D>>> side = find_side(c.points);
      if (!side) return {};
      c.side = *side;
    }
    const bool moves_both = source_.random().below(3) == 0;
    for (std::uint32_t v = 0; v < (moves_both ? 2u : 1u); ++v) {
      if (kind != oracle::Motion_kind::in_wall_plane && kind != oracle::Motion_kind::along_edge) do
          kind = source_.kind(false);
        while (kind == oracle::Motion_kind::in_wall_plane || kind == oracle::Motion_kind::along_edge);
      c.moves.push_back({v, source_.target(kind, c.points[v], c.points[v])});
    }
    return c;
  }

  bool judge(Case<D>& c) override {
    std::optional<Edge<D>> edge = start_of(c);
    if (!edge) return false;
    for (std::uint32_t m = 0; m < c.moves.size(); ++m) {
      const std::optional<Judged> judged = judge_.move(*edge, c.moves[m]);
      if (!judged) return false;
      for (const Rational& time : judged->times) c.crossings.push_back(meeting(world_, c, m, time));
      c.crossing = judged->crossing;
      if (c.crossing == Crossing::no) continue;
      if (c.crossing == Crossing::either && m + 1 < c.moves.size()) return false;
      break;
    }
    return true;
  }

 private:
  /// Where the edge may come from: moved there, one end after the other, it meets no wall off its start.
  std::optional<std::vector<Point<D>>> find_side(const std::vector<Point<D>>& points) {
    constexpr int tries = 12;
    for (int k = 0; k < tries; ++k) {
      const Point<D> aim = source_.start(oracle::Motion_kind::to_lattice);
      const Vector<D> away = (k % 2 == 0 ? 0.125 : 0.03125) * (aim - points[0]);
      const std::vector<Point<D>> side{points[0] + away, points[1] + away};
      if (meets_walls<D>(world_, side)) continue;
      const std::vector<Point<D>> half{side[0], points[1]};
      if (first_touch<D>(world_, points, {0, side[0]}) || first_touch<D>(world_, half, {1, side[1]}))
        continue;
      return side;
    }
    return {};
  }

  /// The edge as it stands, on its side of the walls there. None if it is not in free space.
  std::optional<Edge<D>> start_of(const Case<D>& c) {
    const std::vector<Point<D>>& at = c.side.empty() ? c.points : c.side;
    std::optional<Edge<D>> edge = judge_.place(at[0], at[1]);
    if (!edge || c.side.empty()) return edge;
    for (const std::uint32_t v : {1u, 0u}) {  // the way of find_side() back
      const auto judged = judge_.move(*edge, {v, c.points[v]});
      if (!judged || judged->crossing != Crossing::no) return {};
    }
    return edge;
  }

  const World<D>& world_;
  Edge_judge<D> judge_;
  const oracle::World<D> source_world_;
  oracle::Motion_source<D> source_;
};

}  // namespace

template <int D>
std::unique_ptr<Maker<D>> sweep_maker(const World<D>& world, std::uint64_t seed) {
  return std::make_unique<Sweep_maker<D>>(world, seed);
}

template std::unique_ptr<Maker<2>> sweep_maker<2>(const World<2>&, std::uint64_t);
template std::unique_ptr<Maker<3>> sweep_maker<3>(const World<3>&, std::uint64_t);

}  // namespace cellwalk::corpus
