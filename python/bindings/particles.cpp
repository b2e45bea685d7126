// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles: points that remember their cells, moved in batches.
#include "particles.h"

#include <cellwalk/body/verified_stop.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/walk/walk.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "module.h"
#include "options.h"
#include "pickling.h"

namespace cellwalk::python {
namespace {

/// A particle where one is, in the environment as it is now: on the side on which it was, if its cell still
/// holds it there.
template <int D>
Particle<D> located(const Locator<D>& locator, const Particle<D>& particle) {
  if (!is_usable(particle.position)) return {particle.position};
  const Location<D> at = locator.locate(particle.position);
  if (at.status != Location_status::free) return {particle.position};
  for (std::size_t i = 0; i < at.cells.size(); ++i)
    if (at.cells[i] == particle.cell) return at.sides[static_cast<std::size_t>(at.side_of_cell[i])];
  return at.sides.front();
}

}  // namespace

Particles::Particles(Held_world environment, const py::object& points, int threads)
    : environment_(std::move(environment)) {
  check_threads(threads);
  std::visit(
      [&]<int D>(const World<D>& world) {
        const auto at = points_of<D>(points, "points");
        auto& particles = particles_.emplace<std::vector<Particle<D>>>(at.size());
        const typename World<D>::Reading reading(world);
        const Locator<D>& locator = reading.locator();
        for_each_chunk(at.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            particles[i] =
                (is_usable(at[i]) ? locator.particle_at(at[i]) : std::nullopt).value_or(Particle<D>{at[i]});
        });
        epoch_ = reading.snapshot().epoch();
      },
      *environment_->world);
}

std::size_t Particles::size() const {
  return std::visit([](const auto& particles) { return particles.size(); }, particles_);
}

py::array Particles::positions(const py::object& self) const {
  return std::visit(
      [&]<int D>(const std::vector<Particle<D>>& particles) {
        return view_of(reinterpret_cast<const double*>(particles.data()), particles.size(), D,
                       sizeof(Particle<D>), self);
      },
      particles_);
}

py::array_t<std::int32_t> Particles::cells() const {
  py::array_t<std::int32_t> numbers(static_cast<py::ssize_t>(size()));
  std::int32_t* const number = numbers.mutable_data();
  std::visit(
      [&]<int D>(const std::vector<Particle<D>>& particles) {
        const typename World<D>::Reading reading(std::get<World<D>>(*environment_->world), *moving_);
        for (std::size_t i = 0; i < particles.size(); ++i)
          number[i] = number_of(reading.snapshot(), particles[i].cell);
      },
      particles_);
  return numbers;
}

py::tuple Particles::state() const {
  const py::array_t<std::int32_t> numbers = cells();
  return std::visit(
      [&]<int D>(const std::vector<Particle<D>>& particles) {
        const auto n = static_cast<py::ssize_t>(particles.size());
        py::array_t<double> positions({n, py::ssize_t{D}});
        py::array_t<std::uint16_t> places({n, py::ssize_t{2}});
        auto position = positions.template mutable_unchecked<2>();
        auto place = places.template mutable_unchecked<2>();
        for (py::ssize_t i = 0; i < n; ++i) {
          const Particle<D>& particle = particles[static_cast<std::size_t>(i)];
          for (int k = 0; k < D; ++k) position(i, k) = particle.position[static_cast<std::size_t>(k)];
          place(i, 0) = particle.dimension;
          place(i, 1) = particle.aimed;
        }
        return py::make_tuple(std::const_pointer_cast<Shared_world>(environment_), positions, numbers, places,
                              epoch_);
      },
      particles_);
}

Particles Particles::of_state(const py::tuple& state) {
  need_parts(state, 5);
  auto environment = state[0].cast<std::shared_ptr<Shared_world>>();
  if (!environment) throw py::value_error("this pickle of particles is damaged");  // None is cast to null
  Particles made(std::move(environment));
  made.epoch_ = state[4].cast<std::uint64_t>();
  std::visit(
      [&]<int D>(const World<D>& world) {
        const auto at = points_of<D>(state[1], "positions");
        const auto numbers = state[2].cast<py::array_t<std::int32_t>>();
        const auto places = state[3].cast<py::array_t<std::uint16_t>>();
        const auto n = static_cast<py::ssize_t>(at.size());
        if (numbers.ndim() != 1 || places.ndim() != 2 || places.shape(1) != 2 || numbers.shape(0) != n ||
            places.shape(0) != n)
          throw py::value_error("this pickle of particles is damaged");
        const auto number = numbers.template unchecked<1>();
        const auto place = places.template unchecked<2>();
        auto& particles = made.particles_.emplace<std::vector<Particle<D>>>(at.size());
        const typename World<D>::Looking looking(world);
        const Snapshot<D>& snapshot = looking.snapshot();
        for (py::ssize_t i = 0; i < n; ++i) {
          Particle<D>& particle = particles[static_cast<std::size_t>(i)];
          particle.position = at[static_cast<std::size_t>(i)];
          if (number(i) < 0) continue;
          const auto cell = static_cast<std::size_t>(number(i));
          if (cell < snapshot.cell_slots()) particle.cell = snapshot.cell(cell);
          particle.dimension = place(i, 0);
          particle.aimed = place(i, 1);
          const bool is_known =
              made.epoch_ != snapshot.epoch() || (is_usable(particle.position) && particle.dimension <= D &&
                                                  in_closure(snapshot, particle.cell, particle.position) &&
                                                  particle.aimed < snapshot.facet_count(particle.cell));
          if (!is_known) throw py::value_error("this pickle of particles is damaged");
        }
      },
      *made.environment_->world);
  return made;
}

/// All particles by their numbers, as an array of rows would name them.
struct All_rows {
  std::size_t operator[](std::size_t row) const { return row; }
};

Motions Particles::move(const py::object& targets, const py::object& rows, const std::string& at_contact,
                        int threads) {
  check_threads(threads);
  const bool stops = choose<bool>(at_contact, "at_contact", {{"stay", false}, {"stop", true}});
  return std::visit(
      [&]<int D>(std::vector<Particle<D>>& particles) {
        const auto to = points_of<D>(targets, "targets");
        const auto move_those = [&](const auto& moving) {
          return stops ? move_rows<true>(particles, to, moving, threads)
                       : move_rows<false>(particles, to, moving, threads);
        };
        const std::vector<std::uint32_t> chosen = chosen_rows(rows, to, particles.size());
        return rows.is_none() ? move_those(All_rows{}) : move_those(chosen.data());
      },
      particles_);
}

void Particles::locate_again(int threads) {
  check_threads(threads);
  std::visit(
      [&]<int D>(std::vector<Particle<D>>& particles) {
        const typename World<D>::Reading reading(std::get<World<D>>(*environment_->world), *moving_);
        const Locator<D>& locator = reading.locator();
        for_each_chunk(particles.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) particles[i] = located(locator, particles[i]);
        });
        epoch_ = reading.snapshot().epoch();
      },
      particles_);
}

template <bool stops, int D, class Rows>
Motions Particles::move_rows(std::vector<Particle<D>>& particles, const Points<D>& targets, const Rows& rows,
                             int threads) {
  return run_batch<Walk_counts, D>(
      environment_->world, moving_.get(), targets.size(), threads,
      [&](const typename World<D>::Reading& reading) {
        check_epoch(reading.snapshot());
        return [&snapshot = reading.snapshot(), from = particles.data(), to = targets.data(), rows](
                   Motion_rows<D> out, Chunk<D, Walk_counts>& chunk, std::size_t begin, std::size_t end) {
          Walk_counts counts;
          for (std::size_t row = begin; row < end; ++row) {
            Particle<D>& particle = from[rows[row]];
            const Point<D>& target = to[row];
            if (particle.cell == Cell::none || !is_usable(target)) {
              out.fail(row, particle.cell == Cell::none ? Motion_status::outside : Motion_status::invalid);
              continue;
            }
            const Walk_result<D> result = cellwalk::move(snapshot, particle, target, counts);
            if (!result.contact) {
              out.arrive(row, result.cell, result.cells);
              continue;
            }
            const Contact<D> contact =
                vertex_contact(snapshot, particle.position, target, *result.contact, counts);
            out.meet(row, contact, result.cells);
            chunk.add(snapshot, row, contact);
            if constexpr (stops) stop_at_contact(snapshot, particle, target, contact, counts);
          }
          chunk.counts = counts;
        };
      });
}

void bind_particles(py::module_& module) {
  py::class_<Particles>(
      module, "Particles",
      "Points that remember their cells: a small move costs a few nanoseconds, for any size of the "
      "environment. Their positions always lie in their cells, in free space.")
      .def(py::init<std::shared_ptr<Shared_world>, const py::object&, int>(),
           py::arg("environment").none(false), py::arg("points"), py::kw_only(), py::arg("threads") = 0,
           "Locates the points (N, dimension). Points outside free space get no cell, and do not move.")
      .def("__len__", &Particles::size)
      .def_property_readonly(
          "environment",
          [](const Particles& self) { return std::const_pointer_cast<Shared_world>(self.environment()); },
          "The environment in which they lie.")
      .def_property_readonly(
          "positions", [](const py::object& self) { return self.cast<const Particles&>().positions(self); },
          "float64 (N, dimension): their positions, as a read-only view that changes as they move.")
      .def_property_readonly("cells", &Particles::cells,
                             "int32 (N,): their cells, numbered as in the file; -1 for none.")
      .def("move", &Particles::move, py::arg("targets"), py::kw_only(), py::arg("rows") = py::none(),
           py::arg("at_contact") = "stay", py::arg("threads") = 0,
           "Moves each particle to its target, or reports the wall that blocks it. Walls may be touched.\n\n"
           "rows: only these particles move, integers or a mask; `targets` and the result have a row for "
           "each.\n"
           "at_contact: \"stay\": a blocked particle stays in place; \"stop\": it moves up to the wall, to a "
           "position to which its whole path is free.\n"
           "threads: 0: all cores. The results do not depend on it.")
      .def("locate_again", &Particles::locate_again, py::kw_only(), py::arg("threads") = 0,
           "Finds their cells anew where they are, after walls moved by a reshape() in which they were not "
           "listed: until then they raise UsageError. One that walls passed may be on their other side now, "
           "or "
           "outside.")
      .def(py::pickle([](const Particles& self) { return self.state(); }, &Particles::of_state))
      .def("__repr__",
           [](const Particles& self) { return "<cellwalk.Particles, " + std::to_string(self.size()) + ">"; });
}

}  // namespace cellwalk::python
