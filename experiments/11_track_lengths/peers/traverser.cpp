// SPDX-License-Identifier: LGPL-3.0-or-later
#include "traverser.h"

#include <CGAL/Triangulation_segment_traverser_3.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "triangulation.h"

namespace cellwalk::track_lengths {
namespace {

using Traversal = CGAL::Triangulation_segment_cell_iterator_3<Delaunay>;

/// A ray in doubles; positions on it are distances from its start.
struct Line {
  Point<3> from{}, direction{};
  double length = 0;

  Line(const Point<3>& a, const Point<3>& b) : from(a) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      direction[k] = b[k] - a[k];
      square += direction[k] * direction[k];
    }
    length = std::sqrt(square);
    for (double& x : direction) x /= length;
  }

  double position(const Kernel::Point_3& p) const {
    return (p.x() - from[0]) * direction[0] + (p.y() - from[1]) * direction[1] +
           (p.z() - from[2]) * direction[2];
  }
};

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The point of the ray nearest to the line of an edge; the nearer end of one that lies on the ray.
double position_of_edge(const Line& line, const Kernel::Point_3& p, const Kernel::Point_3& q) {
  const std::array<double, 3> edge{q.x() - p.x(), q.y() - p.y(), q.z() - p.z()},
      to{p.x() - line.from[0], p.y() - line.from[1], p.z() - line.from[2]};
  const double of_edge = dot(edge, edge), cross = dot(edge, line.direction);
  const double denominator = of_edge - cross * cross;
  constexpr double parallel = 1e-12;
  if (denominator <= parallel * of_edge) return std::min(line.position(p), line.position(q));
  return (dot(to, line.direction) * of_edge - dot(to, edge) * cross) / denominator;
}

/// A vertex, an edge or a facet of a cell.
struct Simplex {
  Delaunay::Locate_type type{};
  int i = 0, j = 0;
};

/// Where a ray passes a simplex.
double position(const Simplex& simplex, Delaunay::Cell_handle cell, const Line& line,
                const Plain_planes<double>& planes) {
  const auto [type, i, j] = simplex;
  switch (type) {
    case Delaunay::VERTEX:
      return line.position(cell->vertex(i)->point());
    case Delaunay::EDGE:
      return position_of_edge(line, cell->vertex(i)->point(), cell->vertex(j)->point());
    case Delaunay::FACET: {
      double slope = 0, height = planes.offset[i];
      for (std::size_t k = 0; k < 3; ++k) {
        slope += planes.normal[k][i] * line.direction[k];
        height -= planes.normal[k][i] * line.from[k];
      }
      return height / slope;
    }
    default:
      return 0;
  }
}

}  // namespace

Traverser::Traverser(const World& world) : world_(world) {
  const Plain_tables<double> tables(world.snapshot());
  planes_.resize(tables.planes.size());
  for (std::uint32_t name = 0; name < planes_.size(); ++name) {
    const Delaunay::Cell_handle cell = world.triangulation->cell(Cell{name});
    for (int i = 0; i < 4; ++i) {
      // The facet that does not have this vertex.
      std::size_t facet = 0;
      const auto has_vertex = [&] {
        const auto loop = world.snapshot().loop(Snapshot<3>::half_facet(Cell{name}, facet));
        return std::ranges::find(loop, cell->vertex(i)->info()) != loop.end();
      };
      while (has_vertex()) ++facet;
      for (std::size_t k = 0; k < 3; ++k) planes_[name].normal[k][i] = tables.planes[name].normal[k][facet];
      planes_[name].offset[i] = tables.planes[name].offset[facet];
    }
  }
}

void Traverser::run(const Rays& rays, Peer_rows& rows) const {
  const Delaunay& delaunay = world_.triangulation->delaunay();
  Peer_rows::List& list = rows.lists[0];
  list.cells.clear();
  list.lengths.clear();
  rows.rows.clear();
  const auto point = [](const Point<3>& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    const Particle<3>& start = rays.starts[ray];
    const Point<3>& target = rays.targets[ray];
    const Line line(start.position, target);
    const std::size_t begin = list.cells.size();
    double last = 0;
    const auto end_piece = [&](double next) {
      list.lengths.push_back(next - last);
      last = next;
    };
    auto how = Peer_row::arrived;
    Traversal at(&delaunay, point(start.position), point(target), world_.triangulation->cell(start.cell));
    for (Delaunay::Cell_handle before; at.has_next(); ++at) {
      const Delaunay::Cell_handle cell = at.handle();
      Simplex simplex;
      if (delaunay.is_infinite(cell)) {
        if (before == Delaunay::Cell_handle()) continue;
        at.exit(simplex.type, simplex.i, simplex.j);
        end_piece(position(simplex, before, line, planes_[before->info()]));
        how = Peer_row::left;
        break;
      }
      at.entry(simplex.type, simplex.i, simplex.j);
      if (before != Delaunay::Cell_handle()) end_piece(position(simplex, cell, line, planes_[cell->info()]));
      list.cells.push_back(cell->info());
      before = cell;
    }
    if (how == Peer_row::arrived && list.cells.size() > begin) end_piece(line.length);
    rows.rows.push_back({how, 0, begin, list.cells.size()});
  }
}

}  // namespace cellwalk::track_lengths
