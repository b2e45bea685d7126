// SPDX-License-Identifier: LGPL-3.0-or-later
// The cheapest way from cell to cell, divided into short pieces, whose ends then move to the middle.
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/simulation/centre_line.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/walk.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "cheapest_way.h"
#include "line_end.h"
#include "nearest_walls.h"

namespace cellwalk {
namespace {

using detail::Cell_costs;
using detail::Line_end;
using detail::Near_wall;

/// Pieces are as long as this share of the median distance from walls, but the line has at most so many.
constexpr double piece_share = 0.5, most_pieces = 2000;
/// Sweeps over the line, unless no point moves farther than this share of a piece.
constexpr int most_smoothings = 60;
constexpr double still = 1e-3;
/// In a sweep: the share of the way to the middle of its neighbours, and to the middle between walls.
constexpr double evened = 0.5, centred = 0.5;
/// In distances from the nearest wall: how far the wall opposite is looked for.
constexpr double outlook = 4;
/// A move that walls forbid is tried again, half as far, so many times.
constexpr int tries = 3;

/// The value below which a share of the values lies.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// A line of particles, each in sight of the next.
template <int D>
class Line_finder {
 public:
  Line_finder(const Snapshot<D>& snapshot, const Line_end<D>& from, const Line_end<D>& to)
      : snapshot_(snapshot), from_(from), to_(to), walls_(snapshot, both(from.open, to.open)) {
    clearance_.assign(snapshot.cell_slots(), 0);
  }

  /// \param radius of what follows the line
  Centre_line<D> find(double radius) {
    const std::vector<Cell> way =
        detail::cheapest_way(snapshot_, costs(from_), costs(to_), [&](Cell a, Cell b) {
          const double distance = cellwalk::length(centroid(snapshot_, b) - centroid(snapshot_, a));
          return distance * (1 / clearance(a) + 1 / clearance(b)) / 2;
        });
    if (way.empty()) return {};
    follow(way);
    divide(way);
    const std::vector<Particle<D>> divided = line_;
    for (int i = 0; i < most_smoothings && smooth() > still * piece_; ++i) {
    }
    if (!is_free()) line_ = divided;
    if (radius > 0) cut_ends(radius);
    Centre_line<D> result;
    for (const Particle<D>& p : line_) {
      result.points.push_back(p.position);
      result.clearances.push_back(walls_.nearest(p.position).distance);
    }
    return result;
  }

 private:
  static std::set<Half_facet> both(std::set<Half_facet> a, const std::set<Half_facet>& b) {
    a.insert(b.begin(), b.end());
    return a;
  }

  /// How far walls are from the centroid of a cell.
  double clearance(Cell c) {
    double& known = clearance_[snapshot_.index(c)];
    if (known == 0) known = std::max(walls_.nearest(centroid(snapshot_, c)).distance, least_clearance);
    return known;
  }

  Cell_costs costs(const Line_end<D>& end) {
    Cell_costs result;
    for (const Cell c : end.cells)
      result[c] = cellwalk::length(centroid(snapshot_, c) - end.middle) / clearance(c);
    return result;
  }

  bool sees(const Particle<D>& from, const Point<D>& x) {
    return walk<Exact>(snapshot_, from, x, counts_).status == Walk_status::arrived;
  }

  /// The end of the line, seen from a cell.
  Particle<D> place(const Line_end<D>& end, Cell cell) {
    Particle<D> particle{centroid(snapshot_, cell), cell, static_cast<std::uint16_t>(D), 0};
    // A rounded centroid of a sliver may lie just outside.
    if (!in_closure(snapshot_, cell, particle.position)) particle.position = snapshot_.view(cell).point(0);
    for (const Point<D>& x : end.places())
      if (move<Exact>(snapshot_, particle, x, counts_).status == Walk_status::arrived) break;
    return particle;
  }

  /// Appends a point in sight of the last one; false if it is not.
  bool append(const Point<D>& x) {
    Particle<D> particle = line_.back();
    if (x == particle.position || move<Exact>(snapshot_, particle, x, counts_).status != Walk_status::arrived)
      return false;
    line_.push_back(particle);
    return true;
  }

  /// The line through centroids of cells and facets.
  void follow(const std::vector<Cell>& way) {
    line_ = {place(from_, way.front())};
    for (const Point<D>& x : detail::points_of_way(snapshot_, way)) append(x);
    append(place(to_, way.back()).position);
  }

  /// Leaves out points of short pieces, and divides long ones.
  void divide(const std::vector<Cell>& way) {
    std::vector<double> along;
    for (const Cell c : way) along.push_back(clearance(c));
    double all = 0;
    for (std::size_t i = 0; i + 1 < line_.size(); ++i)
      all += cellwalk::length(line_[i + 1].position - line_[i].position);
    piece_ = std::max(piece_share * quantile(std::move(along), 0.5), all / most_pieces);
    const std::vector<Particle<D>> old = std::exchange(line_, {line_.front()});
    for (std::size_t i = 0; i + 1 < old.size();) {
      std::size_t next = i + 1;
      while (next + 1 < old.size() && is_short(old[i], old[next + 1]) &&
             sees(line_.back(), old[next + 1].position))
        ++next;
      append_pieces(old[next].position);
      i = next;
    }
  }

  bool is_short(const Particle<D>& a, const Particle<D>& b) const {
    return cellwalk::length(b.position - a.position) <= piece_;
  }

  /// \pre it is in sight of the last point
  void append_pieces(const Point<D>& end) {
    const Point<D> begin = line_.back().position;
    const double pieces = std::ceil(cellwalk::length(end - begin) / piece_);
    for (double i = 1; i < pieces; ++i)
      if (append(begin + (i / pieces) * (end - begin)) && !sees(line_.back(), end)) line_.pop_back();
    append(end);
  }

  /// Moves all points but the ends. Returns how far the farthest went.
  double smooth() {
    double farthest = 0;
    for (std::size_t i = 1; i + 1 < line_.size(); ++i) {
      const Point<D> here = line_[i].position;
      Vector<D> step = evened * (0.5 * (line_[i - 1].position + line_[i + 1].position) - here) +
                       to_middle(line_[i], line_[i + 1].position - line_[i - 1].position);
      for (int k = 0; k < tries; ++k, step = 0.5 * step) {
        Particle<D> moved = line_[i];
        if (move<Exact>(snapshot_, moved, here + step, counts_).status != Walk_status::arrived ||
            !sees(moved, line_[i - 1].position) || !sees(moved, line_[i + 1].position))
          continue;
        farthest = std::max(farthest, cellwalk::length(step));
        line_[i] = moved;
        break;
      }
    }
    return farthest;
  }

  /// Across the line, away from the nearest wall.
  Vector<D> to_middle(const Particle<D>& here, const Vector<D>& along) {
    const Near_wall<D> wall = walls_.nearest(here.position);
    const Vector<D> tangent = normalized(along, Vector<D>{});
    Vector<D> away = here.position - wall.point;
    away = normalized(away - dot(away, tangent) * tangent, Vector<D>{});
    const double far = outlook * wall.distance;
    const Walk_result<D> met = walk<Exact>(snapshot_, here, here.position + far * away, counts_);
    const double opposite = met.contact ? met.contact->time * far : far;
    return (centred * std::max(0.0, opposite - wall.distance) / 2) * away;
  }

  /// True if a point may follow the whole line.
  bool is_free() {
    Particle<D> particle = line_.front();
    return std::ranges::all_of(line_, [&](const Particle<D>& next) {
      return move<Exact>(snapshot_, particle, next.position, counts_).status == Walk_status::arrived;
    });
  }

  /// Leaves points out before facets of groups that are nearer to a wall than a radius: these facets are
  /// walls for what is thick. Points that were given stay.
  void cut_ends(double radius) {
    double widest = 0;
    const auto has_room = [&](const Particle<D>& x) {
      const double clearance = detail::clearance<D>(snapshot_, x.cell, x.position, x.position, 2 * radius);
      widest = std::max(widest, clearance);
      return clearance >= radius;
    };
    const auto first = std::ranges::find_if(line_, has_room);
    if (first == line_.end())
      throw Error(Error_code::outside,
                  fmt::format("radius: no point of the centre line from {} to {} is {} away from all walls; "
                              "the widest place has {:.4g}: give a smaller radius, or a path",
                              from_.name, to_.name, radius, widest));
    if (!from_.open.empty()) line_.erase(line_.begin(), first);
    while (!to_.open.empty() && !has_room(line_.back())) line_.pop_back();
  }

  static constexpr double least_clearance = 1e-300;

  const Snapshot<D>& snapshot_;
  const Line_end<D>&from_, &to_;
  detail::Nearest_walls<D> walls_;
  std::vector<double> clearance_;  ///< by index of cells; 0: not known yet
  std::vector<Particle<D>> line_;
  double piece_ = 0;
  Walk_counts counts_;
};

}  // namespace

template <int D>
double Centre_line<D>::length() const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) sum += cellwalk::length(points[i + 1] - points[i]);
  return sum;
}

template <int D>
Centre_line<D> find_centre_line(const Snapshot<D>& snapshot, const Groups<D>& groups,
                                const Catheter_ends<D>& ends, double radius) {
  const Line_end<D> from(snapshot, groups, ends.from, "from"), to(snapshot, groups, ends.to, "to");
  Centre_line<D> line = Line_finder<D>(snapshot, from, to).find(radius);
  if (line.points.empty())
    throw Error(Error_code::outside,
                fmt::format("to: no way leads from {} to {}: they lie in different components of free space, "
                            "of {} and {} cells",
                            from.name, to.name, detail::cells_joined_to(snapshot, from.cells.front()),
                            detail::cells_joined_to(snapshot, to.cells.front())));
  if (line.points.size() < 2)
    throw Error(Error_code::input, fmt::format("to: {} is where the catheter enters", to.name));
  return line;
}

namespace {

/// Of a catheter whose numbers follow from its line: its spacing is this share of the distance from walls
/// that a tenth of the line is below; it is longer than the line, as it may lie along walls.
constexpr double spacing_share = 0.5, narrow = 0.1, longer = 1.1;
constexpr double most_vertices_laid = 100'000;

}  // namespace

template <int D>
void lay_along_centre_line(const Snapshot<D>& snapshot, const Groups<D>& groups, Catheter<D>& catheter) {
  Centre_line<D> line;
  try {
    line = find_centre_line(snapshot, groups, *catheter.ends, catheter.radius);
  } catch (const Error& error) {
    throw Error(error.code(), std::string("catheter.") + error.what());
  }
  if (catheter.spacing == 0)
    catheter.spacing =
        std::max(spacing_share * quantile(line.clearances, narrow), line.length() / most_vertices_laid);
  if (catheter.advance == 0) catheter.advance = catheter.spacing / 2;
  if (catheter.particles == 0)
    catheter.particles = static_cast<std::uint32_t>(
        std::min(most_vertices_laid, std::ceil(longer * line.length() / catheter.spacing) + 2));
  catheter.path = std::move(line.points);
}

template struct Centre_line<2>;
template struct Centre_line<3>;
template Centre_line<2> find_centre_line(const Snapshot<2>&, const Groups<2>&, const Catheter_ends<2>&,
                                         double);
template Centre_line<3> find_centre_line(const Snapshot<3>&, const Groups<3>&, const Catheter_ends<3>&,
                                         double);
template void lay_along_centre_line(const Snapshot<2>&, const Groups<2>&, Catheter<2>&);
template void lay_along_centre_line(const Snapshot<3>&, const Groups<3>&, Catheter<3>&);

}  // namespace cellwalk
