// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies: vertices with edges and faces that no wall ever crosses.
#include <cellwalk/body/body.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/records/make_body.h>

#include <fmt/core.h>
#include <pybind11/stl.h>
#include <tbb/task_arena.h>

#include <mutex>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "body_rows.h"
#include "module.h"
#include "motions.h"
#include "options.h"

namespace cellwalk::python {
namespace {

template <int D>
Body_soup<D> soup_of_arrays(const py::object& points, const py::object& edges, const py::object& faces) {
  Body_parts<D> parts;
  const auto given = points_of<D>(points, "points");
  parts.points.assign(given.begin(), given.end());
  if (!edges.is_none()) {
    const Index_table table = indices_of(edges, "edges", given.size());
    if (table.columns != 2)
      throw py::value_error(fmt::format("edges has {} columns: an edge has 2 ends", table.columns));
    for (std::size_t i = 0; i < table.rows; ++i) parts.segments.push_back({table.row(i)[0], table.row(i)[1]});
  }
  if (!faces.is_none()) {
    const Index_table table = indices_of(faces, "faces", given.size());
    if (table.columns < 3)
      throw py::value_error(
          fmt::format("faces has {} columns: a face has at least 3 corners", table.columns));
    for (std::size_t i = 0; i < table.rows; ++i)
      parts.polygons.emplace_back(table.row(i).begin(), table.row(i).end());
  }
  return make_body(std::move(parts)).body;
}

template <std::size_t D>
void need_finite(const std::array<double, D>& target, std::size_t vertex) {
  if (!is_usable(target)) throw py::value_error(fmt::format("the target of vertex {} is not finite", vertex));
}

/// A body of either dimension, and what its moves did.
class Any_body {
 public:
  Any_body(const Shared_world& environment, const py::object& points, const py::object& edges,
           const py::object& faces)
      : world_(environment.world), body_(place(*world_, [&]<int D>(std::integral_constant<int, D>) {
          return soup_of_arrays<D>(points, edges, faces);
        })) {}

  /// The body of a file.
  Any_body(const Shared_world& environment, const std::string& path)
      : world_(environment.world), body_(place(*world_, [&]<int D>(std::integral_constant<int, D>) {
          return io::read_body<D>(path).body;
        })) {}

  py::array positions(const py::object& self) const {
    return std::visit(
        [&]<int D>(const Body<D>& body) {
          return view_of(body.positions().data()->data(), body.vertex_count(), D, sizeof(Point<D>), self);
        },
        body_);
  }

  py::array_t<std::uint32_t> edges() const {
    return std::visit([](const auto& body) { return table_of(body.edges()); }, body_);
  }
  py::array_t<std::uint32_t> faces() const {
    return std::visit([](const auto& body) { return table_of(body.faces()); }, body_);
  }
  std::size_t vertex_count() const {
    return std::visit([](const auto& body) { return body.vertex_count(); }, body_);
  }

  py::array step(const py::object& targets, Body_options options, int threads) {
    check_threads(threads);
    options.parallel = threads != 1;
    return std::visit(
        [&]<int D>(Body<D>& body) -> py::array {
          const auto to = targets_of(body, targets);
          if (options.edges == Edge_rule::at_target) need_few_edges(body);
          Step_report<D> report;
          std::vector<Body_contact_row<D>> contacts;
          std::vector<Rejected_row<D>> blocked;
          {
            const py::gil_scoped_release released;
            const std::lock_guard guard(*moving_);
            const auto step = [&] { body.step(to, options, report, counts_); };
            threads > 1 ? tbb::task_arena(threads).execute(step) : step();
            const Snapshot<D>& snapshot = std::get<World<D>>(*world_).snapshot();
            for (const Contact<D>& met : report.contacts) contacts.push_back(to_row(snapshot, met));
            for (const Rejected_move<D>& move : report.blocked) blocked.push_back(to_row(snapshot, move));
          }
          return options.reported == Reported::blocked ? py::array(to_array(std::move(blocked)))
                                                       : py::array(to_array(std::move(contacts)));
        },
        body_);
  }

  py::array_t<std::uint32_t> neighbours(std::uint32_t vertex) const {
    need_vertex(vertex);
    return std::visit([&](const auto& body) { return to_array(body.neighbours(vertex)); }, body_);
  }

  py::array move_vertex(std::uint32_t vertex, const py::object& target, const Body_options& options) {
    need_vertex(vertex);
    return std::visit(
        [&]<int D>(Body<D>& body) -> py::array {
          const auto to = target.cast<std::array<double, D>>();
          need_finite(to, vertex);
          std::vector<Body_contact_row<D>> rows;
          {
            const py::gil_scoped_release released;
            const std::lock_guard guard(*moving_);
            if (const auto contact = body.move_vertex(vertex, to, options, counts_))
              rows.push_back(to_row(std::get<World<D>>(*world_).snapshot(), *contact));
          }
          return to_array(std::move(rows));
        },
        body_);
  }

  void validate() {
    const py::gil_scoped_release released;
    const std::lock_guard guard(*moving_);
    std::visit(
        [&](auto& body) {
          body.refresh(counts_);
          body.validate();
        },
        body_);
  }

  py::dict counts() const {
    using namespace py::literals;
    const Body_counts done = [this] {
      const py::gil_scoped_release released;
      const std::lock_guard guard(*moving_);
      return counts_;
    }();
    py::dict result = to_dict(done);
    result["edges"] = to_dict(done.edges);
    return result;
  }

 private:
  using Bodies = std::variant<Body<2>, Body<3>>;

  template <class Make>
  static Bodies place(const Any_world& any, const Make& make) {
    return std::visit(
        [&]<int D>(const World<D>& world) -> Bodies {
          return Body<D>(world.snapshot(), world.locator, make(std::integral_constant<int, D>{}));
        },
        any);
  }

  void need_vertex(std::uint32_t vertex) const {
    if (vertex >= vertex_count())
      throw py::index_error(
          fmt::format("there is no vertex {}: the body has {}, numbered from 0", vertex, vertex_count()));
  }

  template <int D>
  static std::span<const Point<D>> targets_of(const Body<D>& body, const py::object& targets) {
    const auto to = points_of<D>(targets, "targets");
    need_equal(to.size(), "targets", body.vertex_count(), "the body");
    for (std::size_t i = 0; i < to.size(); ++i) need_finite(to[i], i);
    return to;
  }

  /// Each edge of a vertex has a bit.
  template <int D>
  void need_few_edges(const Body<D>& body) {
    if (has_few_edges_) return;
    constexpr std::size_t most = 64;
    for (std::uint32_t v = 0; v < body.vertex_count(); ++v)
      if (const std::size_t count = body.neighbours(v).size(); count > most)
        throw py::value_error(
            fmt::format("vertex {} has {} edges: edges=\"at_target\" takes at most {} a vertex, "
                        "edges=\"swept\" any number",
                        v, count, most));
    has_few_edges_ = true;
  }

  template <std::size_t N>
  static py::array_t<std::uint32_t> table_of(std::span<const std::array<std::uint32_t, N>> rows) {
    py::array_t<std::uint32_t> table({rows.size(), N});
    std::copy_n(reinterpret_cast<const std::uint32_t*>(rows.data()), rows.size() * N, table.mutable_data());
    return table;
  }

  std::shared_ptr<const Any_world> world_;
  Bodies body_;
  Body_counts counts_;
  bool has_few_edges_ = false;  ///< known to
  std::unique_ptr<std::mutex> moving_ = std::make_unique<std::mutex>();
};

struct Step_words {
  const std::string &policy, &edges, &report;
};

Body_options to_options(const Sweep_words& words, const Step_words& rule, bool clearance, int most_contacts) {
  Body_options options;
  options.sweep = to_sweep_options(words);
  options.clearance = clearance;
  options.policy = choose<Contact_policy>(
      rule.policy, "policy", {{"slide", Contact_policy::slide}, {"reject", Contact_policy::reject}});
  options.edges = choose<Edge_rule>(rule.edges, "edges",
                                    {{"swept", Edge_rule::swept}, {"at_target", Edge_rule::at_target}});
  options.reported = choose<Reported>(rule.report, "report",
                                      {{"contacts", Reported::contacts}, {"blocked", Reported::blocked}});
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
      .def(py::init<const Shared_world&, const py::object&, const py::object&, const py::object&>(),
           py::arg("environment"), py::arg("points"), py::arg("edges") = py::none(),
           py::arg("faces") = py::none(),
           "Registers a body where it stands: points (N, dimension), edges (M, 2), faces (K, 3) or polygons "
           "(K, k), whose "
           "sides are edges too. OutsideError names a vertex that is not in free space, an edge that crosses "
           "a wall, or a "
           "face that a wall pierces.")
      .def_static(
          "read",
          [](const Shared_world& environment, const py::object& path) {
            return Any_body(environment, std::string(py::str(path)));
          },
          py::arg("environment"), py::arg("path"),
          "Registers the body of a mesh file or of a polyline in CSV.")
      .def("__len__", &Any_body::vertex_count)
      .def_property_readonly(
          "positions", [](const py::object& self) { return self.cast<const Any_body&>().positions(self); },
          "float64 (N, dimension): a read-only view, no copy: it changes as the body moves.")
      .def_property_readonly("edges", &Any_body::edges, "uint32 (M, 2): ends, in ascending order.")
      .def_property_readonly("faces", &Any_body::faces, "uint32 (K, 3): corners.")
      .def(
          "step",
          [](Any_body& self, const py::object& targets, const std::string& sweep, const std::string& touch,
             const std::string& search, double tolerance, const std::string& policy, const std::string& edges,
             const std::string& report, bool clearance, int most_contacts, int threads) {
            return self.step(targets,
                             to_options({sweep, touch, search, "flooded", tolerance}, {policy, edges, report},
                                        clearance, most_contacts),
                             threads);
          },
          py::arg("targets"), py::kw_only(), py::arg("sweep") = "triangle", py::arg("touch") = "pass",
          py::arg("search") = "exact", py::arg("tolerance") = 0x1p-20, py::arg("policy") = "slide",
          py::arg("edges") = "swept", py::arg("report") = "contacts", py::arg("clearance") = true,
          py::arg("most_contacts") = 4, py::arg("threads") = 1,
          "Moves the vertices one after the other to their targets, as far as walls allow. Returns the "
          "contacts as a structured array: vertex (that moved), feature (number of the vertex, edge or face "
          "that met the wall), time, point, normal, kind, body, cell, facet.\n\n"
          "sweep: \"triangle\": nothing that an edge sweeps is missed; \"faces\": nor a face; "
          "\"three_segments\": the paper's.\n"
          "policy: a vertex that meets a wall slides on along it, until it met most_contacts of them; or "
          "\"reject\": it stays where it was.\n"
          "edges: \"swept\": an edge that meets a wall while it sweeps is one that does. \"at_target\", with "
          "policy=\"reject\": the rule of the paper and of traces: only one that meets a wall where its "
          "vertex goes. Faces are not looked at then, and no vertex may have more than 64 edges.\n"
          "report=\"blocked\", with edges=\"at_target\": returns what blocks instead, vertex by vertex, and "
          "locates no contact of an edge on its way: vertex, stays, is_vertex_blocked, edges and swept_edges "
          "(bit i is for neighbours(vertex)[i]), time, point, normal, kind, cell, facet. A vertex without a "
          "row moved, and nothing was met. edges: a wall is in their way where the vertex would be. The wall "
          "of the row is that in the way of the vertex or, if that is free, of the first of these edges, "
          "with "
          "time and point along the edge. swept_edges, unless sweep is \"three_segments\": a wall is in "
          "their "
          "way while they sweep their triangles, which does not hold the vertex back: where nothing else "
          "does, stays is False, time is nan and cell is -1.\n\n"
          "threads: of a body of some thousand vertices; 0: all cores. The results do not depend on it.")
      .def("neighbours", &Any_body::neighbours, py::arg("vertex"),
           "uint32 (K,): the other ends of the edges of a vertex, ascending.")
      .def(
          "move_vertex",
          [](Any_body& self, std::uint32_t vertex, const py::object& target, const std::string& sweep,
             const std::string& touch, const std::string& search, double tolerance) {
            return self.move_vertex(
                vertex, target, {.sweep = to_sweep_options({sweep, touch, search, "flooded", tolerance})});
          },
          py::arg("vertex"), py::arg("target"), py::kw_only(), py::arg("sweep") = "triangle",
          py::arg("touch") = "pass", py::arg("search") = "exact", py::arg("tolerance") = 0x1p-20,
          "Moves one vertex to a target and returns no contact, or leaves everything as it is and returns "
          "the first: a "
          "structured array of length 0 or 1, as of step().")
      .def("validate", &Any_body::validate,
           "Checks by exact predicates that every vertex is in its cell and no wall crosses the body; raises "
           "Error if so.")
      .def_property_readonly("counts", &Any_body::counts, "What all moves did: machine-independent counts.");
}

}  // namespace cellwalk::python
