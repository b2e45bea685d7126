// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls at which traces go on, as Python names them.
#ifndef CELLWALK_PYTHON_BOUNCING_H
#define CELLWALK_PYTHON_BOUNCING_H

#include <cellwalk/body/boundary_tracer.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cell_tables.h"
#include "world.h"

namespace cellwalk::python {

/// Walls that reflect, and pairs that are joined. Made with the interpreter, and used without.
class Bouncing {
 public:
  /// \param reflect a sequence of names of groups, or of arrays that name facets
  /// \param periodic a sequence of pairs of such
  /// \throw TypeError for something else, UsageError for a negative number of bounces
  Bouncing(const py::object& reflect, const py::object& periodic, int most_bounces);

  /// True if all walls stop what meets them.
  bool is_none() const { return reflecting_.empty() && periodic_.empty(); }
  int most_bounces() const { return most_bounces_; }

  /// \throw Error(input) for groups that do not exist, and as Boundary_tracer, naming the argument
  template <int D>
  Boundary_tracer<D> boundary(const typename World<D>::Reading& reading) const;

 private:
  using Walls = std::variant<std::string, Named_facets>;
  static Walls walls_of(const py::handle& argument, const char* name);
  template <int D>
  static std::vector<Half_facet> find(const typename World<D>::Reading& reading, const Walls& walls);

  std::vector<Walls> reflecting_;
  std::vector<std::pair<Walls, Walls>> periodic_;
  int most_bounces_;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_BOUNCING_H
