// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of either dimension for Python: the checks of their arrays, and their steps under a lock.
#include "any_body.h"

#include <cellwalk/body/body.h>
#include <cellwalk/drawing/draw.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/records/body_soup.h>

#include <fmt/core.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "body_rows.h"
#include "cell_tables.h"
#include "motions.h"
#include "options.h"
#include "pickling.h"

namespace cellwalk::python {
namespace {

template <int D>
Body_soup<D> soup_of_arrays(const py::object& points, const py::object& edges, const py::object& faces,
                            const py::object& radius) {
  Body_parts<D> parts;
  const auto given = points_of<D>(points, "points");
  parts.points.assign(given.begin(), given.end());
  if (!edges.is_none()) {
    const Index_table table = indices_of(edges, "edges", {2, 2}, given.size());
    for (std::size_t i = 0; i < table.size(); ++i)
      parts.segments.push_back({table.row(i)[0], table.row(i)[1]});
  }
  if (!faces.is_none()) {
    const Index_table table = indices_of(faces, "faces", polygons, given.size());
    for (std::size_t i = 0; i < table.size(); ++i)
      parts.polygons.emplace_back(table.row(i).begin(), table.row(i).end());
  }
  const Radii radii(radius, parts.segments.size(), "the edges");
  if (!radii.is_one_for_all()) parts.radii.assign(radii.values().begin(), radii.values().end());
  Body_soup<D> soup = make_body(std::move(parts)).body;
  if (radii.is_one_for_all()) soup.radii = {radii[0]};
  return soup;
}

template <std::size_t D>
void need_finite(const std::array<double, D>& target, std::size_t vertex) {
  if (!is_usable(target))
    throw Error(Error_code::input, fmt::format("the target of vertex {} is not finite", vertex));
}

/// Where the vertices of a body go: all of them, or those of some rows, and the others stand still.
template <int D>
class Body_targets {
 public:
  /// \param rows or None
  Body_targets(const Body<D>& body, const py::object& targets, const py::object& rows)
      : given_(points_of<D>(targets, "targets")), are_all_(rows.is_none()) {
    if (!are_all_) rows_ = distinct_numbers_of(rows, "rows", body.vertex_count(), "vertices");
    need_rows(given_, "targets", are_all_ ? body.vertex_count() : rows_.size(),
              are_all_ ? "the vertices" : "rows");
    for (std::size_t i = 0; i < given_.size(); ++i) need_finite(given_[i], are_all_ ? i : rows_[i]);
    if (are_all_) return;
    moves_.resize(body.vertex_count());
    for (const std::uint32_t row : rows_) moves_[row] = true;
  }

  /// For all vertices of the body as it is now.
  std::span<const Point<D>> of(const Body<D>& body) {
    if (are_all_) return given_;
    all_.assign(body.positions().begin(), body.positions().end());
    for (std::size_t i = 0; i < rows_.size(); ++i) all_[rows_[i]] = given_[i];
    return all_;
  }
  bool moves(std::uint32_t vertex) const { return are_all_ || moves_[vertex]; }

 private:
  Points<D> given_;
  bool are_all_;
  std::vector<std::uint32_t> rows_;
  std::vector<bool> moves_;
  std::vector<Point<D>> all_;
};

template <std::size_t N>
py::array_t<std::uint32_t> table_of(std::span<const std::array<std::uint32_t, N>> rows) {
  py::array_t<std::uint32_t> table({rows.size(), N});
  std::copy_n(reinterpret_cast<const std::uint32_t*>(rows.data()), rows.size() * N, table.mutable_data());
  return table;
}

}  // namespace

template <class Make_soup>
Any_body::Bodies Any_body::place(const Any_world& any, const Make_soup& make) {
  return std::visit(
      [&]<int D>(const World<D>& world) -> Bodies {
        const Body_soup<D> soup = make(std::integral_constant<int, D>{});
        const typename World<D>::Reading reading(world);
        return Body<D>(reading.snapshot(), reading.locator(), soup);
      },
      any);
}

template <class Use>
void Any_body::reading(const Use& use) {
  std::visit(
      [&]<int D>(Body<D>& body) {
        const typename World<D>::Reading world(std::get<World<D>>(*environment_->world), *moving_);
        use(body, world);
      },
      body_);
}

Any_body::Any_body(Held_world environment, const py::object& points, const py::object& edges,
                   const py::object& faces, const py::object& radius)
    : environment_(std::move(environment)),
      body_(place(*environment_->world, [&]<int D>(std::integral_constant<int, D>) {
        return soup_of_arrays<D>(points, edges, faces, radius);
      })) {}

Any_body::Any_body(Held_world environment, const std::string& path)
    : environment_(std::move(environment)),
      body_(place(*environment_->world,
                  [&]<int D>(std::integral_constant<int, D>) { return io::read_body<D>(path).body; })) {}

Any_body Any_body::rope(Held_world environment, const py::object& path, double spacing,
                        const py::object& radius) {
  Bodies body = place(*environment->world, [&]<int D>(std::integral_constant<int, D>) {
    const auto points = points_of<D>(path, "path");
    Body_soup<D> soup = cellwalk::rope<D>({points.begin(), points.end()}, spacing);
    const Radii radii(radius, soup.edges.size(), "the edges of the rope");
    soup.radii.assign(radii.values().begin(), radii.values().end());
    return soup;
  });
  return {std::move(environment), std::move(body)};
}

void Any_body::draw(const Held_world& environment, const std::vector<Any_body*>& bodies,
                    const py::object& contacts, const std::string& file) {
  std::visit(
      [&]<int D>(const World<D>& any) {
        std::vector<const Body<D>*> drawn;
        for (const Any_body* body : bodies) drawn.push_back(&std::get<Body<D>>(body->body_));
        std::vector<Contact<D>> met;
        if (!contacts.is_none()) {
          const auto column = [&](const char* name) {
            if (!has_field(as_array(contacts), name))
              throw py::type_error("contacts must be rows as Body.step() returns them: they have no " +
                                   std::string(name));
            return points_of<D>(contacts[name], "contacts");
          };
          const auto points = column("point"), normals = column("normal");
          for (std::size_t i = 0; i < points.size(); ++i) {
            Contact<D>& contact = met.emplace_back();
            contact.point = points[i];
            contact.normal = normals[i];
          }
        }
        const typename World<D>::Reading reading(any);
        cellwalk::draw<D>(reading.snapshot(), drawn, met, file);
      },
      *environment->world);
}

py::array Any_body::positions(const py::object& self) const {
  return std::visit(
      [&]<int D>(const Body<D>& body) {
        return view_of(body.positions().data()->data(), body.vertex_count(), D, sizeof(Point<D>), self);
      },
      body_);
}

py::array_t<std::uint32_t> Any_body::edges() const {
  return std::visit([](const auto& body) { return table_of(body.edges()); }, body_);
}

py::array_t<std::uint32_t> Any_body::faces() const {
  return std::visit([](const auto& body) { return table_of(body.faces()); }, body_);
}

std::size_t Any_body::vertex_count() const {
  return std::visit([](const auto& body) { return body.vertex_count(); }, body_);
}

py::array_t<double> Any_body::radii() {
  std::vector<double> all;
  reading([&](const auto& body, const auto&) {
    for (std::size_t edge = 0; edge < body.edges().size(); ++edge) all.push_back(body.radius(edge));
  });
  return to_array(std::move(all));
}

void Any_body::set_radii(const py::object& radius) {
  const std::size_t edges = std::visit([](const auto& body) { return body.edges().size(); }, body_);
  const Radii radii(radius, edges, "the edges");
  reading([&](auto& body, const auto&) { body.set_radii(radii.values()); });
}

py::array_t<double> Any_body::clearances(double up_to) {
  std::vector<double> all;
  reading([&](auto& body, const auto&) {
    body.refresh(counts_);
    all = body.clearances(up_to);
  });
  return to_array(std::move(all));
}

py::array Any_body::step(const py::object& targets, const py::object& rows, const Body_options& options) {
  return std::visit(
      [&]<int D>(Body<D>& body) -> py::array {
        Body_targets<D> to(body, targets, rows);
        if (options.rule == Step_rule::reject_at_target) need_few_edges(body);
        Step_report<D> report;
        std::vector<Body_contact_row<D>> contacts;
        std::vector<Rejected_row<D>> blocked;
        {
          const typename World<D>::Reading world(std::get<World<D>>(*environment_->world), *moving_);
          body.step(to.of(body), options, report, counts_);
          for (const Contact<D>& met : report.contacts)
            if (to.moves(met.vertex)) contacts.push_back(to_row(world.snapshot(), met));
          for (const Rejected_move<D>& move : report.blocked)
            if (to.moves(move.vertex)) blocked.push_back(to_row(world.snapshot(), move));
        }
        return options.reports_blocked ? py::array(to_array(std::move(blocked)))
                                       : py::array(to_array(std::move(contacts)));
      },
      body_);
}

py::array_t<std::uint32_t> Any_body::neighbours(std::uint32_t vertex) const {
  need_vertex(vertex);
  return std::visit([&](const auto& body) { return to_array(body.neighbours(vertex)); }, body_);
}

py::array Any_body::move_vertex(std::uint32_t vertex, const py::object& target, const Body_options& options) {
  need_vertex(vertex);
  return std::visit(
      [&]<int D>(Body<D>& body) -> py::array {
        const Point<D> to = point_of<D>(target, "target");
        need_finite(to, vertex);
        std::vector<Body_contact_row<D>> rows;
        {
          const typename World<D>::Reading world(std::get<World<D>>(*environment_->world), *moving_);
          if (const auto contact = body.move_vertex(vertex, to, options, counts_))
            rows.push_back(to_row(world.snapshot(), *contact));
        }
        return to_array(std::move(rows));
      },
      body_);
}

void Any_body::validate() {
  reading([&](auto& body, const auto&) {
    body.refresh(counts_);
    body.validate();
  });
}

void Any_body::register_again() {
  reading([](auto& body, const auto& world) { body.register_again(world.locator()); });
}

py::tuple Any_body::state() {
  std::vector<std::byte> bytes;
  reading([&](const auto& body, const auto&) { bytes = save(body); });
  return py::make_tuple(std::const_pointer_cast<Shared_world>(environment_),
                        py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

Any_body Any_body::of_state(const py::tuple& state) {
  need_parts(state, 2);
  const Held_world environment = state[0].cast<std::shared_ptr<Shared_world>>();
  if (!environment) throw py::value_error("this pickle of a body is damaged");  // None is cast to null
  const auto held = state[1].cast<py::bytes>();
  const std::string_view bytes = held;
  return std::visit(
      [&]<int D>(const World<D>& world) {
        const typename World<D>::Looking looking(world);
        return Any_body(environment,
                        Bodies(restore_body<D>(looking.snapshot(), std::as_bytes(std::span(bytes)))));
      },
      *environment->world);
}

py::dict Any_body::counts() const {
  using namespace py::literals;
  std::visit([](const auto& world) { world.need_not_open_here(); }, *environment_->world);
  const Body_counts done = [this] {
    const py::gil_scoped_release released;
    const std::lock_guard guard(*moving_);
    return counts_;
  }();
  py::dict result = to_dict(done);
  result["edges"] = to_dict(done.edges);
  return result;
}

void Any_body::need_vertex(std::uint32_t vertex) const {
  if (vertex >= vertex_count())
    throw Row_error(
        fmt::format("there is no vertex {}: the body has {}, numbered from 0", vertex, vertex_count()));
}

template <int D>
void Any_body::need_few_edges(const Body<D>& body) {
  if (has_few_edges_) return;
  constexpr std::size_t most = 64;
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v)
    if (const std::size_t count = body.neighbours(v).size(); count > most)
      throw Error(Error_code::usage, fmt::format("vertex {} has {} edges: rule=\"reject_at_target\" takes at "
                                                 "most {} a vertex, rule=\"reject\" any number",
                                                 v, count, most));
  has_few_edges_ = true;
}

}  // namespace cellwalk::python
