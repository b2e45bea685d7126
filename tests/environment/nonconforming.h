// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes whose cells do not conform: boxes in layers that are cut in several ways, and divided into cells of
// different kinds.
#ifndef CELLWALK_TESTS_ENVIRONMENT_NONCONFORMING_H
#define CELLWALK_TESTS_ENVIRONMENT_NONCONFORMING_H

#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace cellwalk::test {

/// What differs between boxes.
struct Layers_options {
  bool cells = false;       ///< each box is divided in its own way; else all are, in one that conforms
  bool by_layer = false;    ///< with `cells`: all boxes of a layer are divided alike, and conform
  bool hanging = false;     ///< every other layer is cut twice as often
  bool shifted = false;     ///< each layer is cut anywhere
  bool collinear = false;   ///< some polyhedra (2D: polygons) have the points on their edges as vertices
  bool incomplete = false;  ///< some cells are solid, and some boxes are left out
  bool turned = true;       ///< by a random integer matrix, so that planes are oblique
  /// Layers have points of their own, at multiples of this distance from each other; negative: common points.
  double gap = -1;
};

/// Of small integer coordinates, but for the gap. All cells are exact.
/// \param below a number below n, of which all choices are made
template <int D>
Cell_soup<D> layers(const Layers_options& options, const std::function<std::size_t(std::size_t n)>& below);

extern template Cell_soup<2> layers(const Layers_options&, const std::function<std::size_t(std::size_t)>&);
extern template Cell_soup<3> layers(const Layers_options&, const std::function<std::size_t(std::size_t)>&);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_NONCONFORMING_H
