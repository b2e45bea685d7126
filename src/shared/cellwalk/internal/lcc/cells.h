// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets, ridges and vertices of the cells of any linear cell complex, by its darts alone. No marks are used,
// so that several threads may read one map.
#ifndef CELLWALK_INTERNAL_LCC_CELLS_H
#define CELLWALK_INTERNAL_LCC_CELLS_H

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>

namespace cellwalk::lcc {

namespace detail {

/// CGAL calls them handles up to 5.5 and descriptors from 5.6 on.
template <class Lcc>
struct Const_dart {
  using type = typename Lcc::Dart_const_handle;
};
template <class Lcc>
requires requires { typename Lcc::Dart_const_descriptor; }
struct Const_dart<Lcc> {
  using type = typename Lcc::Dart_const_descriptor;
};

}  // namespace detail

/// A dart of a map that is read only.
template <class Lcc>
using Dart = typename detail::Const_dart<Lcc>::type;

namespace detail {

template <class T>
bool contains(const T& sequence, const typename T::value_type& value) {
  return std::find(sequence.begin(), sequence.end(), value) != sequence.end();
}

/// A vertex or ridge of a cell: the dart starts at the vertex, or runs along the ridge. In the plane, ridges
/// are vertices.
template <class Lcc>
struct Feature {
  Dart<Lcc> dart;
  bool is_vertex = true;
};

/// The cells of a map. In space a facet of a cell is an orbit of beta_1, named by any of its darts; in the
/// plane it is a dart.
template <class Lcc>
class Cells {
 public:
  static constexpr int D = static_cast<int>(Lcc::dimension);
  static_assert(D == 2 || D == 3);
  static_assert(static_cast<int>(Lcc::ambient_dimension) == D,
                "cells have the dimension of the space they fill");

  using Dart_of = Dart<Lcc>;
  using Darts = boost::container::small_vector<Dart_of, 16>;

  explicit Cells(const Lcc& map) : map_(map) {}

  const Lcc& map() const { return map_; }
  Dart_of next(Dart_of d) const { return map_.template beta<1>(d); }
  Dart_of previous(Dart_of d) const { return map_.template beta<0>(d); }
  /// The dart on the other side of an edge of a cell (3D).
  Dart_of across_edge(Dart_of d) const { return map_.template beta<2>(d); }
  bool is_on_boundary(Dart_of d) const { return map_.template is_free<D>(d); }
  /// \pre not on the boundary
  Dart_of opposite(Dart_of d) const { return map_.template beta<D>(d); }
  const typename Lcc::Point& point(Dart_of d) const { return map_.point(d); }
  const typename Lcc::Point& end(Dart_of d) const { return map_.point(next(d)); }

  /// True if a dart lacks a neighbour in its cell, or a point.
  bool is_open(Dart_of d) const {
    return map_.template is_free<1>(d) || map_.template is_free<0>(d) ||
           (D == 3 && map_.template is_free<2>(d)) || map_.template attribute<0>(d) == Lcc::null_handle;
  }
  /// True if no dart of the cell of d is open.
  bool is_closed(Dart_of d) const {
    Darts reached{d};
    for (std::size_t k = 0; k < reached.size(); ++k) {
      if (is_open(reached[k])) return false;
      for (const Dart_of e : {next(reached[k]), D == 3 ? across_edge(reached[k]) : d})
        if (!contains(reached, e)) reached.push_back(e);
    }
    return true;
  }

  /// The least dart of the facet of d: one name for all its darts.
  Dart_of facet_of(Dart_of d) const {
    Dart_of least = d;
    if constexpr (D == 3)
      for (Dart_of e = next(d); e != d; e = next(e))
        if (e < least) least = e;
    return least;
  }

  /// A dart of each facet of the cell of d, that of d first.
  Darts facets(Dart_of d) const {
    Darts found;
    if constexpr (D == 2) {
      Dart_of e = d;
      do {
        found.push_back(e);
        e = next(e);
      } while (e != d);
    } else {
      found.push_back(facet_of(d));
      for (std::size_t k = 0; k < found.size(); ++k)
        for_each_dart(found[k], [&](Dart_of e) {
          const Dart_of facet = facet_of(across_edge(e));
          if (!contains(found, facet)) found.push_back(facet);
        });
    }
    return found;
  }

  /// Calls f on each dart of a facet: in space its edges in order, in the plane itself.
  template <class F>
  void for_each_dart(Dart_of facet, const F& f) const {
    if constexpr (D == 2) {
      f(facet);
    } else {
      Dart_of e = facet;
      do {
        f(e);
        e = next(e);
      } while (e != facet);
    }
  }

  /// Calls f on the vertices of a cell, each once or more, until it returns false.
  template <class F>
  void for_each_point(const Darts& facets, const F& f) const {
    for (const Dart_of facet : facets) {
      bool goes_on = true;
      for_each_dart(facet, [&](Dart_of e) { goes_on = goes_on && f(point(e)); });
      if (!goes_on) return;
    }
  }

  /// A name of the cell of a feature's dart among the cells around that feature.
  Dart_of name_at(const Feature<Lcc>& feature) const {
    Dart_of least = feature.dart;
    if constexpr (D == 3) {
      if (!feature.is_vertex) return std::min(least, across_edge(least));
      for (Dart_of e = turned(feature.dart); e != feature.dart; e = turned(e))
        if (e < least) least = e;
    }
    return least;
  }

  /// Calls f(facet, neighbour) for the facets of a cell at a feature: a dart of each facet there, and the
  /// feature's dart in the cell behind it, which is only valid where there is such a cell. In space the first
  /// is also a dart of the feature.
  template <class F>
  void for_each_facet_at(const Feature<Lcc>& feature, const F& f) const {
    const Dart_of d = feature.dart;
    const auto behind = [&](Dart_of e) { return is_on_boundary(e) ? e : opposite(e); };
    const auto starting_behind = [&](Dart_of e) { return is_on_boundary(e) ? e : next(opposite(e)); };
    if constexpr (D == 2) {
      f(d, starting_behind(d));
      f(previous(d), behind(previous(d)));
    } else if (!feature.is_vertex) {
      f(d, behind(d));
      f(across_edge(d), behind(across_edge(d)));
    } else {
      Dart_of e = d;
      do {
        f(e, starting_behind(e));
        e = turned(e);
      } while (e != d);
    }
  }

 private:
  /// The next dart of a cell that starts where d does (3D).
  Dart_of turned(Dart_of d) const { return across_edge(previous(d)); }

  const Lcc& map_;
};

}  // namespace detail
}  // namespace cellwalk::lcc

#endif  // CELLWALK_INTERNAL_LCC_CELLS_H
