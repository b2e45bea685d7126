// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces and tallies of the motions of points and of particles, in NumPy arrays.
#include "traces.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "bouncing.h"
#include "cell_tables.h"
#include "module.h"
#include "options.h"
#include "particles.h"
#include "trace_batch.h"
#include "world.h"

namespace cellwalk::python {
namespace {

Trace_arrays to_arrays(Trace_buffers&& buffers) {
  const std::size_t rows = buffers.status.size;
  py::array headings = to_array(std::move(buffers.headings));
  return {to_array(std::move(buffers.offsets)), to_array(std::move(buffers.surface_offsets)),
          to_array(std::move(buffers.cells)),   to_array(std::move(buffers.surfaces)),
          to_array(std::move(buffers.cell)),    to_array(std::move(buffers.wall)),
          to_array(std::move(buffers.lengths)), headings.reshape({rows, buffers.dimension}),
          to_array(std::move(buffers.forward)), to_array(std::move(buffers.status))};
}

/// The weights of a tally: one for each row, or 1 for all.
class Weights {
 public:
  /// \throw TypeError for anything else than real numbers or None, InputError for another number of them, or
  ///        one that is not finite
  Weights(const py::object& argument, std::size_t rows) {
    if (argument.is_none()) return;
    const py::array given = py::array::ensure(argument);
    constexpr std::string_view real_kinds = "biuf";
    if (!given || given.ndim() != 1 || real_kinds.find(given.dtype().kind()) == std::string_view::npos)
      throw py::type_error("weights must be real numbers of shape (N,), or None for 1");
    kept_ = Array::ensure(given);
    const auto size = static_cast<std::size_t>(kept_->size());
    if (size != rows)
      throw Error(
          Error_code::input,
          fmt::format("weights has {} values, and there are {} motions: as many are needed", size, rows));
    rows_ = {kept_->data(), 0};
    for (std::size_t row = 0; row < rows; ++row) {
      const double weight = rows_.values[row];
      if (!std::isfinite(weight))
        throw Error(Error_code::input,
                    fmt::format("weights[{}] must be a finite number, and is {}", row, weight));
      rows_.largest = std::max(rows_.largest, std::abs(weight));
    }
  }

  const Row_weights& rows() const { return rows_; }

 private:
  using Array = py::array_t<double, int{py::array::c_style} | int{py::array::forcecast}>;
  std::optional<Array> kept_;
  Row_weights rows_;
};

/// The array that a tally is added to: the caller's, or a new one of zeros.
/// \throw TypeError if it is no float64 array that can be written in one piece
py::array_t<double> sums_of(const py::object& out, std::size_t cells) {
  if (out.is_none()) {
    Buffer<double> zeros(cells);
    std::fill_n(zeros.values.get(), cells, 0.0);
    return to_array(std::move(zeros));
  }
  using Array = py::array_t<double, py::array::c_style>;
  constexpr int aligned = py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  if (!py::isinstance<Array>(out) || py::cast<py::array>(out).ndim() != 1 ||
      !py::cast<py::array>(out).writeable() || !(py::cast<py::array>(out).flags() & aligned))
    throw py::type_error("out must be a writeable, C-contiguous float64 array of one dimension");
  return py::reinterpret_borrow<Array>(out);
}

template <int D>
std::span<const Point<D>> span_of(const auto& points) {
  return {points.data(), points.size()};
}

/// Walks as a Tracer does.
template <int D>
auto walk_up_to_walls(const Tracing<D>& tracing) {
  return [&tracer = tracing.tracer](auto particles, auto goals, Traces& traces, Walk_counts& counts,
                                    std::span<Vector<D>> /*headings*/) {
    tracer.trace(particles, goals, traces, counts);
  };
}

/// Calls use(world, rows, run), where run(work) calls work(snapshot, tracing, motions, walk, most_bounces).
template <class Use>
auto with_points(const Shared_world& self, const py::object& origins, const py::object& ends, int threads,
                 const Use& use) {
  check_threads(threads);
  return std::visit(
      [&]<int D>(const World<D>& world) {
        const auto from = points_of<D>(origins, "origins"), to = points_of<D>(ends, "ends");
        need_rows(to, "ends", from.size(), "origins");
        return use(world, from.size(), [&](const auto& work) {
          const typename World<D>::Reading reading(world);
          const Tracing<D>& tracing = reading.tracing();
          const Point_motions<D> motions(reading.locator(), reading.snapshot(), span_of<D>(from),
                                         span_of<D>(to));
          return work(reading.snapshot(), tracing, motions, walk_up_to_walls(tracing), 0);
        });
      },
      *self.world);
}

/// The same for the motions of particles.
template <class Use>
auto with_particles(Particles& self, const py::object& targets, const py::object& rows,
                    const Bouncing& bouncing, int threads, const Use& use) {
  check_threads(threads);
  return std::visit(
      [&]<int D>(const World<D>& world) {
        const auto to = points_of<D>(targets, "targets");
        const std::vector<std::uint32_t> chosen = chosen_rows(rows, to, self.size());
        return use(world, to.size(), [&](const auto& work) {
          const typename World<D>::Reading reading(world, self.moving());
          self.check_epoch(reading.snapshot());
          const Tracing<D>& tracing = reading.tracing();
          const Particle_motions<D> motions(self.all<D>(), chosen, span_of<D>(to));
          if (bouncing.is_none())
            return work(reading.snapshot(), tracing, motions, walk_up_to_walls(tracing), 0);
          const Boundary_tracer<D> boundary = bouncing.boundary<D>(reading);
          const int most = bouncing.most_bounces();
          return work(
              reading.snapshot(), tracing, motions,
              [&](auto particles, auto goals, Traces& traces, Walk_counts& counts,
                  std::span<Vector<D>> headings) {
                boundary.trace(particles, goals, most, traces, counts, headings);
              },
              most);
        });
      },
      *self.world());
}

/// Traces the motions that are given to run().
Trace_arrays trace(const auto& run, int threads) {
  return to_arrays(
      run([&](const auto& snapshot, const auto& tracing, const auto& motions, const auto& walk,
              int /*most_bounces*/) { return trace_all(snapshot, tracing, motions, walk, threads); }));
}

template <int D>
py::array_t<double> tally(const World<D>& world, std::size_t rows, const py::object& weights,
                          const py::object& out, int threads, const auto& run) {
  const Weights weight(weights, rows);
  const std::size_t cells = [&] { return typename World<D>::Looking(world).snapshot().cell_slots(); }();
  py::array_t<double> sums = sums_of(out, cells);
  const std::span<double> values(sums.mutable_data(), static_cast<std::size_t>(sums.size()));
  run([&](const auto& snapshot, const auto& tracing, const auto& motions, const auto& walk,
          int most_bounces) {
    tally_all(snapshot, tracing, motions, walk, most_bounces, weight.rows(), threads, values);
  });
  return sums;
}

Trace_arrays trace_points(const Shared_world& self, const py::object& origins, const py::object& ends,
                          int threads) {
  return with_points(self, origins, ends, threads,
                     [&](const auto&, std::size_t, const auto& run) { return trace(run, threads); });
}

py::array_t<double> tally_points(const Shared_world& self, const py::object& origins, const py::object& ends,
                                 const py::object& weights, const py::object& out, int threads) {
  return with_points(self, origins, ends, threads, [&](const auto& world, std::size_t rows, const auto& run) {
    return tally(world, rows, weights, out, threads, run);
  });
}

Trace_arrays trace_particles(Particles& self, const py::object& targets, const py::object& rows,
                             const py::object& reflect, const py::object& periodic, int most_bounces,
                             int threads) {
  const Bouncing bouncing(reflect, periodic, most_bounces);
  return with_particles(self, targets, rows, bouncing, threads,
                        [&](const auto&, std::size_t, const auto& run) { return trace(run, threads); });
}

py::array_t<double> tally_particles(Particles& self, const py::object& targets, const py::object& rows,
                                    const py::object& weights, const py::object& out,
                                    const py::object& reflect, const py::object& periodic, int most_bounces,
                                    int threads) {
  const Bouncing bouncing(reflect, periodic, most_bounces);
  return with_particles(self, targets, rows, bouncing, threads,
                        [&](const auto& world, std::size_t count, const auto& run) {
                          return tally(world, count, weights, out, threads, run);
                        });
}

py::array_t<std::int32_t> facet_rows(const Shared_world& self, const py::object& facets) {
  return std::visit(
      [&]<int D>(const World<D>& world) {
        const Named_facets named(facets, "facets");
        Buffer<std::int32_t> rows(named.size());
        {
          const typename World<D>::Reading reading(world);
          const Tracing<D>& tracing = reading.tracing();
          for (std::size_t i = 0; i < named.size(); ++i) {
            const Half_facet facet = named.find(reading.snapshot(), i);
            if (facet == Half_facet::none)
              throw Error(Error_code::input,
                          fmt::format("facets[{}] has points of a facet that other cells replaced", i));
            rows.values[i] = tracing.row_of[to_index(facet)];
          }
        }
        return to_array(std::move(rows));
      },
      *self.world);
}

/// Adds a method to a class that another file binds.
template <class Function, class... Extra>
void define(const py::object& of_class, const char* name, Function function, const Extra&... extra) {
  py::setattr(of_class, name,
              py::cpp_function(function, py::name(name), py::is_method(of_class),
                               py::sibling(py::getattr(of_class, name, py::none())), extra...));
}

constexpr const char* tally_doc =
    "Sums the lengths of motions by cell, without storing their pieces: a track-length tally.\n\n"
    "weights: float64 (N,): of each motion, by which its lengths are multiplied; 1 without.\n"
    "out: a float64 array to which the sums are added, and which is returned.\n"
    "threads: 0: all cores. The results do not depend on it, to the bit: products are added exactly, "
    "down to 2^-93 of the largest one that is possible.\n\n"
    "Returns float64 by cell, as numbered everywhere. Motions that cannot be made add nothing.";

}  // namespace

void bind_traces(py::module_& module) {
  py::class_<Trace_arrays>(
      module, "Traces",
      "Motions divided by the cells and facets that they cross, in compressed rows: the pieces of row i are "
      "cells[offsets[i]:offsets[i + 1]], in order, and likewise lengths; the facets that it crosses are "
      "surfaces[surface_offsets[i]:surface_offsets[i + 1]]. Rows that bounce hold all of their legs.")
      .def_readonly("offsets", &Trace_arrays::offsets, "int64 (N + 1,): where the pieces of each row begin.")
      .def_readonly("cells", &Trace_arrays::cells,
                    "int32 (M,): the cell of each piece; only cells in which the motion has a length.")
      .def_readonly("lengths", &Trace_arrays::lengths,
                    "float64 (M,): the length of each piece, rounded to nearest, of two as near to even.")
      .def_readonly("surface_offsets", &Trace_arrays::surface_offsets,
                    "int64 (N + 1,): where the facets crossed by each row begin.")
      .def_readonly(
          "surfaces", &Trace_arrays::surfaces,
          "int32 (K,): the facets crossed, as rows of Environment.facets(). At an edge or vertex all "
          "facets that lead through the cells around it, so that each closed surface is left as "
          "often as it is entered, but for ends inside.")
      .def_readonly("forward", &Trace_arrays::forward,
                    "bool (K,): whether the facet is crossed from its `cell` to its `neighbour`, as "
                    "Environment.facets() has them.")
      .def_readonly("wall", &Trace_arrays::wall,
                    "int32 (N,): the wall that blocks the motion, as a row of Environment.facets(); -1 for "
                    "none.")
      .def_readonly("heading", &Trace_arrays::heading,
                    "float64 (N, dimension): each motion from its start to its target, mirrored in the walls "
                    "that reflected it: how it is to go on.")
      .def_readonly("status", &Trace_arrays::status,
                    "uint8 (N,): codes of Status. Motions that are OUTSIDE or INVALID have no pieces.")
      .def_readonly("cell", &Trace_arrays::cell,
                    "int32 (N,): the cell in which the motion ends; -1 if it was not made.")
      .def("__len__", [](const Trace_arrays& self) { return self.status.size(); })
      .def("__repr__", [](const Trace_arrays& self) {
        return fmt::format("<cellwalk.Traces of {} rows, {} pieces, {} crossings>", self.status.size(),
                           self.cells.size(), self.surfaces.size());
      });

  const py::object environment = module.attr("Environment"), particles = module.attr("Particles");
  define(
      environment, "trace", &trace_points, py::arg("origins"), py::arg("ends"), py::kw_only(),
      py::arg("threads") = 0,
      "Divides the motions from origins[i] to ends[i] by the cells that they cross, up to the wall if they "
      "meet one. Cells are exact, lengths are rounded to nearest: none is lost or counted twice.\n\n"
      "threads: 0: all cores. The results do not depend on it.");
  define(environment, "tally", &tally_points, py::arg("origins"), py::arg("ends"), py::kw_only(),
         py::arg("weights") = py::none(), py::arg("out") = py::none(), py::arg("threads") = 0, tally_doc);
  define(environment, "facet_rows", &facet_rows, py::arg("facets"),
         "int32 (N,): the rows of facets() in which facets are, by which Traces name them.\n\n"
         "facets: rows of a selection or of contacts, or integers (N, 2): cells, and numbers of facets in "
         "them, seen from either side.");
  const std::string bounces =
      "reflect: groups of walls that reflect, by names, or as rows of facets: there the particle goes up to "
      "the wall, and the rest of its motion, mirrored, belongs to the same row.\n"
      "periodic: pairs of groups: what meets a wall of one goes on from the other. A translation must take "
      "one "
      "to the other.\n"
      "most_bounces: such walls a row; the next one blocks it.\n";
  define(particles, "trace", &trace_particles, py::arg("targets"), py::kw_only(),
         py::arg("rows") = py::none(), py::arg("reflect") = py::tuple(), py::arg("periodic") = py::tuple(),
         py::arg("most_bounces") = 1000, py::arg("threads") = 0,
         ("Moves each particle to its target like move(), and divides the motions by the cells that they "
          "cross. A blocked particle stays in place; its row goes up to the wall.\n\n"
          "rows: only these particles move, integers or a mask; `targets` and the result have a row for "
          "each.\n" +
          bounces + "threads: 0: all cores. The results do not depend on it.")
             .c_str());
  define(particles, "tally", &tally_particles, py::arg("targets"), py::kw_only(),
         py::arg("rows") = py::none(), py::arg("weights") = py::none(), py::arg("out") = py::none(),
         py::arg("reflect") = py::tuple(), py::arg("periodic") = py::tuple(), py::arg("most_bounces") = 1000,
         py::arg("threads") = 0,
         (std::string("Moves each particle to its target like trace(), with the same options. ") + tally_doc)
             .c_str());
}

}  // namespace cellwalk::python
