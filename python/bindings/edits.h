// SPDX-License-Identifier: LGPL-3.0-or-later
// How Python edits environments among bodies and particles.
#ifndef CELLWALK_PYTHON_EDITS_H
#define CELLWALK_PYTHON_EDITS_H

#include <cellwalk/reshape/reshaping.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "cell_tables.h"
#include "listed.h"
#include "world.h"

namespace cellwalk::python {

/// The edits that are open during a with statement. Made, used and destroyed without the interpreter, but may
/// be destroyed with it.
template <int D>
class Session {
 public:
  /// \throw Error(usage) if this thread has the world open, for listed bodies or particles that are older
  ///        than an edit, and as Reshaping; Error(input) as Environment::thaw()
  Session(World<D>& world, const Listed& listed)
      : opened_(world),
        residents_(listed, thawed().snapshot()),
        reshaping_(thawed(), residents_.residents()) {}

  const Snapshot<D>& snapshot() const { return opened_.environment().snapshot(); }
  Reshaping<D>& reshaping() { return reshaping_; }
  const Listed_residents<D>& residents() const { return residents_; }

 private:
  Environment<D>& thawed() {
    opened_.environment().thaw();
    return opened_.environment();
  }

  typename World<D>::Opened opened_;
  Listed_residents<D> residents_;
  Reshaping<D> reshaping_;
};

/// A row of the table of residents that forbid a change.
struct Held_row {
  std::uint32_t row, owner, feature;
  std::uint8_t body;
  bool is_particle;
  std::array<std::uint8_t, 2> unused;  // no padding: equal rows are equal bytes
};
static_assert(sizeof(Held_row) == 16);

struct Cut_point_row {
  double share;
  std::array<std::int64_t, 2> between;  // as wide as an index of an array
  std::int64_t point;
};
static_assert(sizeof(Cut_point_row) == 32);

/// The class Changes of Python.
struct Changes {
  py::array_t<bool> made;
  py::list reasons;
  py::array held_by;
};

/// The class Replacement of Python.
struct Replaced {
  bool is_made;
  std::string reason;
  py::array_t<std::int32_t> cells;
  py::object point;
  py::array held_by;
};

/// The class CutReport of Python.
struct Cut_made {
  Cut_report report;
  py::array points;
};

/// The class Edits of Python: an environment that is open for edits of one thread, in a with statement.
class Edits {
 public:
  Edits(std::shared_ptr<Any_world> world, Listed listed)
      : world_(std::move(world)), listed_(std::move(listed)) {}

  void enter();
  void exit();

  Changes open(const py::object& facets);
  Changes close(const py::object& facets);
  Changes excavate(const py::object& cells);
  Changes fill(const py::object& cells);

  Replaced insert_point(const py::object& cell, const py::object& position);
  Replaced split_edge(std::uint32_t u, std::uint32_t v, const py::object& position);
  Replaced flip(const py::object& facet);
  Replaced remove_edge(std::uint32_t u, std::uint32_t v);
  Replaced collapse(std::uint32_t u, std::uint32_t onto);
  Replaced merge_vertices(std::uint32_t point, std::uint32_t onto);
  Replaced split_vertex(std::uint32_t vertex, const py::object& cells, const py::object& target);

  Relax_report relax(const py::object& points, const Relax_options& options);
  Cut_made cut(const py::object& blade, const py::object& pieces, const py::object& sweep, double opening,
               double snap);

  py::dict counts();
  bool is_open() const { return !std::holds_alternative<std::monostate>(session_); }

 private:
  /// Calls work(session) for the session that this thread has open.
  /// \throw Error(usage) if there is none
  template <class Work>
  auto with_session(const Work& work);
  template <class Names, class Change>
  Changes change_all(const Names& names, const Change& change);
  template <class Replace>
  Replaced replace(const Replace& replace);

  std::shared_ptr<Any_world> world_;
  Listed listed_;
  std::variant<std::monostate, std::unique_ptr<Session<2>>, std::unique_ptr<Session<3>>> session_;
  std::thread::id thread_;
  bool was_entered_ = false;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_EDITS_H
