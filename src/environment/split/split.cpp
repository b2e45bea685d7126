// SPDX-License-Identifier: LGPL-3.0-or-later
// The conforming split in 3D: facets into triangles, then cells into stars of tetrahedra.
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/split.h>

#include <algorithm>
#include <numeric>

#include "plan.h"
#include "soup.h"

namespace cellwalk {
namespace {

using detail::Split_plan;
using detail::Triangle;
using detail::Triangulation;

/// Writes the result cell by cell.
class Writer {
 public:
  Writer(const Cell_soup<3>& soup, const Split_plan& plan) : soup_(soup), plan_(plan) {
    result_.points = soup.points;
  }

  /// Copies a cell, with its cut facets replaced by triangles.
  void keep(std::size_t c) {
    for (std::size_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f) {
      if (!plan_.is_cut(f)) {
        result_.add_facet(soup_.facet(f), soup_.impassable[f]);
        continue;
      }
      for (const Triangle& t : plan_.triangles(f)) result_.add_facet(t, soup_.impassable[f]);
    }
    result_.end_cell(soup_.solid[c]);
  }

  /// Replaces a cell by tetrahedra. Returns their number.
  std::size_t split(std::size_t c) {
    collect_surface(c);
    const detail::Star& star = plan_.star(c);
    std::uint32_t apex = star.vertex;
    if (!star.is_vertex) {
      apex = static_cast<std::uint32_t>(result_.points.size());
      result_.points.push_back(star.point);
    }
    std::size_t made = 0;
    for (std::size_t i = 0; i < surface_.size(); ++i) {
      const auto [a, b, v] = surface_[i];
      if (a == apex || b == apex || v == apex) continue;
      result_.add_facet(surface_[i], walls_[i]);
      add_side(apex, b, a);
      add_side(apex, v, b);
      add_side(apex, a, v);
      result_.end_cell(soup_.solid[c]);
      ++made;
    }
    return made;
  }

  Cell_soup<3> take() { return std::move(result_); }

 private:
  void collect_surface(std::size_t c) {
    surface_.clear();
    walls_.clear();
    for (std::size_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f) {
      const auto loop = soup_.facet(f);
      if (loop.size() == 3)
        surface_.push_back({loop[0], loop[1], loop[2]});
      else
        for (const Triangle& t : plan_.triangles(f)) surface_.push_back(t);
      walls_.resize(surface_.size(), soup_.impassable[f]);
    }
  }

  /// Adds a side of a tetrahedron that contains the apex; it is a wall if it lies in a wall of the cell.
  void add_side(std::uint32_t apex, std::uint32_t u, std::uint32_t v) {
    bool wall = false;
    for (std::size_t i = 0; i < surface_.size() && !wall; ++i) {
      const auto in_facet = [&](std::uint32_t x) {
        return std::find(surface_[i].begin(), surface_[i].end(), x) != surface_[i].end();
      };
      wall = walls_[i] && in_facet(apex) && in_facet(u) && in_facet(v);
    }
    result_.add_facet({apex, u, v}, wall);
  }

  const Cell_soup<3>& soup_;
  const Split_plan& plan_;
  Cell_soup<3> result_;
  Triangulation surface_;
  std::vector<std::uint8_t> walls_;  // per triangle of surface_
};

}  // namespace

template <>
Cell_soup<3> split(Cell_soup<3> soup, Split_report& report, std::vector<std::uint32_t>* origin,
                   Cells_to_split which) {
  report = {};
  const std::vector<Cell_check> checks = detail::check_soup(soup);
  detail::refuse_hopeless(checks);
  const Split_plan plan(soup, checks, which);
  if (plan.split_cells() == 0) {
    if (origin) {
      origin->resize(soup.cell_count());
      std::iota(origin->begin(), origin->end(), 0u);
    }
    return soup;
  }
  report.cells_split = plan.split_cells();
  report.facets_triangulated = plan.cut_facets();
  for (const Cell_check& check : checks) {
    report.not_planar += check.defect == Cell_defect::facet_not_planar;
    report.not_convex += check.defect != Cell_defect::facet_not_planar && check.defect != Cell_defect::none;
  }
  report.not_simplices = report.cells_split - report.not_planar - report.not_convex;
  if (origin) origin->clear();
  Writer writer(soup, plan);
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c) {
    std::size_t made = 1;
    if (plan.is_split(c)) {
      made = writer.split(c);
      report.cells_made += made;
    } else {
      writer.keep(c);
    }
    if (origin) origin->insert(origin->end(), made, c);
  }
  Cell_soup<3> result = writer.take();
  report.points_added = result.points.size() - soup.points.size();
  return result;
}

}  // namespace cellwalk
