// SPDX-License-Identifier: LGPL-3.0-or-later
// The layout of a row of a cell table, and the search for the facet or cell that a row names.
#include "cell_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

namespace cellwalk::python {
namespace {

constexpr std::int32_t no_number = -1;

/// Where the parts of a row lie. Coordinates come first, so that all are aligned.
struct Row_layout {
  std::size_t numbers, points, mark, size;
};

/// \param numbers before the points
Row_layout layout_of(std::size_t dimension, std::size_t numbers, std::size_t most_points) {
  Row_layout layout{};
  layout.numbers = dimension * sizeof(double);
  layout.points = layout.numbers + numbers * sizeof(std::int32_t);
  layout.mark = layout.points + most_points * sizeof(std::int32_t);
  layout.size = (layout.mark + sizeof(double)) / sizeof(double) * sizeof(double);
  return layout;
}

constexpr std::size_t numbers_of_facet = 3, numbers_of_cell = 1;

/// Fills a table, whose unused bytes are 0.
class Row_writer {
 public:
  Row_writer(Cell_table& table, std::size_t rows, std::size_t numbers)
      : layout_(layout_of(table.dimension, numbers, table.most_points)), table_(table) {
    table.row_size = layout_.size;
    table.rows.resize(rows * layout_.size);
  }

  template <std::size_t D, std::size_t N>
  void write(const std::array<double, D>& mean, const std::array<std::int32_t, N>& numbers,
             std::span<const std::uint32_t> points, bool mark) {
    std::uint8_t* const row = table_.rows.data() + next_++ * layout_.size;
    std::vector<std::int32_t> padded(points.begin(), points.end());
    padded.resize(table_.most_points, no_number);
    std::memcpy(row, mean.data(), sizeof mean);
    std::memcpy(row + layout_.numbers, numbers.data(), sizeof numbers);
    std::memcpy(row + layout_.points, padded.data(), padded.size() * sizeof(std::int32_t));
    row[layout_.mark] = mark;
  }

 private:
  Row_layout layout_;
  Cell_table& table_;
  std::size_t next_ = 0;
};

template <int D, class Visit>
void for_each_cell(const Snapshot<D>& snapshot, const Visit& visit) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell cell = snapshot.cell(i); cell != Cell::none) visit(cell);
}

/// \throw ValueError if there is no such cell
template <int D>
Cell cell_at(const Snapshot<D>& snapshot, std::int64_t number, const char* name, std::size_t row) {
  if (number >= 0 && static_cast<std::uint64_t>(number) < snapshot.cell_slots())
    if (const Cell cell = snapshot.cell(static_cast<std::size_t>(number)); cell != Cell::none) return cell;
  throw Row_error(fmt::format("{}[{}]: there is no cell {}", name, row, number));
}

/// True if the points given for a row are those of a loop or cell; also if none are given.
template <class Points>
bool has_points(const std::vector<std::int64_t>& given, std::size_t width, std::size_t row,
                const Points& points) {
  if (width == 0) return true;
  std::vector<std::int64_t> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  const auto first = given.begin() + static_cast<std::ptrdiff_t>(row * width);
  const auto last = first + static_cast<std::ptrdiff_t>(width);
  return std::equal(std::upper_bound(first, last, no_number), last, sorted.begin(), sorted.end());
}

std::vector<std::int64_t> integers(const py::object& of) {
  const auto all = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(of);
  return {all.data(), all.data() + all.size()};
}

/// The field `points` of an array, each row ascending; empty if there is none.
std::pair<std::vector<std::int64_t>, std::size_t> points_in(const py::array& array) {
  if (!has_field(array, "points")) return {};
  const py::array field = array.attr("__getitem__")("points");
  if (field.ndim() == 0 || array.size() == 0) return {};
  std::pair<std::vector<std::int64_t>, std::size_t> result{integers(field), 0};
  result.second = result.first.size() / static_cast<std::size_t>(array.size());
  for (auto row = result.first.begin(); row != result.first.end();
       row += static_cast<std::ptrdiff_t>(result.second))
    std::sort(row, row + static_cast<std::ptrdiff_t>(result.second));
  return result;
}

bool is_of_integers(const py::array& array) {
  return array.dtype().kind() == 'i' || array.dtype().kind() == 'u';
}

}  // namespace

bool has_field(const py::array& array, const char* field) {
  const py::object names = array.dtype().attr("names");
  return !names.is_none() && names.contains(field);
}

template <int D>
Cell_table cell_table_of(const Snapshot<D>& snapshot, std::span<const Half_facet> facets) {
  Cell_table table{true, D, D, 0, {}};
  if constexpr (D == 3)
    for_each_cell(snapshot, [&](Cell cell) {
      const Cell_view<D> view = snapshot.view(cell);
      for (std::size_t f = 0; f < view.facet_count(); ++f)
        table.most_points = std::max(table.most_points, view.loop(f).size());
    });
  Row_writer writer(table, facets.size(), numbers_of_facet);
  for (const Half_facet f : facets) {
    const Cell cell = snapshot.cell_of(f), other = snapshot.neighbour(f);
    const std::array numbers{
        static_cast<std::int32_t>(snapshot.index(cell)), static_cast<std::int32_t>(snapshot.facet_of(f)),
        other == Cell::none ? no_number : static_cast<std::int32_t>(snapshot.index(other))};
    writer.write(centroid(snapshot, f), numbers, snapshot.loop(f), snapshot.is_impassable(f));
  }
  return table;
}

template <int D>
Cell_table cell_table_of(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
  Cell_table table{false, D, D + 1, 0, {}};
  for_each_cell(snapshot, [&](Cell cell) {
    table.most_points = std::max(table.most_points, snapshot.view(cell).vertex_count());
  });
  Row_writer writer(table, cells.size(), numbers_of_cell);
  for (const Cell cell : cells)
    writer.write(centroid(snapshot, cell), std::array{static_cast<std::int32_t>(snapshot.index(cell))},
                 snapshot.view(cell).vertices, snapshot.is_solid(cell));
  return table;
}

template <int D>
Selection<D> all_of(const Snapshot<D>& snapshot) {
  Selection<D> all;
  for_each_cell(snapshot, [&](Cell cell) {
    all.cells.push_back(cell);
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      const Cell other = snapshot.neighbour(facet);
      if (other == Cell::none || snapshot.index(other) > snapshot.index(cell)) all.facets.push_back(facet);
    }
  });
  return all;
}

py::array to_array(const Cell_table& table) {
  const Row_layout layout =
      layout_of(table.dimension, table.of_facets ? numbers_of_facet : numbers_of_cell, table.most_points);
  py::list names, formats, offsets;
  const auto add = [&](const char* name, const py::object& format, std::size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  };
  const auto row = [](const char* type, std::size_t count) {
    return py::make_tuple(type, py::make_tuple(count));
  };
  const py::str number("i4");
  add("cell", number, layout.numbers);
  if (table.of_facets) {
    add("facet", number, layout.numbers + sizeof(std::int32_t));
    add("neighbour", number, layout.numbers + 2 * sizeof(std::int32_t));
  }
  add(table.of_facets ? "wall" : "solid", py::str("?"), layout.mark);
  add("mean", row("f8", table.dimension), 0);
  add("points", row("i4", table.most_points), layout.points);
  const py::dtype type(names, formats, offsets, static_cast<py::ssize_t>(layout.size));
  py::array result(type, static_cast<py::ssize_t>(table.rows.size() / table.row_size));
  std::copy(table.rows.begin(), table.rows.end(), static_cast<std::uint8_t*>(result.mutable_data()));
  return result;
}

Named_cells::Named_cells(const py::handle& argument, const char* name) : name_(name) {
  const py::array array = as_array(argument);
  if (has_field(array, "cell")) {
    cells_ = integers(array.attr("__getitem__")("cell"));
    std::tie(points_, width_) = points_in(array);
  } else if (is_of_integers(array) && array.ndim() <= 1) {
    cells_ = integers(array);
  } else if (is_of_integers(array)) {
    refuse_shape(name, shape_text(array), "(N,)");
  } else if (array.ndim() != 1 || array.size() != 0) {
    refuse_type(name, "integers (N,), or rows of cells()", argument);
  }
}

Named_facets::Named_facets(const py::handle& argument, const char* name) : name_(name) {
  const py::array array = as_array(argument);
  if (has_field(array, "cell") && has_field(array, "facet")) {
    cells_ = integers(array.attr("__getitem__")("cell"));
    facets_ = integers(array.attr("__getitem__")("facet"));
    std::tie(points_, width_) = points_in(array);
  } else if (is_of_integers(array) && (array.ndim() == 1 || array.ndim() == 2) &&
             array.shape(array.ndim() - 1) == 2) {
    const std::vector<std::int64_t> all = integers(array);
    for (std::size_t i = 0; i < all.size(); i += 2) {
      cells_.push_back(all[i]);
      facets_.push_back(all[i + 1]);
    }
  } else if (is_of_integers(array)) {
    refuse_shape(name, shape_text(array), "(N, 2)");
  } else if (array.size() != 0) {
    refuse_type(name, "integers (N, 2) of cells and numbers of facets in them, or rows of facets()",
                argument);
  }
}

template <int D>
Cell Named_cells::find(const Snapshot<D>& snapshot, std::size_t row) const {
  const Cell cell = cell_at(snapshot, cells_[row], name_, row);
  return has_points(points_, width_, row, snapshot.view(cell).vertices) ? cell : Cell::none;
}

template <int D>
Half_facet Named_facets::find(const Snapshot<D>& snapshot, std::size_t row) const {
  const Cell cell = cell_at(snapshot, cells_[row], name_, row);
  const std::int64_t facet = facets_[row];
  const std::size_t count = snapshot.facet_count(cell);
  if (facet < 0 || static_cast<std::uint64_t>(facet) >= count)
    throw Row_error(fmt::format("{}[{}]: cell {} has no facet {}, but {}, numbered from 0", name_, row,
                                cells_[row], facet, count));
  const Half_facet found = snapshot.half_facet(cell, static_cast<std::size_t>(facet));
  return has_points(points_, width_, row, snapshot.loop(found)) ? found : Half_facet::none;
}

#define CELLWALK_INSTANTIATE(D)                                                       \
  template Cell_table cell_table_of(const Snapshot<D>&, std::span<const Half_facet>); \
  template Cell_table cell_table_of(const Snapshot<D>&, std::span<const Cell>);       \
  template Selection<D> all_of(const Snapshot<D>&);                                   \
  template Cell Named_cells::find(const Snapshot<D>&, std::size_t) const;             \
  template Half_facet Named_facets::find(const Snapshot<D>&, std::size_t) const;
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::python
