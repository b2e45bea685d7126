// SPDX-License-Identifier: LGPL-3.0-or-later
// The method of the paper as it is written: particles walk from dart to dart of CGAL's combinatorial map,
// forecast by the facet that they aim at, and a temporary one along each edge whose ends are in different
// cells. All signs are exact. A motion that touches a wall and goes on is free.
//
//   map_walk
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/lcc/walker.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "families.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

struct Impassable {
  const Map<3>* map;
  bool operator()(const Const_dart<3>& d) const { return map->info(d).is_impassable(); }
};

struct Walked_map {
  explicit Walked_map(const Grid_world& world)
      : storage(build_map(world.soup, world.gluing)), walker(storage->map, {&storage->map}) {}
  const std::unique_ptr<Map_storage<3>> storage;
  const lcc::Walker<Map<3>, Impassable> walker;
};

class Map_walk {
 public:
  static constexpr unsigned bits = segment_bits;
  Map_walk(std::shared_ptr<Walked_map> map, const Grid_world& world) : map_(std::move(map)), world_(&world) {}

  void prepare(const Trace& trace) {
    particles_.clear();
    for (const Point<3>& x : trace.start_positions) {
      const std::uint32_t cell = world_->cell_at(x);
      particles_.push_back(
          {to_map_point(x), map_->storage->dart_of_half_facet[world_->soup.cell_begin[cell]]});
    }
    counts_ = {};
  }
  template <class Counter>
  bool start(std::size_t, const Point<3>*, const Point<3>*, Counter&) {
    return false;
  }
  template <class Counter>
  unsigned vertex(std::size_t body, std::size_t v, const Point<3>*, const Point<3>& target, Counter&) {
    auto* const particles = particles_.data() + body * trace_vertices;
    auto p = particles[v];
    unsigned answer = map_->walker.move(p, to_map_point(target), counts_).status != lcc::Status::arrived;
    for (std::size_t k = 0; k < trace_edges; ++k) {
      const auto& q = particles[trace_neighbour(v, k)];
      if (cell_of(p.dart) == cell_of(q.dart)) continue;
      const auto way = map_->walker.walk(p, q.position, counts_);
      answer |= static_cast<unsigned>(way.status != lcc::Status::arrived) << (k + 1);
    }
    if (!answer) particles[v] = p;
    return answer;
  }
  void add_counts(Counts& counts) const {
    counts.walks += counts_.walks;
    counts.crossings += counts_.crossings;
    counts.signs += counts_.signs;
  }

 private:
  std::uint32_t cell_of(const Const_dart<3>& d) const { return map_->storage->map.info(d).cell(); }

  std::shared_ptr<Walked_map> map_;
  const Grid_world* world_;
  std::vector<lcc::Particle<Map<3>>> particles_;
  lcc::Counts counts_;
};

}  // namespace

void add_map_walk(const Grid_world& world, Peers& peers) {
  Build build;
  const auto map = measured_build(build, "cell", [&] { return std::make_shared<Walked_map>(world); });
  add_peer(peers, "map_walk", Map_walk(map, world), build);
}

}  // namespace cellwalk::figure_8
