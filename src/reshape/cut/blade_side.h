// SPDX-License-Identifier: LGPL-3.0-or-later
// Which edges a blade passes, and on which side of it points lie.
#ifndef CELLWALK_RESHAPE_CUT_BLADE_SIDE_H
#define CELLWALK_RESHAPE_CUT_BLADE_SIDE_H

#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/reshape/cut.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace cellwalk::detail {

/// \throw Error(input) for a point that is not finite, for a piece that names no point, or has no extent, and
///        for two pieces whose sides do not agree
template <int D>
void check_blade(const Blade<D>& blade);

template <int D>
class Blade_side {
 public:
  /// \throw Error(input) as check_blade()
  explicit Blade_side(const Blade<D>& blade);

  /// \throw Error(input) for a corner of a piece that lies so far off an environment, given by its box, that
  ///        doubles cannot decide which piece is near a point
  void check_reach(const Box<D>& environment) const;
  const Box<D>& box() const { return box_; }
  /// True if the box of a piece meets a box.
  bool may_pass(const Box<D>& box) const;

  /// The share of the segment uv, rounded, at which the blade passes it: u and v lie strictly on either side
  /// of the plane of a piece, which the segment meets. The first piece that it does counts.
  std::optional<double> passes(const Point<D>& u, const Point<D>& v) const;
  /// True if x lies on a piece, exactly.
  bool has(const Point<D>& x) const;
  /// Positive in front of the blade, from where its pieces are seen counterclockwise; by the piece that is
  /// nearest, in doubles: it chooses where a cut runs, and decides nothing.
  double side(const Point<D>& x) const;

 private:
  using Corners = std::array<Point<D>, static_cast<std::size_t>(D)>;
  std::vector<Corners> pieces_;
  std::vector<Vector<D>> normals_;  ///< unit
  std::vector<Box<D>> boxes_;
  Box<D> box_;
};

extern template void check_blade(const Blade<2>&);
extern template void check_blade(const Blade<3>&);
extern template class Blade_side<2>;
extern template class Blade_side<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_CUT_BLADE_SIDE_H
