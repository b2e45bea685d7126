// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies: vertices with edges and faces that no wall ever crosses.
#include <fmt/core.h>

#include <string>

#include "any_body.h"
#include "body_rows.h"
#include "listed.h"
#include "module.h"
#include "options.h"

namespace cellwalk::python {
namespace {

struct Step_words {
  const std::string &rule, &report;
};

/// \param search the caller's, to which the options refer
Body_options to_options(const Sweep_words& words, Search_options& search, const Step_words& step,
                        bool clearance, int most_contacts) {
  Body_options options;
  options.sweep = to_sweep_options(words, search);
  options.clearance = clearance;
  options.rule = choose<Step_rule>(step.rule, "rule",
                                   {{"slide", Step_rule::slide},
                                    {"reject", Step_rule::reject},
                                    {"reject_at_target", Step_rule::reject_at_target}});
  options.reports_blocked = choose<bool>(step.report, "report", {{"contacts", false}, {"blocked", true}});
  if (options.reports_blocked && options.rule != Step_rule::reject_at_target)
    throw Error(Error_code::usage, "report=\"blocked\" needs rule=\"reject_at_target\"");
  options.most_contacts = most_contacts;
  return options;
}

}  // namespace

void bind_bodies(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Body_contact_row_2, vertex, feature, time, point, normal, kind, body, cell, facet);
  PYBIND11_NUMPY_DTYPE(Body_contact_row_3, vertex, feature, time, point, normal, kind, body, cell, facet);
  PYBIND11_NUMPY_DTYPE(Blocked_row_2, vertex, stays, is_vertex_blocked, edges, swept_edges, time, point,
                       normal, kind, cell, facet);
  PYBIND11_NUMPY_DTYPE(Blocked_row_3, vertex, stays, is_vertex_blocked, edges, swept_edges, time, point,
                       normal, kind, cell, facet);
  py::class_<Any_body>(
      module, "Body",
      "A body among walls: no wall ever crosses its vertices and edges, nor its faces while it is moved with "
      "sweep=\"faces\".")
      .def(
          py::init<std::shared_ptr<Shared_world>, const py::object&, const py::object&, const py::object&,
                   const py::object&>(),
          py::arg("environment").none(false), py::arg("points"), py::arg("edges") = py::none(),
          py::arg("faces") = py::none(), py::arg("radius") = 0.0,
          "Registers a body where it stands: points (N, dimension), edges (M, 2), faces (K, 3) or polygons "
          "(K, k), whose sides are edges too. OutsideError names a vertex that is not in free space, an edge "
          "that crosses a wall, or a face that a wall pierces.\n\n"
          "radius: how far each edge keeps from every wall, exactly: a number, for vertices without edges, "
          "too, or a float64 array with one for each row of edges; sides of faces that are no rows of edges "
          "have 0, and of a row that is repeated the largest counts. OutsideError names an edge or a vertex "
          "that is closer to a wall. With a radius, step() takes the rules \"slide\" and \"reject\" with "
          "sweep=\"triangle\" and touch=\"pass\".")
      .def_static(
          "read",
          [](const std::shared_ptr<Shared_world>& environment, const py::object& path) {
            return Any_body(environment, path_of(path));
          },
          py::arg("environment").none(false), py::arg("path"),
          "Registers the body of a mesh file or of a polyline in CSV, with the radii that its edges have "
          "there.")
      .def_static(
          "rope", &Any_body::rope, py::arg("environment").none(false), py::arg("path"), py::arg("spacing"),
          py::arg("radius") = 0.0,
          "Registers a rope along a path, points (N, dimension): a polyline through all of them, with "
          "edges no longer than the spacing. radius: as of the class.")
      .def("__len__", &Any_body::vertex_count)
      .def("__repr__",
           [](const Any_body& self) {
             return fmt::format("<cellwalk.Body, {} vertices, {} edges, {} faces>", self.vertex_count(),
                                self.edges().shape(0), self.faces().shape(0));
           })
      .def_property_readonly(
          "environment",
          [](const Any_body& self) { return std::const_pointer_cast<Shared_world>(self.environment()); },
          "The environment in which it lies.")
      .def_property_readonly(
          "positions", [](const py::object& self) { return self.cast<const Any_body&>().positions(self); },
          "float64 (N, dimension): a read-only view, no copy: it changes as the body moves.")
      .def_property_readonly("edges", &Any_body::edges, "uint32 (M, 2): ends, in ascending order.")
      .def_property_readonly("faces", &Any_body::faces, "uint32 (K, 3): corners.")
      .def_property_readonly(
          "radii", &Any_body::radii,
          "float64 (M,): how far each edge keeps from every wall, in the order of edges; 0 where it may "
          "touch walls. A new array: set_radii() changes them.")
      .def(
          "set_radii", &Any_body::set_radii, py::arg("radius"),
          "Changes the radii: a number for all edges, and vertices without edges, or a float64 array (M,) in "
          "the order of edges. OutsideError names the first edge or vertex that is closer to a wall than its "
          "new radius; then nothing has changed.")
      .def("clearances", &Any_body::clearances, py::arg("up_to"),
           "float64 (M,): a lower bound of the distance of each edge to all walls, off by rounding only, or "
           "up_to where it is farther from them. Never below the edge's radius, as far as that is below "
           "up_to.")
      .def(
          "step",
          [](Any_body& self, const py::object& targets, const py::object& rows, const std::string& sweep,
             const std::string& touch, const std::string& search, double tolerance, const std::string& rule,
             const std::string& report, bool clearance, int most_contacts) {
            Search_options searched;
            return self.step(targets, rows,
                             to_options({sweep, touch, search, "flooded", tolerance}, searched,
                                        {rule, report}, clearance, most_contacts));
          },
          py::arg("targets"), py::kw_only(), py::arg("rows") = py::none(), py::arg("sweep") = "triangle",
          py::arg("touch") = "pass", py::arg("search") = "exact", py::arg("tolerance") = 0x1p-20,
          py::arg("rule") = "slide", py::arg("report") = "contacts", py::arg("clearance") = true,
          py::arg("most_contacts") = 4,
          "Moves the vertices one after the other to their targets, as far as walls allow. Returns the "
          "contacts as a structured array: vertex (that moved), feature (number of the vertex, edge or face "
          "that met the wall), time, point, normal, kind, body, cell, facet.\n\n"
          "rows: only these vertices move, in ascending order, and `targets` has a row for each: integers, "
          "or "
          "a mask. The others stand still.\n"
          "sweep: \"triangle\": nothing that an edge sweeps is missed; \"faces\": nor a face; "
          "\"three_segments\": the paper's.\n"
          "rule: \"slide\": a vertex that meets a wall, itself or by an edge that sweeps, slides along it, "
          "until it met most_contacts of them. \"reject\": it stays where it was. \"reject_at_target\", "
          "the rule of the paper and of traces: it stays if it meets a wall, or one of its edges does at "
          "its target. Faces are left alone then, and no vertex may have more than 64 edges.\n"
          "report=\"blocked\", with rule=\"reject_at_target\": returns what blocks instead, vertex by "
          "vertex, and "
          "locates no contact of an edge on its way: vertex, stays, is_vertex_blocked, edges and swept_edges "
          "(bit i is for neighbours(vertex)[i]), time, point, normal, kind, cell, facet. A vertex without a "
          "row moved, and nothing was met. edges: a wall is in their way where the vertex would be. The wall "
          "of the row is that in the way of the vertex or, if that is free, of the first of these edges, "
          "with "
          "time and point along the edge. swept_edges, unless sweep is \"three_segments\": a wall is in "
          "their "
          "way while they sweep their triangles, which does not hold the vertex back: where nothing else "
          "does, stays is False, time is nan and cell is -1.")
      .def("neighbours", &Any_body::neighbours, py::arg("vertex"),
           "uint32 (K,): the other ends of the edges of a vertex, ascending.")
      .def(
          "move_vertex",
          [](Any_body& self, std::uint32_t vertex, const py::object& target, const std::string& sweep,
             const std::string& touch, const std::string& search, double tolerance) {
            Search_options searched;
            return self.move_vertex(
                vertex, target,
                {.sweep = to_sweep_options({sweep, touch, search, "flooded", tolerance}, searched)});
          },
          py::arg("vertex"), py::arg("target"), py::kw_only(), py::arg("sweep") = "triangle",
          py::arg("touch") = "pass", py::arg("search") = "exact", py::arg("tolerance") = 0x1p-20,
          "Moves one vertex to a target and returns no contact, or leaves everything as it is and returns "
          "the first: a "
          "structured array of length 0 or 1, as of step().")
      .def("register_again", &Any_body::register_again,
           "Registers the body anew where it stands, after walls moved by a reshape() in which it was not "
           "listed: until then it raises UsageError. OutsideError where a wall came to lie in its way: then "
           "it "
           "is as it was.")
      .def(py::pickle([](Any_body& self) { return self.state(); }, &Any_body::of_state))
      .def("validate", &Any_body::validate,
           "Checks by exact predicates that every vertex is in its cell and no wall crosses the body; raises "
           "Error if so.")
      .def_property_readonly("counts", &Any_body::counts, "What all moves did: machine-independent counts.");
  module.def(
      "draw",
      [](const std::shared_ptr<Shared_world>& environment, const py::object& bodies,
         const py::object& contacts, const py::object& file) {
        const Listed listed = listed_of(environment->world, bodies, py::tuple());
        Any_body::draw(environment, listed.bodies, contacts, path_of(file));
      },
      py::arg("environment").none(false), py::arg("bodies"), py::arg("contacts") = py::none(), py::kw_only(),
      py::arg("file"),
      "Draws the walls of an environment with bodies and contacts, as step() returns them, into a PNG file "
      "of "
      "1600 x 1000 pixels.");
}

}  // namespace cellwalk::python
