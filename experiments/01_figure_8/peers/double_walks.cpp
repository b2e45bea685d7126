// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks in plain doubles, without any contact. An edge whose ends are in one cell needs no walk; any other is
// walked anew from the cell of p.
//
//   double_walk     over a table of hexahedra: six planes and six neighbours a cell
//   double_regions  the same, with a box free of walls for each body: in double_regions.cpp
//   library_double  the library's walk with rounded signs (policy Double, strategy exit_rule)
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "families.h"
#include "hexahedra.h"
#include "replay.h"

namespace cellwalk::figure_8 {

std::vector<Hexahedron> hexahedra(const Grid_world& world) {
  const Cell_soup<3>& soup = world.soup;
  std::vector<std::uint32_t> cell_of(soup.facet_count());
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) cell_of[f] = c;
  constexpr std::size_t faces = Hexahedron::faces;
  std::vector<Hexahedron> table(soup.cell_count());
  for (std::size_t c = 0; c < table.size(); ++c) {
    if (soup.cell_begin[c + 1] - soup.cell_begin[c] != faces)
      throw std::invalid_argument("a cell is no hexahedron");
    for (std::size_t i = 0; i < faces; ++i) {
      const std::uint32_t f = soup.cell_begin[c] + static_cast<std::uint32_t>(i),
                          other = world.gluing.opposite[f];
      const auto loop = soup.facet(f);
      const Point<3>& a = soup.points[loop[0]];
      const Vector<3> n = cross(soup.points[loop[1]] - a, soup.points[loop[2]] - a);
      table[c].x[i] = n[0];
      table[c].y[i] = n[1];
      table[c].z[i] = n[2];
      table[c].offset[i] = dot(n, a);
      const bool is_wall = other == no_facet || soup.impassable[f] || soup.impassable[other];
      table[c].neighbour[i] = is_wall ? no_facet : cell_of[other];
    }
  }
  return table;
}

namespace {

class Double_walk {
 public:
  static constexpr unsigned bits = segment_bits;
  Double_walk(std::shared_ptr<std::vector<Hexahedron>> table, const Grid_world& world)
      : table_(std::move(table)), world_(&world) {}

  void prepare(const Trace& trace) {
    cells_.clear();
    for (const Point<3>& x : trace.start_positions) cells_.push_back(world_->cell_at(x));
  }
  template <class Counter>
  bool start(std::size_t, const Point<3>*, const Point<3>*, Counter&) {
    return false;
  }
  template <class Counter>
  unsigned vertex(std::size_t body, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    return walk_vertex(*table_, cells_.data() + body * trace_vertices, v, positions, target, counter);
  }

 private:
  std::shared_ptr<std::vector<Hexahedron>> table_;
  const Grid_world* world_;
  std::vector<std::uint32_t> cells_;
};

struct Library {
  explicit Library(const Grid_world& world) : snapshot(Snapshot<3>::compile(world.soup, world.gluing)) {}
  Snapshot<3> snapshot;
};

class Library_double {
 public:
  static constexpr unsigned bits = segment_bits;
  Library_double(std::shared_ptr<Library> library, const Grid_world& world)
      : library_(std::move(library)), world_(&world) {}

  void prepare(const Trace& trace) {
    particles_.clear();
    for (const Point<3>& x : trace.start_positions)
      particles_.push_back({x, library_->snapshot.cell(world_->cell_at(x)), 3, 0});
    counts_ = {};
  }
  template <class Counter>
  bool start(std::size_t, const Point<3>*, const Point<3>*, Counter&) {
    return false;
  }
  template <class Counter>
  unsigned vertex(std::size_t body, std::size_t v, const Point<3>*, const Point<3>& target, Counter&) {
    Particle<3>* const particles = particles_.data() + body * trace_vertices;
    Particle<3> p = particles[v];
    unsigned answer = move<Double>(library_->snapshot, p, target, counts_).status != Walk_status::arrived;
    if (answer) p = particles[v];
    for (std::size_t k = 0; k < trace_edges; ++k) {
      const Particle<3>& q = particles[trace_neighbour(v, k)];
      if (p.cell == q.cell) continue;
      const Walk_result<3> way = walk<Double>(library_->snapshot, p, q.position, counts_);
      answer |= static_cast<unsigned>(way.status != Walk_status::arrived) << (k + 1);
    }
    if (!answer) particles[v] = p;
    return answer;
  }
  void add_counts(Counts& counts) const {
    counts.walks += counts_.walks;
    counts.crossings += counts_.crossings;
    counts.signs += counts_.predicates.orientations;
  }

 private:
  std::shared_ptr<Library> library_;
  const Grid_world* world_;
  std::vector<Particle<3>> particles_;
  Walk_counts counts_;
};

}  // namespace

void add_double_walks(const Grid_world& world, Peers& peers) {
  Build build;
  const auto table = measured_build(
      build, "cell", [&] { return std::make_shared<std::vector<Hexahedron>>(hexahedra(world)); });
  add_peer(peers, "double_walk", Double_walk(table, world), build);
  const auto library = measured_build(build, "cell", [&] { return std::make_shared<Library>(world); });
  add_peer(peers, "library_double", Library_double(library, world), build);
}

}  // namespace cellwalk::figure_8
