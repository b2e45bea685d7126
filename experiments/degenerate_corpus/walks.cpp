// SPDX-License-Identifier: LGPL-3.0-or-later
// Points that move. The oracle of walks follows all legal continuations from the cell of the start.
#include <algorithm>
#include <memory>

#include "makers.h"
#include "oracle/oracle.h"
#include "touch.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::corpus {
namespace {

template <int D>
class Walk_maker final : public Maker<D> {
 public:
  Walk_maker(const World<D>& world, std::uint64_t seed)
      : world_(world),
        oracle_(world.soup),
        source_world_{"", world.soup, true},
        source_(source_world_, seed) {}

  std::optional<Case<D>> propose() override {
    const oracle::Motion_kind kind = source_.kind(source_.random().below(12) == 0);
    Case<D> c;
    c.points = {source_.start(kind)};
    const std::vector<std::uint32_t> cells = oracle_.place(c.points[0]).free_cells;
    if (cells.empty()) return {};
    const std::uint32_t cell = cells[source_.random().below(cells.size())];
    if (meets_walls<D>(world_, c.points)) {
      c.side = {middle(cell)};
      const oracle::Place place = oracle_.place(c.side[0]);
      if (place.dimension != D || place.free_cells != std::vector{cell}) return {};
    }
    c.moves = {{0, source_.target(kind, c.points[0], c.points[0])}};
    return c;
  }

  bool judge(Case<D>& c) override {
    // The cell that the point comes from; elsewhere all cells are linked, and any will do.
    const Point<D>& inner = c.side.empty() ? c.points[0] : c.side[0];
    const std::uint32_t cell = oracle_.place(inner).free_cells.at(0);
    const oracle::Trace trace = oracle_.trace(c.points[0], c.moves[0].to);
    const oracle::Truth truth = oracle::judge(trace, cell);
    c.crossing = truth.stops.empty()      ? Crossing::no
                 : truth.arrivals.empty() ? Crossing::yes
                                          : Crossing::either;
    std::vector<int> events;
    for (const oracle::Stop& stop : truth.stops) events.push_back(stop.event);
    std::ranges::sort(events);
    events.erase(std::unique(events.begin(), events.end()), events.end());
    for (const int e : events)
      c.crossings.push_back(meeting(world_, c, 0, to_rational(trace.events[static_cast<std::size_t>(e)])));
    return true;
  }

 private:
  /// A point inside a cell.
  Point<D> middle(std::uint32_t cell) const {
    const Cell_soup<D>& soup = world_.soup;
    std::vector<std::uint32_t> vertices;
    for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f)
      vertices.insert(vertices.end(), soup.facet(f).begin(), soup.facet(f).end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Point<D> sum{};
    for (const std::uint32_t v : vertices) sum = sum + soup.points[v];
    return (1.0 / static_cast<double>(vertices.size())) * sum;
  }

  const World<D>& world_;
  const oracle::Oracle<D> oracle_;
  const oracle::World<D> source_world_;
  oracle::Motion_source<D> source_;
};

}  // namespace

template <int D>
std::unique_ptr<Maker<D>> walk_maker(const World<D>& world, std::uint64_t seed) {
  return std::make_unique<Walk_maker<D>>(world, seed);
}

template std::unique_ptr<Maker<2>> walk_maker<2>(const World<2>&, std::uint64_t);
template std::unique_ptr<Maker<3>> walk_maker<3>(const World<3>&, std::uint64_t);

}  // namespace cellwalk::corpus
