// SPDX-License-Identifier: GPL-3.0-or-later
// The names of the vertices and facets of surfaces in messages: their numbers in the input.
#ifndef CELLWALK_MESHING_FILL_FEATURE_NAMES_H
#define CELLWALK_MESHING_FILL_FEATURE_NAMES_H

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// Surfaces one after the other, with their vertices and facets numbered through.
class Feature_names {
 public:
  /// \param points,facets their numbers in the input; empty if nobody counts them
  void add(std::string surface, std::vector<std::uint32_t> points, std::size_t point_count,
           std::vector<std::uint32_t> facets, std::size_t facet_count) {
    surfaces_.push_back(
        {std::move(surface), {std::move(points), point_count}, {std::move(facets), facet_count}});
  }

  std::string vertex(std::size_t v) const { return name("vertex", &Surface::points, v); }
  std::string facet(std::size_t f) const { return name("facet", &Surface::facets, f); }
  /// Both: "vertices 3 and 5", "facet 0 of surface and facet 2 of obstacle 1".
  std::string vertices(std::size_t v, std::size_t w) const {
    return names("vertex", "vertices", &Surface::points, v, w);
  }
  std::string facets(std::size_t f, std::size_t g) const {
    return names("facet", "facets", &Surface::facets, f, g);
  }

 private:
  struct Numbers {
    std::vector<std::uint32_t> input;
    std::size_t count;
  };
  struct Surface {
    std::string name;
    Numbers points, facets;
  };

  /// The surface of a feature, and its number there.
  std::pair<std::size_t, std::size_t> place(Numbers Surface::*numbers, std::size_t i) const {
    std::size_t s = 0;
    for (; s + 1 < surfaces_.size() && i >= (surfaces_[s].*numbers).count; ++s)
      i -= (surfaces_[s].*numbers).count;
    return {s, i};
  }
  std::string of(std::size_t surface) const {
    return surfaces_.size() > 1 ? " of " + surfaces_[surface].name : "";
  }
  std::string name(const std::string& kind, Numbers Surface::*numbers, std::size_t feature) const {
    const auto [s, i] = place(numbers, feature);
    const auto& input = (surfaces_[s].*numbers).input;
    return (input.empty() ? "a " + kind : kind + " " + std::to_string(input[i])) + of(s);
  }
  std::string names(const std::string& one, const std::string& many, Numbers Surface::*numbers,
                    std::size_t feature, std::size_t other) const {
    const auto [s, i] = place(numbers, feature);
    const auto [t, j] = place(numbers, other);
    const auto& input = (surfaces_[s].*numbers).input;
    if (s != t || input.empty()) return name(one, numbers, feature) + " and " + name(one, numbers, other);
    return many + " " + std::to_string(input[i]) + " and " + std::to_string(input[j]) + of(s);
  }

  std::vector<Surface> surfaces_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_FEATURE_NAMES_H
