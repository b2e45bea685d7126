// SPDX-License-Identifier: GPL-3.0-or-later
// Components of the free space, and its cells.
#include "free_cells.h"

#include <algorithm>

#include "edges.h"

namespace cellwalk::detail {
namespace {

/// Components with a smaller part of the largest one's volume are left out: between facets that cross almost
/// in parallel, rounding leaves pockets.
constexpr double tiny = 1e-4;

/// The facet opposite corner i of a positive tetrahedron, seen from outside.
Triangle outward(const std::array<std::uint32_t, 4>& t, int i) {
  Triangle f{t[(i + 1) & 3], t[(i + 2) & 3], t[(i + 3) & 3]};
  if ((i & 1) != 0) std::swap(f[1], f[2]);
  return f;
}

bool is_free_beyond(const Free_space& space, std::uint32_t t, int i) {
  const std::int32_t n = space.mesh.neighbours[t][i];
  return n >= 0 && space.is_free[n];
}

/// The triangle between two free tetrahedra, if it is a membrane.
bool is_membrane(const Free_space& space, const Labels::const_iterator& label) {
  if (label == space.labels.end()) return false;
  return label->second.part == Part::sheet || (space.keeps_inner && label->second.part == Part::surface);
}

template <class Visit>
void for_each_free_side(const Free_space& space, const Visit& visit) {
  for (std::uint32_t t = 0; t < space.mesh.tetrahedra.size(); ++t)
    for (int i = 0; i < 4 && space.is_free[t]; ++i)
      visit(t, i, space.labels.find(opposite(space.mesh.tetrahedra[t], i)));
}

}  // namespace

Found leave_out_small(Free_space& space) {
  Joined_sets sets(space.mesh.tetrahedra.size());
  for_each_free_side(space, [&](std::uint32_t t, int i, const auto& label) {
    if (is_free_beyond(space, t, i) && !is_membrane(space, label))
      sets.join(t, static_cast<std::uint32_t>(space.mesh.neighbours[t][i]));
  });
  std::vector<double> volume(space.is_free.size(), 0);
  for (std::uint32_t t = 0; t < space.is_free.size(); ++t)
    if (space.is_free[t]) volume[sets.find(t)] += volume_of(space.mesh, t);
  const double largest = volume.empty() ? 0 : *std::max_element(volume.begin(), volume.end());
  Found left_out;
  for (std::uint32_t t = 0; t < space.is_free.size(); ++t) {
    const double share = volume[sets.find(t)] / largest;
    if (!space.is_free[t] || share >= tiny) continue;
    space.is_free[t] = false;
    if (sets.find(t) != t) continue;
    const double sum = left_out.measured;
    left_out.add(centre_of(space.mesh, t));
    left_out.measured = sum + share;
  }
  return left_out;
}

std::vector<Facet> walls_of(const Free_space& space) {
  std::vector<Facet> walls;
  for_each_free_side(space, [&](std::uint32_t t, int i, const auto& label) {
    const bool is_inner = is_free_beyond(space, t, i);
    if (is_inner &&
        (!is_membrane(space, label) || space.mesh.neighbours[t][i] < static_cast<std::int32_t>(t)))
      return;
    Facet wall{outward(space.mesh.tetrahedra[t], i)};
    if (label != space.labels.end()) wall.part = label->second.part, wall.number = label->second.number;
    walls.push_back(wall);
  });
  return walls;
}

Found opened_facets(const Free_space& space) {
  Found opened;
  for_each_free_side(space, [&](std::uint32_t t, int i, const auto& label) {
    if (label == space.labels.end() || label->second.part != Part::surface || is_membrane(space, label) ||
        !is_free_beyond(space, t, i) || space.mesh.neighbours[t][i] < static_cast<std::int32_t>(t))
      return;
    Point<3> place{};
    for (const std::uint32_t v : label->first) place = place + (1.0 / 3) * space.mesh.points[v];
    opened.add(place);
  });
  return opened;
}

double free_volume(const Free_space& space) {
  double volume = 0;
  for (std::uint32_t t = 0; t < space.is_free.size(); ++t)
    if (space.is_free[t]) volume += volume_of(space.mesh, t);
  return volume;
}

Repaired_surface cells_of(const Free_space& space, const Part_names& names) {
  Repaired_surface result;
  for (const auto& [key, name] : names) result.groups[name];
  std::vector<std::uint32_t> number(space.mesh.points.size(), 0xffffffffu);
  for (std::uint32_t t = 0; t < space.is_free.size(); ++t) {
    if (!space.is_free[t]) continue;
    for (int i = 0; i < 4; ++i) {
      Triangle f = outward(space.mesh.tetrahedra[t], i);
      const auto label = space.labels.find(sorted(f));
      const bool is_inner = is_free_beyond(space, t, i);
      const bool is_wall = !is_inner || is_membrane(space, label);
      for (std::uint32_t& v : f) {
        if (number[v] == 0xffffffffu) {
          number[v] = static_cast<std::uint32_t>(result.soup.points.size());
          result.soup.points.push_back(space.mesh.points[v]);
        }
        v = number[v];
      }
      if (is_wall && label != space.labels.end()) {
        const auto name = names.find({label->second.part, label->second.number});
        const bool is_second_side = is_inner && space.mesh.neighbours[t][i] < static_cast<std::int32_t>(t);
        if (name != names.end() && !is_second_side)
          result.groups[name->second].facets.push_back(static_cast<std::uint32_t>(result.soup.facet_count()));
      }
      result.soup.add_facet({f[0], f[1], f[2]}, is_wall);
    }
    result.soup.end_cell();
  }
  return result;
}

}  // namespace cellwalk::detail
