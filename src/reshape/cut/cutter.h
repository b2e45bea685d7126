// SPDX-License-Identifier: LGPL-3.0-or-later
// A cut: which edges are split, which facets form it, which vertices are parted. Theory: docs/cutting.md.
#ifndef CELLWALK_RESHAPE_CUT_CUTTER_H
#define CELLWALK_RESHAPE_CUT_CUTTER_H

#include <cellwalk/reshape/cut.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "blade_side.h"
#include "splitter.h"

namespace cellwalk::detail {

/// Makes one cut.
template <int D>
class Cutter {
 public:
  Cutter(Environment<D>& environment, Splitter<D>& splitter, const Blade<D>& blade,
         const Cut_options<D>& options)
      : environment_(environment), splitter_(splitter), blade_(blade), options_(options) {}

  /// Opens the groups near all that will be split, so that nothing is refused for them after a change.
  /// \throw Error(usage) for a particle near that does not lie in its cell
  void prepare();
  /// \param before the report of cuts made already, which is added
  Cut_report run(Cut_report before);

 private:
  using Key = std::array<std::uint32_t, static_cast<std::size_t>(D)>;
  enum class Side : std::int8_t { back = -1, on = 0, front = 1 };

  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }
  void check_reach() const;
  std::vector<Cell> near_cells() const;
  void label(std::span<const Cell> near);
  void split();
  bool split_edge(std::uint32_t u, std::uint32_t v, double share);
  void find_facets();
  void part();
  void part(std::uint32_t vertex);
  double longest_edge(std::uint32_t vertex, std::span<const Cell> cells) const;
  std::vector<std::vector<Cell>> solid_parts(std::uint32_t vertex);
  bool is_held(std::uint32_t vertex);
  Side side_of(std::uint32_t vertex);
  Side side_of(Cell cell);
  Key key_of(Half_facet facet) const;
  Vector<D> direction(std::uint32_t vertex, std::span<const Cell> solid) const;

  Environment<D>& environment_;
  Splitter<D>& splitter_;
  Blade_side<D> blade_;
  Cut_options<D> options_;
  Cut_report report_;
  std::map<std::uint32_t, Side> sides_;  ///< of vertices looked at
  /// Edges to be split, with the share at which the blade passes them.
  std::map<std::array<std::uint32_t, 2>, double> edges_;
  std::set<Key> facets_;  ///< of the cut
};

extern template class Cutter<2>;
extern template class Cutter<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_CUT_CUTTER_H
