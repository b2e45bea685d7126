// SPDX-License-Identifier: LGPL-3.0-or-later
// Regions free of walls, as the library has them, in plain doubles: each body keeps a box. While its targets
// lie in the box nothing is tested, and the cells of its vertices are not followed. They are caught up with
// when the body leaves the box; then another one is searched. Where there is none, the vertices and edges are
// walked.
//
//   double_regions
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "body_box.h"
#include "candidates.h"
#include "families.h"
#include "hexahedra.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

constexpr std::size_t faces = Hexahedron::faces;

/// The table, and the boxes that facets lie in.
struct Boxed_hexahedra {
  std::vector<Hexahedron> cells;
  std::vector<std::array<Box, faces>> boxes;
};

Boxed_hexahedra boxed_hexahedra(const Grid_world& world) {
  Boxed_hexahedra table{hexahedra(world), {}};
  const Cell_soup<3>& soup = world.soup;
  table.boxes.resize(table.cells.size());
  for (std::size_t c = 0; c < table.boxes.size(); ++c)
    for (std::size_t i = 0; i < faces; ++i) {
      Box box = Box::nowhere();
      for (const std::uint32_t v : soup.facet(soup.cell_begin[c] + i))
        for (std::size_t k = 0; k < 3; ++k) {
          box.low[k] = std::min(box.low[k], soup.points[v][k]);
          box.high[k] = std::max(box.high[k], soup.points[v][k]);
        }
      table.boxes[c][i] = box;
    }
  return table;
}

/// Searches boxes free of walls through cells that meet them. A wall counts as the box that it lies in.
class Region_search {
 public:
  explicit Region_search(const Boxed_hexahedra& table) : table_(&table), seen_(table.cells.size(), 0) {}

  /// The box around `least` that is left of `most` when sides are moved past each wall that it meets, the one
  /// that costs the smallest share of it. Nothing if a wall meets `least`.
  /// \param cell holds a point of `least`
  Box find(std::uint32_t cell, const Box& least, const Box& most) {
    Box region = most;
    if (++search_ == 0) {
      std::fill(seen_.begin(), seen_.end(), 0);
      search_ = 1;
    }
    cells_.assign(1, cell);
    seen_[cell] = search_;
    for (std::size_t next = 0; next < cells_.size(); ++next) {
      const std::uint32_t c = cells_[next];
      for (std::size_t i = 0; i < faces; ++i) {
        const Box& facet = table_->boxes[c][i];
        if (!experiments::meet(region, facet)) continue;
        const std::uint32_t other = table_->cells[c].neighbour[i];
        if (other == no_facet) {
          if (!cut(region, least, facet)) return Box::nowhere();
        } else if (seen_[other] != search_) {
          seen_[other] = search_;
          cells_.push_back(other);
        }
      }
    }
    return region;
  }

 private:
  static bool cut(Box& region, const Box& least, const Box& wall) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double best = 0;  // the share that is left
    std::size_t axis = 3;
    bool is_high = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = region.high[k] - region.low[k];
      const auto note = [&](bool is_beside, bool high, double left) {
        if (!is_beside || left <= best) return;
        best = left;
        axis = k;
        is_high = high;
      };
      note(wall.low[k] > least.high[k], true, (wall.low[k] - region.low[k]) / size);
      note(wall.high[k] < least.low[k], false, (region.high[k] - wall.high[k]) / size);
    }
    if (axis == 3) return false;
    if (is_high)
      region.high[axis] = std::nextafter(wall.low[axis], -infinity);
    else
      region.low[axis] = std::nextafter(wall.high[axis], infinity);
    return true;
  }

  const Boxed_hexahedra* table_;
  std::vector<std::uint32_t> seen_;  ///< by which search a cell was found last
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> cells_;
};

class Double_regions {
 public:
  static constexpr unsigned bits = segment_bits;
  Double_regions(std::shared_ptr<Boxed_hexahedra> table, const Grid_world& world)
      : table_(std::move(table)), world_(&world), search_(*table_) {}

  void prepare(const Trace& trace) {
    margin_ = kept_steps * trace.speed;
    cells_.clear();
    for (const Point<3>& x : trace.start_positions) cells_.push_back(world_->cell_at(x));
    bodies_.assign(trace.bodies, {});
  }
  template <class Counter>
  bool start(std::size_t b, const Point<3>* positions, const Point<3>* targets, Counter& counter) {
    Body& body = bodies_[b];
    if (holds(body.region, targets)) return true;  // the positions lie in it as well
    std::uint32_t* const cells = cells_.data() + b * trace_vertices;
    if (body.has_region) {
      for (std::size_t v = 0; v < trace_vertices; ++v)
        walk_hexahedra(table_->cells, cells[v], body.registered[v], positions[v], counter);
      body.has_region = false;
      body.region = Box::nowhere();
    }
    const Box least = body_box(positions, targets);
    counter.boxes();
    body.region = search_.find(cells[0], least, least.enlarged(margin_));
    body.has_region = body.region.contains(least);
    if (!body.has_region) return false;
    std::copy_n(positions, trace_vertices, body.registered.begin());
    return true;
  }
  template <class Counter>
  unsigned vertex(std::size_t body, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return walk_vertex(table_->cells, cells_.data() + body * trace_vertices, v, positions, target, counter);
  }

 private:
  struct Body {
    Box region = Box::nowhere();
    std::array<Point<3>, trace_vertices> registered;  ///< where the cells of the vertices were found
    bool has_region = false;
  };

  static bool holds(const Box& box, const Point<3>* points) {
    bool in = true;
    for (std::size_t v = 0; v < trace_vertices; ++v)
      for (std::size_t k = 0; k < 3; ++k) in &= (box.low[k] <= points[v][k]) & (points[v][k] <= box.high[k]);
    return in;
  }

  std::shared_ptr<Boxed_hexahedra> table_;
  const Grid_world* world_;
  Region_search search_;
  double margin_ = 0;
  std::vector<std::uint32_t> cells_;
  std::vector<Body> bodies_;
};

}  // namespace

void add_double_regions(const Grid_world& world, Peers& peers) {
  Build build;
  const auto table = measured_build(
      build, "cell", [&] { return std::make_shared<Boxed_hexahedra>(boxed_hexahedra(world)); });
  add_peer(peers, "double_regions", Double_regions(table, world), build);
}

}  // namespace cellwalk::figure_8
