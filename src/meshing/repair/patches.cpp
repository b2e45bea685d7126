// SPDX-License-Identifier: GPL-3.0-or-later
// Floods across edges, and components within components.
#include "patches.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "edges.h"
#include "meshing/fill/narrow_distance.h"
#include "winding.h"

namespace cellwalk::detail {
namespace {

/// Above this, the rest of a surface surrounds a sheet: a half or less where the sheet is a part of the wall.
constexpr double surrounded = 0.75;
constexpr std::size_t samples_of_patch = 9;
/// Solid angles that are computed in all, about ten seconds: where there are more patches, those beyond the
/// largest ones are debris.
constexpr std::size_t most_angles = 200'000'000;

Joined_sets connected(const std::vector<Facet>& facets, const std::vector<Edge_use>& uses) {
  Joined_sets patches(facets.size());
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    if (edge.size() == 2) patches.join(edge[0].facet, edge[1].facet);
  });
  return patches;
}

/// True if all corners lie in one plane, up to rounding.
bool is_flat(const Facets& s, const std::vector<std::uint32_t>& patch) {
  const auto largest = *std::max_element(patch.begin(), patch.end(), [&](std::uint32_t f, std::uint32_t g) {
    return area(s, s.facets[f]) < area(s, s.facets[g]);
  });
  const Vector<3> normal = normalized(area_vector(s, s.facets[largest]), {});
  const Point<3>& origin = s.corner(s.facets[largest], 0);
  constexpr double rounding = 1e-9;
  return std::all_of(patch.begin(), patch.end(), [&](std::uint32_t f) {
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(dot(s.corner(s.facets[f], k) - origin, normal)) > rounding * s.size) return false;
    return true;
  });
}

/// The components of a surface, connected by points.
class Components {
 public:
  explicit Components(const Facets& s) : surface_(s) {
    Joined_sets points(s.points.size());
    for (const Facet& f : s.facets)
      if (f.part != Part::sheet)
        points.join(f.corners[0], f.corners[1]), points.join(f.corners[0], f.corners[2]);
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::uint32_t f = 0; f < s.facets.size(); ++f) {
      if (s.facets[f].part == Part::sheet) {
        of_.push_back(none);
        continue;
      }
      const auto at =
          number.insert({points.find(s.facets[f].corners[0]), static_cast<std::uint32_t>(number.size())})
              .first;
      of_.push_back(at->second);
    }
    facets_.resize(number.size());
    for (std::uint32_t f = 0; f < s.facets.size(); ++f)
      if (of_[f] != none) facets_[of_[f]].push_back(f);
  }

  static constexpr std::uint32_t none = 0xffffffffu;

  std::size_t size() const { return facets_.size(); }
  std::uint32_t of(std::uint32_t facet) const { return of_[facet]; }
  const std::vector<std::uint32_t>& facets(std::size_t c) const { return facets_[c]; }

  double volume(std::size_t c) const {
    double sum = 0;
    const Point<3> origin = centre(surface_, surface_.facets[facets_[c][0]]);
    for (const std::uint32_t f : facets_[c]) sum += signed_volume(surface_, {&surface_.facets[f], 1}, origin);
    return sum;
  }
  /// True if a point lies inside a component, whatever its orientation.
  bool encloses(std::size_t c, const Point<3>& p) const {
    double sum = 0;
    for (const std::uint32_t f : facets_[c]) {
      const Facet& t = surface_.facets[f];
      sum += winding_number(surface_.corner(t, 0), surface_.corner(t, 1), surface_.corner(t, 2), p);
    }
    return std::abs(sum) > 0.5;
  }

 private:
  const Facets& surface_;
  std::vector<std::uint32_t> of_;
  std::vector<std::vector<std::uint32_t>> facets_;
};

struct Extent {
  Point<3> low, high;

  bool contains(const Point<3>& p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < low[k] || p[k] > high[k]) return false;
    return true;
  }
};

Extent extent_of(const Facets& s, const std::vector<std::uint32_t>& facets) {
  Extent e{s.corner(s.facets[facets[0]], 0), s.corner(s.facets[facets[0]], 0)};
  for (const std::uint32_t f : facets)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        e.low[k] = std::min(e.low[k], s.corner(s.facets[f], i)[k]);
        e.high[k] = std::max(e.high[k], s.corner(s.facets[f], i)[k]);
      }
  return e;
}

/// Calls visit(f, g) for triangles of different components that touch up to rounding. It may part a component in
/// another one from the wall on which it stands.
template <class Visit>
void for_each_touching_pair(const Facets& surface, const Components& components, const Visit& visit) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  constexpr double touching = 1e-11;
  const double within = touching * surface.size;
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    if (components.of(f) == Components::none) continue;
    CGAL::Bbox_3 box;
    for (std::size_t k = 0; k < 3; ++k) box += to_cgal(surface.corner(surface.facets[f], k)).bbox();
    boxes.emplace_back(CGAL::Bbox_3(box.xmin() - within, box.ymin() - within, box.zmin() - within,
                                    box.xmax() + within, box.ymax() + within, box.zmax() + within),
                       f);
  }
  const auto corners = [&](const Facet& f) {
    return Triangle_corners{surface.corner(f, 0), surface.corner(f, 1), surface.corner(f, 2)};
  };
  const auto names = [](const Facet& f) {
    return std::array<std::size_t, 3>{f.corners[0], f.corners[1], f.corners[2]};
  };
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (components.of(a.info()) == components.of(b.info())) return;
    const Facet &f = surface.facets[a.info()], &g = surface.facets[b.info()];
    if (distance_of(corners(f), corners(g), names(f), names(g)).distance <= within) visit(a.info(), b.info());
  });
}

}  // namespace

Turned turn_to_agree(Facets& surface) {
  std::vector<Facet>& facets = surface.facets;
  const auto uses = edge_uses(facets);
  struct Neighbour {
    std::uint32_t facet;
    bool agrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(facets.size());
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].forward != edge[1].forward;
    neighbours[edge[0].facet].push_back({edge[1].facet, agrees});
    neighbours[edge[1].facet].push_back({edge[0].facet, agrees});
  });
  Turned turned;
  enum : std::uint8_t { unseen, kept, reversed };
  std::vector<std::uint8_t> state(facets.size(), unseen);
  for (std::uint32_t seed = 0; seed < facets.size(); ++seed) {
    if (state[seed] != unseen) continue;
    std::vector<std::uint32_t> patch{seed};
    state[seed] = kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::uint32_t f = patch[i];
      count += state[f] == reversed;
      for (const Neighbour& n : neighbours[f]) {
        const std::uint8_t wanted = n.agrees == (state[f] == kept) ? kept : reversed;
        if (state[n.facet] == unseen) {
          state[n.facet] = wanted;
          patch.push_back(n.facet);
        } else if (state[n.facet] != wanted && n.facet > f) {
          turned.one_sided.add(centre(surface, facets[f]));
        }
      }
    }
    const std::uint8_t minority = 2 * count > patch.size() ? kept : reversed;
    for (const std::uint32_t f : patch)
      if (state[f] == minority) {
        turn(facets[f]);
        turned.facets.add(centre(surface, facets[f]));
      }
  }
  return turned;
}

Oriented orient_by_nesting(Facets& surface,
                           const std::vector<std::pair<std::uint32_t, std::uint32_t>>& crossing) {
  const Components components(surface);
  std::vector<std::vector<std::uint32_t>> meets(components.size());
  const auto meet = [&](std::uint32_t f, std::uint32_t g) {
    const std::uint32_t a = components.of(f), b = components.of(g);
    if (a == Components::none || b == Components::none || a == b) return;
    meets[a].push_back(b), meets[b].push_back(a);
  };
  for (const auto& [f, g] : crossing) meet(f, g);
  if (components.size() > 1) for_each_touching_pair(surface, components, meet);
  for (auto& others : meets) std::sort(others.begin(), others.end());
  std::vector<Extent> extents;
  for (std::size_t c = 0; c < components.size(); ++c)
    extents.push_back(extent_of(surface, components.facets(c)));
  Oriented result;
  std::vector<std::uint32_t> turned;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Point<3> place = surface.corner(surface.facets[components.facets(c)[0]], 0);
    bool is_hole = false;
    for (std::size_t other = 0; other < components.size(); ++other)
      if (other != c && extents[other].contains(place) &&
          !std::binary_search(meets[c].begin(), meets[c].end(), other) && components.encloses(other, place))
        is_hole = !is_hole;
    if ((components.volume(c) < 0) != is_hole)
      turned.insert(turned.end(), components.facets(c).begin(), components.facets(c).end());
  }
  for (const std::uint32_t f : turned) {
    turn(surface.facets[f]);
    result.facets.add(centre(surface, surface.facets[f]));
  }
  result.inside_out = !turned.empty() && turned.size() == surface.facets.size();
  const auto uses = edge_uses(surface.facets);
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    std::ptrdiff_t sum = 0;
    for (const Edge_use& use : edge) sum += use.forward ? 1 : -1;
    if (sum != 0) result.uneven.add(0.5 * (surface.points[edge[0].low] + surface.points[edge[0].high]));
  });
  return result;
}

Found find_inner_sheets(Facets& surface) {
  const auto uses = edge_uses(surface.facets);
  Joined_sets sets = connected(surface.facets, uses);
  // Without a sheet, fewer edges have an odd number of triangles.
  std::vector<std::ptrdiff_t> odd_edges(surface.facets.size(), 0);
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    if (edge.size() == 2) return;
    for (const Edge_use& use : edge) odd_edges[sets.find(use.facet)] += edge.size() % 2 == 1 ? 1 : -1;
  });
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f)
    if (surface.facets[f].part != Part::sheet && odd_edges[sets.find(f)] > 0)
      by_root[sets.find(f)].push_back(f);
  std::vector<std::vector<std::uint32_t>> patches;
  for (auto& [root, patch] : by_root) patches.push_back(std::move(patch));
  std::stable_sort(patches.begin(), patches.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  const std::size_t most_tested = most_angles / (samples_of_patch * surface.facets.size()) + 1;
  if (patches.size() > most_tested) patches.resize(most_tested);
  Found found;
  for (const auto& patch : patches) {
    const std::uint32_t root = sets.find(patch[0]);
    std::size_t inside = 0, samples = std::min(samples_of_patch, patch.size());
    for (std::size_t i = 0; i < samples; ++i) {
      const Facet& f = surface.facets[patch[i * patch.size() / samples]];
      const double rest = winding_number_if(surface, centre(surface, f),
                                            [&](std::uint32_t g) { return sets.find(g) != root; });
      inside += std::abs(rest) > surrounded;
    }
    // A flat patch encloses nothing, also where it pokes through a wall.
    if (inside == 0 || (inside < samples && !is_flat(surface, patch))) continue;
    for (const std::uint32_t f : patch) {
      surface.facets[f].part = Part::sheet;
      found.add(centre(surface, surface.facets[f]));
    }
  }
  return found;
}

}  // namespace cellwalk::detail
