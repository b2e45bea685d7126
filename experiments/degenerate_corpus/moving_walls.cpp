// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that follow one of their vertices, and an edge off all walls that stands still. The second oracle of
// moving walls follows the definition through all times.
#include <cellwalk/edge/chain.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "makers.h"
#include "reshape/definition_oracle.h"
#include "touch.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::corpus {
namespace {

template <int D>
class Moving_wall_maker final : public Maker<D> {
 public:
  Moving_wall_maker(const World<D>& world, std::uint64_t seed)
      : world_(world),
        environment_(
            Environment<D>::build(world.soup, {.duplicates = Duplicate_vertices::keep, .simplicial = true})),
        locator_(environment_.snapshot()),
        source_world_{"", world.soup, true},
        source_(source_world_, seed) {}

  std::optional<Case<D>> propose() override {
    Random& random = source_.random();
    const Wall<D>& any = world_.walls[random.below(world_.walls.size())];
    const std::uint32_t v = any.corners[random.below(D)];
    Case<D> c;
    c.moves_wall = true;
    c.moves = {{v, target(v)}};
    if (!keeps_cells(c.moves[0])) return {};
    c.points = object(c.moves[0]);
    if (c.points[0] == c.points[1] || meets_walls<D>(world_, c.points)) return {};
    return c;
  }

  bool judge(Case<D>& c) override {
    const Move<D>& move = c.moves[0];
    const Point<D>& from = point(move.vertex);
    if (!keeps_cells(move) || !keeps_boundary(move)) return false;
    const Snapshot<D>& snapshot = environment_.snapshot();
    const auto p = locator_.particle_at(c.points[0]), q = locator_.particle_at(c.points[1]);
    if (!p || !q) return false;
    const Chain_result<D> found = find_chain(snapshot, *p, *q, counts_);
    if (found.contact) return false;
    if (move.to == from) return true;
    const test::Wall_motion<D> motion{snapshot, move.vertex, from, move.to};
    const test::Fate fate = test::fate_of(
        motion, {p->position, q->position, p->cell, q->cell, {found.chain.begin(), found.chain.end()}});
    if (fate.has_choice) return false;
    for (const auto& end : {*p, *q}) {
      const test::Fate of_end = test::fate_of(motion, {end.position, end.position, end.cell, end.cell, {}});
      if (of_end.has_choice) return false;
      if (of_end.blocked && (!fate.blocked || *of_end.blocked < *fate.blocked))
        throw std::logic_error("an end that its edge contradicts");
    }
    if (!fate.blocked) return true;
    c.crossing = Crossing::yes;
    c.crossings = {meeting(world_, c, 0, Rational(fate.blocked->str()))};
    return true;
  }

 private:
  const Point<D>& point(std::uint32_t v) const { return world_.soup.points[v]; }

  double eighths(int low, int high) {
    return (low + static_cast<double>(source_.random().below(static_cast<std::uint64_t>(high - low + 1)))) /
           8;
  }

  std::vector<std::vector<std::uint32_t>> cells_around(std::uint32_t v) const {
    const Cell_soup<D>& soup = world_.soup;
    std::vector<std::vector<std::uint32_t>> result;
    for (std::size_t c = 0; c < soup.cell_count(); ++c) {
      std::vector<std::uint32_t> corners;
      for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
        corners.insert(corners.end(), soup.facet(f).begin(), soup.facet(f).end());
      std::ranges::sort(corners);
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      if (std::ranges::binary_search(corners, v)) result.push_back(corners);
    }
    return result;
  }

  /// A sum of eighths of the ways to vertices around.
  Point<D> target(std::uint32_t v) {
    const auto cells = cells_around(v);
    Point<D> x = point(v);
    for (std::uint64_t k = 1 + source_.random().below(2); k-- > 0;) {
      const auto& cell = cells[source_.random().below(cells.size())];
      const Point<D>& other = point(cell[source_.random().below(cell.size())]);
      x = x + eighths(-6, 6) * (other - point(v));
    }
    return x;
  }

  /// True if all cells at the vertex are simplices, and keep a positive volume.
  bool keeps_cells(const Move<D>& move) const {
    return std::ranges::all_of(cells_around(move.vertex), [&](const std::vector<std::uint32_t>& cell) {
      std::vector<Point<D>> before, after;
      for (const std::uint32_t u : cell) {
        before.push_back(point(u));
        after.push_back(u == move.vertex ? move.to : point(u));
      }
      return cell.size() == D + 1 && test::volume_sign<D>(before) == test::volume_sign<D>(after);
    });
  }

  /// Walls of the boundary may not run into each other; of that nothing is made.
  bool keeps_boundary(const Move<D>& move) {
    Reshaping<D> reshaping(environment_, {}, {.at_contact = At_contact::hold});
    const Move_end end = reshaping.test_move(move.vertex, move.to).end;
    if (end != Move_end::reached && end != Move_end::boundary)
      throw std::logic_error("a move of a vertex that cells contradict");
    return end == Move_end::reached;
  }

  /// An edge, in most cases one that a wall at the vertex meets at a multiple of an eighth of its way: at a
  /// corner of the wall, on a side of it or within.
  std::vector<Point<D>> object(const Move<D>& move) {
    Random& random = source_.random();
    const std::uint64_t way = random.below(6);
    if (way == 0) {
      const Point<D> p = source_.start(kind());
      return {p, source_.target(kind(), p, p)};
    }
    std::vector<const Wall<D>*> walls;
    for (const Wall<D>& wall : world_.walls)
      if (std::ranges::find(wall.corners, move.vertex) != wall.corners.end()) walls.push_back(&wall);
    const double time = random.chance(0.2) ? 1 : eighths(1, 7);
    const Point<D> moved = point(move.vertex) + time * (move.to - point(move.vertex));
    std::vector<Vector<D>> sides;
    for (const std::uint32_t u : walls[random.below(walls.size())]->corners)
      if (u != move.vertex) sides.push_back(point(u) - moved);
    const auto on_wall = [&](int low, int high) {
      Vector<D> sum = eighths(low, high) * sides[0];
      if (D == 3) sum = sum + (random.chance(0.4) ? 0.0 : eighths(low, high)) * sides[D - 2];
      return sum;
    };
    const Point<D> met = random.chance(0.35) ? moved : moved + on_wall(0, 4);
    Vector<D> along = way < 3 ? on_wall(-6, 6) : source_.target(kind(), met, met) - met;
    along = (random.chance(0.5) ? 0.5 : 0.125) * along;
    return {random.chance(0.5) ? met : met - along, met + along};
  }

  oracle::Motion_kind kind() {
    for (;;) {
      const oracle::Motion_kind k = source_.kind(source_.random().below(12) == 0);
      if (k != oracle::Motion_kind::in_wall_plane && k != oracle::Motion_kind::along_edge) return k;
    }
  }

  const World<D>& world_;
  Environment<D> environment_;
  const Locator<D> locator_;
  const oracle::World<D> source_world_;
  oracle::Motion_source<D> source_;
  Walk_counts counts_;
};

}  // namespace

template <int D>
std::unique_ptr<Maker<D>> moving_wall_maker(const World<D>& world, std::uint64_t seed) {
  return std::make_unique<Moving_wall_maker<D>>(world, seed);
}

template std::unique_ptr<Maker<2>> moving_wall_maker<2>(const World<2>&, std::uint64_t);
template std::unique_ptr<Maker<3>> moving_wall_maker<3>(const World<3>&, std::uint64_t);

}  // namespace cellwalk::corpus
