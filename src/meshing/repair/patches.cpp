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
/// A patch that surrounds its own border more than this is a shell with a hole: that fills half of the view
/// there.
constexpr double shell = 0.3;
constexpr std::size_t samples_of_patch = 9;
/// Within this part of the size, components touch.
constexpr double touching = 1e-11;
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

/// The components of a surface: patches connected by edges of two triangles that are closed by themselves,
/// and the others, connected by edges of any number.
class Components {
 public:
  explicit Components(const Facets& s) : surface_(s) {
    const auto uses = edge_uses(s.facets);
    Joined_sets patches = connected(s.facets, uses);
    std::vector<bool> is_closed(s.facets.size(), true);
    for_each_edge(uses, [&](std::span<const Edge_use> edge) {
      if (edge.size() == 2) {  // of one patch
        if (edge[0].forward == edge[1].forward) is_closed[patches.find(edge[0].facet)] = false;
        return;
      }
      std::map<std::uint32_t, int> sums;
      for (const Edge_use& use : edge) sums[patches.find(use.facet)] += use.forward ? 1 : -1;
      for (const auto& [patch, sum] : sums)
        if (sum != 0) is_closed[patch] = false;
    });
    Joined_sets sets = patches;
    for_each_edge(uses, [&](std::span<const Edge_use> edge) {
      std::uint32_t first = none;
      for (const Edge_use& use : edge) {
        if (is_closed[patches.find(use.facet)]) continue;
        if (first == none) first = use.facet;
        sets.join(first, use.facet);
      }
    });
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::uint32_t f = 0; f < s.facets.size(); ++f) {
      if (s.facets[f].part == Part::sheet) {
        of_.push_back(none);
        continue;
      }
      const auto at = number.insert({sets.find(f), static_cast<std::uint32_t>(number.size())}).first;
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
  /// True if a component lies inside another one, whatever its orientation. If they meet, most of it must.
  bool encloses(std::size_t outer, std::size_t inner, bool they_meet) const {
    const std::vector<std::uint32_t>& facets = facets_[inner];
    const std::size_t samples = they_meet ? std::min(samples_of_patch, facets.size()) : 1;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < samples; ++i) {
      const Point<3> p = centre(surface_, surface_.facets[facets[i * facets.size() / samples]]);
      double sum = 0;
      for (const std::uint32_t f : facets_[outer]) {
        const Facet& t = surface_.facets[f];
        sum += winding_number(surface_.corner(t, 0), surface_.corner(t, 1), surface_.corner(t, 2), p);
      }
      inside += std::abs(sum) > 0.5;
    }
    return static_cast<double>(inside) > surrounded * static_cast<double>(samples);
  }

 private:
  const Facets& surface_;
  std::vector<std::uint32_t> of_;
  std::vector<std::vector<std::uint32_t>> facets_;
};

struct Extent {
  Point<3> low, high;

  bool contains(const Extent& other, double within) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (other.low[k] < low[k] - within || other.high[k] > high[k] + within) return false;
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

/// Calls visit(f, g) for triangles of different components that touch up to rounding, which may part a
/// component in another one from the wall on which it stands.
template <class Visit>
void for_each_touching_pair(const Facets& surface, const Components& components, const Visit& visit) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
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
    const Near_triangles near = distance_of(corners(f), corners(g), names(f), names(g));
    if (near.common_corners > 0 || near.distance <= within) visit(a.info(), b.info());
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
  std::vector<double> volumes;
  for (std::size_t c = 0; c < components.size(); ++c) {
    extents.push_back(extent_of(surface, components.facets(c)));
    volumes.push_back(components.volume(c));
  }
  Oriented result;
  std::vector<std::uint32_t> turned;
  for (std::size_t c = 0; c < components.size(); ++c) {
    bool is_hole = false;
    for (std::uint32_t other = 0; other < components.size(); ++other) {
      if (other == c || !extents[other].contains(extents[c], touching * surface.size)) continue;
      // One that meets it from inside may be a part of the body or a hollow in it: the file's directions say.
      const bool they_meet = std::binary_search(meets[c].begin(), meets[c].end(), other);
      if (they_meet && (volumes[c] < 0) == (volumes[other] < 0)) continue;
      if (components.encloses(other, c, they_meet)) is_hole = !is_hole;
    }
    if ((volumes[c] < 0) != is_hole)
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
  // Without a sheet, more edges have an even number of triangles, which cancel.
  std::vector<std::ptrdiff_t> mended_edges(surface.facets.size(), 0);
  std::vector<bool> is_at_border(surface.facets.size(), false);
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    if (edge.size() == 2) return;
    for (const Edge_use& use : edge) {
      const std::uint32_t root = sets.find(use.facet);
      std::ptrdiff_t rest = 0;
      for (const Edge_use& other : edge)
        if (sets.find(other.facet) != root) rest += other.forward ? 1 : -1;
      mended_edges[root] += edge.size() % 2 == 1 && rest == 0 ? 1 : -1;
      is_at_border[use.facet] = true;
    }
  });
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f)
    if (surface.facets[f].part != Part::sheet && mended_edges[sets.find(f)] > 0)
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
    double own = 0;
    std::size_t borders = 0;
    for (const std::uint32_t f : patch) {
      if (!is_at_border[f] || borders == samples_of_patch) continue;
      own += std::abs(winding_number_if(surface, centre(surface, surface.facets[f]),
                                        [&](std::uint32_t g) { return g != f && sets.find(g) == root; }));
      ++borders;
    }
    if (own > shell * static_cast<double>(borders)) continue;
    std::size_t inside = 0, samples = std::min(samples_of_patch, patch.size());
    for (std::size_t i = 0; i < samples; ++i) {
      const Facet& f = surface.facets[patch[i * patch.size() / samples]];
      const double rest = winding_number_if(surface, centre(surface, f), [&](std::uint32_t g) {
        // One in the same place counts as a half, whose sign is a matter of rounding.
        return sets.find(g) != root && sorted(surface.facets[g].corners) != sorted(f.corners);
      });
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
