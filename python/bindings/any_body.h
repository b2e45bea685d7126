// SPDX-License-Identifier: LGPL-3.0-or-later
// The class Body of Python.
#ifndef CELLWALK_PYTHON_ANY_BODY_H
#define CELLWALK_PYTHON_ANY_BODY_H

#include <cellwalk/body/body.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "world.h"

namespace cellwalk::python {

/// A body of either dimension, and the counts of its moves.
class Any_body {
 public:
  Any_body(Held_world environment, const py::object& points, const py::object& edges, const py::object& faces,
           const py::object& radius);
  /// The body of a file.
  Any_body(Held_world environment, const std::string& path);
  static Any_body rope(Held_world environment, const py::object& path, double spacing,
                       const py::object& radius);

  py::array positions(const py::object& self) const;
  py::array_t<std::uint32_t> edges() const;
  py::array_t<std::uint32_t> faces() const;
  std::size_t vertex_count() const;
  py::array_t<double> radii();
  void set_radii(const py::object& radius);
  py::array_t<double> clearances(double up_to);
  /// \param rows the vertices that move, or None for all
  py::array step(const py::object& targets, const py::object& rows, const Body_options& options);
  py::array_t<std::uint32_t> neighbours(std::uint32_t vertex) const;
  py::array move_vertex(std::uint32_t vertex, const py::object& target, const Body_options& options);
  void validate();
  void register_again();
  /// For pickles: the environment, and the body as bytes.
  /// \throw Error(usage) if it must be registered again
  py::tuple state();
  /// \throw py::value_error if it is none, Error(input) for bytes that are damaged or do not fit
  static Any_body of_state(const py::tuple& state);
  py::dict counts() const;

  const Held_world& environment() const { return environment_; }
  std::shared_ptr<const Any_world> world() const { return environment_->world; }
  /// Draws bodies of an environment in it.
  /// \param contacts of step(), or None
  static void draw(const Held_world& environment, const std::vector<Any_body*>& bodies,
                   const py::object& contacts, const std::string& file);
  /// For reshape(), which is alone in the world.
  template <int D>
  Body<D>& body() {
    return std::get<Body<D>>(body_);
  }

 private:
  using Bodies = std::variant<Body<2>, Body<3>>;

  Any_body(Held_world environment, Bodies body)
      : environment_(std::move(environment)), body_(std::move(body)) {}

  template <class Make_soup>
  static Bodies place(const Any_world& any, const Make_soup& make);
  /// Calls use() with the body and a Reading of its world; no other thread uses the body meanwhile.
  template <class Use>
  void reading(const Use& use);
  void need_vertex(std::uint32_t vertex) const;
  /// Each edge of a vertex has a bit.
  template <int D>
  void need_few_edges(const Body<D>& body);

  Held_world environment_;
  Bodies body_;
  Body_counts counts_;
  bool has_few_edges_ = false;  ///< known to
  std::unique_ptr<std::mutex> moving_ = std::make_unique<std::mutex>();
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_ANY_BODY_H
