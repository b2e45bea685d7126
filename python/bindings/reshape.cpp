// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move among the bodies and particles listed.
#include "reshape.h"

#include <cellwalk/reshape/reshaping.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "listed.h"
#include "options.h"
#include "wall_rows.h"

namespace cellwalk::python {
namespace {

/// The class WallMoves of Python.
struct Wall_moves {
  py::array_t<std::uint32_t> point;
  py::array_t<std::uint8_t> end;
  py::array_t<double> position, time;
  py::array_t<std::int32_t> cell;
  py::array contacts, hits;
  std::uint32_t rounds;
  py::dict counts;
};

struct Reshape_words {
  const std::string &at_contact, &sweep;
  int most_rounds, most_pushes, most_contacts;
};

/// The request of a call: moves, or tests of moves.
struct Reshape_request {
  Reshape_options options;
  bool only_tests = false;
};

void need_at_least(int least, int given, const char* name) {
  if (given < least)
    throw Error(Error_code::usage, fmt::format("{} takes a number from {}, not {}", name, least, given));
}

/// \throw UsageError for words and numbers that are none of the options
Reshape_request to_request(const Reshape_words& words) {
  Reshape_request request;
  request.only_tests = words.at_contact == "test";
  request.options.at_contact = choose<At_contact>(words.at_contact, "at_contact",
                                                  {{"stop", At_contact::stop},
                                                   {"hold", At_contact::hold},
                                                   {"push", At_contact::push},
                                                   {"test", At_contact::hold}});
  need_at_least(1, words.most_rounds, "most_rounds");
  need_at_least(0, words.most_pushes, "most_pushes");
  need_at_least(1, words.most_contacts, "most_contacts");
  request.options.most_rounds = words.most_rounds;
  request.options.most_pushes = words.most_pushes;
  request.options.body.sweep.sweep = to_sweep(words.sweep);
  request.options.body.most_contacts = words.most_contacts;
  return request;
}

/// The moves as they are given.
/// \throw TypeError for arrays of another type, InputError for another shape, a point that does not exist or
///        has two rows, and a target that is not finite
template <int D>
std::vector<Vertex_move<D>> moves_of(const py::object& points, const py::object& targets,
                                     std::size_t point_count) {
  const auto to = points_of<D>(targets, "targets");
  const std::vector<std::uint32_t> numbers = distinct_numbers_of(points, "points", point_count, "points");
  need_rows(to, "targets", numbers.size(), "points");
  std::vector<Vertex_move<D>> moves;
  moves.reserve(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (!is_usable(to[i])) throw Error(Error_code::input, fmt::format("targets[{}] is not finite", i));
    moves.push_back({numbers[i], to[i]});
  }
  return moves;
}

/// \throw Error(usage) for a point at a cell that is not a simplex
template <int D>
void need_simplices(Environment<D>& environment, const std::vector<Vertex_move<D>>& moves) {
  for (const Vertex_move<D>& move : moves)
    for (const Cell c : environment.cells_around(move.point))
      if (environment.snapshot().view(c).vertex_count() != D + 1)
        throw Error(
            Error_code::usage,
            fmt::format("point {} cannot be moved: cell {} at it is not a {}; make the environment with "
                        "simplicial=True",
                        move.point, environment.snapshot().index(c), D == 2 ? "triangle" : "tetrahedron"));
}

template <std::size_t D>
py::array_t<double> to_table(const std::vector<std::array<double, D>>& points) {
  py::array_t<double> table({points.size(), D});
  std::copy_n(reinterpret_cast<const double*>(points.data()), points.size() * D, table.mutable_data());
  return table;
}

/// The part that is done alone in the world, without the interpreter.
template <int D>
Wall_rows<D> work_off(World<D>& world, const Reshape_request& request,
                      const std::vector<Vertex_move<D>>& moves, const Listed& listed) {
  typename World<D>::Changing changing(world);
  need_simplices(changing.environment(), moves);
  std::vector<std::uint32_t> points;
  points.reserve(moves.size());
  for (const Vertex_move<D>& move : moves) points.push_back(move.point);
  changing.will_move(std::move(points));
  Wall_rows<D> rows(changing.snapshot(), moves);
  const Listed_residents<D> residents(listed, changing.snapshot());
  Reshaping<D> reshaping(changing.environment(), residents.residents(), request.options);
  const auto add_hit = [&](Wall_hit<D> hit) {
    residents.number(hit.resident);
    rows.add_hit(hit);
  };
  const auto set = [&](Vertex_result<D> result) {
    if (result.hit) residents.number(result.hit->resident);
    rows.set(result);
  };
  if (request.only_tests) {
    for (const Vertex_move<D>& move : moves) {
      const Vertex_result<D> result = reshaping.test_move(move.point, move.target);
      set(result);
      if (result.hit) add_hit(*result.hit);
    }
  } else {
    const Move_report<D> report = reshaping.move(moves);
    for (const Vertex_result<D>& result : report.short_of_target) set(result);
    for (const Wall_hit<D>& hit : report.hits) add_hit(hit);
    rows.rounds = report.rounds;
  }
  reshaping.finish();
  rows.counts = reshaping.counts();
  return rows;
}

Wall_moves reshape(const Shared_world& self, const py::object& points, const py::object& targets,
                   const py::object& bodies, const py::object& particles, const Reshape_words& words) {
  const Reshape_request request = to_request(words);
  const Listed listed = listed_of(self.world, bodies, particles);
  return std::visit(
      [&]<int D>(World<D>& world) {
        const std::size_t count = [&] {
          return typename World<D>::Looking(world).snapshot().points().size();
        }();
        const std::vector<Vertex_move<D>> moves = moves_of<D>(points, targets, count);
        Wall_rows<D> rows = work_off(world, request, moves, listed);
        std::vector<std::uint32_t> numbers;
        numbers.reserve(moves.size());
        for (const Vertex_move<D>& move : moves) numbers.push_back(move.point);
        py::dict done = to_dict(rows.counts);
        done["walk"] = to_dict(rows.counts.walk);
        return Wall_moves{to_array(std::move(numbers)),
                          to_array(std::move(rows.end)),
                          to_table(rows.position),
                          to_array(std::move(rows.time)),
                          to_array(std::move(rows.cell)),
                          to_array(std::move(rows.contacts)),
                          to_array(std::move(rows.hits)),
                          rows.rounds,
                          std::move(done)};
      },
      *self.world);
}

void bind_results(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Wall_hit_row_2, row, time, point, normal, kind, cell, facet, corners, weights,
                       is_particle, owner, body, feature, resident_weights);
  PYBIND11_NUMPY_DTYPE(Wall_hit_row_3, row, time, point, normal, kind, cell, facet, corners, weights,
                       is_particle, owner, body, feature, resident_weights);
  py::class_<Wall_moves>(module, "WallMoves",
                         "What came of the moves of points of an environment, row by row.")
      .def_readonly("point", &Wall_moves::point, "uint32 (N,): the points, as they were given.")
      .def_readonly("end", &Wall_moves::end, "uint8 (N,): codes of MoveEnd.")
      .def_readonly("position", &Wall_moves::position,
                    "float64 (N, dimension): where the points are now; with at_contact=\"test\", where they "
                    "would be, each by itself.")
      .def_readonly("time", &Wall_moves::time,
                    "float64 (N,): the share of the way that was free when the point was last tried: 1 if it "
                    "arrived, up to the contact, or until a cell would be flat; NaN where none is known.")
      .def_readonly("cell", &Wall_moves::cell,
                    "int32 (N,): the cell that would be flat or inverted, or that of the wall that met "
                    "something; -1 for none.")
      .def_readonly(
          "contacts", &Wall_moves::contacts,
          "A structured array with a row for each point that ended at a contact, in the order of `row`: row, "
          "time, point (where they meet), normal (unit, from the wall to what it meets), kind (Feature of "
          "the "
          "wall), cell and facet (the wall), corners (its points, the one that moves first) with weights (of "
          "the corners at the point, of sum 1), is_particle, owner (which of `particles`, or of `bodies`), "
          "body "
          "(Feature of what is met) and feature (its number there) with resident_weights (of its vertices at "
          "the point, of sum 1, else 0).")
      .def_readonly("hits", &Wall_moves::hits,
                    "All that was met, in the order met, also what was pushed out of the way; as `contacts`.")
      .def_readonly("rounds", &Wall_moves::rounds, "In how many rounds moves were tried.")
      .def_readonly("counts", &Wall_moves::counts, "The machine-independent counts of the moves.")
      .def("__len__", [](const Wall_moves& self) { return self.point.size(); })
      .def("__repr__", [](const Wall_moves& self) {
        return fmt::format("<cellwalk.WallMoves of {} points, {} contacts>", self.point.size(),
                           self.contacts.shape(0));
      });
}

}  // namespace

void bind_reshape(py::module_& module, Environment_class& environment) {
  bind_results(module);
  environment.def(
      "reshape",
      [](const Shared_world& self, const py::object& points, const py::object& targets,
         const py::object& bodies, const py::object& particles, const std::string& at_contact,
         int most_rounds, int most_pushes, const std::string& sweep, int most_contacts) {
        return reshape(self, points, targets, bodies, particles,
                       {at_contact, sweep, most_rounds, most_pushes, most_contacts});
      },
      py::arg("points"), py::arg("targets"), py::kw_only(), py::arg("bodies") = py::tuple(),
      py::arg("particles") = py::tuple(), py::arg("at_contact") = "stop", py::arg("most_rounds") = 8,
      py::arg("most_pushes") = 16, py::arg("sweep") = "triangle", py::arg("most_contacts") = 4,
      "Moves points of the environment, integer (N,), along straight lines to targets (N, dimension), one "
      "after "
      "the other, among the bodies and particles listed, which stand still or are pushed. Each move is made "
      "whole or not at all, by exact tests. All cells at the points must be tetrahedra, or triangles in 2D: "
      "make the environment with simplicial=True.\n\n"
      "bodies, particles: all that lie in the environment. One that is not listed raises UsageError at its "
      "next "
      "use, also after at_contact=\"test\", until Body.register_again() or Particles.locate_again().\n"
      "at_contact: what a point does whose walls meet one of them. \"stop\": it goes to a verified position, "
      "there or just before; \"hold\": it stays where it was; \"push\": what it meets is moved out of its "
      "way, "
      "as far as walls allow, and else it stops; \"test\": nothing moves, and each row says what \"hold\" "
      "would "
      "do if it came first.\n"
      "most_rounds: points are tried so often, in order and backwards in turn; one that would make a cell "
      "flat "
      "goes half of the way to that, and on when others moved.\n"
      "most_pushes: so often a point tries to push what it meets, a move.\n"
      "sweep, most_contacts: how bodies move that are pushed, see Body.step().\n\n"
      "Other threads wait meanwhile that use the environment. An error that names an argument changes "
      "nothing; "
      "else the moves before it are made. The first call takes about 1 us for each point of the environment, "
      "and "
      "the next question about where points are a few tenths of a microsecond for each cell, to find them "
      "faster.");
}

}  // namespace cellwalk::python
