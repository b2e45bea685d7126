// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits between the entry and the exit of a `with` block: arguments are checked before any change.
#include "edits.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "motions.h"

namespace cellwalk::python {
namespace {

/// \throw UsageError for cells that were replaced
template <int D, class Names>
auto find_one(const Snapshot<D>& snapshot, const Names& names, const char* name) {
  if (names.size() != 1)
    throw Error(Error_code::input, fmt::format("{} names {} of them: give one", name, names.size()));
  const auto found = names.find(snapshot, 0);
  if (found == std::remove_const_t<decltype(found)>::none)
    throw Error(Error_code::usage, fmt::format("{} was replaced by others: list them again", name));
  return found;
}

template <int D>
Blade<D> blade_of(const py::object& blade, const py::object& pieces, const py::object& sweep) {
  const auto points = points_of<D>(blade, "blade");
  if (!pieces.is_none() && !sweep.is_none())
    throw Error(Error_code::usage, "pieces and sweep exclude each other: give one");
  if (!sweep.is_none()) {
    if constexpr (D == 2)
      throw Error(Error_code::usage, "sweep is for 3D: in 2D the blade is a line");
    else
      return swept_blade(points, point_of<D>(sweep, "sweep") - Point<D>{});
  }
  if (pieces.is_none()) return blade_along<D>(points);
  const Index_table table = indices_of(pieces, "pieces", {D, D}, points.size());
  Blade<D> result;
  result.points.assign(points.begin(), points.end());
  for (std::size_t i = 0; i < table.size(); ++i)
    std::copy_n(table.row(i).begin(), D, result.pieces.emplace_back().begin());
  return result;
}

}  // namespace

void Edits::enter() {
  if (was_entered_) throw Error(Error_code::usage, "these edits were opened before: call editing() again");
  std::visit(
      [&]<int D>(World<D>& world) {
        const py::gil_scoped_release released;
        session_ = std::make_unique<Session<D>>(world, listed_);
      },
      *world_);
  was_entered_ = true;
  thread_ = std::this_thread::get_id();
}

template <class Work>
auto Edits::with_session(const Work& work) {
  if (std::holds_alternative<std::monostate>(session_))
    throw Error(Error_code::usage,
                "edits are made in a with statement: `with environment.editing() as edits`");
  if (thread_ != std::this_thread::get_id())
    throw Error(Error_code::usage, "another thread opened these edits: make them there");
  const auto visit = [&]<int D>(std::type_identity<Session<D>>) {
    return work(*std::get<std::unique_ptr<Session<D>>>(session_));
  };
  return world_->index() == 0 ? visit(std::type_identity<Session<2>>{})
                              : visit(std::type_identity<Session<3>>{});
}

void Edits::exit() {
  with_session([&](auto& session) {
    const py::gil_scoped_release released;
    const auto ended = std::exchange(session_, std::monostate{});
    session.reshaping().finish();
  });
}

/// Adds rows for all that forbids a change.
template <int D>
void add_held(const Listed_residents<D>& residents, const std::vector<Resident>& held_by, std::size_t row,
              std::vector<Held_row>& rows) {
  for (Resident resident : held_by) {
    residents.number(resident);
    rows.push_back({static_cast<std::uint32_t>(row),
                    resident.owner,
                    resident.number,
                    static_cast<std::uint8_t>(resident.feature),
                    resident.is_particle,
                    {}});
  }
}

/// Nothing is changed if an argument is wrong; names are looked up before.
template <class Names, class Change>
Changes Edits::change_all(const Names& names, const Change& change) {
  std::vector<Outcome> results;
  std::vector<Held_row> held;
  with_session([&]<int D>(Session<D>& session) {
    const py::gil_scoped_release released;
    using Name = decltype(names.find(session.snapshot(), 0));
    std::vector<Name> found;
    for (std::size_t i = 0; i < names.size(); ++i) found.push_back(names.find(session.snapshot(), i));
    for (const Name name : found) {
      Outcome& result = results.emplace_back();
      if (name == Name::none) {
        result.reason = "it was replaced by others";
        continue;
      }
      result = change(session.reshaping(), name);
      add_held(session.residents(), result.held_by, results.size() - 1, held);
    }
  });
  Changes changes{py::array_t<bool>(static_cast<py::ssize_t>(results.size())), py::list(),
                  to_array(std::move(held))};
  bool* const made = changes.made.mutable_data();
  for (std::size_t i = 0; i < results.size(); ++i) {
    made[i] = results[i].is_made;
    changes.reasons.append(results[i].reason);
  }
  return changes;
}

Changes Edits::open(const py::object& facets) {
  return change_all(Named_facets(facets, "facets"),
                    [](auto& to, Half_facet facet) { return to.open(facet); });
}
Changes Edits::close(const py::object& facets) {
  return change_all(Named_facets(facets, "facets"),
                    [](auto& to, Half_facet facet) { return to.close(facet); });
}
Changes Edits::excavate(const py::object& cells) {
  return change_all(Named_cells(cells, "cells"), [](auto& to, Cell cell) { return to.excavate(cell); });
}
Changes Edits::fill(const py::object& cells) {
  return change_all(Named_cells(cells, "cells"), [](auto& to, Cell cell) { return to.fill(cell); });
}

template <class Replace>
Replaced Edits::replace(const Replace& replace) {
  Replacement done;
  std::vector<std::int32_t> numbers;
  std::vector<Held_row> held;
  with_session([&](auto& session) {
    done = replace(session);
    add_held(session.residents(), done.held_by, 0, held);
    for (const Cell cell : done.cells) numbers.push_back(number_of(session.snapshot(), cell));
  });
  const bool has_point = done.point != Replacement::none;
  return {done.is_made, std::move(done.reason), to_array(std::move(numbers)),
          has_point ? py::object(py::int_(done.point)) : py::none(), to_array(std::move(held))};
}

Replaced Edits::insert_point(const py::object& cell, const py::object& position) {
  const Named_cells name(cell, "cell");
  return replace([&]<int D>(Session<D>& session) {
    const Point<D> at = point_of<D>(position, "position");
    const py::gil_scoped_release released;
    return session.reshaping().insert_point(find_one(session.snapshot(), name, "cell"), at);
  });
}

Replaced Edits::split_edge(std::uint32_t u, std::uint32_t v, const py::object& position) {
  return replace([&]<int D>(Session<D>& session) {
    const Point<D> at = point_of<D>(position, "position");
    const py::gil_scoped_release released;
    return session.reshaping().split_edge(u, v, at);
  });
}

Replaced Edits::flip(const py::object& facet) {
  const Named_facets name(facet, "facet");
  return replace([&](auto& session) {
    const py::gil_scoped_release released;
    return session.reshaping().flip(find_one(session.snapshot(), name, "facet"));
  });
}

Replaced Edits::remove_edge(std::uint32_t u, std::uint32_t v) {
  return replace([&](auto& session) {
    const py::gil_scoped_release released;
    return session.reshaping().remove_edge(u, v);
  });
}

Replaced Edits::collapse(std::uint32_t u, std::uint32_t onto) {
  return replace([&](auto& session) {
    const py::gil_scoped_release released;
    return session.reshaping().collapse(u, onto);
  });
}

Replaced Edits::merge_vertices(std::uint32_t point, std::uint32_t onto) {
  return replace([&](auto& session) {
    const py::gil_scoped_release released;
    return session.reshaping().merge_vertices(point, onto);
  });
}

Replaced Edits::split_vertex(std::uint32_t vertex, const py::object& cells, const py::object& target) {
  const Named_cells names(cells, "cells");
  return replace([&]<int D>(Session<D>& session) {
    const Point<D> to = point_of<D>(target, "target");
    const py::gil_scoped_release released;
    std::vector<Cell> solid;
    for (std::size_t i = 0; i < names.size(); ++i) {
      solid.push_back(names.find(session.snapshot(), i));
      if (solid.back() == Cell::none)
        throw Error(Error_code::usage, fmt::format("cells[{}] was replaced by others: list them again", i));
    }
    return session.reshaping().split_vertex(vertex, solid, to);
  });
}

Relax_report Edits::relax(const py::object& points, const Relax_options& options) {
  return with_session([&](auto& session) {
    const std::vector<std::uint32_t> numbers =
        numbers_of(points, "points", session.snapshot().points().size(), "points");
    const py::gil_scoped_release released;
    return session.reshaping().relax(numbers, options);
  });
}

Cut_made Edits::cut(const py::object& blade, const py::object& pieces, const py::object& sweep,
                    double opening, double snap) {
  Cut_report report = with_session([&]<int D>(Session<D>& session) {
    const Blade<D> along = blade_of<D>(blade, pieces, sweep);
    const py::gil_scoped_release released;
    return session.reshaping().cut(along, {.opening = opening, .snap = snap});
  });
  std::vector<Cut_point_row> rows;
  rows.reserve(report.points.size());
  for (const Cut_point& made : report.points)
    rows.push_back({made.share, {made.between[0], made.between[1]}, made.point});
  return {std::move(report), to_array(std::move(rows))};
}

py::dict Edits::counts() {
  return with_session([](auto& session) {
    const Reshape_counts& counts = session.reshaping().counts();
    py::dict result = to_dict(counts);
    result["walk"] = to_dict(counts.walk);
    return result;
  });
}

}  // namespace cellwalk::python
