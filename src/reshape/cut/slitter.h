// SPDX-License-Identifier: LGPL-3.0-or-later
// A slit in membranes, walls with free cells on both sides, along a blade. Theory: docs/cutting.md.
#ifndef CELLWALK_RESHAPE_CUT_SLITTER_H
#define CELLWALK_RESHAPE_CUT_SLITTER_H

#include <cellwalk/reshape/cut.h>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "blade_side.h"
#include "reshape/toggle/toggle.h"
#include "splitter.h"

namespace cellwalk::detail {

/// Makes one slit.
template <int D>
class Slitter {
 public:
  /// \throw Error(input) for a blade that is none
  Slitter(Environment<D>& environment, Splitter<D>& splitter, Toggle<D>& toggle, const Blade<D>& blade,
          const Cut_options<D>& options)
      : environment_(environment),
        splitter_(splitter),
        toggle_(toggle),
        blade_(blade),
        half_width_(options.opening / 2) {}

  /// Opens the groups near all that will be split, so that nothing is refused for them after a change.
  /// \throw Error(usage) for a particle near that does not lie in its cell
  void prepare();
  Cut_report run();

 private:
  /// An edge of membranes that crosses a border of the slit, and where: beyond an end means there.
  struct Crossing {
    std::array<std::uint32_t, 2> edge;
    double share;
  };
  enum class Border : std::int8_t { back = -1, front = 1 };

  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }
  bool is_membrane(Half_facet facet) const;
  std::set<std::array<std::uint32_t, 2>> near_edges() const;
  std::optional<double> share_at(Border border, std::uint32_t u, std::uint32_t v) const;
  std::vector<Crossing> crossings(Border border) const;
  void split(Border border);
  void open();

  Environment<D>& environment_;
  Splitter<D>& splitter_;
  Toggle<D>& toggle_;
  Blade_side<D> blade_;
  double half_width_;
  Cut_report report_;
  std::set<std::uint32_t> vertices_;  ///< of the slit
};

extern template class Slitter<2>;
extern template class Slitter<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_CUT_SLITTER_H
