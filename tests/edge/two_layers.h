// SPDX-License-Identifier: LGPL-3.0-or-later
// Two layers of unit cubes with walls put in by hand, for faces.
#ifndef CELLWALK_TESTS_EDGE_TWO_LAYERS_H
#define CELLWALK_TESTS_EDGE_TWO_LAYERS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/gluing.h>

#include "oracle/squares_and_cubes.h"

namespace cellwalk::test {

/// Two layers of unit cubes; the plane between them is z = 1.
class Two_layers {
 public:
  explicit Two_layers(std::uint32_t n) : n_(n), soup_(oracle::make_cubes(n, n, 2)) {}

  /// A membrane between the layers.
  void lay(std::uint32_t x, std::uint32_t y) { oracle::set_wall(soup_, index(x, y, 0), index(x, y, 1)); }
  /// Walls all round a cube of the lower layer.
  void fill(std::uint32_t x, std::uint32_t y) {
    lay(x, y);
    for (const std::uint32_t other :
         {index(x - 1, y, 0), index(x + 1, y, 0), index(x, y - 1, 0), index(x, y + 1, 0)})
      oracle::set_wall(soup_, index(x, y, 0), other);
    soup_.solid[index(x, y, 0)] = 1;
  }
  /// A wall between two cubes of a layer, across x.
  void stand(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    oracle::set_wall(soup_, index(x - 1, y, z), index(x, y, z));
  }
  Snapshot<3> compile() const { return Snapshot<3>::compile(soup_, glue(soup_)); }
  std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + n_ * (y + n_ * z);
  }

 private:
  std::uint32_t n_;
  Cell_soup<3> soup_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_TWO_LAYERS_H
