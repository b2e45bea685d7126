// SPDX-License-Identifier: LGPL-3.0-or-later
// The methods of Edits for Python, and selections of facets and cells by conditions.
#include "bind_edits.h"

#include <fmt/core.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edits.h"

namespace cellwalk::python {
namespace {

/// The class Selection of Python.
struct Selected {
  py::array facets, cells;
};

/// The part of a group that is left.
/// \throw InputError if there is no such group
template <int D>
Selection<D> group_of(const typename World<D>::Looking& looking, const std::string& name) {
  Groups<D> groups = looking.groups();
  const auto found = groups.find(name);
  if (found != groups.end()) return std::move(found->second);
  std::string names;
  for (const auto& [known, selection] : groups) names += (names.empty() ? "" : ", ") + known;
  throw Error(Error_code::input, fmt::format("there is no group \"{}\": the environment has {}", name,
                                             names.empty() ? "none" : names));
}

template <int D>
std::array<Point<D>, 2> two_points(const py::object& given, const char* name) {
  const Points<D> points(given, name);
  if (points.size() != 2) refuse_rows(name, points.size(), D, 2, "its points");
  return {points[0], points[1]};
}

template <int D>
std::pair<Point<D>, double> point_and_number(const py::object& given, const char* name) {
  if (!py::isinstance<py::sequence>(given) || py::len(given) != 2 ||
      !PyNumber_Check(given[py::int_(1)].ptr()))
    throw py::type_error(fmt::format("{} must be a pair of a point and a number", name));
  return {point_of<D>(given[py::int_(0)], name), py::float_(given[py::int_(1)]).cast<double>()};
}

template <int D>
void need_finite(const Point<D>& x, const char* name) {
  if (!is_finite(x))
    throw Error(Error_code::input, fmt::format("{} has a coordinate that is not finite", name));
}

/// \throw TypeError for no numbers, InputError for those that make none, UsageError for no condition
template <int D>
Environment_part<D> part_of(const py::object& box, const py::object& ball, const py::object& plane) {
  Environment_part<D> part;
  if (!box.is_none() && !ball.is_none())
    throw Error(Error_code::usage, "box and ball exclude each other: give one");
  if (box.is_none() && ball.is_none() && plane.is_none())
    throw Error(Error_code::usage, "select() takes a box, a ball, a plane or a group: give one");
  if (!box.is_none()) {
    const auto [lower, upper] = two_points<D>(box, "box");
    need_finite<D>(lower, "box");
    need_finite<D>(upper, "box");
    for (std::size_t k = 0; k < D; ++k)
      if (lower[k] > upper[k])
        throw Error(Error_code::input, "box: the first corner is the lower one in all coordinates");
    part.shape = Scene_box<D>{lower, upper};
  }
  if (!ball.is_none()) {
    const auto [centre, radius] = point_and_number<D>(ball, "ball");
    need_finite<D>(centre, "ball");
    if (!(radius > 0 && radius < std::numeric_limits<double>::infinity()))
      throw Error(Error_code::input, "ball: the radius is a positive number");
    part.shape = Scene_ball<D>{centre, radius};
  }
  if (!plane.is_none()) {
    const auto [point, normal] = two_points<D>(plane, "plane");
    need_finite<D>(point, "plane");
    need_finite<D>(normal, "plane");
    part.plane = Scene_plane<D>{point, normal};
    if (!(dot(part.plane->normal, part.plane->normal) > 0))
      throw Error(Error_code::input, "plane: a normal cannot be zero");
  }
  return part;
}

Selected select(const Shared_world& self, const py::object& box, const py::object& ball,
                const py::object& plane, const std::optional<std::string>& group) {
  return std::visit(
      [&]<int D>(const World<D>& world) {
        if (group && !(box.is_none() && ball.is_none() && plane.is_none()))
          throw Error(Error_code::usage, "a group and places exclude each other: give one");
        const Environment_part<D> part = group ? Environment_part<D>{} : part_of<D>(box, ball, plane);
        const auto [facets, cells] = [&] {
          const typename World<D>::Looking looking(world);
          const Selection<D> found =
              group ? group_of<D>(looking, *group) : cellwalk::select(looking.snapshot(), part);
          return std::pair(cell_table_of<D>(looking.snapshot(), std::span(found.facets)),
                           cell_table_of<D>(looking.snapshot(), std::span(found.cells)));
        }();
        return Selected{to_array(facets), to_array(cells)};
      },
      *self.world);
}

/// The table of all facets, or of all cells.
py::array all_rows(const Shared_world& self, bool of_facets) {
  return to_array(std::visit(
      [&]<int D>(const World<D>& world) {
        const typename World<D>::Looking looking(world);
        const Selection<D> all = all_of(looking.snapshot());
        return of_facets ? cell_table_of<D>(looking.snapshot(), std::span(all.facets))
                         : cell_table_of<D>(looking.snapshot(), std::span(all.cells));
      },
      *self.world));
}

void bind_edit_results(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Held_row, row, owner, feature, body, is_particle);
  PYBIND11_NUMPY_DTYPE(Cut_point_row, share, between, point);
  py::class_<Selected>(module, "Selection", "Facets and cells of a part of an environment.")
      .def_readonly("facets", &Selected::facets,
                    "Those between two cells, each once; a structured array as of Environment.facets().")
      .def_readonly("cells", &Selected::cells, "A structured array as of Environment.cells().")
      .def("__repr__", [](const Selected& self) {
        return fmt::format("<cellwalk.Selection of {} facets, {} cells>", self.facets.size(),
                           self.cells.size());
      });
  py::class_<Changes>(module, "Changes", "What came of facets or cells that were changed, row by row.")
      .def_readonly("made", &Changes::made,
                    "bool (N,): True also where nothing had to be changed; False where it was refused.")
      .def_readonly("reasons", &Changes::reasons, "Why each was refused; an empty string where it was made.")
      .def_readonly("held_by", &Changes::held_by,
                    "A structured array with a row for all that forbids a change: row (which change), "
                    "is_particle, owner (which of `particles`, or of `bodies`), body (Feature) and feature "
                    "(its number there).")
      .def("__len__", [](const Changes& self) { return self.made.size(); })
      .def("__repr__", [](const Changes& self) {
        std::size_t made = 0;
        for (py::ssize_t i = 0; i < self.made.size(); ++i) made += self.made.at(i);
        return fmt::format("<cellwalk.Changes, {} of {} made>", made, self.made.size());
      });
  py::class_<Replaced>(module, "Replacement", "What came of a replacement of cells by others.")
      .def_readonly("made", &Replaced::is_made, "False if it was refused: then nothing was changed.")
      .def_readonly("reason", &Replaced::reason, "Why it was refused; an empty string if it was made.")
      .def_readonly("cells", &Replaced::cells, "int32: the numbers of the new cells.")
      .def_readonly("point", &Replaced::point,
                    "The number of the point that was added, or of the one that was removed, which later "
                    "points may get; None if there is none.")
      .def_readonly("held_by", &Replaced::held_by,
                    "What forbids a merge, with the columns of Changes.held_by; no row otherwise.")
      .def("__bool__", [](const Replaced& self) { return self.is_made; })
      .def("__repr__", [](const Replaced& self) {
        return self.is_made ? fmt::format("<cellwalk.Replacement, {} cells>", self.cells.size())
                            : fmt::format("<cellwalk.Replacement, refused: {}>", self.reason);
      });
  py::class_<Cut_made>(module, "CutReport", "What came of a cut along a blade.")
      .def_property_readonly(
          "cells", [](const Cut_made& self) { return self.report.cells; }, "Solid ones that the blade met.")
      .def_property_readonly(
          "edges", [](const Cut_made& self) { return self.report.edges; },
          "Of solid cells that the blade passes, and of membranes where they cross a border of the slit.")
      .def_property_readonly(
          "split", [](const Cut_made& self) { return self.report.split; }, "Of these edges, split.")
      .def_property_readonly(
          "snapped", [](const Cut_made& self) { return self.report.snapped; },
          "Of these edges, passed at an end.")
      .def_property_readonly(
          "refused", [](const Cut_made& self) { return self.report.refused(); },
          "Of these edges, neither split nor snapped: the cut is not complete there.")
      .def_property_readonly(
          "facets", [](const Cut_made& self) { return self.report.facets; }, "Of the cut.")
      .def_property_readonly(
          "slit", [](const Cut_made& self) { return self.report.slit; },
          "Facets of membranes that were opened.")
      .def_property_readonly(
          "opened", [](const Cut_made& self) { return self.report.opened; },
          "Points of the cut that were parted.")
      .def_property_readonly(
          "rim", [](const Cut_made& self) { return self.report.rim; },
          "Points at its rim inside solid cells, or on the boundary, which hold together.")
      .def_property_readonly(
          "held", [](const Cut_made& self) { return self.report.held; },
          "Points that could not be parted, as a cell would be flat.")
      .def_readonly(
          "points", &Cut_made::points,
          "A structured array of the points that were made: point, between (the ends of the edge on "
          "which it lies, or twice the point from which it was taken back) and share (of the edge, "
          "from the first end).")
      .def("__repr__", [](const Cut_made& self) {
        return fmt::format("<cellwalk.CutReport, {} facets, {} points parted, {} edges refused>",
                           self.report.facets, self.report.opened, self.report.refused());
      });
  py::class_<Relax_report>(module, "RelaxReport", "What came of cells that were made better.")
      .def_readonly("smoothed", &Relax_report::smoothed, "Points moved.")
      .def_readonly("flipped", &Relax_report::flipped, "Facets flipped.")
      .def_readonly("edges_removed", &Relax_report::edges_removed, "Edges removed.")
      .def_readonly("split", &Relax_report::split, "Edges split.")
      .def_readonly("collapsed", &Relax_report::collapsed, "Edges collapsed.")
      .def_readonly("tried", &Relax_report::tried, "Cells that were not good enough.")
      .def_readonly("rounds", &Relax_report::rounds, "Rounds made.")
      .def_readonly("least_before", &Relax_report::least_before, "The least quality of the cells before.")
      .def_readonly("least_after", &Relax_report::least_after, "The least quality of the cells after it.")
      .def_property_readonly("operations", &Relax_report::operations, "All operations made.")
      .def("__repr__", [](const Relax_report& self) {
        return fmt::format("<cellwalk.RelaxReport, {} operations, least quality {:.3g}, then {:.3g}>",
                           self.operations(), self.least_before, self.least_after);
      });
}

void bind_toggles(py::class_<Edits>& edits) {
  edits
      .def("open", &Edits::open, py::arg("facets"),
           "Makes walls between two free cells, or two solid ones, passable. Nothing that lies there can "
           "forbid it; facets of the boundary, or between a solid and a free cell, are refused.\n\n"
           "facets: rows of Environment.facets(), of a selection or of contacts, or integers (N, 2): cells, "
           "and numbers of facets in them. Rows with points are refused if other cells replaced their own.")
      .def("close", &Edits::close, py::arg("facets"),
           "Makes facets walls. One is refused if a vertex, an edge or a face would be on both sides of it; "
           "`held_by` lists all of them.")
      .def("excavate", &Edits::excavate, py::arg("cells"),
           "Makes solid cells free: their facets to free cells become passable. Nothing can forbid it.\n\n"
           "cells: rows of Environment.cells() or of a selection, or integers (N,).")
      .def("fill", &Edits::fill, py::arg("cells"),
           "Makes free cells solid. One is refused if something lies in its inside, or on its border with no "
           "free space beside it; `held_by` lists it.");
}

void bind_replacements(py::class_<Edits>& edits) {
  edits
      .def("insert_point", &Edits::insert_point, py::arg("cell"), py::arg("position"),
           "Replaces a cell by the cells of a new point strictly inside it.")
      .def("split_edge", &Edits::split_edge, py::arg("u"), py::arg("v"), py::arg("position"),
           "Replaces the cells around the edge of two points by those that a new point makes of them. It "
           "need not lie on the edge. If a wall has the edge, it must lie on it exactly, and nothing may lie "
           "in these cells.")
      .def("flip", &Edits::flip, py::arg("facet"),
           "Replaces the two cells of a facet by three around the edge that joins their other points; in 2D "
           "by two on both sides of it.\n\n"
           "facet: a row of Environment.facets(), or a pair: a cell, and the number of a facet in it.")
      .def("remove_edge", &Edits::remove_edge, py::arg("u"), py::arg("v"),
           "Replaces the cells around an edge by those on the best triangulation of the points around it. "
           "3D only.")
      .def("collapse", &Edits::collapse, py::arg("u"), py::arg("onto"),
           "Removes the point u by moving it along an edge into the other end.")
      .def("merge_vertices", &Edits::merge_vertices, py::arg("point"), py::arg("onto"),
           "Merges a point of the walls of a gap with one across it, a stitch: the free cells that have both "
           "vanish. Refused if a cell would be flat, or if anything lies in the free cells around the point.")
      .def("split_vertex", &Edits::split_vertex, py::arg("vertex"), py::arg("cells"), py::arg("target"),
           "Takes solid cells around a point back from it: they get a new point at the target, in their "
           "inside, and free cells fill the gap.")
      .def(
          "relax",
          [](Edits& self, const py::object& points, double good_enough, int most_rounds,
             std::uint32_t most_operations, bool smooth, bool flip, bool split, bool collapse, double longest,
             double shortest) {
            return self.relax(points, {good_enough, most_rounds, most_operations, smooth, flip, split,
                                       collapse, longest, shortest});
          },
          py::arg("points"), py::kw_only(), py::arg("good_enough") = 0.3, py::arg("most_rounds") = 4,
          py::arg("most_operations") = 1000, py::arg("smooth") = true, py::arg("flip") = true,
          py::arg("split") = true, py::arg("collapse") = true, py::arg("longest") = 2.0,
          py::arg("shortest") = 0.4,
          "Makes cells around points, integer (N,), better, worst first, by the replacements above and by "
          "moves of points without walls. Walls stay where they are. The quality of a cell is 1 if it is "
          "regular, 0 if it is flat.\n\n"
          "good_enough: cells of at least this quality are left alone.\n"
          "most_rounds, most_operations: through all cells that are not good enough, and in total.\n"
          "smooth, flip, split, collapse: what it may do.\n"
          "longest, shortest: longer edges are split, shorter ones collapsed, in units of the mean of all "
          "edges around the points.")
      .def("cut", &Edits::cut, py::arg("blade"), py::kw_only(), py::arg("pieces") = py::none(),
           py::arg("sweep") = py::none(), py::arg("opening") = 0.01, py::arg("snap") = 0.125,
           "Cuts solid cells along a blade: edges that it passes are split near it, the cells in front of it "
           "are taken back, and free ones fill the gap.\n\n"
           "blade: float64 (N, dimension): the corners of a convex polygon in order around it, in 2D a line; "
           "with `sweep` a line; with `pieces` the corners of these.\n"
           "pieces: integer (M, dimension): triangles, or segments in 2D, whose sides agree.\n"
           "sweep: the displacement by which the line is swept (3D).\n"
           "opening: how far cells are taken back at first, in lengths.\n"
           "snap: where the blade passes an edge nearer to an end than this share of it, it passes the end.")
      .def_property_readonly("counts", &Edits::counts, "The machine-independent counts so far.")
      .def("__repr__", [](const Edits& self) {
        return self.is_open() ? "<cellwalk.Edits, open>" : "<cellwalk.Edits, not open>";
      });
}

void bind_class(py::module_& module) {
  py::class_<Edits> edits(
      module, "Edits",
      "An environment that is open for edits of one thread, among the bodies and particles listed, which "
      "stand still: see Environment.editing(). Each edit is made whole or not at all, and is decided "
      "exactly. "
      "What forbids one is in its result; an argument that names nothing is an error, and then this call "
      "changed nothing, but for an error in the midst of many rows.");
  edits
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Edits&>().enter();
             return self;
           })
      .def(
          "__exit__",
          [](Edits& self, const py::object&, const py::object&, const py::object&) { self.exit(); },
          py::arg("type"), py::arg("value"), py::arg("traceback"));
  bind_toggles(edits);
  bind_replacements(edits);
}

}  // namespace

void bind_edits(py::module_& module, Environment_class& environment) {
  bind_edit_results(module);
  bind_class(module);
  environment
      .def(
          "editing",
          [](const Shared_world& self, const py::object& bodies, const py::object& particles) {
            return std::make_unique<Edits>(self.world, listed_of(self.world, bodies, particles));
          },
          py::kw_only(), py::arg("bodies") = py::tuple(), py::arg("particles") = py::tuple(),
          "Opens the environment for edits, in a with statement:\n\n"
          "    with environment.editing(bodies=[body]) as edits:\n"
          "        edits.open(valve.facets)\n\n"
          "bodies, particles: all that lie in the environment. One that is not listed raises UsageError at "
          "its next use, if anything was changed, until Body.register_again() or "
          "Particles.locate_again().\n\n"
          "Other threads that use the environment wait until the statement ends; do not wait for them in it. "
          "In it, this thread may ask for facets(), cells(), select() and points, and anything else that "
          "uses "
          "the environment raises UsageError. What was made stays if the statement ends by an exception. The "
          "first time takes about 1 us for each cell, and 679 bytes for each tetrahedron until freeze().")
      .def(
          "facets", [](const Shared_world& self) { return all_rows(self, true); },
          "All facets, each once, seen from the cell of lower number: a structured array of cell, facet (its "
          "number in the cell), neighbour (the cell on its other side; -1 on the boundary), wall, mean (of "
          "its "
          "points) and points (counterclockwise seen from outside of the cell; -1 after the last one).")
      .def(
          "cells", [](const Shared_world& self) { return all_rows(self, false); },
          "All cells, by number: a structured array of cell, solid, mean (of its points) and points (-1 "
          "after "
          "the last one).")
      .def(
          "select", &select, py::kw_only(), py::arg("box") = py::none(), py::arg("ball") = py::none(),
          py::arg("plane") = py::none(), py::arg("group") = py::none(),
          "Facets and cells by place. A cell belongs to the selection if its mean lies in the shape and in "
          "front of the plane; a facet between two cells, if its mean lies in the shape, and the means of "
          "its "
          "cells on either side of the plane.\n\n"
          "box: its lower and its upper corner.\n"
          "ball: its centre and its radius.\n"
          "plane: a point of it, and its normal, which points to its front.\n"
          "group: instead of a place, the name of a group, see `groups`: its facets and cells that are left, "
          "those on the boundary too.")
      .def_property_readonly(
          "groups",
          [](const Shared_world& self) {
            return std::visit([](const auto& world) { return world.group_names(); }, *self.world);
          },
          "The names of the groups of facets and cells that the file of the environment has, in order. Edits "
          "that replace cells take them out of their groups, and save() writes what is left.")
      .def(
          "freeze",
          [](const Shared_world& self) {
            std::visit(
                []<int D>(World<D>& world) { typename World<D>::Changing(world).environment().freeze(); },
                *self.world);
          },
          "Drops what only edits need, and editing() makes again.");
}

}  // namespace cellwalk::python
