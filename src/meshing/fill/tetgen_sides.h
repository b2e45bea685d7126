// SPDX-License-Identifier: GPL-3.0-or-later
// The test that TetGen preserved surfaces, and the surfaces that enclose each tetrahedron.
#ifndef CELLWALK_MESHING_FILL_TETGEN_SIDES_H
#define CELLWALK_MESHING_FILL_TETGEN_SIDES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tetgen_call.h"

namespace cellwalk::detail {

using Triangle = std::array<std::uint32_t, 3>;

struct Triangle_hash {
  std::size_t operator()(const Triangle& t) const {
    std::uint64_t h = t[0];
    for (int i : {1, 2}) h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u + t[i];
    return h ^ (h >> 32);
  }
};

/// The surface that each triangle belongs to, by its points in ascending order.
using Owners = std::unordered_map<Triangle, std::uint32_t, Triangle_hash>;

Triangle sorted(Triangle t);

/// The facet of a tetrahedron opposite vertex i.
Triangle opposite(const std::array<std::uint32_t, 4>& t, int i);

Owners owners_of(const std::vector<Surface_soup>& surfaces);

/// Checks that every triangle of the surfaces is a facet of the mesh, with its points unchanged.
/// \throw Error(not_certified) with the first vertex or facet that is not kept
void check_kept(const Tetgen_result& mesh, const std::vector<Surface_soup>& surfaces, const Owners& owners,
                const Feature_names& names);

/// The vertices of a tetrahedron in positive orientation.
/// \throw Error(not_certified) if it is flat
std::array<std::uint32_t, 4> positive(const Tetgen_result& mesh, std::array<std::uint32_t, 4> t);

/// The surfaces that enclose each tetrahedron: an odd number of their triangles lie between it and the
/// outside. Regions are flooded inwards from the hull; crossing a surface flips the bit of that surface.
class Sides {
 public:
  /// \pre the mesh and the owners outlive it
  /// \throw Error(not_certified) if a part of the mesh has no hull
  Sides(const Tetgen_result& mesh, const Owners& owners, std::size_t surfaces);

  const std::vector<bool>& operator[](std::size_t t) const { return sides_[region_[t]]; }

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  void flood(std::uint32_t seed, std::vector<bool> seed_sides);

  const Tetgen_result& mesh_;
  const Owners& owners_;
  std::vector<std::uint32_t> region_;     // per tetrahedron
  std::vector<std::vector<bool>> sides_;  // per region: enclosed by each surface
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_TETGEN_SIDES_H
