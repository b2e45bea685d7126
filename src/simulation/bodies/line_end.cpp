// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups and points looked up, and the free cells at them.
#include "line_end.h"

#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/locate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cellwalk::detail {
namespace {

/// In radii of the group: how far before its middle the line ends, the first that is in sight.
constexpr double distances_before[] = {0.05, 0.1, 0.2, 0.4};

/// Outwards seen from the cell, and as long as the facet is large.
Vector<3> area_vector(const Snapshot<3>& snapshot, const std::vector<std::uint32_t>& loop) {
  Vector<3> sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum = sum + 0.5 * cross(snapshot.point(loop[i]) - snapshot.point(loop[0]),
                            snapshot.point(loop[i + 1]) - snapshot.point(loop[0]));
  return sum;
}
Vector<2> area_vector(const Snapshot<2>& snapshot, const std::vector<std::uint32_t>& loop) {
  const Vector<2> along = snapshot.point(loop[1]) - snapshot.point(loop[0]);
  return {along[1], -along[0]};
}

}  // namespace

template <int D>
Line_end<D>::Line_end(const Snapshot<D>& snapshot, const Groups<D>& groups, const Catheter_end<D>& end,
                      const char* key) {
  if (const auto* point = std::get_if<Point<D>>(&end)) {
    name = fmt::format("({})", fmt::join(*point, ", "));
    find_point(snapshot, *point);
    if (cells.empty())
      throw Error(Error_code::outside,
                  fmt::format("{}: {} lies in no free cell; put it into free space", key, name));
    return;
  }
  name = std::get<std::string>(end);
  const auto group = groups.find(name);
  if (group == groups.end()) {
    std::string known;
    for (const auto& [other, selection] : groups) known += (known.empty() ? "" : ", ") + other;
    throw Error(Error_code::input,
                fmt::format("{}: there is no group \"{}\"; {}", key, name,
                            known.empty() ? "the environment has none: give a point" : "there are " + known));
  }
  find_group(snapshot, group->second);
  if (cells.empty())
    throw Error(Error_code::input, fmt::format("{}: group \"{}\" has no facet of a free cell", key, name));
}

template <int D>
void Line_end<D>::find_point(const Snapshot<D>& snapshot, const Point<D>& point) {
  middle = point;
  const Location<D> location = Locator<D>(snapshot).locate(point);
  if (location.status == Location_status::free) cells = {location.cell};
}

template <int D>
void Line_end<D>::find_group(const Snapshot<D>& snapshot, const Selection<D>& group) {
  std::set<Cell> at;
  const auto add = [&](Cell c) {
    if (c != Cell::none && !snapshot.is_solid(c)) at.insert(c);
  };
  Vector<D> sum{};
  double area = 0;
  for (const Half_facet f : group.facets) {
    const Cell own = snapshot.cell_of(f);
    add(own);
    add(snapshot.neighbour(f));
    open.insert(f);
    const Vector<D> outwards = area_vector(snapshot, snapshot.loop(f));
    const double size = length(outwards);
    area += size;
    sum = sum + size * centroid(snapshot, f);
    inwards = snapshot.is_solid(own) ? inwards + outwards : inwards - outwards;
  }
  for (const Cell c : group.cells) add(c);
  cells.assign(at.begin(), at.end());
  if (area > 0) {
    middle = (1 / area) * sum;
    const double radius = D == 2 ? area / 2 : std::sqrt(area / std::numbers::pi);
    inwards = radius * normalized(inwards, Vector<D>{});
  } else {
    for (const Cell c : cells)
      middle = middle + (1 / static_cast<double>(cells.size())) * centroid(snapshot, c);
  }
}

template <int D>
std::vector<Point<D>> Line_end<D>::places() const {
  if (!(length(inwards) > 0)) return {middle};
  std::vector<Point<D>> result;
  for (const double distance : distances_before) {
    result.push_back(middle + distance * inwards);
    // A membrane has free space on both sides.
    result.push_back(middle - distance * inwards);
  }
  return result;
}

template <int D>
std::size_t cells_joined_to(const Snapshot<D>& snapshot, Cell cell) {
  std::vector<Cell> open{cell};
  std::vector<bool> is_seen(snapshot.cell_slots());
  is_seen[snapshot.index(cell)] = true;
  for (std::size_t i = 0; i < open.size(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(open[i]); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(open[i], k);
      const Cell next = snapshot.neighbour(f);
      if (next == Cell::none || snapshot.is_impassable(f) || is_seen[snapshot.index(next)]) continue;
      is_seen[snapshot.index(next)] = true;
      open.push_back(next);
    }
  return open.size();
}

template struct Line_end<2>;
template struct Line_end<3>;
template std::size_t cells_joined_to(const Snapshot<2>&, Cell);
template std::size_t cells_joined_to(const Snapshot<3>&, Cell);

}  // namespace cellwalk::detail
